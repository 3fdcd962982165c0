#include "rhombicVolumeGeometry.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

itk::Vector<double, 3>
AxisOf(const VolumeGeometry & geometry, unsigned int axis)
{
  return itk::Vector<double, 3>(geometry.direction.GetVnlMatrix().get_column(axis).data_block());
}

} // namespace

VolumeGeometry
MakeGeometry(const itk::Size<3> & size, const itk::Point<double, 3> & origin, const itk::Vector<double, 3> steps[3])
{
  VolumeGeometry geometry;
  geometry.size = size;
  geometry.origin = origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    geometry.spacing[axis] = steps[axis].GetNorm();
    for (unsigned int row = 0; row < 3; ++row)
    {
      constexpr double rounding = 1e-15; // VNL's inversion of the direction does not converge with values near 0
      const double cosine = steps[axis][row] / geometry.spacing[axis];
      geometry.direction[row][axis] = std::abs(cosine) < rounding ? 0.0 : cosine;
    }
  }
  return geometry;
}

VolumeGeometry
MakeUnplacedGeometry(const itk::Size<3> & size, const std::array<double, 3> & voxelSize)
{
  itk::Vector<double, 3> steps[3];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    steps[axis].Fill(0);
    steps[axis][axis] = voxelSize[axis];
  }
  itk::Point<double, 3> origin;
  origin.Fill(0);
  return MakeGeometry(size, origin, steps);
}

void
CheckGeometry(const VolumeGeometry & geometry,
              const std::filesystem::path & path,
              const std::string & matrix,
              ScanReadOptions::Policy onSheared,
              std::vector<std::string> & notes)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    RefuseGeometryIf(!std::isfinite(geometry.origin[axis]) || !std::isfinite(geometry.spacing[axis]),
                     path,
                     "its " + matrix + " holds numbers that are not finite; export it again from its source");
    constexpr double smallest = 1e-9, largest = 1e9; // mm
    RefuseGeometryIf(geometry.spacing[axis] < smallest || geometry.spacing[axis] > largest,
                     path,
                     "its voxels have no proper size along axis " + std::to_string(axis) + " (" + matrix +
                       "); export it again from its source");
  }
  constexpr double smallestVolume = 0.1; // that three unit axes must span: sheared by 84 degrees
  const double volume = AxisOf(geometry, 0) * itk::CrossProduct(AxisOf(geometry, 1), AxisOf(geometry, 2));
  RefuseGeometryIf(std::abs(volume) < smallestVolume,
                   path,
                   "its axes lie in one plane or nearly so (the " + matrix +
                     " is singular); export it again from its source");

  double largestCosine = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    largestCosine = std::max(largestCosine, std::abs(AxisOf(geometry, axis) * AxisOf(geometry, (axis + 1) % 3)));
  }
  constexpr double tolerance = 1e-3;
  if (largestCosine > tolerance)
  {
    const std::string degrees =
      FormatNumber(std::asin(std::min(1.0, largestCosine)) * 180 / itk::Math::pi, 3) + " degrees";
    RefuseGeometryIf(onSheared == ScanReadOptions::Policy::Refuse,
                     path,
                     "its " + matrix + " is sheared: its axes are " + degrees +
                       " from perpendicular; accept sheared volumes, or resample it to perpendicular axes first");
    notes.push_back(path.string() + " is sheared: the axes of its " + matrix + " are " + degrees +
                    " from perpendicular.");
  }
}

bool
AreSameGrids(const itk::ImageBase<3> & a, const itk::ImageBase<3> & b)
{
  constexpr double tolerance = 0.001; // voxels
  const auto & region = a.GetLargestPossibleRegion();
  bool areSame = region == b.GetLargestPossibleRegion();
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    itk::Index<3> index = region.GetIndex();
    if (corner < 3)
    {
      index[corner] = region.GetUpperIndex()[corner];
    }
    const auto place =
      b.TransformPhysicalPointToContinuousIndex<double>(a.TransformIndexToPhysicalPoint<double>(index));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      areSame = areSame && std::abs(place[axis] - static_cast<double>(index[axis])) < tolerance;
    }
  }
  return areSame;
}

} // namespace rhombic
