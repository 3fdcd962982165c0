#include "itkTriangleProximity.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Corners = std::array<PositionType, 3>;

constexpr double ShareOfSide = 0.25;   // below which pieces are not cut
constexpr double NearForCentres = 0.9; // of the distance

double
SquaredDistance(const PositionType & a, const PositionType & b)
{
  const PositionType way = Subtract(a, b);
  return Dot(way, way);
}

PositionType
Middle(const PositionType & a, const PositionType & b)
{
  return { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
}

double
SquaredLongestSide(const Corners & corners)
{
  const auto & [a, b, c] = corners;
  return std::max({ SquaredDistance(a, b), SquaredDistance(b, c), SquaredDistance(c, a) });
}

double
SquaredLongestSide(const TriangleTree & surface, std::uint32_t triangle)
{
  const auto & points = surface.GetSurface().GetPoints();
  const auto & [a, b, c] = surface.GetSurface().GetTriangles()[triangle];
  return SquaredLongestSide({ ToPosition(points[a]), ToPosition(points[b]), ToPosition(points[c]) });
}

class Proof
{
public:
  Proof(const Corners & whole, const TriangleTree & surface, double distance)
    : m_Surface(surface)
    , m_Distance(distance)
    , m_SquaredSide(SquaredLongestSide(whole))
  {}

  /** \param likely a triangle of the surface that may be near, or None */
  bool
  IsNear(const Corners & piece, std::uint32_t likely) const
  {
    const auto & [a, b, c] = piece;
    const PositionType centre{ (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 };
    const auto [nearest, squaredDistance] = this->FindNearest(centre, likely);
    if (nearest == TriangleTree::None)
    {
      return false;
    }
    const double squaredRadius =
      std::max({ SquaredDistance(a, centre), SquaredDistance(b, centre), SquaredDistance(c, centre) });
    const auto isSmall = [&, id = nearest] {
      const double side = std::min(m_SquaredSide, SquaredLongestSide(m_Surface, id));
      return SquaredLongestSide(piece) <= ShareOfSide * ShareOfSide * side;
    };
    if (isSmall() || std::sqrt(squaredDistance) + std::sqrt(squaredRadius) <= m_Distance ||
        std::all_of(piece.begin(), piece.end(), [&, id = nearest](const PositionType & corner) {
          return SquaredDistance(corner, m_Surface.FindClosestPointOfTriangle(corner, id)) <= m_Distance * m_Distance;
        }))
    {
      return true;
    }
    const PositionType ab = Middle(a, b);
    const PositionType bc = Middle(b, c);
    const PositionType ca = Middle(c, a);
    return this->IsNear({ ab, bc, ca }, nearest) && this->IsNear({ a, ab, ca }, nearest) &&
           this->IsNear({ ab, b, bc }, nearest) && this->IsNear({ ca, bc, c }, nearest);
  }

private:
  struct Nearest
  {
    std::uint32_t triangle; // None if it is not near enough
    double squaredDistance;
  };

  Nearest
  FindNearest(const PositionType & position, std::uint32_t likely) const
  {
    double bound = NearForCentres * NearForCentres * m_Distance * m_Distance;
    if (likely != TriangleTree::None)
    {
      const double squared = SquaredDistance(position, m_Surface.FindClosestPointOfTriangle(position, likely));
      likely = squared <= bound ? likely : TriangleTree::None;
      bound = std::min(bound, squared);
    }
    const auto nearest = m_Surface.FindClosestPoint(position, bound);
    return nearest.triangle != TriangleTree::None ? Nearest{ nearest.triangle, nearest.squaredDistance }
                                                  : Nearest{ likely, bound };
  }

  const TriangleTree & m_Surface;
  const double m_Distance;
  const double m_SquaredSide; // the longest of the whole
};

} // namespace

bool
IsWithinDistance(const Corners & corners, const TriangleTree & surface, double distance)
{
  return Proof(corners, surface, distance).IsNear(corners, TriangleTree::None);
}

} // namespace itk
