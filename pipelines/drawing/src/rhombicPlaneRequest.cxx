#include "rhombicPictureSteps.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
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

constexpr std::size_t Places = 200; // that are tried for a slice

/** The n-th of places that lie evenly within a box, in LPS mm. */
double
PositionOf(std::size_t n, std::size_t axis, const LPSBox & box)
{
  return box.lowest[axis] +
         (box.highest[axis] - box.lowest[axis]) * static_cast<double>(n) / static_cast<double>(Places);
}

/** The areas in mm^2 of a closed surface's sections at PositionOf() all places. A section's area is the sum of the
 * areas of all triangles above it, projected along the axis, as the whole surface's sum is 0. */
std::array<double, Places>
FindSections(const itk::TriangleSurface & surface, std::size_t axis, const LPSBox & box)
{
  std::array<double, Places> areas{};
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const double perMillimetre = static_cast<double>(Places) / std::max(box.highest[axis] - box.lowest[axis], 1e-9);
  for (const auto & [first, second, third] : surface.GetTriangles())
  {
    const auto & a = surface.GetPoints()[first];
    const auto & b = surface.GetPoints()[second];
    const auto & c = surface.GetPoints()[third];
    const double area =
      0.5 * ((double(b[u]) - a[u]) * (double(c[v]) - a[v]) - (double(b[v]) - a[v]) * (double(c[u]) - a[u]));
    const double place = ((double(a[axis]) + b[axis] + c[axis]) / 3.0 - box.lowest[axis]) * perMillimetre;
    areas[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(Places - 1)))] += area;
  }
  for (std::size_t n = Places - 1; n > 0; --n)
  {
    areas[n - 1] += areas[n];
  }
  return areas;
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
  constexpr double notable = 0.1; // share of a surface's largest section that counts as shown
  constexpr double like = 0.05;   // sums of shares that differ by less are alike
  const std::size_t axis = AxisOf(plane);
  const LPSBox box = BoxAround(scene.surfaces);
  const double middle = CentreOf(box)[axis];
  std::array<int, Places> shown{};     // surfaces
  std::array<double, Places> shares{}; // of the largest sections of all surfaces
  for (const SceneSurface & surface : scene.surfaces)
  {
    const std::array<double, Places> areas = FindSections(*surface.surface, axis, box);
    const double largest = *std::max_element(areas.begin(), areas.end());
    for (std::size_t n = 0; largest > 0.0 && n < Places; ++n)
    {
      shown[n] += areas[n] >= notable * largest ? 1 : 0;
      shares[n] += std::max(0.0, areas[n]) / largest;
    }
  }
  const auto valueAt = [&](std::size_t n) {
    return std::make_tuple(shown[n], std::lround(shares[n] / like), -std::abs(PositionOf(n, axis, box) - middle));
  };
  std::size_t best = 0;
  for (std::size_t n = 1; n < Places; ++n)
  {
    best = valueAt(n) > valueAt(best) ? n : best;
  }
  const auto [lowest, highest] = ReachOf(scene.box, axis);
  return PointAtPosition(scene.box, plane, std::clamp(PositionOf(best, axis, box), lowest, highest));
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
