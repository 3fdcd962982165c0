#include "rhombicVolumeGeometry.h"

#include "rhombicFailure.h"

#include <cmath>
#include <string>

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Geometry, "Cannot place " + path.string() + " in the patient: " + why + ".");
}

itk::Vector<double, 3>
AxisOf(const VolumeGeometry & geometry, unsigned int axis)
{
  itk::Vector<double, 3> vector;
  for (unsigned int row = 0; row < 3; ++row)
  {
    vector[row] = geometry.direction[row][axis];
  }
  return vector;
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
      geometry.direction[row][axis] = steps[axis][row] / geometry.spacing[axis];
    }
  }
  return geometry;
}

void
CheckGeometry(const VolumeGeometry & geometry, const std::filesystem::path & path)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(geometry.origin[axis]) || !std::isfinite(geometry.spacing[axis]) ||
        !std::isfinite(AxisOf(geometry, axis).GetSquaredNorm()))
    {
      Refuse(path, "its header holds numbers that are not finite; export it again from its source");
    }
    if (geometry.spacing[axis] <= 0)
    {
      Refuse(path, "its voxels have no size along axis " + std::to_string(axis) + "; export it again from its source");
    }
  }
  constexpr double tolerance = 1e-3;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double cosine = AxisOf(geometry, axis) * AxisOf(geometry, (axis + 1) % 3);
    if (std::abs(cosine) > tolerance || std::abs(AxisOf(geometry, axis).GetNorm() - 1) > tolerance)
    {
      Refuse(path,
             "its axes are not perpendicular (cosine " + std::to_string(cosine) +
               "), and this version does not resample sheared volumes; resample it to perpendicular axes first");
    }
  }
}

} // namespace rhombic
