#include "rhombicVoxelMetrics.h"

#include "itkImageRegionConstIterator.h"
#include "itkImageRegionIterator.h"
#include "itkSignedMaurerDistanceMapImageFilter.h"

#include <vtkMarchingCubesTriangleCases.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

using CodeImage = itk::Image<std::uint8_t, 3>;
using DistanceImage = itk::Image<double, 3>;
using VectorType = itk::Vector<double, 3>;

/** The voxels around a corner, relative to the one with the highest index, in the order of VTK's cases. */
constexpr std::array<std::array<int, 3>, 8> Voxels{ { { { -1, -1, -1 } },
                                                      { { 0, -1, -1 } },
                                                      { { 0, 0, -1 } },
                                                      { { -1, 0, -1 } },
                                                      { { -1, -1, 0 } },
                                                      { { 0, -1, 0 } },
                                                      { { 0, 0, 0 } },
                                                      { { -1, 0, 0 } } } };

/** The two voxels beside each edge of a cube of voxels' centres, in the order of VTK's cases. */
constexpr std::array<std::array<unsigned int, 2>, 12> Edges{ { { { 0, 1 } },
                                                               { { 1, 2 } },
                                                               { { 3, 2 } },
                                                               { { 0, 3 } },
                                                               { { 4, 5 } },
                                                               { { 5, 6 } },
                                                               { { 7, 6 } },
                                                               { { 4, 7 } },
                                                               { { 0, 4 } },
                                                               { { 1, 5 } },
                                                               { { 3, 7 } },
                                                               { { 2, 6 } } } };

/** The point in mm where a triangle meets an edge: in the middle. */
VectorType
MiddleOf(int edge, const VectorType & spacing)
{
  VectorType middle;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto & [one, other] = Edges[static_cast<std::size_t>(edge)];
    middle[axis] = 0.5 * spacing[axis] * (Voxels[one][axis] + Voxels[other][axis]);
  }
  return middle;
}

/** The area in mm^2 of the triangles in a cube of voxels' centres, by the code of its voxels inside. */
std::array<double, 256>
FindAreas(const VectorType & spacing)
{
  std::array<double, 256> areas{};
  for (std::size_t code = 0; code < areas.size(); ++code)
  {
    const bool isComplemented = std::bitset<8>(code).count() > 4;
    const auto & edges = vtkMarchingCubesTriangleCases::GetCases()[isComplemented ? 255 - code : code].edges;
    for (std::size_t n = 0; edges[n] >= 0; n += 3)
    {
      const VectorType corner = MiddleOf(edges[n], spacing);
      areas[code] +=
        0.5 *
        itk::CrossProduct(MiddleOf(edges[n + 1], spacing) - corner, MiddleOf(edges[n + 2], spacing) - corner).GetNorm();
    }
  }
  return areas;
}

/** An image of all corners of a region's voxels; the first corner of a voxel has the voxel's index. */
template <typename TImage>
typename TImage::Pointer
MakeCorners(const itk::ImageRegion<3> & region, const VectorType & spacing)
{
  itk::ImageRegion<3> corners = region;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    corners.SetSize(axis, region.GetSize(axis) + 1);
  }
  const auto image = TImage::New();
  image->SetRegions(corners);
  image->SetSpacing(spacing);
  image->Allocate(true);
  return image;
}

/** For each corner a bit for each of its voxels that has the label. */
CodeImage::Pointer
MakeCodes(const VoxelLabel & label, const itk::ImageRegion<3> & region, const VectorType & spacing)
{
  const auto codes = MakeCorners<CodeImage>(region, spacing);
  std::array<itk::OffsetValueType, 8> corners{}; // of a voxel, relative to its first
  for (std::size_t voxel = 0; voxel < Voxels.size(); ++voxel)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      corners[voxel] -= Voxels[voxel][axis] * codes->GetOffsetTable()[axis];
    }
  }
  for (const ScanImage & layer : LayersOf(label.map))
  {
    std::visit(
      [&](const auto & image) {
        using ImageType = std::decay_t<decltype(*image)>;
        for (itk::ImageRegionConstIterator<ImageType> it(image, region); !it.IsAtEnd(); ++it)
        {
          if (static_cast<std::int32_t>(it.Get()) != label.value)
          {
            continue;
          }
          std::uint8_t * const first = codes->GetBufferPointer() + codes->ComputeOffset(it.GetIndex());
          for (std::size_t voxel = 0; voxel < corners.size(); ++voxel)
          {
            first[corners[voxel]] = static_cast<std::uint8_t>(first[corners[voxel]] | 1u << voxel);
          }
        }
      },
      layer);
  }
  return codes;
}

