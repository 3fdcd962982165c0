#include "rhombicColour.h"
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

/** The distance in CIELAB (D65). */
double
DistanceInLab(const std::array<std::uint8_t, 3> & first, const std::array<std::uint8_t, 3> & second)
{
  const auto toLab = [](const std::array<std::uint8_t, 3> & colour) {
    std::array<double, 3> rgb;
    std::transform(
      colour.begin(), colour.end(), rgb.begin(), [](std::uint8_t byte) { return rhombic::SRGBToLinear(byte / 255.0); });
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
    const double x = f((0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2]) / 0.95047);
    const double y = f(0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2]);
    const double z = f((0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2]) / 1.08883);
    return std::array<double, 3>{ 116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z) };
  };
  const auto a = toLab(first);
  const auto b = toLab(second);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(LabelColours, OfUnknownLabelsThatTouchAreToldApart)
{
  std::vector<std::string> names{ "left thing", "right thing", "left other", "right other" };
  for (int n = 0; n < 8; ++n)
  {
    names.push_back("unit " + std::string(1, static_cast<char>('a' + n)));
  }
  LabelMap map = MakeMap(names);
  for (auto & summary : map.labels)
  {
    summary.label.colour = rhombic::AnatomicalColour(summary.label.name, summary.label.value);
  }
  rhombic::ColourLabels(map, LabelColours::Anatomy);
  for (std::size_t a = 0; a < map.labels.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_GE(DistanceInLab(map.labels[a].label.colour, map.labels[b].label.colour), 5.0)
        << names[a] << ", " << names[b];
    }
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
