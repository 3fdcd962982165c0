#include "rhombicSlicePart.h"

#include "rhombicLabelSurfaces.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using Grid = itk::ImageBase<3>;

Vector3
PointOf(const Grid & grid, const itk::ContinuousIndex<double, 3> & index)
{
  const auto point = grid.TransformContinuousIndexToPhysicalPoint<double>(index);
  return { point[0], point[1], point[2] };
}

/** The middle of the box, along the patient's axes, around the voxels of labels. */
Vector3
MiddleOf(const std::vector<LabelVoxels> & labels, const Grid & grid)
{
  std::vector<Vector3> corners;
  for (const LabelVoxels & label : labels)
  {
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      itk::ContinuousIndex<double, 3> index;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        index[axis] = (corner >> axis & 1) != 0 ? static_cast<double>(label.region.GetUpperIndex()[axis]) + 0.5
                                                : static_cast<double>(label.region.GetIndex(axis)) - 0.5;
      }
      corners.push_back(PointOf(grid, index));
    }
  }
  LPSBox box{ corners.front(), corners.front() };
  for (const Vector3 & corner : corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lowest[axis] = std::min(box.lowest[axis], corner[axis]);
      box.highest[axis] = std::max(box.highest[axis], corner[axis]);
    }
  }
  return CentreOf(box);
}

/** The centroid of the voxels of the labels whose names fit a pattern; nothing if none fits. */
std::optional<Vector3>
CentroidOf(const std::vector<LabelVoxels> & labels, const std::string & pattern, const Grid & grid)
{
  itk::ContinuousIndex<double, 3> sum;
  sum.Fill(0.0);
  double count = 0.0;
  for (const LabelVoxels & label : labels)
  {
    if (FitsPattern(pattern, label.name))
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += static_cast<double>(label.count) * label.centroid[axis];
      }
      count += static_cast<double>(label.count);
    }
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    sum[axis] /= count;
  }
  return count > 0.0 ? std::optional(PointOf(grid, sum)) : std::nullopt;
}

/** The voxels that the plane at a coordinate of the patient's axis passes, in a box. */
itk::ImageRegion<3>
VoxelsInPlane(const Grid & grid, std::size_t patientAxis, double coordinate)
{
  const itk::ImageRegion<3> & whole = grid.GetLargestPossibleRegion();
  const itk::ContinuousIndex<double, 3> first(whole.GetIndex());
  const double start = PointOf(grid, first)[patientAxis];
  double steps[3]; // of the coordinate, by axis of the grid
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    itk::ContinuousIndex<double, 3> next = first;
    next[axis] += 1.0;
    steps[axis] = PointOf(grid, next)[patientAxis] - start;
  }
  itk::ImageRegion<3> voxels = whole;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    double lowest = coordinate - start; // what this axis has to add to the start
    double highest = lowest;
    for (unsigned int other = 0; other < 3; ++other)
    {
      const double length = other != axis ? steps[other] * static_cast<double>(whole.GetSize(other)) : 0.0;
      lowest -= std::max(0.0, length);
      highest -= std::min(0.0, length);
    }
    constexpr double parallel = 1e-9; // mm
    if (std::abs(steps[axis]) > parallel)
    {
      const auto [begin, end] = std::minmax({ lowest / steps[axis], highest / steps[axis] });
      const auto last = static_cast<double>(whole.GetSize(axis) - 1);
      const auto low = static_cast<itk::IndexValueType>(std::clamp(std::floor(begin), 0.0, last));
      const auto high = static_cast<itk::IndexValueType>(std::clamp(std::ceil(end), 0.0, last));
      voxels.SetIndex(axis, whole.GetIndex(axis) + low);
      voxels.SetSize(axis, static_cast<itk::SizeValueType>(high - low + 1));
    }
  }
  return voxels;
}

itk::ImageRegion<3>
BoxAround(const itk::ImageRegion<3> & a, const itk::ImageRegion<3> & b)
{
  itk::ImageRegion<3> box;
  itk::Index<3> upper;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.SetIndex(axis, std::min(a.GetIndex(axis), b.GetIndex(axis)));
    upper[axis] = std::max(a.GetUpperIndex()[axis], b.GetUpperIndex()[axis]);
  }
  box.SetUpperIndex(upper);
  return box;
}

/** The place of a slice, found without surfaces; nothing if it can't be found so. */
std::optional<Vector3>
PlaceOf(const PlaneRequest & slice, const LoadedSource & loaded, const std::vector<LabelVoxels> & labels)
{
  const Grid & grid = GeometryOf(loaded.labels->scan.image);
  if (const auto position = ToNumber<double>(slice.place); position && std::isfinite(*position))
  {
    return PointAtPosition(BoxOf(*loaded.FindScan()), slice.plane, *position);
  }
  if (!slice.place.empty() && slice.place[0] == '#')
  {
    const std::size_t number = ToNumber<std::size_t>(slice.place.substr(1)).value();
    return loaded.scan ? std::optional(PointAtIndex(*loaded.scan, slice.plane, number)) : std::nullopt;
  }
  if (!loaded.requests.empty()) // isosurfaces count, too
  {
    return std::nullopt;
  }
  return slice.place.empty() ? MiddleOf(labels, grid) : CentroidOf(labels, slice.place, grid);
}

} // namespace

SlicePart
FindSlicePart(const std::vector<PlaneRequest> & slices, const PictureSource & source, const LoadedSource & loaded)
{
  const SurfaceFinish & finish = source.finish;
  const bool removesParts = finish.minimumVolume > 0.0 || finish.keepsLargestPart || finish.fillsCavities;
  if (slices.empty() || removesParts || !loaded.labels || !loaded.labels->probabilities.empty() ||
      !loaded.labels->scan.sliceOrigins.empty())
  {
    return {};
  }
  const std::vector<LabelVoxels> labels = FindLabelVoxels(*loaded.labels, source.surfaces.labels->labels);
  const Grid & grid = GeometryOf(loaded.labels->scan.image);
  SlicePart part;
  for (const PlaneRequest & slice : slices)
  {
    const std::optional<Vector3> place = PlaceOf(slice, loaded, labels);
    if (!place)
    {
      return {};
    }
    const std::size_t axis = AxisOf(slice.plane);
    const itk::ImageRegion<3> voxels = VoxelsInPlane(grid, axis, (*place)[axis]);
    part.voxels = part.voxels ? BoxAround(*part.voxels, voxels) : voxels;
    const bool isFoundWithoutSurfaces = ToNumber<double>(slice.place) || slice.place[0] == '#';
    if (!isFoundWithoutSurfaces)
    {
      part.places[slice.place] = *place;
    }
  }
  const bool isMost = part.voxels->GetNumberOfPixels() > grid.GetLargestPossibleRegion().GetNumberOfPixels() / 2;
  return isMost ? SlicePart() : part;
}

} // namespace rhombic
