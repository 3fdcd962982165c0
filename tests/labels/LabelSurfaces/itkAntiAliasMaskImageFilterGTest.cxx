#include "itkAntiAliasMaskImageFilter.h"

#include "itkCommand.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

namespace
{

using MaskType = itk::Image<std::uint8_t, 3>;
using FieldType = itk::Image<float, 3>;
using Filter = itk::AntiAliasMaskImageFilter;
using Index = itk::Index<3>;

template <typename TInside>
MaskType::Pointer
MakeMask(const itk::Size<3> & size, const TInside & inside)
{
  const auto mask = MaskType::New();
  mask->SetRegions(size);
  mask->Allocate();
  for (itk::ImageRegionIteratorWithIndex<MaskType> it(mask, mask->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(inside(it.GetIndex()) ? 1 : 0);
  }
  return mask;
}

/** Smooth blobs, with noise on them. */
MaskType::Pointer
MakeBlobs(unsigned int seed, const itk::Size<3> & size = { { 37, 29, 23 } })
{
  std::mt19937 random(seed);
  return MakeMask(size, [&](const Index & index) {
    const double wave = std::sin(0.4 * static_cast<double>(index[0])) + std::cos(0.5 * static_cast<double>(index[1])) +
                        std::sin(0.6 * static_cast<double>(index[2]));
    return wave + 0.01 * static_cast<double>(random() % 100) > 1.2;
  });
}

FieldType::Pointer
MakeField(MaskType * mask, itk::ThreadIdType threads = 0)
{
  const auto filter = Filter::New();
  filter->SetInput(mask);
  if (threads > 0)
  {
    filter->SetNumberOfWorkUnits(threads);
  }
  filter->Update();
  return filter->GetOutput();
}

/** Calls \a check(index, value of the mask, value of the field). */
template <typename TCheck>
void
ForEachVoxel(const MaskType & mask, const FieldType & field, const TCheck & check)
{
  for (itk::ImageRegionConstIteratorWithIndex<MaskType> it(&mask, mask.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    check(it.GetIndex(), it.Get(), field.GetPixel(it.GetIndex()));
  }
}

TEST(AntiAliasMask, APlaneBetweenVoxelsStaysThere)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto mask = MakeMask({ { 20, 20, 20 } }, [axis](const Index & index) { return index[axis] >= 10; });
    ForEachVoxel(*mask, *MakeField(mask), [axis](const Index & index, std::uint8_t, float value) {
      const double depth = static_cast<double>(index[axis]) - 9.5;
      if (std::abs(depth) < 2.0)
      {
        EXPECT_NEAR(value, depth, 0.15);
      }
    });
  }
}

TEST(AntiAliasMask, MasksOfOneValueAreFarFromAnyBorder)
{
  for (const bool isInside : { false, true })
  {
    const auto mask = MakeMask({ { 5, 4, 3 } }, [isInside](const Index &) { return isInside; });
    ForEachVoxel(*mask, *MakeField(mask), [isInside](const Index &, std::uint8_t, float value) {
      EXPECT_GT(isInside ? value : -value, 2.5f);
    });
  }
}

TEST(AntiAliasMask, InsideAndOutsideAreTreatedAlike)
{
  // A ball of radius 9 and a gap of two voxels through it: nothing that tubes would be put around.
  const auto isInside = [](const Index & index) {
    const auto square = [](itk::IndexValueType x) { return static_cast<double>((x - 14) * (x - 14)); };
    return square(index[0]) + square(index[1]) + square(index[2]) <= 81.0;
  };
  const auto mask = MakeMask({ { 29, 29, 29 } }, isInside);
  const auto opposite = MakeMask({ { 29, 29, 29 } }, [&](const Index & index) { return !isInside(index); });
  const auto field = MakeField(mask);
  ForEachVoxel(*mask, *MakeField(opposite), [&](const Index & index, std::uint8_t, float value) {
    EXPECT_NEAR(value, -field->GetPixel(index), 1e-4);
  });
}

TEST(AntiAliasMask, CoversLocallyWhatTheMaskCovers)
{
  const auto mask = MakeBlobs(1);
  double covered = 0.0;
  double inside = 0.0;
  ForEachVoxel(*mask, *MakeField(mask), [&](const Index &, std::uint8_t value, float depth) {
    covered += std::clamp(static_cast<double>(depth) + 0.5, 0.0, 1.0);
    inside += value;
  });
  EXPECT_NEAR(covered / inside, 1.0, 0.02);
}

TEST(AntiAliasMask, SingleVoxelsAndDiagonalLinesStayInside)
{
  const auto mask = MakeMask({ { 30, 30, 30 } }, [](const Index & index) {
    return (index[0] == 4 && index[1] == 20 && index[2] == 5) ||
           (index[0] >= 6 && index[0] < 26 && index[1] == index[0] && index[2] == 31 - index[0]);
  });
  const auto filter = Filter::New();
  filter->SetInput(mask);
  filter->Update();
  ForEachVoxel(*mask, *filter->GetOutput(), [](const Index &, std::uint8_t value, float depth) {
    EXPECT_EQ(value != 0, depth > 0.0f);
  });
  EXPECT_EQ(filter->GetThinVoxels().size(), 21);
  EXPECT_EQ(filter->GetProtectedVoxels().size(), 21);
}

TEST(AntiAliasMask, SpursGoAndBridgesStay)
{
  const auto isBlock = [](const Index & index) {
    return index[1] >= 8 && index[1] < 24 && index[2] >= 8 && index[2] < 24 &&
           ((index[0] >= 6 && index[0] < 14) || (index[0] >= 15 && index[0] < 24));
  };
  const Index spur{ { 24, 16, 16 } };
  const Index bridge{ { 14, 16, 16 } };
  const auto mask = MakeMask({ { 32, 32, 32 } },
                             [&](const Index & index) { return isBlock(index) || index == spur || index == bridge; });
  const auto filter = Filter::New();
  filter->SetInput(mask);
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetPixel(spur), 0.3f);
  EXPECT_GT(filter->GetOutput()->GetPixel(bridge), 0.0f);
}

