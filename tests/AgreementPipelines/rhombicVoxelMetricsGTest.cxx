#include "rhombicVoxelMetrics.h"

#include "rhombicLabelScan.h"

#include <gtest/gtest.h>

#include <vtkCell.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace
{

using rhombic::VoxelMetrics;
using rhombictest::At;
using rhombictest::Ball;
using rhombictest::LabelGrid;
using rhombictest::LabelImage;
using rhombictest::MakeLabelScan;
using Corner = std::array<int, 3>;

/** The area of the isosurface that VTK's filter finds among eight values, of which some are inside. */
double
AreaOf(const std::array<bool, 8> & isInside, const std::array<double, 3> & spacing)
{
  const bool isComplemented = std::count(isInside.begin(), isInside.end(), true) > 4;
  const vtkNew<vtkImageData> cube;
  cube->SetDimensions(2, 2, 2);
  cube->SetSpacing(spacing[0], spacing[1], spacing[2]);
  cube->AllocateScalars(VTK_DOUBLE, 1);
  for (std::size_t n = 0; n < 8; ++n)
  {
    *static_cast<double *>(cube->GetScalarPointer(n & 1u, n >> 1 & 1u, n >> 2 & 1u)) =
      isInside[n] != isComplemented ? 1.0 : 0.0;
  }
  const vtkNew<vtkMarchingCubes> filter;
  filter->SetInputData(cube);
  filter->SetValue(0, 0.5);
  filter->Update();
  double area = 0.0;
  for (vtkIdType n = 0; n < filter->GetOutput()->GetNumberOfCells(); ++n)
  {
    area += static_cast<vtkTriangle *>(filter->GetOutput()->GetCell(n))->ComputeArea();
  }
  return area;
}

/** The corners on the border of a mask, and their areas. */
std::map<Corner, double>
BorderOf(const LabelImage & mask, const std::array<double, 3> & spacing)
{
  std::map<Corner, double> border;
  const auto size = mask.GetLargestPossibleRegion().GetSize();
  for (int z = 0; z <= static_cast<int>(size[2]); ++z)
  {
    for (int y = 0; y <= static_cast<int>(size[1]); ++y)
    {
      for (int x = 0; x <= static_cast<int>(size[0]); ++x)
      {
        std::array<bool, 8> isInside{};
        for (int n = 0; n < 8; ++n)
        {
          const itk::Index<3> voxel{ { x - 1 + (n & 1), y - 1 + (n >> 1 & 1), z - 1 + (n >> 2 & 1) } };
          isInside[static_cast<std::size_t>(n)] =
            mask.GetLargestPossibleRegion().IsInside(voxel) && mask.GetPixel(voxel) == 1;
        }
        const auto count = std::count(isInside.begin(), isInside.end(), true);
        if (count > 0 && count < 8)
        {
          border[{ x, y, z }] = AreaOf(isInside, spacing);
        }
      }
    }
  }
  return border;
}

/** The published algorithm, as slow as can be. */
struct SlowMetrics
{
  SlowMetrics(const std::map<Corner, double> & from,
              const std::map<Corner, double> & to,
              const std::array<double, 3> & spacing)
  {
    for (const auto & [corner, area] : from)
    {
      double nearest = 1e300;
      for (const auto & [other, ignored] : to)
      {
        nearest = std::min(nearest,
                           std::hypot(spacing[0] * (corner[0] - other[0]),
                                      spacing[1] * (corner[1] - other[1]),
                                      spacing[2] * (corner[2] - other[2])));
      }
      distances.emplace_back(nearest, area);
      whole += area;
      mean += nearest * area;
    }
    mean /= whole;
    std::sort(distances.begin(), distances.end());
  }

  double
  Percentile(double share) const
  {
    double sum = 0.0;
    for (const auto & [distance, area] : distances)
    {
      sum += area;
      if (sum / whole >= share)
      {
        return distance;
      }
    }
    return distances.back().first;
  }

  double
  AreaWithin(double tolerance) const
  {
    double sum = 0.0;
    for (const auto & [distance, area] : distances)
    {
      sum += distance <= tolerance ? area : 0.0;
    }
    return sum;
  }

  std::vector<std::pair<double, double>> distances;
  double whole = 0.0;
  double mean = 0.0;
};

/** Lumps of random voxels, some of them at the border of the grid. */
TEST(VoxelMetrics, AreThoseOfThePublishedAlgorithm)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int pair = 0; pair < 50; ++pair)
  {
    const LabelGrid grid{ { { 5, 6, 4 } },
                          { 0.5 + uniform(random), 0.5 + uniform(random), 1.0 + 3.0 * uniform(random) } };
    const double share = 0.1 + 0.8 * uniform(random);
    const auto noise = [&](const itk::Point<double, 3> &) { return uniform(random) < share ? 1 : 0; };
    const rhombic::Scan first = MakeLabelScan(grid, noise);
    const rhombic::Scan second = MakeLabelScan(grid, noise);
    const auto & imageOfFirst = *std::get<LabelImage::Pointer>(first.image);
    const auto & imageOfSecond = *std::get<LabelImage::Pointer>(second.image);
    const std::map<Corner, double> borderOfFirst = BorderOf(imageOfFirst, grid.spacing);
    const std::map<Corner, double> borderOfSecond = BorderOf(imageOfSecond, grid.spacing);
    const SlowMetrics toSecond(borderOfFirst, borderOfSecond, grid.spacing);
    const SlowMetrics toFirst(borderOfSecond, borderOfFirst, grid.spacing);
    const double tolerance = 0.6 + uniform(random);
    const VoxelMetrics found =
      rhombic::ComputeVoxelMetrics({ first, 1 }, { second, 1 }, imageOfFirst.GetLargestPossibleRegion(), tolerance);
    EXPECT_NEAR(found.meanToSecond, toSecond.mean, 1e-6) << pair;
    EXPECT_NEAR(found.meanToFirst, toFirst.mean, 1e-6) << pair;
    EXPECT_NEAR(found.hausdorff, std::max(toFirst.Percentile(1.0), toSecond.Percentile(1.0)), 1e-6) << pair;
    EXPECT_NEAR(found.hausdorff95, std::max(toFirst.Percentile(0.95), toSecond.Percentile(0.95)), 1e-6) << pair;
    EXPECT_NEAR(found.normalizedDice,
                (toFirst.AreaWithin(tolerance) + toSecond.AreaWithin(tolerance)) / (toFirst.whole + toSecond.whole),
                1e-6)
      << pair;
  }
}

