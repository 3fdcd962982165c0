#include "rhombicHiding.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace rhombic
{
namespace
{

constexpr int RaysAlongSide = 256;
constexpr double EnclosedShare = 0.9; // of the rays through a surface
constexpr double HidingShare = 0.005; // of the rays through the focus
constexpr double LikeShare = 0.05;    // views whose shares differ by less are alike
constexpr double LeastArea = 0.5;     // of the largest in a view: others look along the focus

constexpr int LongerSideOfSeen = 600; // pixels
constexpr int FewestSeenPixels = 3;

constexpr float Nothing = std::numeric_limits<float>::infinity();

/** A point as rays see it: in pixels to the right and downwards, and mm along the rays. */
using SeenPoint = std::array<float, 3>;

/** The rays of a view through a box. */
Projection
RaysThrough(const LPSBox & box, const ViewFrame & frame)
{
  double longest = 0.0;
  for (const Vector3 & side : { frame.right, frame.up })
  {
    double length = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      length += std::abs(side[axis]) * (box.highest[axis] - box.lowest[axis]);
    }
    longest = std::max(longest, length);
  }
  Projection rays;
  rays.frame = frame;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    rays.centre[axis] = 0.5 * (box.lowest[axis] + box.highest[axis]);
  }
  rays.width = rays.height = RaysAlongSide;
  rays.pixelSize = std::max(longest, 1e-6) / RaysAlongSide;
  return rays;
}

/** The projection in the picture with \a LongerSideOfSeen pixels along its longer side. */
Projection
Reduced(Projection projection)
{
  const double scale = static_cast<double>(LongerSideOfSeen) / std::max({ projection.width, projection.height, 1 });
  projection.pixelSize /= scale;
  projection.width = std::max(1, static_cast<int>(std::lround(scale * projection.width)));
  projection.height = std::max(1, static_cast<int>(std::lround(scale * projection.height)));
  return projection;
}

Vector3
ToVector(const itk::TriangleSurface::PointType & point)
{
  return { point[0], point[1], point[2] };
}

itk::BulkVector<SeenPoint>
SeePoints(const itk::TriangleSurface & surface, const Projection & rays)
{
  const double depthOfCentre = Dot(rays.centre, rays.frame.look);
  itk::BulkVector<SeenPoint> seen;
  seen.reserve(surface.GetNumberOfPoints());
  for (const auto & stored : surface.GetPoints())
  {
    const Vector3 point = ToVector(stored);
    const PicturePosition position = rays.PositionOf(point);
    seen.push_back({ static_cast<float>(position.x),
                     static_cast<float>(position.y),
                     static_cast<float>(Dot(point, rays.frame.look) - depthOfCentre) });
  }
  return seen;
}

/** Twice the area of the triangle of an edge and a ray in the picture, with a sign. The other
 * direction of the edge has exactly the negated area: a ray never passes between two triangles. */
float
AreaBeside(const SeenPoint & from, const SeenPoint & to, const SeenPoint & ray)
{
  if (to < from)
  {
    return -AreaBeside(to, from, ray);
  }
  return (to[0] - from[0]) * (ray[1] - from[1]) - (to[1] - from[1]) * (ray[0] - from[0]);
}

/** The pixels along an axis, first and last, whose centres lie within a triangle's extent. */
std::pair<int, int>
PixelsAlong(std::size_t axis, const std::array<SeenPoint, 3> & corners, int count)
{
  const auto [least, most] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
  const auto last = static_cast<float>(count);
  return { static_cast<int>(std::ceil(std::clamp(least, 0.0f, last) - 0.5f)),
           static_cast<int>(std::floor(std::clamp(most, 0.0f, last) - 0.5f)) };
}

/** Calls \a meet(x, y, depth) for each ray through a triangle. */
template <typename TMeet>
void
MeetTriangle(const std::array<SeenPoint, 3> & corners, const Projection & rays, const TMeet & meet)
{
  const auto [left, right] = PixelsAlong(0, corners, rays.width);
  const auto [top, bottom] = PixelsAlong(1, corners, rays.height);
  const auto & [a, b, c] = corners;
  for (int y = top; y <= bottom; ++y)
  {
    for (int x = left; x <= right; ++x)
    {
      const SeenPoint ray{ static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0.0f };
      const float ofA = AreaBeside(b, c, ray);
      const float ofB = AreaBeside(c, a, ray);
      const float ofC = AreaBeside(a, b, ray);
      const float area = ofA + ofB + ofC;
      const auto [least, most] = std::minmax({ ofA, ofB, ofC });
      if (area != 0.0f && (least >= 0.0f || most <= 0.0f))
      {
        meet(x, y, (ofA * a[2] + ofB * b[2] + ofC * c[2]) / area);
      }
    }
  }
}

