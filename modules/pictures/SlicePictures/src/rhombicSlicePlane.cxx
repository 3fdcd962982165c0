#include "rhombicSlicePlane.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkSliceStack.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** In the order of SlicePlane. */
const std::vector<std::string> PlaneNames{ "axial", "coronal", "sagittal" };

Vector3
MiddleOf(const SliceBox & box)
{
  Vector3 middle = box.corner;
  for (const Vector3 & side : box.sides)
  {
    middle = Along(middle, side, 0.5);
  }
  return middle;
}

/** How far the box reaches along a unit vector, in mm. */
double
LengthAlong(const Vector3 & direction, const SliceBox & box)
{
  double length = 0.0;
  for (const Vector3 & side : box.sides)
  {
    length += std::abs(Dot(side, direction));
  }
  return length;
}

/** Along the two sides that are most nearly in the plane. */
double
SmallestSpacing(const SliceBox & box, const Vector3 & look)
{
  std::array<double, 3> steepness{};
  for (std::size_t n = 0; n < 3; ++n)
  {
    steepness[n] = std::abs(Dot(box.sides[n], look)) / Length(box.sides[n]);
  }
  const auto across =
    static_cast<std::size_t>(std::max_element(steepness.begin(), steepness.end()) - steepness.begin());
  return std::min(box.spacing[(across + 1) % 3], box.spacing[(across + 2) % 3]);
}

std::string
Describe(const Vector3 & point)
{
  return FormatFixed(point[0], 1) + ", " + FormatFixed(point[1], 1) + ", " + FormatFixed(point[2], 1);
}

/** The middle of the box, moved along the look direction onto the slice through a point. */
Vector3
CentreOfSlice(const Vector3 & point, const SliceBox & box, const Vector3 & look)
{
  const Vector3 middle = MiddleOf(box);
  const double depth = Dot(Subtract(point, middle), look);
  const double beside = std::abs(depth) - 0.5 * LengthAlong(look, box);
  constexpr double tolerance = 1e-6; // mm: slices in the faces of the box are in it
  if (!(beside <= tolerance))
  {
    throw Failure(FailureKind::Usage,
                  "The slice through the point " + Describe(point) + " (LPS mm) is " + FormatFixed(beside, 1) +
                    " mm outside of what is shown, whose middle is at " + Describe(middle) +
                    "; choose a position between its ends.");
  }
  return Along(middle, look, depth);
}

int
NumberOfPixels(double length, double pixelSize)
{
  constexpr double tolerance = 1e-6; // of a pixel, for rounding
  constexpr double most = 65536.0;
  const double number = std::max(1.0, std::ceil(length / pixelSize - tolerance));
  if (!(pixelSize > 0.0) || !(number <= most))
  {
    throw Failure(FailureKind::Usage,
                  "Slices of " + FormatFixed(length, 1) + " mm can't have pixels of " + FormatNumber(pixelSize) +
                    " mm; give a size above " + FormatNumber(length / most) + " mm.");
  }
  return static_cast<int>(number);
}

} // namespace

std::size_t
AxisOf(SlicePlane plane)
{
  return plane == SlicePlane::Axial ? 2 : plane == SlicePlane::Coronal ? 1 : 0;
}

std::string
NameOf(SlicePlane plane)
{
  return PlaneNames[static_cast<std::size_t>(plane)];
}

SlicePlane
SlicePlaneFromName(const std::string & name)
{
  const auto found = std::find(PlaneNames.begin(), PlaneNames.end(), LowerCase(name));
  if (found == PlaneNames.end())
  {
    throw Failure(FailureKind::Usage, DescribeUnknown("slice plane", name, PlaneNames, "use " + Enumerate(PlaneNames)));
  }
  return static_cast<SlicePlane>(found - PlaneNames.begin());
}

ViewFrame
FrameOf(SlicePlane plane, SliceConvention convention)
{
  constexpr Vector3 towardsHead{ 0, 0, 1 };
  const double side = convention == SliceConvention::Radiological ? 1.0 : -1.0;
  ViewFrame frame{ { -1, 0, 0 }, towardsHead, {} };
  if (plane == SlicePlane::Axial)
  {
    frame = { { 0, 0, side }, { 0, -1, 0 }, {} };
  }
  else if (plane == SlicePlane::Coronal)
  {
    frame.look = { 0, side, 0 };
  }
  frame.right = Cross(frame.look, frame.up);
  return frame;
}