/** What the program itself gives for balls of 20 and 21 mm around the middle of the grid. */
TEST(VoxelMetrics, AreThoseOfTheProgram)
{
  struct Known
  {
    LabelGrid grid;
    double toSecond, toFirst, hausdorff, hausdorff95, wide, narrow; // mm, and the surface Dice at 1.1 and 0.9 mm
  };
  const Known known[] = { { { { { 48, 48, 48 } }, { 1.0, 1.0, 1.0 } },
                            0.78856411954358,
                            0.7985252200514537,
                            1.4142135623730951,
                            1.4142135623730951,
                            0.9466897851527605,
                            0.22829687338154997 },
                          { { { { 60, 60, 16 } }, { 0.8, 0.8, 3.0 } },
                            0.5068716086939604,
                            0.5760592828634198,
                            3.0,
                            1.6,
                            0.8340885231428655,
                            0.8340885231428655 },
                          { { { { 68, 68, 10 } }, { 0.7, 0.7, 5.0 } },
                            0.4066385348091564,
                            0.5085548779987343,
                            2.1,
                            1.4,
                            0.8525508616305435,
                            0.7567699081475995 } };
  for (const Known & balls : known)
  {
    const rhombic::Scan first = MakeLabelScan(balls.grid, Ball(20.0));
    const rhombic::Scan second = MakeLabelScan(balls.grid, Ball(21.0));
    const auto & region = rhombic::GeometryOf(first.image).GetLargestPossibleRegion();
    const VoxelMetrics wide = rhombic::ComputeVoxelMetrics({ first, 1 }, { second, 1 }, region, 1.1);
    const VoxelMetrics narrow = rhombic::ComputeVoxelMetrics({ first, 1 }, { second, 1 }, region, 0.9);
    EXPECT_NEAR(wide.meanToSecond, balls.toSecond, 1e-9);
    EXPECT_NEAR(wide.meanToFirst, balls.toFirst, 1e-9);
    EXPECT_NEAR(wide.hausdorff, balls.hausdorff, 1e-9);
    EXPECT_NEAR(wide.hausdorff95, balls.hausdorff95, 1e-9);
    EXPECT_NEAR(wide.normalizedDice, balls.wide, 1e-9);
    EXPECT_NEAR(narrow.normalizedDice, balls.narrow, 1e-9);
  }
}

} // namespace