/** Where rays first meet those surfaces for which \a counts(number) holds. */
template <typename TCounts>
std::vector<float>
FindNearest(const Scene & scene, const Projection & rays, const TCounts & counts)
{
  std::vector<float> nearest(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height), Nothing);
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    if (counts(n))
    {
      const std::vector<float> depths = FindDepths(scene.surfaces[n], scene.cuts, rays);
      std::transform(nearest.begin(), nearest.end(), depths.begin(), nearest.begin(), [](float a, float b) {
        return std::min(a, b);
      });
    }
  }
  return nearest;
}

/** Of the rays that meet something in \a behind, the share that meets something nearer in \a front; 0 without rays. */
double
HiddenShare(const std::vector<float> & front, const std::vector<float> & behind)
{
  std::size_t rays = 0;
  std::size_t hidden = 0;
  for (std::size_t n = 0; n < behind.size(); ++n)
  {
    rays += behind[n] < Nothing ? 1 : 0;
    hidden += front[n] < behind[n] && behind[n] < Nothing ? 1 : 0;
  }
  return rays > 0 ? static_cast<double>(hidden) / static_cast<double>(rays) : 0.0;
}

/** The numbers of a surface in front and one behind. */
using SurfacePair = std::pair<std::size_t, std::size_t>;

/** The pairs, in ascending order, of an opaque surface and another one whose boxes meet. */
std::vector<SurfacePair>
PairsOf(const Scene & scene)
{
  std::vector<LPSBox> boxes;
  for (const SceneSurface & surface : scene.surfaces)
  {
    boxes.push_back(BoxAround({ surface }));
  }
  const auto doMeet = [&boxes](std::size_t a, std::size_t b) {
    bool all = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      all = all && boxes[a].lowest[axis] <= boxes[b].highest[axis] && boxes[b].lowest[axis] <= boxes[a].highest[axis];
    }
    return all;
  };
  std::vector<SurfacePair> pairs;
  for (std::size_t front = 0; front < boxes.size(); ++front)
  {
    for (std::size_t behind = 0; behind < boxes.size(); ++behind)
    {
      if (front != behind && scene.surfaces[front].opacity == 1.0 && doMeet(front, behind))
      {
        pairs.emplace_back(front, behind);
      }
    }
  }
  return pairs;
}

LPSBox
BoxOfFocus(const Scene & scene, const std::vector<bool> & isFocus)
{
  std::vector<SceneSurface> focus;
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    if (isFocus[n])
    {
      focus.push_back(scene.surfaces[n]);
    }
  }
  return BoxAround(focus);
}

} // namespace

std::vector<float>
FindDepths(const SceneSurface & item, const std::vector<ClipPlane> & cuts, const Projection & rays)
{
  std::vector<float> depths(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height), Nothing);
  std::vector<ClipPlane> planes;
  std::copy_if(
    cuts.begin(), cuts.end(), std::back_inserter(planes), [&item](const ClipPlane & cut) { return IsCut(item, cut); });
  const auto isRemoved = [&](int x, int y, float depth) {
    const Vector3 point = Along(rays.PointAt({ x + 0.5, y + 0.5 }), rays.frame.look, depth);
    return std::any_of(planes.begin(), planes.end(), [&point](const ClipPlane & plane) {
      return Dot(point, plane.normal) > Dot(plane.point, plane.normal);
    });
  };
  const itk::BulkVector<SeenPoint> points = SeePoints(*item.surface, rays);
  for (const auto & triangle : item.surface->GetTriangles())
  {
    MeetTriangle(
      { points[triangle[0]], points[triangle[1]], points[triangle[2]] }, rays, [&](int x, int y, float depth) {
        float & nearest =
          depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(rays.width) + static_cast<std::size_t>(x)];
        if (depth < nearest && (planes.empty() || !isRemoved(x, y, depth)))
        {
          nearest = depth;
        }
      });
  }
  return depths;
}

