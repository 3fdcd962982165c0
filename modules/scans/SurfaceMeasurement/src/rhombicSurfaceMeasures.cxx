#include "rhombicSurfaceMeasures.h"

#include "rhombicForEachBlock.h"
#include "itkTriangleSurfaceInterior.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rhombic
{
namespace
{

itk::SamplePlanes
PlanesOf(const Scan & scan)
{
  const itk::ImageBase<3> & grid = GeometryOf(scan.image);
  const auto & region = grid.GetLargestPossibleRegion();
  const auto pointAt = [&](itk::IndexValueType column, itk::IndexValueType row, itk::IndexValueType slice) {
    auto index = region.GetIndex();
    index[0] += column;
    index[1] += row;
    index[2] += slice;
    itk::Point<double, 3> point;
    grid.TransformIndexToPhysicalPoint(index, point);
    return point;
  };
  itk::SamplePlanes planes;
  planes.columnStep = pointAt(1, 0, 0) - pointAt(0, 0, 0);
  planes.rowStep = pointAt(0, 1, 0) - pointAt(0, 0, 0);
  planes.numberOfColumns = region.GetSize(0);
  planes.numberOfRows = region.GetSize(1);
  planes.origins = scan.sliceOrigins;
  for (itk::SizeValueType slice = planes.origins.size(); slice < region.GetSize(2); ++slice)
  {
    planes.origins.push_back(pointAt(0, 0, static_cast<itk::IndexValueType>(slice)));
  }
  return planes;
}

/** Count, sum and sum of squares of the values inside the surface in one slice. */
struct SliceSums
{
  std::size_t count = 0;
  double sum = 0.0;
  double squares = 0.0;
};

template <typename TPixel>
std::vector<SliceSums>
SumInterior(const itk::TriangleSurface & surface, const itk::Image<TPixel, 3> & image, const itk::SamplePlanes & planes)
{
  std::vector<SliceSums> slices(planes.origins.size()); // each is changed by one thread alone
  FindTriangleSurfaceInteriorSamples(surface, planes, [&](auto slice, auto row, auto begin, auto end) {
    const TPixel * const values =
      image.GetBufferPointer() + (slice * planes.numberOfRows + row) * planes.numberOfColumns;
    SliceSums & sums = slices[slice];
    for (auto column = begin; column < end; ++column)
    {
      const auto value = static_cast<double>(values[column]);
      if (std::isfinite(value))
      {
        ++sums.count;
        sums.sum += value;
        sums.squares += value * value;
      }
    }
  });
  return slices;
}

} // namespace

std::optional<double>
SurfaceMeasures::GetVolumeError() const
{
  if (isosurface)
  {
    return 100.0 * isosurface->GetErrorOf(volume);
  }
  return voxelVolume ? std::optional<double>(100.0 * (volume / *voxelVolume - 1.0)) : std::nullopt;
}

SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface)
{
  SurfaceMeasures measures;
  measures.volume = ComputeTriangleSurfaceVolume(surface);
  measures.area = ComputeTriangleSurfaceArea(surface);
  measures.bounds = surface.GetBounds();
  measures.centroid = ComputeTriangleSurfaceCentroid(surface);
  measures.longestDiameter = ComputeTriangleSurfaceLongestDiameter(surface);
  return measures;
}

SurfaceMeasures
MeasureSurface(const itk::TriangleSurface & surface, const Scan & scan)
{
  SurfaceMeasures measures;
  const itk::SamplePlanes planes = PlanesOf(scan);
  const std::vector<double> voxelVolumes = VoxelVolumes(scan);
  std::vector<SliceSums> slices;
  ForEachOnThreads(2, [&](std::size_t task) {
    if (task == 0)
    {
      measures = MeasureSurface(surface);
    }
    else
    {
      slices = std::visit([&](const auto & image) { return SumInterior(surface, *image, planes); }, scan.image);
    }
  });
  double volume = 0.0;
  double sum = 0.0; // weighted by the voxels' volumes
  double squares = 0.0;
  for (std::size_t slice = 0; slice < slices.size(); ++slice)
  {
    volume += static_cast<double>(slices[slice].count) * voxelVolumes[slice];
    sum += slices[slice].sum * voxelVolumes[slice];
    squares += slices[slice].squares * voxelVolumes[slice];
  }
  measures.voxelVolume = volume;
  if (volume > 0.0)
  {
    const double mean = sum / volume;
    measures.meanValue = mean;
    measures.standardDeviation = std::sqrt(std::max(0.0, squares / volume - mean * mean));
  }
  return measures;
}

double
CountVoxelVolume(const Scan & scan, const Threshold & threshold)
{
  const std::vector<double> voxelVolumes = VoxelVolumes(scan);
  std::vector<double> inside(voxelVolumes.size()); // voxels of each slice
  const auto count = [&](const auto & image) {
    const auto & size = image->GetLargestPossibleRegion().GetSize();
    const std::size_t sliceSize = size[0] * size[1];
    ForEachInBlocks(inside.size(), 1, [&](std::size_t slice) {
      const auto * const begin = image->GetBufferPointer() + slice * sliceSize;
      inside[slice] = static_cast<double>(std::count_if(
        begin, begin + sliceSize, [&](auto value) { return threshold.IsInside(static_cast<double>(value)); }));
    });
  };
  std::visit(count, scan.image);
  return std::inner_product(inside.begin(), inside.end(), voxelVolumes.begin(), 0.0);
}

} // namespace rhombic
