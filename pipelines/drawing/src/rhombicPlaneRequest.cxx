#include "rhombicPictureSteps.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace rhombic
{

namespace
{

/** The lowest and the highest coordinate of a box along an axis of the patient, in LPS mm. */
std::pair<double, double>
ReachOf(const SliceBox & box, std::size_t axis)
{
  double lowest = box.corner[axis];
  double highest = box.corner[axis];
  for (const Vector3 & side : box.sides)
  {
    lowest += std::min(0.0, side[axis]);
    highest += std::max(0.0, side[axis]);
  }
  return { lowest, highest };
}

/** Throws Failure(Usage) for a position in LPS mm that is not in the box. */
void
RequireInside(SlicePlane plane, double position, const SliceBox & box)
{
  const std::size_t axis = AxisOf(plane);
  const auto [lowest, highest] = ReachOf(box, axis);
  if (position < lowest || position > highest)
  {
    throw Failure(FailureKind::Usage,
                  NameOf(plane) + " " + "xyz"[axis] + " = " + FormatNumber(position, 6) +
                    " mm is outside of what is shown, which reaches from " + FormatNumber(lowest, 5) + " to " +
                    FormatNumber(highest, 5) + " mm; choose a place in between.");
  }
}

} // namespace

void
CheckPlaces(const std::vector<PlaneRequest> & requests, const Scan & scan)
{
  for (const PlaneRequest & request : requests)
  {
    if (const auto position = ToNumber<double>(request.place); position && std::isfinite(*position))
    {
      RequireInside(request.plane, *position, BoxOf(scan));
    }
    else if (request.place[0] == '#')
    {
      PointAtIndex(scan, request.plane, ToNumber<std::size_t>(request.place.substr(1)).value());
    }
  }
}

PlaneRequest
ParsePlaneRequest(const std::string & text)
{
  const auto equals = text.find('=');
  PlaneRequest request;
  request.plane = SlicePlaneFromName(text.substr(0, equals));
  request.place = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (equals != std::string::npos && request.place.empty())
  {
    throw Failure(FailureKind::Usage,
                  "The plane '" + text +
                    "' names no place; write axial=12.5 (mm in LPS), axial=#40 (a slice), or axial=liver.");
  }
  if (request.place[0] == '#' && !ToNumber<std::size_t>(request.place.substr(1)))
  {
    throw Failure(FailureKind::Usage, "'" + request.place + "' is no slice; write #40 for the 41st.");
  }
  return request;
}

CutRequest
ParseCutRequest(const std::string & text)
{
  const auto sign = text.find_first_of("<>");
  if (sign == std::string::npos)
  {
    const PlaneRequest plane = ParsePlaneRequest(text);
    return { plane, plane.plane != SlicePlane::Coronal };
  }
  const std::string axis = LowerCase(text.substr(0, sign));
  const std::string place = text.substr(sign + 1);
  for (const SlicePlane plane : { SlicePlane::Sagittal, SlicePlane::Coronal, SlicePlane::Axial })
  {
    const char letter = plane == SlicePlane::Sagittal ? 'x' : plane == SlicePlane::Coronal ? 'y' : 'z';
    if ((axis == NameOf(plane) || axis == std::string(1, letter)) && ToNumber<double>(place))
    {
      return { { plane, place }, text[sign] == '>' };
    }
  }
  throw Failure(FailureKind::Usage,
                "The cut '" + text +
                  "' is not understood; write x>12, y<-30 or z>100 (mm in LPS) for what is "
                  "removed, or a plane, as coronal=liver.");
}

void
NeedPlaces(const std::vector<PlaneRequest> & requests, SceneRules & rules)
{
  for (const PlaneRequest & request : requests)
  {
    if (!request.place.empty() && request.place[0] != '#' && !ToNumber<double>(request.place))
    {
      rules.needed.push_back(request.place);
    }
  }
}

Vector3
PlaceOfMost(SlicePlane plane, const PictureScene & scene)
{
  constexpr int places = 200; // that are tried
  constexpr double end = 0.1; // share of a surface's extent at each end, in which little of it is cut
  const std::size_t axis = AxisOf(plane);
  const LPSBox box = BoxAround(scene.surfaces);
  const double middle = CentreOf(box)[axis];
  std::vector<std::pair<double, double>> reaches;
  for (const SceneSurface & surface : scene.surfaces)
  {
    const LPSBox reach = BoxAround({ surface });
    const double margin = end * (reach.highest[axis] - reach.lowest[axis]);
    reaches.emplace_back(reach.lowest[axis] + margin, reach.highest[axis] - margin);
  }
  const auto countAt = [&reaches](double position) {
    return std::count_if(reaches.begin(), reaches.end(), [position](const auto & reach) {
      return position >= reach.first && position <= reach.second;
    });
  };
  double best = middle;
  for (int n = 0; n <= places; ++n)
  {
    const double position = box.lowest[axis] + (box.highest[axis] - box.lowest[axis]) * n / places;
    const auto gain = countAt(position) - countAt(best);
    if (gain > 0 || (gain == 0 && std::abs(position - middle) < std::abs(best - middle)))
    {
      best = position;
    }
  }
  const auto [lowest, highest] = ReachOf(scene.box, axis);
  return PointAtPosition(scene.box, plane, std::clamp(best, lowest, highest));
}

std::vector<Vector3>
PlacesInLightbox(const PlaneRequest & request, const SliceSettings & settings, const PictureScene & scene)
{
  const std::size_t axis = AxisOf(request.plane);
  LPSBox box{};
  for (const std::size_t n : { 0U, 1U, 2U })
  {
    std::tie(box.lowest[n], box.highest[n]) = ReachOf(scene.box, n);
  }
  if (settings.outlines)
  {
    const LPSBox surfaces = BoxAround(scene.surfaces);
    box.lowest[axis] = std::max(box.lowest[axis], surfaces.lowest[axis]);
    box.highest[axis] = std::min(box.highest[axis], surfaces.highest[axis]);
  }
  auto places =
    SpreadEvenly(BoxOf(box.lowest, box.highest, scene.box.spacing), FrameOf(request.plane), settings.lightbox);
  if (request.plane == SlicePlane::Axial) // the viewer is at the feet
  {
    std::reverse(places.begin(), places.end());
  }
  return places;
}

Vector3
FindPlace(const PlaneRequest & request, const PictureScene & scene)
{
  if (const auto found = scene.places.find(request.place); found != scene.places.end())
  {
    return found->second;
  }
  if (request.place.empty())
  {
    return CentreOf(BoxAround(scene.surfaces));
  }
  if (const auto position = ToNumber<double>(request.place); position && std::isfinite(*position))
  {
    RequireInside(request.plane, *position, scene.box);
    return PointAtPosition(scene.box, request.plane, *position);
  }
  if (request.place[0] == '#')
  {
    if (!scene.scan)
    {
      throw Failure(FailureKind::Usage, "Slices are counted in scans, and this source is none; give a position in mm.");
    }
    return PointAtIndex(*scene.scan, request.plane, ToNumber<std::size_t>(request.place.substr(1)).value());
  }
  Vector3 sum{};
  double volume = 0.0;
  for (const SceneSurface & surface : SurfacesNamed(scene.surfaces, request.place))
  {
    const auto centroid = ComputeTriangleSurfaceCentroid(*surface.surface);
    const double share = std::abs(ComputeTriangleSurfaceVolume(*surface.surface));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum[axis] += share * centroid[axis];
    }
    volume += share;
  }
  return { sum[0] / volume, sum[1] / volume, sum[2] / volume };
}

} // namespace rhombic
