#ifndef itkTriangleProximity_h
#define itkTriangleProximity_h

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleTree.h"

namespace itk
{

/** \class TriangleProximity
 * \brief Whether all of a triangle is within a distance of a surface.
 *
 * The triangle is cut into pieces. A piece is near if all its corners are near one triangle of the surface, because the
 * points within a distance of a triangle are a convex set. A piece is also near if its centre is nearer than the
 * distance by at least the distance from the centre to the farthest corner. Pieces are no longer cut when their longest
 * side is below a quarter of that of the triangle and of the nearest triangle of the surface: then the corners must be
 * near and the centre within 0.9 times the distance. So the answer yes is proven except between these points, no
 * farther than 0.1 of that side from one of these points. */
class TriangleProximity
{
public:
  /** \param distance in mm, above 0 */
  TriangleProximity(const CornersType & triangle, const TriangleTree & surface, double distance)
    : m_Triangle(triangle)
    , m_Surface(surface)
    , m_Distance(distance)
    , m_SquaredSide(SquaredLongestSide(triangle))
  {}

  /** Whether the triangle is near one of three triangles of the surface. */
  bool
  IsNearOneOf(const std::array<std::uint32_t, 3> & triangles) const
  {
    return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
      return this->IsNearTriangle(m_Triangle, triangle);
    });
  }

  /** Whether the triangle is near the surface. The three triangles \a likely of the surface are tried first; the nearer
   * they are, the faster is the answer. */
  bool
  IsNearSurface(const std::array<std::uint32_t, 3> & likely) const
  {
    return this->IsNearOneOf(likely) || this->IsNear(m_Triangle, likely[0]);
  }

private:
  static constexpr double SmallestShareOfSide = 0.25; ///< smaller pieces are not cut
  static constexpr double NearForCentres = 0.9;       ///< relative to the distance

  static double
  SquaredLongestSide(const CornersType & corners)
  {
    const auto & [a, b, c] = corners;
    return std::max({ SquaredDistance(a, b), SquaredDistance(b, c), SquaredDistance(c, a) });
  }

  static PositionType
  Middle(const PositionType & a, const PositionType & b)
  {
    return { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
  }

  /** Whether a piece is near one triangle of the surface. */
  bool
  IsNearTriangle(const CornersType & piece, std::uint32_t triangle) const
  {
    return std::all_of(piece.begin(), piece.end(), [&](const PositionType & corner) {
      return this->SquaredDistanceTo(triangle, corner) <= m_Distance * m_Distance;
    });
  }

  /** Whether a piece is near the surface; \a likely is a triangle of the surface that may be near. */
  bool
  IsNear(const CornersType & piece, std::uint32_t likely) const
  {
    if (this->IsNearTriangle(piece, likely))
    {
      return true;
    }
    const auto & [a, b, c] = piece;
    const PositionType centre{ (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 };
    const double squaredRadius =
      std::max({ SquaredDistance(a, centre), SquaredDistance(b, centre), SquaredDistance(c, centre) });
    const double enough = std::max(0.0, m_Distance - std::sqrt(squaredRadius)); // so that the farthest corner is near
    const Nearest nearest = this->FindNearest(centre, likely, enough * enough);
    if (nearest.triangle == TriangleTree::None)
    {
      return false;
    }
    if (nearest.squaredDistance <= enough * enough || this->IsNearTriangle(piece, nearest.triangle))
    {
      return true;
    }
    if (this->IsSmall(piece, nearest.triangle))
    {
      return this->AreCornersNear(piece);
    }
    const PositionType ab = Middle(a, b);
    const PositionType bc = Middle(b, c);
    const PositionType ca = Middle(c, a);
    return this->IsNear({ ab, bc, ca }, nearest.triangle) && this->IsNear({ a, ab, ca }, nearest.triangle) &&
           this->IsNear({ ab, b, bc }, nearest.triangle) && this->IsNear({ ca, bc, c }, nearest.triangle);
  }

  struct Nearest
  {
    std::uint32_t triangle; ///< None if nothing is near enough
    double squaredDistance;
  };

  /** The triangle nearest to a centre, or any triangle within the squared distance \a enough. */
  Nearest
  FindNearest(const PositionType & centre, std::uint32_t likely, double enough) const
  {
    const double limit = NearForCentres * NearForCentres * m_Distance * m_Distance;
    const double squared = this->SquaredDistanceTo(likely, centre);
    if (squared <= std::min(limit, enough))
    {
      return { likely, squared };
    }
    const auto nearest = m_Surface.FindClosestPoint(centre, std::min(limit, squared), enough);
    return nearest.triangle == TriangleTree::None && squared <= limit
             ? Nearest{ likely, squared }
             : Nearest{ nearest.triangle, nearest.squaredDistance };
  }

  bool
  IsSmall(const CornersType & piece, std::uint32_t nearest) const
  {
    const double side =
      std::min(m_SquaredSide,
               SquaredLongestSide(CornersOf(m_Surface.GetSurface(), m_Surface.GetSurface().GetTriangles()[nearest])));
    return SquaredLongestSide(piece) <= SmallestShareOfSide * SmallestShareOfSide * side;
  }

  bool
  AreCornersNear(const CornersType & piece) const
  {
    const double limit = m_Distance * m_Distance;
    return std::all_of(piece.begin(), piece.end(), [&](const PositionType & corner) {
      return m_Surface.FindClosestPoint(corner, limit, limit).triangle != TriangleTree::None;
    });
  }

  double
  SquaredDistanceTo(std::uint32_t triangle, const PositionType & position) const
  {
    return SquaredDistance(position, m_Surface.FindClosestPointOfTriangle(position, triangle));
  }

  const CornersType & m_Triangle;
  const TriangleTree & m_Surface;
  const double m_Distance;
  const double m_SquaredSide; ///< longest side of the triangle
};

} // namespace itk

#endif
