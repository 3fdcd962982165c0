#include "rhombicCameraFit.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int DefaultSide = 1200;      // pixels, of a picture whose size is not given
constexpr double MarginShare = 0.02;   // of the shorter side
constexpr double SmallestReach = 1e-3; // mm, for a scene without extent
constexpr double Lowest = std::numeric_limits<double>::lowest();

const double PerspectiveSlope =
  std::tan(15.0 * std::acos(-1.0) / 180.0); // an angle of 30 degrees across the shorter side

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

  void
  Add(const Vector3 & point, const ViewFrame & frame, const Slopes & slopes)
  {
    const double depth = Dot(frame.look, point);
    horizontal.Add(Dot(frame.right, point), slopes.horizontal * depth);
    vertical.Add(Dot(frame.up, point), slopes.vertical * depth);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
};

SceneExtent
MeasureScene(const Scene & scene, const ViewFrame & frame, const Slopes & slopes)
{
  SceneExtent extent;
  for (const auto & item : scene.surfaces)
  {
    for (const auto & point : item.surface->GetPoints())
    {
      extent.Add({ point[0], point[1], point[2] }, frame, slopes);
    }
  }
  for (const auto & plane : scene.planes)
  {
    const auto width = static_cast<double>(plane.projection.width);
    const auto height = static_cast<double>(plane.projection.height);
    for (const PicturePosition & corner :
         { PicturePosition{ 0, 0 }, PicturePosition{ width, 0 }, { 0, height }, { width, height } })
    {
      extent.Add(plane.projection.PointAt(corner), frame, slopes);
    }
  }
  return extent;
}

/** The extent of the settings' box, or of the whole scene without one. */
SceneExtent
MeasureFitted(const Scene & scene, const RenderSettings & settings, const ViewFrame & frame, const Slopes & slopes)
{
  if (!settings.extent)
  {
    return MeasureScene(scene, frame, slopes);
  }
  SceneExtent extent;
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = (corner >> axis & 1) != 0 ? settings.extent->highest[axis] : settings.extent->lowest[axis];
    }
    extent.Add(point, frame, slopes);
  }
  return extent;
}

/** Whole numbers of pixels. */
Margins
MarginsOf(const RenderSettings & settings)
{
  const int width = settings.width > 0 ? settings.width : DefaultSide;
  const int height = settings.height > 0 ? settings.height : DefaultSide;
  const double margin = std::round(MarginShare * std::min(width, height));
  const Margins margins = settings.margins.value_or(Margins{ margin, margin, margin, margin });
  return { std::ceil(margins.left), std::ceil(margins.right), std::ceil(margins.top), std::ceil(margins.bottom) };
}

/** Pixels between the margins. */
double
Inner(int side, double margin, double otherMargin)
{
  const double inner = side - margin - otherMargin;
  if (!(inner >= 1.0))
  {
    throw Failure(FailureKind::Usage,
                  "Margins of " + FormatNumber(margin) + " and " + FormatNumber(otherMargin) +
                    " pixels leave no room in a picture of " + std::to_string(side) + " pixels.");
  }
  return inner;
}

/** \class Fit
 * \brief How a view fits in parallel projection, before the settings' zoom and centre. */
struct Fit
{
  SceneExtent extent; ///< of the settings' box or the whole scene
  double pixelSize;   ///< at which the extent fits
};

/** The pixel size at which the extent fits between the margins of sides that are given, or of the default side when
 * none is. */
Fit
FitParallel(const Scene & scene, const RenderSettings & settings, const Margins & margins, const ViewFrame & frame)
{
  Fit fit{ MeasureFitted(scene, settings, frame, {}), 0.0 };
  const int side = settings.width == 0 && settings.height == 0 ? DefaultSide : 0;
  if (const int width = std::max(settings.width, side); width > 0)
  {
    fit.pixelSize = 2.0 * fit.extent.horizontal.Reach() / Inner(width, margins.left, margins.right);
  }
  if (const int height = std::max(settings.height, side); height > 0)
  {
    fit.pixelSize =
      std::max(fit.pixelSize, 2.0 * fit.extent.vertical.Reach() / Inner(height, margins.top, margins.bottom));
  }
  return fit;
}

