#ifndef itkTriangleProximity_h
#define itkTriangleProximity_h

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleDistances.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace itk
{

/** Triangles of a surface to all of which together a triangle is near: as long as they stay, the triangle is near the
 * surface, whatever else changes. */
struct ProximityProof
{
  static constexpr unsigned int MostTriangles = 6;

  std::array<std::uint32_t, MostTriangles> triangles{};
  unsigned int size = 0; ///< more than MostTriangles if there are too many

  void
  Add(std::uint32_t triangle)
  {
    const auto end = triangles.begin() + std::min(size, MostTriangles);
    if (this->IsComplete() && std::find(triangles.begin(), end, triangle) == end)
    {
      if (size < MostTriangles)
      {
        triangles[size] = triangle;
      }
      ++size;
    }
  }

  bool
  IsComplete() const
  {
    return size <= MostTriangles;
  }
};

/** \class TriangleProximity
 * \brief Whether all of a triangle is within a distance of a surface.
 *
 * The triangle is cut into pieces. A piece is near if all its corners are near one triangle of the surface, because the
 * points within a distance of a triangle are a convex set. A piece is also near if its centre is nearer than the
 * distance by at least the distance from the centre to the farthest corner. Other pieces are cut along the border of
 * the triangle of the surface that is nearest to their centre, seen along that triangle's normal: what lies over the
 * triangle is then near it, or is cut further. Pieces are no longer cut when their longest side is below an eighth of
 * that of the triangle and of the nearest triangle of the surface: then the corners must be near and the centre within
 * 0.9 times the distance. So the answer yes is proven except between these points, no farther than 0.1 of that side
 * from one of these points.
 *
 * Most triangles need less: IsNearNearby() halves them until the corners of each piece are near one of a few triangles.
 * It asks for distances of 0.9 times the distance at most, so that its yes is also that of the search above. */
class TriangleProximity
{
public:
  /** \param distance in mm, above 0
   *  \param proof if not null, gets the triangles of the surface that make IsNearSurface() true */
  TriangleProximity(const CornersType & triangle,
                    const TriangleTree & surface,
                    double distance,
                    ProximityProof * proof = nullptr)
    : m_Triangle(triangle)
    , m_Surface(surface)
    , m_Distance(distance)
    , m_Proof(proof)
    , m_SquaredSide(SquaredLongestSide(triangle))
  {}

  /** Whether the triangle is near one of three triangles of the surface. */
  bool
  IsNearOneOf(const std::array<std::uint32_t, 3> & triangles) const
  {
    const Piece whole(m_Triangle);
    return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
      return this->IsNearTriangle(whole, triangle);
    });
  }

  /** Whether the triangle is near the surface. The three triangles \a likely of the surface are tried first; the nearer
   * they are, the faster is the answer. */
  bool
  IsNearSurface(const std::array<std::uint32_t, 3> & likely) const
  {
    return this->IsNearOneOf(likely) || this->IsNear(Piece(m_Triangle), likely[0]);
  }

  /** Whether the triangle is certain to be near those of GetNearby(), by few cuts. */
  bool
  IsNearNearby() const
  {
    if (m_Nearby.IsEmpty())
    {
      return false;
    }
    std::array<MarkedCorner, 3> corners;
    for (unsigned int n = 0; n < 3; ++n)
    {
      corners[n] = this->Mark(m_Triangle[n]);
      if (corners[n].near.none())
      {
        return false;
      }
    }
    NearbyTriangles::Some needed;
    unsigned int cuts = MostCuts;
    if (!this->AreHalvesNear(corners[0], corners[1], corners[2], needed, cuts))
    {
      return false;
    }
    for (std::size_t n = 0; m_Proof != nullptr && n < needed.size(); ++n)
    {
      needed[n] ? m_Proof->Add(m_Nearby.GetTriangle(n)) : void();
    }
    return true;
  }

  /** Triangles of the surface around the triangle, in which nearest ones are searched for first. Faster than the tree,
   * if some are near each point of the triangle. */
  NearbyTriangles &
  GetNearby()
  {
    return m_Nearby;
  }

