#include "rhombicIsosurfaceVolume.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace rhombic
{
namespace
{

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
CountSites(const itk::FCCImage<TPixel> & lattice, const itk::ImageBase<3> * grid, const TInside & isInside)
{
  const auto & region = lattice.GetLargestPossibleRegion();
  const auto & size = region.GetSize();
  const std::array<std::vector<double>, 3> shares{ FindShares(lattice, grid, 0),
                                                   FindShares(lattice, grid, 1),
                                                   FindShares(lattice, grid, 2) };
  std::vector<double> planes(size[2]);
  ForEachInBlocks(size[2], 1, [&](std::size_t k) {
    const TPixel * value = lattice.GetBufferPointer() + k * size[1] * size[0];
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
  });
  return std::accumulate(planes.begin(), planes.end(), 0.0);
}

} // namespace

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