/** The side of a picture: the given side, or, if that is 0, as long as an extent needs. */
int
SideOf(int given, const Extent & extent, double pixelSize, double margins)
{
  // A little less than the quotient, which rounding may have raised above a whole number.
  const double pixels = std::min(std::ceil(2.0 * extent.Reach() / pixelSize - 1e-6), 1e6);
  return given > 0 ? given : std::max(static_cast<int>(pixels), 1) + static_cast<int>(margins);
}

void
PlaceCentre(const RenderSettings & settings, const SceneExtent & fitted, double depth, Camera & camera)
{
  double right = fitted.horizontal.Centre();
  double up = fitted.vertical.Centre();
  if (settings.centre)
  {
    right = Dot(camera.frame.right, *settings.centre);
    up = Dot(camera.frame.up, *settings.centre);
  }
  const ViewFrame & frame = camera.frame;
  camera.centre = Along(Along(Scaled(frame.right, right), frame.up, up), frame.look, depth);
}

void
SetPerspective(const Scene & scene, const RenderSettings & settings, const Margins & margins, Camera & camera)
{
  const double slopePerPixel = PerspectiveSlope / (0.5 * std::min(camera.width, camera.height));
  const Slopes slopes{ 0.5 * Inner(camera.width, margins.left, margins.right) * slopePerPixel,
                       0.5 * Inner(camera.height, margins.top, margins.bottom) * slopePerPixel };
  const auto fitted = MeasureFitted(scene, settings, camera.frame, slopes);
  const double distance =
    std::max(fitted.horizontal.Reach() / slopes.horizontal, fitted.vertical.Reach() / slopes.vertical);
  const double depth = 0.5 * (fitted.nearest + fitted.farthest);
  camera.spread = 1.0 / (distance + depth);
  camera.pixelSize = slopePerPixel / camera.spread / settings.zoom;
  PlaceCentre(settings, fitted, depth, camera);
}

/** Sets the depths between which the whole scene lies, also the parts outside the settings' box. */
void
SetDepths(const Scene & scene, Camera & camera)
{
  const auto all = MeasureScene(scene, camera.frame, {});
  const double depth = Dot(camera.frame.look, camera.centre);
  const double slack = 0.01 * std::max(all.farthest - all.nearest, 1.0);
  camera.nearest = all.nearest - depth - slack;
  camera.farthest = all.farthest - depth + slack;
  if (camera.spread > 0.0)
  {
    const double eye = -1.0 / camera.spread;
    camera.nearest = std::max(camera.nearest, eye + 0.01 * (camera.farthest - eye));
  }
}

} // namespace

Projection
Camera::ToProjection() const
{
  Projection projection{ frame, centre, pixelSize, width, height };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    projection.centre[axis] -= pixelSize * (rightward * frame.right[axis] + upward * frame.up[axis]);
  }
  return projection;
}

std::vector<Camera>
FitCameras(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views)
{
  const Margins margins = MarginsOf(settings);
  std::vector<Fit> fits;
  double largest = 0.0;
  for (const View & view : views)
  {
    fits.push_back(FitParallel(scene, settings, margins, view.frame));
    largest = std::max(largest, fits.back().pixelSize);
  }
  std::vector<Camera> cameras;
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    const Fit & fit = fits[n];
    const double pixelSize = settings.pixelSize.value_or(settings.sameScale ? largest : fit.pixelSize);
    Camera camera;
    camera.frame = views[n].frame;
    camera.width = SideOf(settings.width, fit.extent.horizontal, pixelSize, margins.left + margins.right);
    camera.height = SideOf(settings.height, fit.extent.vertical, pixelSize, margins.top + margins.bottom);
    camera.rightward = 0.5 * (margins.left - margins.right);
    camera.upward = 0.5 * (margins.bottom - margins.top);
    camera.pixelSize = pixelSize / settings.zoom;
    PlaceCentre(settings, fit.extent, 0.5 * (fit.extent.nearest + fit.extent.farthest), camera);
    if (settings.perspective)
    {
      SetPerspective(scene, settings, margins, camera);
    }
    SetDepths(scene, camera);
    cameras.push_back(camera);
  }
  return cameras;
}

} // namespace rhombic