std::vector<bool>
FindSeenSurfaces(const Scene & scene, const Projection & projection)
{
  const Projection rays = Reduced(projection);
  const std::size_t count = scene.surfaces.size();
  std::vector<float> nearest(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height), Nothing);
  std::vector<std::size_t> front(nearest.size(), count); // the opaque surface there
  for (std::size_t n = 0; n < count; ++n)
  {
    const bool isOpaque = scene.surfaces[n].opacity >= 1.0;
    const auto depths = isOpaque ? FindDepths(scene.surfaces[n], scene.cuts, rays) : std::vector<float>();
    for (std::size_t pixel = 0; pixel < depths.size(); ++pixel)
    {
      if (depths[pixel] < nearest[pixel])
      {
        nearest[pixel] = depths[pixel];
        front[pixel] = n;
      }
    }
  }
  std::vector<bool> isSeen;
  for (std::size_t n = 0; n < count; ++n)
  {
    const bool isOpaque = scene.surfaces[n].opacity >= 1.0;
    const auto depths = isOpaque ? std::vector<float>() : FindDepths(scene.surfaces[n], scene.cuts, rays);
    const int pixels =
      isOpaque ? static_cast<int>(std::count(front.begin(), front.end(), n))
               : std::inner_product(depths.begin(), depths.end(), nearest.begin(), 0, std::plus<>(), std::less<>());
    isSeen.push_back(pixels >= FewestSeenPixels);
  }
  return isSeen;
}

std::vector<std::size_t>
FindEnclosing(const Scene & scene)
{
  const std::size_t count = scene.surfaces.size();
  std::vector<SurfacePair> pairs = PairsOf(scene);
  const LPSBox box = pairs.empty() ? LPSBox() : BoxAround(scene.surfaces);
  for (const View & view : StandardViews())
  {
    std::vector<bool> isNeeded(count, false);
    for (const auto & [front, behind] : pairs)
    {
      isNeeded[front] = isNeeded[behind] = true;
    }
    std::vector<std::vector<float>> depths(count);
    ForEachOnThreads(count, [&](std::size_t n) {
      depths[n] =
        isNeeded[n] ? FindDepths(scene.surfaces[n], scene.cuts, RaysThrough(box, view.frame)) : std::vector<float>();
    });
    const auto isSeen = [&depths](const SurfacePair & pair) {
      return HiddenShare(depths[pair.first], depths[pair.second]) < EnclosedShare;
    };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isSeen), pairs.end());
  }
  std::vector<std::size_t> enclosing;
  for (const SurfacePair & pair : pairs)
  {
    if (enclosing.empty() || enclosing.back() != pair.first)
    {
      enclosing.push_back(pair.first);
    }
  }
  return enclosing;
}

std::vector<std::size_t>
FindHiding(const Scene & scene, const std::vector<bool> & isFocus, const std::vector<View> & views)
{
  const LPSBox box = BoxOfFocus(scene, isFocus);
  std::vector<bool> hides(scene.surfaces.size(), false);
  for (const View & view : views)
  {
    const Projection rays = RaysThrough(box, view.frame);
    const std::vector<float> focus = FindNearest(scene, rays, [&isFocus](std::size_t n) { return isFocus[n]; });
    for (std::size_t n = 0; n < hides.size(); ++n)
    {
      if (!isFocus[n] && !hides[n])
      {
        hides[n] = HiddenShare(FindDepths(scene.surfaces[n], scene.cuts, rays), focus) >= HidingShare;
      }
    }
  }
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < hides.size(); ++n)
  {
    if (hides[n])
    {
      numbers.push_back(n);
    }
  }
  return numbers;
}

const View &
FindBestView(const Scene & scene, const std::vector<bool> & isFocus)
{
  struct Candidate
  {
    const View * view;
    double hiddenShare;
    double area; // of the focus in the view, in mm^2
  };
  const LPSBox box = BoxOfFocus(scene, isFocus);
  std::vector<Candidate> candidates;
  double largestArea = 0.0;
  for (const View & view : StandardViews())
  {
    const Projection rays = RaysThrough(box, view.frame);
    const std::vector<float> focus = FindNearest(scene, rays, [&isFocus](std::size_t n) { return isFocus[n]; });
    const std::vector<float> front =
      FindNearest(scene, rays, [&](std::size_t n) { return !isFocus[n] && scene.surfaces[n].opacity == 1.0; });
    const auto met =
      static_cast<double>(std::count_if(focus.begin(), focus.end(), [](float depth) { return depth < Nothing; }));
    const double area = met * rays.pixelSize * rays.pixelSize;
    candidates.push_back({ &view, HiddenShare(front, focus), area });
    largestArea = std::max(largestArea, area);
  }
  const Candidate * best = nullptr;
  for (const Candidate & candidate : candidates)
  {
    const bool isLarge = candidate.area >= LeastArea * largestArea;
    if (isLarge && (best == nullptr || candidate.hiddenShare <= best->hiddenShare - LikeShare))
    {
      best = &candidate;
    }
  }
  return *best->view;
}

} // namespace rhombic
