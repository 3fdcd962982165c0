#include "rhombicCameraFit.h"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr double ViewAngle = 30.0;     // degrees, across the shorter side
constexpr double SmallestReach = 1e-3; // mm, for a scene without extent
constexpr double Lowest = std::numeric_limits<double>::lowest();

/** Slopes of the rays through the inner edges of the margins: tangents, 0 in parallel projection. */
struct Slopes
{
  double horizontal = 0.0;
  double vertical = 0.0;
};

/** The extent of the scene along one axis of the picture. Seen from a camera at depth -t, the rays at the margins are
 * at centre +- slope * (t + d) at depth d. So a point at (x, d) is inside when x - slope * d <= centre + slope * t and
 * -x - slope * d <= -centre + slope * t. Only the largest left sides matter: `up` and `down`. */
struct Extent
{
  double up = Lowest;
  double down = Lowest;

  void
  Add(double coordinate, double spread)
  {
    up = std::max(up, coordinate - spread);
    down = std::max(down, -coordinate - spread);
  }

  double
  Centre() const
  {
    return 0.5 * (up - down);
  }

  /** slope * t, or half the size in parallel projection. */
  double
  Reach() const
  {
    return std::max(0.5 * (up + down), SmallestReach);
  }
};

struct SceneExtent
{
  Extent horizontal;
  Extent vertical;
  double nearest = std::numeric_limits<double>::max();
  double farthest = Lowest;
};

using DirectionType = ViewFrame::DirectionType;

double
Along(const DirectionType & direction, const itk::TriangleSurface::PointType & point)
{
  return direction[0] * double{ point[0] } + direction[1] * double{ point[1] } + direction[2] * double{ point[2] };
}

SceneExtent
Measure(const std::vector<SceneSurface> & scene, const ViewFrame & frame, const Slopes & slopes)
{
  SceneExtent extent;
  for (const auto & item : scene)
  {
    for (const auto & point : item.surface->GetPoints())
    {
      const double depth = Along(frame.look, point);
      extent.horizontal.Add(Along(frame.right, point), slopes.horizontal * depth);
      extent.vertical.Add(Along(frame.up, point), slopes.vertical * depth);
      extent.nearest = std::min(extent.nearest, depth);
      extent.farthest = std::max(extent.farthest, depth);
    }
  }
  return extent;
}

void
PlaceCamera(const ViewFrame & frame, const SceneExtent & extent, double depth, vtkCamera * camera)
{
  std::array<double, 3> position;
  for (std::size_t i = 0; i < position.size(); ++i)
  {
    position[i] =
      frame.right[i] * extent.horizontal.Centre() + frame.up[i] * extent.vertical.Centre() + frame.look[i] * depth;
  }
  const double size = std::max(extent.farthest - extent.nearest, 1.0);
  camera->SetPosition(position.data());
  camera->SetFocalPoint(
    position[0] + size * frame.look[0], position[1] + size * frame.look[1], position[2] + size * frame.look[2]);
  camera->SetViewUp(frame.up[0], frame.up[1], frame.up[2]);
  const double slack = 0.01 * size;
  const double nearest = extent.nearest - depth;
  camera->SetClippingRange(std::max(nearest - slack, 0.5 * nearest), extent.farthest - depth + slack);
}

} // namespace

void
FitCamera(const std::vector<SceneSurface> & scene, const RenderSettings & settings, double margin, vtkCamera * camera)
{
  const ViewFrame frame = FrameOf(settings.view);
  const double innerWidth = settings.width - 2.0 * margin;
  const double innerHeight = settings.height - 2.0 * margin;
  camera->SetParallelProjection(!settings.perspective);
  if (settings.perspective)
  {
    const double slopePerPixel =
      std::tan(vtkMath::RadiansFromDegrees(0.5 * ViewAngle)) / (0.5 * std::min(settings.width, settings.height));
    const Slopes slopes{ 0.5 * innerWidth * slopePerPixel, 0.5 * innerHeight * slopePerPixel };
    const auto extent = Measure(scene, frame, slopes);
    const double distance =
      std::max(extent.horizontal.Reach() / slopes.horizontal, extent.vertical.Reach() / slopes.vertical);
    camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(0.5 * settings.height * slopePerPixel)));
    PlaceCamera(frame, extent, -distance, camera);
    return;
  }
  const auto extent = Measure(scene, frame, Slopes{});
  const double pixel = 2.0 * std::max(extent.horizontal.Reach() / innerWidth, extent.vertical.Reach() / innerHeight);
  camera->SetParallelScale(0.5 * settings.height * pixel);
  const double standOff = std::max(extent.farthest - extent.nearest, 1.0);
  PlaceCamera(frame, extent, extent.nearest - standOff, camera);
}

} // namespace rhombic
