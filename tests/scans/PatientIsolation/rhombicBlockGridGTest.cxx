#include "rhombicBlockGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace
{

using ImageType = itk::Image<float, 3>;

ImageType::Pointer
MakeImage(const itk::Size<3> & size)
{
  const auto image = ImageType::New();
  image->SetRegions(size);
  image->Allocate(true);
  return image;
}

TEST(BlockSamples, EachSampleIsInOneBlock)
{
  const itk::Size<3> size{ { 7, 6, 5 } };
  const rhombic::BlockShape shape{ 3, 2, 2 };
  const itk::Size<3> blocks{ { 3, 3, 3 } };
  const auto image = MakeImage(size);
  rhombic::ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    const auto block = index[0] / 3 + 3 * (index[1] / 2 + 3 * (index[2] / 2));
    image->GetBufferPointer()[offset] = static_cast<float>(block);
  });
  struct Sums
  {
    float lowest = 1e9f;
    float highest = -1e9f;
    std::size_t count = 0;
  };
  std::vector<Sums> stored(27);
  std::vector<std::size_t> samples(27, 0);
  rhombic::SumBlocks<Sums>(
    *image,
    shape,
    blocks,
    [](Sums & sums, float value) {
      sums.lowest = std::min(sums.lowest, value);
      sums.highest = std::max(sums.highest, value);
      ++sums.count;
    },
    [&](std::size_t block, const Sums & sums, std::size_t count) {
      stored[block] = sums;
      samples[block] = count;
    });
  std::size_t total = 0;
  for (std::size_t block = 0; block < 27; ++block)
  {
    EXPECT_EQ(stored[block].lowest, static_cast<float>(block));
    EXPECT_EQ(stored[block].highest, static_cast<float>(block));
    EXPECT_EQ(stored[block].count, samples[block]);
    total += samples[block];
  }
  EXPECT_EQ(total, 7u * 6u * 5u);
}

// Both kinds of interpolation reproduce what is linear, but for the outer blocks.
TEST(BlockSamples, LinearFieldsAreInterpolatedExactly)
{
  const itk::Size<3> blocks{ { 6, 5, 4 } };
  constexpr std::size_t samplesPerBlock = 3;
  const auto field = MakeImage(blocks);
  rhombic::ForEachIndex(blocks, [&](const itk::Index<3> & index, std::size_t offset) {
    field->GetBufferPointer()[offset] = static_cast<float>(index[0] + 2 * index[1] - 3 * index[2]);
  });
  const auto positionOf = [](std::size_t sample) {
    return (static_cast<double>(sample) + 0.5) / static_cast<double>(samplesPerBlock) - 0.5;
  };
  for (std::size_t i = 3; i < 15; ++i)
  {
    for (std::size_t j = 3; j < 12; ++j)
    {
      for (std::size_t k = 3; k < 9; ++k)
      {
        const double expected = positionOf(i) + 2.0 * positionOf(j) - 3.0 * positionOf(k);
        const auto linear = [&](std::size_t sample, unsigned int axis) {
          return rhombic::LinearTaps(static_cast<double>(sample) + 0.5, samplesPerBlock, blocks[axis]);
        };
        const auto quadratic = [&](std::size_t sample, unsigned int axis) {
          return rhombic::QuadraticTaps(sample, samplesPerBlock, blocks[axis]);
        };
        EXPECT_NEAR(
          rhombic::InterpolateInRow(rhombic::InterpolateRow(*field, linear(j, 1), linear(k, 2)), linear(i, 0)),
          expected,
          1e-5);
        EXPECT_NEAR(
          rhombic::InterpolateInRow(rhombic::InterpolateRow(*field, quadratic(j, 1), quadratic(k, 2)), quadratic(i, 0)),
          expected,
          1e-5);
      }
    }
  }
}

TEST(BlockGrid, NeighboursStayInTheGrid)
{
  const itk::Size<3> size{ { 3, 3, 1 } };
  const auto mask = rhombic::MakeMask(*MakeImage(size), [](std::size_t offset) { return offset == 0; });
  std::vector<std::size_t> faceNeighbours;
  std::vector<bool> isNear;
  rhombic::ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    faceNeighbours.push_back(0);
    rhombic::ForEachFaceNeighbour(size, index, offset, [&](std::size_t neighbour) {
      EXPECT_LT(neighbour, 9u);
      ++faceNeighbours.back();
    });
    isNear.push_back(rhombic::IsNear(*mask, offset));
  });
  EXPECT_EQ(faceNeighbours, (std::vector<std::size_t>{ 2, 3, 2, 3, 4, 3, 2, 3, 2 }));
  EXPECT_EQ(isNear, (std::vector<bool>{ true, true, false, true, true, false, false, false, false }));
}

TEST(BlockGrid, DistancesAreThoseToTheNearestBlock)
{
  std::mt19937 random(1);
  const auto grid = MakeImage({ { 17, 9, 12 } });
  const double spacing[3] = { 3.0, 2.5, 4.0 };
  grid->SetSpacing(spacing);
  constexpr double reach = 11.0;
  for (const unsigned int share : { 0u, 1u, 30u })
  {
    const auto mask = rhombic::MakeMask(*grid, [&](std::size_t) { return random() % 1000 < share; });
    const auto distances = rhombic::DistanceTo(*mask, reach);
    const auto & size = grid->GetBufferedRegion().GetSize();
    rhombic::ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
      double expected = reach;
      rhombic::ForEachIndex(size, [&](const itk::Index<3> & other, std::size_t otherOffset) {
        if (mask->GetBufferPointer()[otherOffset] != 0)
        {
          expected = std::min(expected,
                              std::hypot(3.0 * static_cast<double>(index[0] - other[0]),
                                         2.5 * static_cast<double>(index[1] - other[1]),
                                         4.0 * static_cast<double>(index[2] - other[2])));
        }
      });
      EXPECT_NEAR(distances->GetBufferPointer()[offset], expected, 1e-5);
    });
  }
}

} // namespace