TEST(AntiAliasMask, HasTheSameBytesForAnyNumberOfThreads)
{
  const auto mask = MakeBlobs(2, { { 37, 29, 120 } });
  const auto one = MakeField(mask, 1);
  const auto many = MakeField(mask, 7);
  const auto bytes = one->GetBufferedRegion().GetNumberOfPixels() * sizeof(float);
  EXPECT_EQ(std::memcmp(one->GetBufferPointer(), many->GetBufferPointer(), bytes), 0);
}

TEST(AntiAliasMask, TheFieldMovesWithTheMask)
{
  // Planes are smoothed some at a time: the same mask lies otherwise among them.
  constexpr itk::SizeValueType depth = 130;
  const auto blobs = MakeBlobs(3, { { 37, 29, depth } });
  const auto shifted = [&](itk::IndexValueType planes) {
    return MakeMask({ { 37, 29, depth + 80 } }, [&](const Index & index) {
      const Index before{ { index[0], index[1], index[2] - planes } };
      return before[2] >= 0 && blobs->GetBufferedRegion().IsInside(before) && blobs->GetPixel(before) != 0;
    });
  };
  const auto field = MakeField(shifted(20));
  for (const itk::IndexValueType planes : { 31, 37, 52 })
  {
    const auto moved = MakeField(shifted(planes));
    ForEachVoxel(*blobs, *field, [&](const Index & index, std::uint8_t, float) {
      const Index there{ { index[0], index[1], index[2] + planes } };
      EXPECT_EQ(moved->GetPixel(there), field->GetPixel({ { index[0], index[1], index[2] + 20 } })) << there;
    });
  }
}

TEST(AntiAliasMask, WhereItIsNeededTheFieldIsThatOfTheWholeMask)
{
  const auto mask = MakeMask({ { 60, 40, 40 } }, [](const Index & index) {
    return std::hypot(double(index[0] - 30), double(index[1] - 20), double(index[2] - 20)) < 14.0;
  });
  const auto whole = MakeField(mask);
  const auto filter = Filter::New();
  filter->SetInput(mask);
  filter->SetNeeded([](const Index & first, itk::SizeValueType) { return first[0] >= 16 && first[2] >= 10; });
  filter->Update();
  ForEachVoxel(*mask, *filter->GetOutput(), [&](const Index & index, std::uint8_t isInside, float value) {
    if (index[0] >= 16 && index[2] >= 14) // four voxels from where it is not needed
    {
      EXPECT_NEAR(std::clamp(value, -2.5f, 2.5f), std::clamp(whole->GetPixel(index), -2.5f, 2.5f), 0.02);
    }
    else if (index[0] < 16 || index[2] < 10)
    {
      EXPECT_GT(isInside != 0 ? value : -value, 2.5f);
    }
  });
}

TEST(AntiAliasMask, KeepsTheGeometry)
{
  const auto mask = MakeBlobs(3);
  mask->SetRegions(MaskType::RegionType({ { -5, 7, 100 } }, { { 37, 29, 23 } }));
  const double spacing[3] = { 0.8, 0.8, 5.0 };
  mask->SetSpacing(spacing);
  const auto field = MakeField(mask);
  EXPECT_EQ(field->GetBufferedRegion(), mask->GetBufferedRegion());
  EXPECT_EQ(field->GetSpacing(), mask->GetSpacing());
}

TEST(AntiAliasMask, CanBeAborted)
{
  const auto filter = Filter::New();
  filter->SetInput(MakeBlobs(4));
  filter->AddObserver(itk::ProgressEvent(), [&filter](const itk::EventObject &) {
    if (filter->GetProgress() > 0.0f)
    {
      filter->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
}

TEST(AntiAliasMask, Prints)
{
  std::ostringstream text;
  Filter::New()->Print(text);
  EXPECT_NE(text.str().find("ProtectSpecksOnly: Off"), std::string::npos);
}

} // namespace
