#include "rhombicDrawnMaps.h"

#include "itkMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace rhombic
{
namespace
{

using Position = std::array<double, 3>; ///< in pixels, from the first voxel

/** The depth of a position below the surface of a shape, in pixels. */
using Shape = std::function<double(const Position &)>;

/** A number of [0, 1), the same with every compiler. */
double
Uniform(std::mt19937 & random)
{
  return static_cast<double>(random()) / 4294967296.0;
}

/** By how far a hand is off the border in one slice, in pixels: smooth, at most a half. */
class Hand
{
public:
  explicit Hand(std::mt19937 & random)
  {
    for (Wave & wave : m_Waves)
    {
      constexpr double shortest = 12.0; // pixels
      constexpr double longest = 48.0;
      const double direction = 2.0 * itk::Math::pi * Uniform(random);
      const double number = 2.0 * itk::Math::pi / (shortest + (longest - shortest) * Uniform(random));
      wave = { number * std::cos(direction), number * std::sin(direction), 2.0 * itk::Math::pi * Uniform(random) };
    }
  }

  double
  operator()(const Position & position) const
  {
    double sum = 0.0;
    for (const Wave & wave : m_Waves)
    {
      sum += std::sin(wave[0] * position[0] + wave[1] * position[1] + wave[2]);
    }
    return 0.5 * sum / static_cast<double>(m_Waves.size());
  }

private:
  using Wave = std::array<double, 3>; // along x and y, phase
  std::array<Wave, 4> m_Waves;
};

Shape
MakeEllipsoid(const Position & centre, const Position & radii)
{
  const double smallest = *std::min_element(radii.begin(), radii.end());
  return [=](const Position & position) {
    double sum = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double share = (position[axis] - centre[axis]) / radii[axis];
      sum += share * share;
    }
    return smallest * (1.0 - std::sqrt(sum));
  };
}

/** A shape whose surface goes up and down in waves of some length along each axis. */
Shape
Fold(const Shape & shape, double depth, double length)
{
  return [=](const Position & position) {
    const double number = 2.0 * itk::Math::pi / length;
    const double waves = std::sin(number * position[0]) * std::cos(number * position[1]) +
                         std::sin(number * position[1]) * std::cos(number * position[2]) +
                         std::sin(number * position[2]) * std::cos(number * position[0]);
    return shape(position) + depth * waves;
  };
}

/** Draws shapes as labels from 1; of several at a place the last one is seen. */
DrawnMap::Pointer
Draw(const DrawnMap::SizeType & size, const DrawnMap::SpacingType & spacing, const std::vector<Shape> & shapes)
{
  constexpr double border = 0.5; // pixels on either side
  constexpr double flipped = 0.05;
  std::mt19937 random(37);
  const auto map = DrawnMap::New();
  map->SetRegions(size);
  map->SetSpacing(spacing);
  map->Allocate(true);
  std::uint16_t * voxel = map->GetBufferPointer();
  for (itk::SizeValueType z = 0; z < size[2]; ++z)
  {
    std::vector<Hand> hands;
    for (std::size_t n = 0; n < shapes.size(); ++n)
    {
      hands.emplace_back(random);
    }
    for (itk::SizeValueType y = 0; y < size[1]; ++y)
    {
      for (itk::SizeValueType x = 0; x < size[0]; ++x, ++voxel)
      {
        const Position position{ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) };
        for (std::size_t n = 0; n < shapes.size(); ++n)
        {
          const double depth = shapes[n](position);
          if (depth < -2.0 * border)
          {
            continue; // where no hand puts the border
          }
          const double drawn = depth + hands[n](position);
          const bool isFlipped = std::abs(drawn) < border && Uniform(random) < flipped;
          *voxel = (drawn >= 0.0) != isFlipped ? static_cast<std::uint16_t>(n + 1) : *voxel;
        }
      }
    }
  }
  return map;
}

} // namespace

DrawnMap::Pointer
DrawThickOrgans()
{
  const std::vector<Shape> organs{
    MakeEllipsoid({ 120.0, 140.0, 55.0 }, { 85.0, 75.0, 18.0 }), // liver
    MakeEllipsoid({ 300.0, 190.0, 58.0 }, { 38.0, 48.0, 12.0 }), // spleen
    MakeEllipsoid({ 120.0, 225.0, 36.0 }, { 33.0, 30.0, 11.0 }), // kidneys
    MakeEllipsoid({ 265.0, 225.0, 38.0 }, { 33.0, 30.0, 11.0 }),
    MakeEllipsoid({ 250.0, 120.0, 58.0 }, { 55.0, 40.0, 12.0 }), // stomach
    MakeEllipsoid({ 205.0, 160.0, 46.0 }, { 60.0, 14.0, 4.5 }),  // pancreas
    MakeEllipsoid({ 145.0, 90.0, 44.0 }, { 20.0, 22.0, 6.0 }),   // gallbladder
    MakeEllipsoid({ 200.0, 210.0, 45.0 }, { 14.0, 14.0, 42.0 }), // aorta
    MakeEllipsoid({ 170.0, 208.0, 45.0 }, { 13.0, 11.0, 40.0 }), // vein
    MakeEllipsoid({ 190.0, 140.0, 14.0 }, { 46.0, 40.0, 9.0 }),  // bladder
    MakeEllipsoid({ 190.0, 120.0, 30.0 }, { 90.0, 38.0, 8.0 }),  // bowel
  };
  DrawnMap::SpacingType spacing;
  spacing[0] = 0.78;
  spacing[1] = 0.78;
  spacing[2] = 5.0;
  return Draw({ { 384, 320, 89 } }, spacing, organs);
}

DrawnMap::Pointer
DrawNestedTissues()
{
  const Position centre{ 103.0, 128.0, 107.0 };
  const std::vector<Shape> tissues{
    MakeEllipsoid(centre, { 88.0, 112.0, 92.0 }),                  // fluid
    Fold(MakeEllipsoid(centre, { 80.0, 104.0, 84.0 }), 3.0, 22.0), // grey matter
    Fold(MakeEllipsoid(centre, { 70.0, 93.0, 74.0 }), 5.0, 22.0),  // white matter
  };
  DrawnMap::SpacingType spacing;
  spacing.Fill(1.0);
  return Draw({ { 207, 256, 215 } }, spacing, tissues);
}

} // namespace rhombic