private:
  static constexpr double SmallestShareOfSide = 0.125; ///< smaller pieces are not cut
  static constexpr double NearForCentres = 0.9;        ///< relative to the distance
  static constexpr double LeastInside = 0.0625;        ///< of centres, relative to the farthest corner's distance
  static constexpr unsigned int MostCuts = 48;         ///< into halves
  static constexpr unsigned int ManyCorners = 8;       ///< a cut across pieces of more would leave too many

  /** A convex part of the triangle. */
  struct Piece
  {
    static constexpr unsigned int MostCorners = ManyCorners + 3; ///< after cuts along three sides

    Piece() = default;

    explicit Piece(const CornersType & triangle)
      : size(3)
    {
      std::copy(triangle.begin(), triangle.end(), corners.begin());
    }

    const PositionType *
    begin() const
    {
      return corners.data();
    }

    const PositionType *
    end() const
    {
      return corners.data() + size;
    }

    void
    Add(const PositionType & corner)
    {
      corners[size++] = corner;
    }

    PositionType
    GetCentre() const
    {
      PositionType sum{};
      for (const PositionType & corner : *this)
      {
        sum = rhombic::Add(sum, corner);
      }
      return Scaled(sum, 1.0 / size);
    }

    double
    GetSquaredLongestSide() const
    {
      double longest = 0.0;
      for (unsigned int n = 0; n < size; ++n)
      {
        longest = std::max(longest, SquaredDistance(corners[n], corners[(n + 1) % size]));
      }
      return longest;
    }

    std::array<PositionType, MostCorners> corners;
    unsigned int size = 0;
  };

  /** The parts of a piece in front of a plane and behind it; a part may be empty. Each has at most one corner more than
   * the piece. */
  static std::pair<Piece, Piece>
  Cut(const Piece & piece, const PositionType & point, const PositionType & normal)
  {
    std::pair<Piece, Piece> parts;
    const auto heightOf = [&](const PositionType & corner) { return Dot(normal, Subtract(corner, point)); };
    for (unsigned int n = 0; n < piece.size; ++n)
    {
      const PositionType & corner = piece.corners[n];
      const PositionType & next = piece.corners[(n + 1) % piece.size];
      const double height = heightOf(corner);
      const double nextHeight = heightOf(next);
      (height >= 0.0 ? parts.first : parts.second).Add(corner);
      if ((height >= 0.0) != (nextHeight >= 0.0))
      {
        const PositionType between = Mix(corner, next, height / (height - nextHeight));
        parts.first.Add(between);
        parts.second.Add(between);
      }
    }
    return parts;
  }

  /** A corner of a piece, and which of the nearby triangles are near it. */
  struct MarkedCorner
  {
    PositionType position;
    NearbyTriangles::Some near;
  };

  MarkedCorner
  Mark(const PositionType & position) const
  {
    constexpr double rounding = 1e-9; // far more than that of distances
    const double distance = NearForCentres * (1.0 - rounding) * m_Distance;
    return { position, m_Nearby.FindWithin(distance * distance, position) };
  }

  /** Whether a piece is certain to be near the nearby triangles. \param needed gets those that show it \param cuts how
   * many may be made */
  bool
  AreHalvesNear(const MarkedCorner & a,
                const MarkedCorner & b,
                const MarkedCorner & c,
                NearbyTriangles::Some & needed,
                unsigned int & cuts) const
  {
    const NearbyTriangles::Some common = a.near & b.near & c.near;
    if (common.any())
    {
      if ((common & needed).none())
      {
        needed.set(common._Find_first());
      }
      return true;
    }
    if (cuts == 0)
    {
      return false;
    }
    --cuts;
    const double ab = SquaredDistance(a.position, b.position);
    const double bc = SquaredDistance(b.position, c.position);
    const double ca = SquaredDistance(c.position, a.position);
    const auto cut = [&](const MarkedCorner & from, const MarkedCorner & to, const MarkedCorner & opposite) {
      const MarkedCorner middle = this->Mark(Mix(from.position, to.position, 0.5));
      return middle.near.any() && this->AreHalvesNear(from, middle, opposite, needed, cuts) &&
             this->AreHalvesNear(middle, to, opposite, needed, cuts);
    };
    return ab >= bc && ab >= ca ? cut(a, b, c) : bc >= ca ? cut(b, c, a) : cut(c, a, b);
  }

  static double
  SquaredLongestSide(const CornersType & corners)
  {
    return Piece(corners).GetSquaredLongestSide();
  }

  /** Whether a piece is near one triangle of the surface. */
  bool
  IsNearTriangle(const Piece & piece, std::uint32_t triangle) const
  {
    const bool isNear = std::all_of(piece.begin(), piece.end(), [&](const PositionType & corner) {
      return this->SquaredDistanceTo(triangle, corner) <= m_Distance * m_Distance;
    });
    return isNear && this->NeedsTriangle(triangle);
  }

  /** Notes that a part is near because of a triangle of the surface. Returns true. */
  bool
  NeedsTriangle(std::uint32_t triangle) const
  {
    if (m_Proof != nullptr)
    {
      m_Proof->Add(triangle);
    }
    return true;
  }

  /** Whether a piece is near the surface; \a likely is a triangle of the surface that may be near. */
  bool
  IsNear(const Piece & piece, std::uint32_t likely) const
  {
    if (m_Nearby.IsEmpty() && this->IsNearTriangle(piece, likely))
    {
      return true;
    }
    const PositionType centre = piece.GetCentre();
    double squaredRadius = 0.0;
    for (const PositionType & corner : piece)
    {
      squaredRadius = std::max(squaredRadius, SquaredDistance(corner, centre));
    }
    const double enough = std::max(0.0, m_Distance - std::sqrt(squaredRadius)); // so that the farthest corner is near
    const Nearest nearest = this->FindNearest(centre, likely, enough * enough);
    if (nearest.triangle == TriangleTree::None)
    {
      return false;
    }
    if (nearest.squaredDistance <= enough * enough)
    {
      return this->NeedsTriangle(nearest.triangle);
    }
    if (this->IsNearTriangle(piece, nearest.triangle))
    {
      return true;
    }
    if (this->IsSmall(piece, nearest.triangle))
    {
      return this->NeedsTriangle(nearest.triangle) && this->AreCornersNear(piece);
    }
    if (piece.size > ManyCorners)
    {
      return this->IsNearBesideDiagonal(piece, nearest.triangle);
    }
    const std::optional<bool> isNear = this->IsNearInParts(piece, centre, std::sqrt(squaredRadius), nearest.triangle);
    return isNear ? *isNear : this->IsNearInHalves(piece, centre, nearest.triangle);
  }

  /** Cuts a piece along the sides of a triangle of the surface. Nothing if its centre does not lie over the triangle,
   * or so close to a side that the cut would leave most of the piece, or if the part over the triangle is not near it.
   */
  std::optional<bool>
  IsNearInParts(const Piece & piece, const PositionType & centre, double radius, std::uint32_t triangle) const
  {
    const CornersType corners = CornersOf(m_Surface.GetSurface(), m_Surface.GetSurface().GetTriangles()[triangle]);
    const PositionType normal = AreaVector(corners);
    std::array<PositionType, 3> inwards; // perpendicular to each side
    for (unsigned int side = 0; side < 3; ++side)
    {
      inwards[side] = Cross(normal, Subtract(corners[(side + 1) % 3], corners[side]));
      if (!(Dot(inwards[side], Subtract(centre, corners[side])) > LeastInside * radius * Length(inwards[side])))
      {
        return std::nullopt;
      }
    }
    Piece over = piece;
    std::array<Piece, 3> beside;
    for (unsigned int side = 0; side < 3; ++side)
    {
      std::tie(over, beside[side]) = Cut(over, corners[side], inwards[side]);
    }
    if (!this->IsNearTriangle(over, triangle))
    {
      return std::nullopt;
    }
    return std::all_of(
      beside.begin(), beside.end(), [&](const Piece & part) { return part.size == 0 || this->IsNear(part, triangle); });
  }

  /** Cuts a piece through its centre, across the direction of its farthest corner. */
  bool
  IsNearInHalves(const Piece & piece, const PositionType & centre, std::uint32_t likely) const
  {
    const PositionType & farthest =
      *std::max_element(piece.begin(), piece.end(), [&](const PositionType & one, const PositionType & other) {
        return SquaredDistance(one, centre) < SquaredDistance(other, centre);
      });
    const auto [front, back] = Cut(piece, centre, Subtract(farthest, centre));
    return this->IsNear(front, likely) && this->IsNear(back, likely);
  }

  /** Cuts a piece between two opposite corners, which leaves fewer corners to each part. */
  bool
  IsNearBesideDiagonal(const Piece & piece, std::uint32_t likely) const
  {
    std::pair<Piece, Piece> parts;
    const unsigned int opposite = piece.size / 2;
    for (unsigned int n = 0; n < piece.size; ++n)
    {
      if (n <= opposite)
      {
        parts.first.Add(piece.corners[n]);
      }
      if (n == 0 || n >= opposite)
      {
        parts.second.Add(piece.corners[n]);
      }
    }
    return this->IsNear(parts.first, likely) && this->IsNear(parts.second, likely);
  }

  struct Nearest
  {
    std::uint32_t triangle; ///< None if nothing is near enough
    double squaredDistance;
  };

  /** A triangle near a centre: within the squared distance \a enough, the nearest of those around, or if they are far,
   * of all. */
  Nearest
  FindNearest(const PositionType & centre, std::uint32_t likely, double enough) const
  {
    const double limit = NearForCentres * NearForCentres * m_Distance * m_Distance;
    if (!m_Nearby.IsEmpty())
    {
      const NearbyTriangles::Nearest nearest = m_Nearby.FindNearest(centre);
      if (nearest.squaredDistance <= limit)
      {
        return { nearest.triangle, nearest.squaredDistance };
      }
    }
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
  IsSmall(const Piece & piece, std::uint32_t nearest) const
  {
    const double side =
      std::min(m_SquaredSide,
               SquaredLongestSide(CornersOf(m_Surface.GetSurface(), m_Surface.GetSurface().GetTriangles()[nearest])));
    return piece.GetSquaredLongestSide() <= SmallestShareOfSide * SmallestShareOfSide * side;
  }

  bool
  AreCornersNear(const Piece & piece) const
  {
    const double limit = m_Distance * m_Distance;
    return std::all_of(piece.begin(), piece.end(), [&](const PositionType & corner) {
      const std::uint32_t near = m_Surface.FindClosestPoint(corner, limit, limit).triangle;
      return near != TriangleTree::None && this->NeedsTriangle(near);
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
  ProximityProof * const m_Proof;
  const double m_SquaredSide; ///< longest side of the triangle
  NearbyTriangles m_Nearby;   ///< some triangles of the surface, the first to be asked
};

} // namespace itk

#endif