bool
IsBorder(std::uint8_t code)
{
  return code != 0 && code != 255;
}

/** The distance in mm from each corner to the nearest one on the border. */
DistanceImage::Pointer
FindDistances(const CodeImage & codes)
{
  const auto borders = CodeImage::New();
  borders->CopyInformation(&codes);
  borders->SetRegions(codes.GetBufferedRegion());
  borders->Allocate();
  std::transform(codes.GetBufferPointer(),
                 codes.GetBufferPointer() + codes.GetBufferedRegion().GetNumberOfPixels(),
                 borders->GetBufferPointer(),
                 [](std::uint8_t code) { return IsBorder(code) ? 1 : 0; });
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<CodeImage, DistanceImage>::New();
  filter->SetInput(borders);
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  filter->Update();
  return filter->GetOutput();
}

/** The distances in mm from the borders of one label to those of another, and the areas in mm^2 that have them. */
using Distances = std::vector<std::pair<double, double>>;

Distances
MeasureBorder(const CodeImage & codes, const DistanceImage & toOther, const std::array<double, 256> & areas)
{
  Distances distances;
  const std::size_t count = codes.GetBufferedRegion().GetNumberOfPixels();
  for (std::size_t corner = 0; corner < count; ++corner)
  {
    const std::uint8_t code = codes.GetBufferPointer()[corner];
    if (IsBorder(code))
    {
      distances.emplace_back(std::max(0.0, toOther.GetBufferPointer()[corner]), areas[code]);
    }
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

double
AreaOf(const Distances & distances)
{
  return std::accumulate(
    distances.begin(), distances.end(), 0.0, [](double sum, const auto & corner) { return sum + corner.second; });
}

double
MeanOf(const Distances & distances)
{
  const double sum = std::accumulate(distances.begin(), distances.end(), 0.0, [](double before, const auto & corner) {
    return before + corner.first * corner.second;
  });
  return sum / AreaOf(distances);
}

/** The least distance within which a share of the area lies. */
double
QuantileOf(const Distances & distances, double share)
{
  const double enough = share * AreaOf(distances);
  double area = 0.0;
  for (const auto & [distance, ofCorner] : distances)
  {
    area += ofCorner;
    if (area >= enough)
    {
      return distance;
    }
  }
  return distances.back().first;
}

double
AreaWithin(const Distances & distances, double tolerance)
{
  return std::accumulate(distances.begin(), distances.end(), 0.0, [&](double sum, const auto & corner) {
    return sum + (corner.first <= tolerance ? corner.second : 0.0);
  });
}

} // namespace

VoxelMetrics
ComputeVoxelMetrics(const VoxelLabel & first,
                    const VoxelLabel & second,
                    const itk::ImageRegion<3> & region,
                    double tolerance)
{
  const VectorType spacing = GeometryOf(first.map.image).GetSpacing();
  const std::array<double, 256> areas = FindAreas(spacing);
  const CodeImage::Pointer codesOfFirst = MakeCodes(first, region, spacing);
  const CodeImage::Pointer codesOfSecond = MakeCodes(second, region, spacing);
  const Distances ofFirst = MeasureBorder(*codesOfFirst, *FindDistances(*codesOfSecond), areas);
  const Distances ofSecond = MeasureBorder(*codesOfSecond, *FindDistances(*codesOfFirst), areas);
  VoxelMetrics metrics;
  metrics.meanToSecond = MeanOf(ofFirst);
  metrics.meanToFirst = MeanOf(ofSecond);
  metrics.hausdorff = std::max(ofFirst.back().first, ofSecond.back().first);
  metrics.hausdorff95 = std::max(QuantileOf(ofFirst, 0.95), QuantileOf(ofSecond, 0.95));
  metrics.normalizedDice =
    (AreaWithin(ofFirst, tolerance) + AreaWithin(ofSecond, tolerance)) / (AreaOf(ofFirst) + AreaOf(ofSecond));
  return metrics;
}

} // namespace rhombic
