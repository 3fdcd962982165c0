#include "rhombicFailure.h"
#include "rhombicLabelMap.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** The first voxels that are not 0, and those behind the last, along each axis. */
struct LabelBox
{
  itk::Size<3> begin;
  itk::Size<3> end{ { 0, 0, 0 } };
};

template <typename TPixel>
void
Extend(LabelBox & box, const itk::Image<TPixel, 3> & image)
{
  const auto size = image.GetLargestPossibleRegion().GetSize();
  auto & [begin, end] = box;
  const TPixel * line = image.GetBufferPointer();
  for (std::size_t z = 0; z < size[2]; ++z)
  {
    for (std::size_t y = 0; y < size[1]; ++y, line += size[0])
    {
      const auto isLabel = [](TPixel value) { return value != 0; };
      const TPixel * const lineEnd = line + size[0];
      const TPixel * const first = std::find_if(line, lineEnd, isLabel);
      if (first != lineEnd)
      {
        const auto last = std::find_if(std::make_reverse_iterator(lineEnd), std::make_reverse_iterator(first), isLabel);
        begin = { { std::min<std::size_t>(begin[0], static_cast<std::size_t>(first - line)),
                    std::min<std::size_t>(begin[1], y),
                    std::min<std::size_t>(begin[2], z) } };
        end = { { std::max<std::size_t>(end[0], static_cast<std::size_t>(last.base() - line)),
                  std::max<std::size_t>(end[1], y + 1),
                  z + 1 } };
      }
    }
  }
}

/** Whether a point is in a voxel of a grid. */
bool
IsInside(const itk::ImageBase<3> & grid, const itk::Point<double, 3> & point)
{
  const auto index = grid.TransformPhysicalPointToContinuousIndex<double>(point);
  const itk::ImageRegion<3> region = grid.GetLargestPossibleRegion();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double first = static_cast<double>(region.GetIndex(axis)) - 0.5;
    if (!(index[axis] >= first && index[axis] <= first + static_cast<double>(region.GetSize(axis))))
    {
      return false;
    }
  }
  return true;
}

/** The fraction of a region of \a inner that is in \a outer, in world space. Both extend to the outer faces of their
 * voxels. */
double
OverlapOfRegion(const itk::ImageBase<3> & inner, const itk::ImageRegion<3> & region, const itk::ImageBase<3> & outer)
{
  constexpr int points = 32; // along each axis, in the middle of equal parts of the region
  std::size_t inside = 0;
  for (int n = 0; n < points * points * points; ++n)
  {
    const int cell[3] = { n % points, n / points % points, n / points / points };
    itk::ContinuousIndex<double, 3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = static_cast<double>(region.GetIndex(axis)) - 0.5 +
                    (cell[axis] + 0.5) / points * static_cast<double>(region.GetSize(axis));
    }
    itk::Point<double, 3> point;
    inner.TransformContinuousIndexToPhysicalPoint(index, point);
    inside += IsInside(outer, point) ? 1 : 0;
  }
  return static_cast<double>(inside) / (points * points * points);
}

} // namespace

itk::ImageRegion<3>
RegionOfLabels(const std::vector<ScanImage> & layers)
{
  const itk::ImageRegion<3> whole = GeometryOf(layers.front()).GetLargestPossibleRegion();
  LabelBox box{ whole.GetSize() };
  for (const ScanImage & layer : layers)
  {
    std::visit([&box](const auto & image) { Extend(box, *image); }, layer);
  }
  if (box.end[2] == 0)
  {
    return whole;
  }
  itk::ImageRegion<3> region = whole;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    region.SetIndex(axis, whole.GetIndex(axis) + static_cast<itk::IndexValueType>(box.begin[axis]));
    region.SetSize(axis, box.end[axis] - box.begin[axis]);
  }
  return region;
}

std::string
RequireOverlap(const Scan & scan,
               const Scan & labels,
               const std::filesystem::path & scanPath,
               const std::filesystem::path & labelsPath)
{
  const double overlap =
    OverlapOfRegion(GeometryOf(labels.image), RegionOfLabels(LayersOf(labels)), GeometryOf(scan.image));
  if (overlap == 0)
  {
    throw Failure(FailureKind::Geometry,
                  "The labels of " + labelsPath.string() + " lie nowhere in " + scanPath.string() +
                    "; check that both are of the same patient and examination.");
  }
  constexpr double enough = 0.99;
  if (overlap >= enough)
  {
    return "";
  }
  return "Only " + std::to_string(static_cast<int>(std::floor(100 * overlap))) + " % of the box around the labels of " +
         labelsPath.string() + " lie in " + scanPath.string() + ".";
}

} // namespace rhombic
