#include "rhombicCartesianSurfaces.h"

#include "rhombicForEachBlock.h"
#include "rhombicShapeFields.h"

#include "itkImageRegionConstIteratorWithIndex.h"

#include <cmath>
#include <unordered_map>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<float, 3>;

/** The zero between the middle two of four values that are 1 apart, of the cubic through them; by bisection. */
double
ZeroOfCubic(const std::array<double, 4> & f)
{
  const auto cubic = [&f](double t) {
    return -f[0] * t * (t - 1.0) * (t - 2.0) / 6.0 + f[1] * (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 -
           f[2] * (t + 1.0) * t * (t - 2.0) / 2.0 + f[3] * (t + 1.0) * t * (t - 1.0) / 6.0;
  };
  constexpr unsigned int steps = 40;
  double begin = 0.0;
  double end = 1.0;
  for (unsigned int step = 0; step < steps; ++step)
  {
    const double middle = (begin + end) / 2.0;
    ((cubic(middle) >= 0.0) == (f[1] >= 0.0) ? begin : end) = middle;
  }
  return begin;
}

/** Moves a point in index coordinates along its edge, which may be the diagonal of a square or a cube from its least to
 * its greatest corner. A point at a sample stays. */
void
MoveAlongEdge(const VolumeType & volume, itk::ContinuousIndex<double, 3> & point)
{
  constexpr double rounding = 1e-4; // of float32 positions
  VolumeType::IndexType index;
  VolumeType::OffsetType step{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    index[axis] = std::lround(point[axis]);
    if (std::abs(point[axis] - static_cast<double>(index[axis])) > rounding)
    {
      index[axis] = static_cast<itk::IndexValueType>(std::floor(point[axis]));
      step[axis] = 1;
    }
  }
  const auto & region = volume.GetBufferedRegion();
  const auto last = index + step + step;
  if (step == VolumeType::OffsetType{} || !region.IsInside(index - step) || !region.IsInside(last))
  {
    return;
  }
  const std::array<double, 4> values{
    volume.GetPixel(index - step), volume.GetPixel(index), volume.GetPixel(index + step), volume.GetPixel(last)
  };
  if ((values[1] >= 0.0) == (values[2] >= 0.0))
  {
    return; // a point so near to a sample that its edge is not known
  }
  const double zero = ZeroOfCubic(values);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    point[axis] = static_cast<double>(index[axis]) + zero * static_cast<double>(step[axis]);
  }
}

} // namespace

itk::TriangleSurface::Pointer
ExtractCuberille(const VolumeType * volume)
{
  const auto surface = itk::TriangleSurface::New();
  const auto & region = volume->GetBufferedRegion();
  std::unordered_map<itk::OffsetValueType, std::uint32_t> points;
  const auto pointAt = [&](const VolumeType::IndexType & corner) { // the lower corner of the voxel of this index
    const auto next = static_cast<std::uint32_t>(surface->GetNumberOfPoints());
    const auto [found, isNew] = points.emplace(volume->ComputeOffset(corner), next);
    if (isNew)
    {
      itk::TriangleSurface::PointType point;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = static_cast<float>(volume->GetOrigin()[axis] +
                                         volume->GetSpacing()[axis] * (static_cast<double>(corner[axis]) - 0.5));
      }
      surface->GetPoints().push_back(point);
    }
    return found->second;
  };
  for (itk::ImageRegionConstIteratorWithIndex<VolumeType> it(volume, region); !it.IsAtEnd(); ++it)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      auto next = it.GetIndex();
      ++next[axis];
      if (!region.IsInside(next) || (it.Get() >= 0.0F) == (volume->GetPixel(next) >= 0.0F))
      {
        continue;
      }
      std::array<std::uint32_t, 4> corners;
      for (unsigned int n = 0; n < 4; ++n) // counter-clockwise as seen from the next voxel
      {
        auto corner = next;
        corner[(axis + 1) % 3] += n == 1 || n == 2 ? 1 : 0;
        corner[(axis + 2) % 3] += n >= 2 ? 1 : 0;
        corners[n] = pointAt(corner);
      }
      const auto [a, b, c, d] = corners;
      const bool facesNext = it.Get() >= 0.0F;
      using Triangle = itk::TriangleSurface::TriangleType;
      surface->GetTriangles().push_back(facesNext ? Triangle{ a, b, c } : Triangle{ a, c, b });
      surface->GetTriangles().push_back(facesNext ? Triangle{ a, c, d } : Triangle{ a, d, c });
    }
  }
  return surface;
}

void
MovePointsToCubics(const VolumeType * volume, itk::TriangleSurface & surface)
{
  constexpr itk::SizeValueType blockSize = 1024;
  const ReferenceField spline = MakeInterpolatedField(volume);
  auto & points = surface.GetPoints();
  auto & normals = surface.GetNormals();
  normals.resize(points.size());
  ForEachInBlocks(points.size(), blockSize, [&](itk::SizeValueType n) {
    auto & point = points[n];
    itk::ContinuousIndex<double, 3> position;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      position[axis] = (point[axis] - volume->GetOrigin()[axis]) / volume->GetSpacing()[axis];
    }
    MoveAlongEdge(*volume, position);
    Vector3 moved;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      moved[axis] = volume->GetOrigin()[axis] + volume->GetSpacing()[axis] * position[axis];
      point[axis] = static_cast<float>(moved[axis]);
    }
    Vector3 gradient;
    spline.Evaluate(moved, gradient);
    const double slope = Length(gradient);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      normals[n][axis] = static_cast<float>(slope > 0.0 ? -gradient[axis] / slope : 0.0);
    }
  });
}

} // namespace rhombic
