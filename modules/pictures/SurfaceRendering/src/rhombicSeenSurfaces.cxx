#include "rhombicSeenSurfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int LongerSide = 600;
constexpr std::size_t FewestPixels = 3;
constexpr std::size_t Nothing = std::numeric_limits<std::size_t>::max();

/** A point of a surface in a picture: \a depth is along the look direction, in mm from the projection's centre. */
struct SeenPoint
{
  double x;
  double y;
  double depth;
};

/** The picture with \a LongerSide pixels along its longer side. */
Projection
Reduced(Projection projection)
{
  const double scale = static_cast<double>(LongerSide) / std::max({ projection.width, projection.height, 1 });
  projection.pixelSize /= scale;
  projection.width = std::max(1, static_cast<int>(std::lround(scale * projection.width)));
  projection.height = std::max(1, static_cast<int>(std::lround(scale * projection.height)));
  return projection;
}

/** Depths of the opaque surfaces in front. */
class DepthPicture
{
public:
  DepthPicture(const Scene & scene, const Projection & projection)
    : m_Scene(scene)
    , m_Projection(projection)
    , m_Depths(static_cast<std::size_t>(projection.width) * static_cast<std::size_t>(projection.height),
               std::numeric_limits<double>::infinity())
    , m_Front(m_Depths.size(), Nothing)
  {}

  /** Draws an opaque surface. */
  void
  Draw(std::size_t number)
  {
    this->VisitPixels(number, [&](std::size_t pixel, double depth) {
      if (depth < m_Depths[pixel])
      {
        m_Depths[pixel] = depth;
        m_Front[pixel] = number;
      }
    });
  }

  /** The pixels in which an opaque surface is in front. */
  std::size_t
  CountFront(std::size_t number) const
  {
    return static_cast<std::size_t>(std::count(m_Front.begin(), m_Front.end(), number));
  }

  /** The pixels, each as often as it is drawn, in which a surface is before all opaque ones. */
  std::size_t
  CountBefore(std::size_t number) const
  {
    std::size_t count = 0;
    this->VisitPixels(number, [&](std::size_t pixel, double depth) { count += depth < m_Depths[pixel] ? 1 : 0; });
    return count;
  }

private:
  /** Calls visit(pixel, depth) for the pixels whose middles are in triangles of a surface, but for those cut away. */
  template <typename TVisit>
  void
  VisitPixels(std::size_t number, const TVisit & visit) const
  {
    const SceneSurface & surface = m_Scene.surfaces[number];
    std::vector<ClipPlane> cuts;
    std::copy_if(m_Scene.cuts.begin(), m_Scene.cuts.end(), std::back_inserter(cuts), [&](const ClipPlane & cut) {
      return cut.surfaces.empty() ||
             std::find(cut.surfaces.begin(), cut.surfaces.end(), surface.name) != cut.surfaces.end();
    });
    const auto isThere = [&](int x, int y, double depth) {
      const Vector3 point = Along(m_Projection.PointAt({ x + 0.5, y + 0.5 }), m_Projection.frame.look, depth);
      return std::none_of(cuts.begin(), cuts.end(), [&point](const ClipPlane & cut) {
        return Dot(Subtract(point, cut.point), cut.normal) > 0.0;
      });
    };
    std::vector<SeenPoint> points;
    points.reserve(surface.surface->GetPoints().size());
    for (const auto & p : surface.surface->GetPoints())
    {
      const Vector3 point{ p[0], p[1], p[2] };
      const PicturePosition position = m_Projection.PositionOf(point);
      points.push_back(
        { position.x - 0.5, position.y - 0.5, Dot(Subtract(point, m_Projection.centre), m_Projection.frame.look) });
    }
    for (const auto & triangle : surface.surface->GetTriangles())
    {
      this->VisitTriangle(
        points[triangle[0]], points[triangle[1]], points[triangle[2]], [&](int x, int y, double depth) {
          if (cuts.empty() || isThere(x, y, depth))
          {
            visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(m_Projection.width) +
                    static_cast<std::size_t>(x),
                  depth);
          }
        });
    }
  }

  /** Calls visit(x, y, depth). Positions are counted from the middle of the first pixel. */
  template <typename TVisit>
  void
  VisitTriangle(const SeenPoint & a, const SeenPoint & b, const SeenPoint & c, const TVisit & visit) const
  {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const auto clampTo = [](double position, int size) {
      return static_cast<int>(std::clamp(position, -1.0, static_cast<double>(size)));
    };
    const int left = std::max(0, clampTo(std::ceil(std::min({ a.x, b.x, c.x })), m_Projection.width));
    const int right =
      std::min(m_Projection.width - 1, clampTo(std::floor(std::max({ a.x, b.x, c.x })), m_Projection.width));
    const int top = std::max(0, clampTo(std::ceil(std::min({ a.y, b.y, c.y })), m_Projection.height));
    const int bottom =
      std::min(m_Projection.height - 1, clampTo(std::floor(std::max({ a.y, b.y, c.y })), m_Projection.height));
    for (int y = top; y <= bottom && area != 0.0; ++y)
    {
      for (int x = left; x <= right; ++x)
      {
        const double shareOfB = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
        const double shareOfC = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
        if (shareOfB >= 0.0 && shareOfC >= 0.0 && shareOfB + shareOfC <= 1.0)
        {
          visit(x, y, a.depth + shareOfB * (b.depth - a.depth) + shareOfC * (c.depth - a.depth));
        }
      }
    }
  }

  const Scene & m_Scene;
  const Projection & m_Projection;
  std::vector<double> m_Depths;
  std::vector<std::size_t> m_Front;
};

} // namespace

std::vector<bool>
FindSeenSurfaces(const Scene & scene, const Projection & projection)
{
  const Projection reduced = Reduced(projection);
  DepthPicture picture(scene, reduced);
  const auto isOpaque = [&scene](std::size_t n) { return scene.surfaces[n].opacity >= 1.0; };
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    if (isOpaque(n))
    {
      picture.Draw(n);
    }
  }
  std::vector<bool> isSeen;
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    isSeen.push_back((isOpaque(n) ? picture.CountFront(n) : picture.CountBefore(n)) >= FewestPixels);
  }
  return isSeen;
}

} // namespace rhombic
