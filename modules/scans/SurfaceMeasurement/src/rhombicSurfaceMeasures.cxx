#include "rhombicSurfaceMeasures.h"

#include "rhombicForEachBlock.h"
#include "rhombicMappedVoxels.h"

#include "detail/itkForEachLoadedPart.h"
#include "itkTriangleSurfaceInterior.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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
    return grid.TransformIndexToPhysicalPoint<double>(region.GetIndex() + itk::Offset<3>{ { column, row, slice } });
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

/** For each lattice coordinate along an axis, the share of the unit interval around it that lies in the grid's voxels;
 * 1 everywhere without a grid. */
template <typename TPixel>
std::vector<double>
FindShares(const itk::FCCImage<TPixel> & lattice, const itk::ImageBase<3> * grid, unsigned int axis)
{
  const auto & region = lattice.GetLargestPossibleRegion();
  const itk::SizeValueType unitsPerIndex = axis == 0 ? 2 : 1;
  std::vector<double> shares(unitsPerIndex * region.GetSize(axis), 1.0);
  if (grid == nullptr)
  {
    return shares;
  }
  constexpr double halfVoxel = 0.5;
  const auto origin = grid->TransformPhysicalPointToContinuousIndex<double>(lattice.GetOrigin());
  const double step = lattice.GetSpacing()[axis] / grid->GetSpacing()[axis];
  const auto begin = static_cast<double>(grid->GetLargestPossibleRegion().GetIndex(axis)) - halfVoxel;
  const double end = begin + static_cast<double>(grid->GetLargestPossibleRegion().GetSize(axis));
  const auto first = static_cast<double>(region.GetIndex(axis)) * static_cast<double>(unitsPerIndex);
  for (std::size_t n = 0; n < shares.size(); ++n)
  {
    const double position = origin[axis] + (first + static_cast<double>(n)) * step;
    const double low = std::max(begin, position - 0.5 * step);
    const double high = std::min(end, position + 0.5 * step);
    shares[n] = std::max(0.0, high - low) / step;
  }
  return shares;
}

/** Number of sites for which \a isInside(value); sites at the border count by their share in the grid's voxels. */
template <typename TPixel, typename TInside>
double
CountSites(itk::FCCImage<TPixel> & lattice, const itk::ImageBase<3> * grid, const TInside & isInside)
{
  const auto & region = lattice.GetLargestPossibleRegion();
  const auto & size = region.GetSize();
  const std::array<std::vector<double>, 3> shares{ FindShares(lattice, grid, 0),
                                                   FindShares(lattice, grid, 1),
                                                   FindShares(lattice, grid, 2) };
  std::vector<double> planes(size[2]);
  const auto countPlane = [&](itk::SizeValueType k) {
    itk::Index<3> start = region.GetIndex();
    start[2] += static_cast<itk::IndexValueType>(k);
    const TPixel * value = lattice.GetBufferPointer() + lattice.ComputeOffset(start);
    for (itk::SizeValueType j = 0; j < size[1]; ++j)
    {
      const auto row = region.GetIndex(1) + static_cast<itk::IndexValueType>(j);
      const auto plane = region.GetIndex(2) + static_cast<itk::IndexValueType>(k);
      const double * share = shares[0].data() + itk::FCCLattice::Parity(row, plane);
      double sum = 0.0;
      for (itk::SizeValueType i = 0; i < size[0]; ++i, ++value, share += 2)
      {
        sum += isInside(*value) ? *share : 0.0;
      }
      planes[k] += sum * shares[1][j] * shares[2][k];
    }
  };
  ForEachLoadedPart(lattice, [&](itk::SizeValueType begin, itk::SizeValueType end) {
    ForEachInBlocks(end - begin, 1, [&](std::size_t n) { countPlane(begin + n); });
  });
  return std::accumulate(planes.begin(), planes.end(), 0.0);
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
      DropPages(scan.image);
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
    const std::size_t slicesOfPart = 1 + (std::size_t{ 1 } << 26) / sliceSize; // of a mapped scan in memory
    ForEachInBlocks(inside.size(), 1, [&](std::size_t slice) {
      const auto * const begin = image->GetBufferPointer() + slice * sliceSize;
      inside[slice] = static_cast<double>(std::count_if(
        begin, begin + sliceSize, [&](auto value) { return threshold.IsInside(static_cast<double>(value)); }));
      if (slice % slicesOfPart == 0)
      {
        DropPages(scan.image);
      }
    });
  };
  std::visit(count, scan.image);
  return std::inner_product(inside.begin(), inside.end(), voxelVolumes.begin(), 0.0);
}

IsosurfaceVolume
EstimateIsosurfaceVolume(const FCCVolume & lattice,
                         const Threshold & threshold,
                         double area,
                         const itk::ImageBase<3> * grid)
{
  const double isovalue = threshold.isovalue;
  return std::visit(
    [&](const auto & image) {
      const auto & spacing = image->GetSpacing();
      const double site = itk::FCCLattice::CellVolume * spacing[0] * spacing[1] * spacing[2];
      const double sites = threshold.insideIsBelow
                             ? CountSites(*image, grid, [=](auto value) { return value < isovalue; })
                             : CountSites(*image, grid, [=](auto value) { return value >= isovalue; });
      const double standardError = std::pow(site, 2.0 / 3.0) * std::sqrt(area / 12.0);
      constexpr double shareForPlanes = 0.002; // for surfaces along the lattice's planes
      return IsosurfaceVolume{ sites * site, 3.0 * standardError + shareForPlanes * sites * site };
    },
    lattice);
}

} // namespace rhombic
