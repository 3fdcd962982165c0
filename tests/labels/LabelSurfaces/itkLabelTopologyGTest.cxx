#include "itkLabelTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace
{

using Topology = itk::LabelTopology;
using Region = itk::ImageRegion<3>;

/** Labels with random weights in boxes, label 0 everywhere, and the topology that assigns them. */
struct Labels
{
  explicit Labels(unsigned int seed)
  {
    const itk::Size<3> size{ { 12, 20, 20 } };
    boxes = { Region(size),
              { { { 1, 2, 3 } }, { { 8, 9, 10 } } },
              { { { 4, 8, 2 } }, { { 8, 10, 9 } } },
              { { { 2, 4, 9 } }, { { 7, 12, 10 } } } };
    labels->SetRegions(size);
    labels->Allocate();
    weights->SetNumberOfRows(size[1] * size[2]);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> weightOf(-2.0f, 2.0f);
    for (itk::SizeValueType site = 0; site < boxes[0].GetNumberOfPixels(); ++site)
    {
      const itk::Index<3> index = labels->ComputeIndex(static_cast<itk::OffsetValueType>(site));
      float strongest = -itk::FCCLabelWeights::Limit;
      for (Topology::LabelType label = 0; label < boxes.size(); ++label)
      {
        if (boxes[label].IsInside(index))
        {
          const float weight = weightOf(random);
          weights->Add(site / size[0], { static_cast<std::uint16_t>(index[0]), label, weight });
          labels->GetBufferPointer()[site] = weight > strongest ? label : labels->GetBufferPointer()[site];
          strongest = std::max(strongest, weight);
        }
      }
    }
    for (itk::SizeValueType row = 0; row < weights->GetNumberOfRows(); ++row)
    {
      weights->SortRow(row);
    }
    topology.emplace(*labels, *weights, groups, [](const itk::Point<double, 3> &) { return false; });
    topology->Assign({});
  }

  std::vector<Topology::LabelType>
  GetLabels() const
  {
    return { labels->GetBufferPointer(), labels->GetBufferPointer() + boxes[0].GetNumberOfPixels() };
  }

  std::vector<Region> boxes; ///< by label
  Topology::LatticeType::Pointer labels = Topology::LatticeType::New();
  itk::FCCLabelWeights::Pointer weights = itk::FCCLabelWeights::New();
  std::vector<Topology::LabelType> groups;
  std::optional<Topology> topology;
};

TEST(LabelTopology, OffsetsByBoxesChangeWhatOffsetsOfTheWholeLatticeChange)
{
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    Labels byBoxes(seed);
    Labels whole(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offsetOf(-0.8, 0.8);
    std::size_t changed = 0;
    for (unsigned int round = 0; round < 8; ++round)
    {
      std::vector<double> offsets(4);
      offsets[1 + random() % 3] = offsetOf(random);
      offsets[round == 0 ? 3 : 1 + random() % 3] = offsetOf(random);
      const auto before = whole.GetLabels();
      whole.topology->AddOffsets(offsets);
      byBoxes.topology->AddOffsets(offsets, byBoxes.boxes);
      const auto after = whole.GetLabels();
      changed += before != after ? 1 : 0;
      ASSERT_EQ(byBoxes.GetLabels(), after) << seed << ' ' << round;
      for (itk::SizeValueType row = 0; row < whole.weights->GetNumberOfRows(); ++row)
      {
        const auto isSame = [](const auto & a, const auto & b) {
          return a.i == b.i && a.label == b.label && a.weight == b.weight;
        };
        const auto & some = byBoxes.weights->GetRow(row);
        const auto & all = whole.weights->GetRow(row);
        ASSERT_TRUE(std::equal(some.begin(), some.end(), all.begin(), all.end(), isSame)) << seed << ' ' << row;
      }
    }
    EXPECT_GT(changed, 0u) << seed;
  }
}

} // namespace
