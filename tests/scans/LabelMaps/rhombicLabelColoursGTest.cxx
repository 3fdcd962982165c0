#include "rhombicLabelColours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace
{

using rhombic::LabelColours;
using rhombic::LabelMap;

/** A map of 8 x 8 x 8 voxels in which every label touches others, at random. */
LabelMap
MakeMap(const std::vector<std::string> & names)
{
  using ImageType = rhombic::CartesianImage<std::uint8_t>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 8, 8, 8 } });
  image->Allocate();
  std::mt19937 random(3);
  std::uniform_int_distribution<int> value(0, static_cast<int>(names.size()));
  std::generate_n(image->GetBufferPointer(), 512, [&] { return static_cast<std::uint8_t>(value(random)); });
  LabelMap map;
  map.scan.image = ImageType::Pointer(image);
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    rhombic::LabelSummary summary;
    summary.label.value = static_cast<std::int32_t>(n + 1);
    summary.label.name = names[n];
    summary.label.colour = { 0, 255, 255 };
    map.labels.push_back(summary);
  }
  return map;
}

TEST(LabelColours, OfKnownNamesAreThoseOfAnatomy)
{
  for (const auto colours : { LabelColours::Anatomy, LabelColours::Table, LabelColours::ColourBlind })
  {
    LabelMap map = MakeMap({ "liver", "thing" });
    rhombic::ColourLabels(map, colours);
    const std::array<std::uint8_t, 3> cyan{ 0, 255, 255 };
    EXPECT_EQ(map.labels[0].label.colour == cyan, colours == LabelColours::Table);
    EXPECT_EQ(map.labels[1].label.colour == cyan, colours != LabelColours::ColourBlind);
    if (colours != LabelColours::Table)
    {
      EXPECT_NE(map.labels[1].label.colour, map.labels[0].label.colour);
    }
  }
}

TEST(LabelColours, OfLabelsThatTouchDiffer)
{
  // All of one colour in the table, and in the map all pairs touch.
  for (const auto colours : { LabelColours::Anatomy, LabelColours::ColourBlind })
  {
    LabelMap map = MakeMap({ "a", "b", "c", "lung_upper_lobe_left", "lung_lower_lobe_left", "liver", "liver_2" });
    rhombic::ColourLabels(map, colours);
    std::set<std::array<std::uint8_t, 3>> different;
    for (const auto & summary : map.labels)
    {
      different.insert(summary.label.colour);
    }
    EXPECT_EQ(different.size(), map.labels.size());
  }
}

/** Two balls about one middle, each in a layer of its own: a lump of value 1 in a bulk of value 2. */
LabelMap
MakeLayers(bool isLumpFirst)
{
  using ImageType = rhombic::CartesianImage<std::uint8_t>;
  const auto makeLayer = [](int radius, std::uint8_t value) {
    const auto image = ImageType::New();
    image->SetRegions(itk::Size<3>{ { 40, 40, 40 } });
    image->Allocate();
    for (int n = 0; n < 40 * 40 * 40; ++n)
    {
      const bool isInside = std::hypot(n % 40 - 19.5, n / 40 % 40 - 19.5, n / 1600 - 19.5) < radius;
      image->GetBufferPointer()[n] = isInside ? value : 0;
    }
    return ImageType::Pointer(image);
  };
  LabelMap map;
  map.scan.image = isLumpFirst ? makeLayer(5, 1) : makeLayer(12, 2);
  map.scan.furtherLayers = { isLumpFirst ? makeLayer(12, 2) : makeLayer(5, 1) };
  map.labels.resize(2);
  map.labels[0].label = { 1, "lump", { 10, 200, 30 } };
  map.labels[1].label = { 2, "bulk", { 10, 200, 30 } };
  return map;
}

TEST(LabelColours, OfLabelsThatOverlapDiffer)
{
  for (const bool isLumpFirst : { false, true })
  {
    LabelMap map = MakeLayers(isLumpFirst);
    rhombic::ColourLabels(map, LabelColours::Anatomy);
    EXPECT_NE(map.labels[0].label.colour, map.labels[1].label.colour);
  }
}

} // namespace