SliceBox
BoxOf(const Scan & scan)
{
  const itk::SliceStack stack(GeometryOf(scan.image), scan.sliceOrigins);
  const itk::ImageBase<3>::PointType corner = stack.TransformFrameToPoint(stack.GetLowest());
  SliceBox box{};
  for (unsigned int row = 0; row < 3; ++row)
  {
    box.corner[row] = corner[row];
    box.spacing[row] = stack.GetPitch()[row];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.sides[axis][row] = stack.GetDirection()[row][axis] * (stack.GetHighest()[axis] - stack.GetLowest()[axis]);
    }
  }
  return box;
}

SliceBox
BoxOf(const Vector3 & lowest, const Vector3 & highest, const Vector3 & spacing)
{
  SliceBox box{ lowest, {}, spacing };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.sides[axis][axis] = highest[axis] - lowest[axis];
  }
  return box;
}

Vector3
PointAtPosition(const SliceBox & box, SlicePlane plane, double position)
{
  Vector3 point = MiddleOf(box);
  point[AxisOf(plane)] = position;
  return point;
}

Vector3
PointAtIndex(const Scan & scan, SlicePlane plane, std::size_t index)
{
  const itk::ImageBase<3> & grid = GeometryOf(scan.image);
  const auto & region = grid.GetLargestPossibleRegion();
  const auto steepness = [&grid, row = AxisOf(plane)](unsigned int axis) {
    return std::abs(grid.GetDirection()[static_cast<unsigned int>(row)][axis]);
  };
  unsigned int nearest = 0;
  for (const unsigned int axis : { 1U, 2U })
  {
    nearest = steepness(axis) > steepness(nearest) ? axis : nearest;
  }
  if (index >= region.GetSize(nearest))
  {
    throw Failure(FailureKind::Usage,
                  "There is no " + NameOf(plane) + " slice " + std::to_string(index) + "; the scan has slices 0 to " +
                    std::to_string(region.GetSize(nearest) - 1) + ".");
  }
  itk::ContinuousIndex<double, 3> middle;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = static_cast<double>(region.GetIndex(axis)) + 0.5 * (static_cast<double>(region.GetSize(axis)) - 1.0);
  }
  middle[nearest] = static_cast<double>(region.GetIndex(nearest)) + static_cast<double>(index);
  auto point = grid.TransformContinuousIndexToPhysicalPoint<double, double>(middle);
  if (nearest == 2 && !scan.sliceOrigins.empty())
  {
    auto first = region.GetIndex();
    first[2] += static_cast<itk::IndexValueType>(index);
    point += scan.sliceOrigins[index] - grid.TransformIndexToPhysicalPoint<double>(first);
  }
  return { point[0], point[1], point[2] };
}

std::vector<Vector3>
SpreadEvenly(const SliceBox & box, const ViewFrame & frame, std::size_t count)
{
  const Vector3 middle = MiddleOf(box);
  const double step = LengthAlong(frame.look, box) / static_cast<double>(count);
  std::vector<Vector3> points;
  for (std::size_t n = 0; n < count; ++n)
  {
    points.push_back(
      Along(middle, frame.look, step * (static_cast<double>(n) + 0.5 - 0.5 * static_cast<double>(count))));
  }
  return points;
}

Projection
SliceThrough(const Vector3 & point, const SliceBox & box, const ViewFrame & frame, double pixelSize)
{
  const double size = pixelSize != 0.0 ? pixelSize : SmallestSpacing(box, frame.look);
  return { frame,
           CentreOfSlice(point, box, frame.look),
           size,
           NumberOfPixels(LengthAlong(frame.right, box), size),
           NumberOfPixels(LengthAlong(frame.up, box), size) };
}

Projection
SliceOfSize(int width,
            int height,
            const Vector3 & point,
            const SliceBox & box,
            const ViewFrame & frame,
            const Margins & margins)
{
  const double size = std::max(LengthAlong(frame.right, box) / (width - margins.left - margins.right),
                               LengthAlong(frame.up, box) / (height - margins.top - margins.bottom));
  const Vector3 middle = CentreOfSlice(point, box, frame.look);
  const Vector3 beside = Along(middle, frame.right, 0.5 * size * (margins.right - margins.left));
  return { frame, Along(beside, frame.up, 0.5 * size * (margins.top - margins.bottom)), size, width, height };
}

} // namespace rhombic
