#ifndef itkFCCBoxSpline_h
#define itkFCCBoxSpline_h

#include "detail/itkFCCTetrahedron.h"

namespace itk
{

/** \class FCCBoxSpline
 * \brief The six-direction box spline of the face-centered cubic lattice.
 *
 * The projection of a six-dimensional cube along the six pairs of nearest neighbours: a function phi of lattice
 * coordinates, piecewise cubic, with continuous first derivatives, positive within the truncated octahedron |x| < 2,
 * |y| < 2, |z| < 2, |x| + |y| + |z| < 3 and 0 elsewhere. Its sum over all sites is 1 everywhere, and the *splines*, the
 * sums of c(s) phi(p - s) over the sites s, contain all quadratic polynomials. phi is 1/2 at the site 0, 1/24 at its 12
 * nearest neighbours, and 0 at all other sites.
 *
 * The formula is that of M. Kim, A. Entezari and J. Peters, "Box spline reconstruction on the face-centered cubic
 * lattice", IEEE Trans. Visualization and Computer Graphics 14 (2008), with its pieces joined: for x >= y >= z >= 0 in
 * the support, with (t)+ = max(t, 0),
 *
 *   24 phi = (3 - x - y - z)^2 (3 - x - y + 2 z) - 4 (1 - x)+^3 - 4 (1 - y)+^3
 *            - 3 (1 - x - y - z)+^2 - (1 - x - y + z)+^2 (4 - x - y - 2 z)
 *            + (x - y + z - 1)+^2 (4 - x - 2 y - z) + (x - y - z - 1)+^2 (5 - 2 x - y - z)
 *
 * The borders of the pieces of all shifted phi cut each unit cube into the regular tetrahedron of its odd corners, and
 * four pieces at its sites. Within each of these, the same 16 sites reach a point, and a spline is one cubic polynomial
 * (Cubic); all pieces of one shape are the same but for reflections, so there are two tables of polynomials, derived
 * here at compile time.
 *
 * \ingroup FCCInterpolation
 */
struct FCCBoxSpline
{
  using SiteType = FCCLattice::SiteType;
  using PointType = std::array<double, 3>; ///< in lattice coordinates

  static constexpr double AtSite = 1.0 / 2.0;
  static constexpr double AtNearestNeighbor = 1.0 / 24.0;

  static constexpr unsigned int SupportSize = 16;
  using SupportType = std::array<SiteType, SupportSize>;

  /** The two kinds of tetrahedra that are pieces. */
  enum Shape : unsigned char
  {
    Octant, ///< eighth of an octahedron around a site: x, y, z > 0 and x + y + z < 1 from it
    Cube    ///< the tetrahedron of a unit cube's odd corners, from a corner that is a site
  };

  /** A tetrahedron in which every spline is one polynomial. */
  struct Piece
  {
    Shape shape;
    SiteType origin;    ///< origin of the piece's own coordinates
    SiteType direction; ///< directions of the piece's own axes: 1 or -1 for each
    SupportType sites;  ///< the sites s with phi(p - s) > 0 for the points p within the piece
  };

  /** A value and its gradient, in lattice coordinates. */
  struct Jet
  {
    double value = 0.0;
    PointType gradient{};
  };

  /** The monomials are the products of three of 1, x, y and z, in the order 1, x, y, z, xx, xy, ... yzz, zzz. */
  static constexpr unsigned int NumberOfMonomials = 20;

  /** A spline within a piece. */
  struct Cubic
  {
    std::array<double, NumberOfMonomials> coefficients; ///< times 24, in the piece's own coordinates
    SiteType origin;
    SiteType direction;

    /** Converts lattice coordinates to the piece's own. */
    PointType
    ToPiece(const PointType & point) const
    {
      PointType local;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        local[axis] = static_cast<double>(direction[axis]) * (point[axis] - static_cast<double>(origin[axis]));
      }
      return local;
    }

    /** The value at a point of the piece, in lattice coordinates. */
    double
    GetValue(const PointType & point) const
    {
      const auto [x, y, z] = this->ToPiece(point);
      const auto & q = coefficients;
      const double ofX = q[1] + x * (q[4] + x * q[10] + y * q[11] + z * q[12]) + y * (q[5] + y * q[13] + z * q[14]) +
                         z * (q[6] + z * q[15]);
      const double ofY = q[2] + y * (q[7] + y * q[16] + z * q[17]) + z * (q[8] + z * q[18]);
      const double ofZ = q[3] + z * (q[9] + z * q[19]);
      return (q[0] + x * ofX + y * ofY + z * ofZ) * AtNearestNeighbor;
    }

    /** Value and gradient at a point of the piece, in lattice coordinates. */
    Jet
    GetJet(const PointType & point) const
    {
      const auto [x, y, z] = this->ToPiece(point);
      const auto & q = coefficients;
      const double slope[3] = {
        q[1] + x * (2.0 * q[4] + 3.0 * x * q[10] + 2.0 * (y * q[11] + z * q[12])) + y * (q[5] + y * q[13] + z * q[14]) +
          z * (q[6] + z * q[15]),
        q[2] + x * (q[5] + x * q[11] + z * q[14]) + y * (2.0 * (q[7] + x * q[13] + z * q[17]) + 3.0 * y * q[16]) +
          z * (q[8] + z * q[18]),
        q[3] + x * (q[6] + x * q[12] + y * q[14]) + y * (q[8] + y * q[17]) +
          z * (2.0 * (q[9] + x * q[15] + y * q[18]) + 3.0 * z * q[19]),
      };
      Jet jet{ this->GetValue(point), {} };
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        jet.gradient[axis] = static_cast<double>(direction[axis]) * slope[axis] * AtNearestNeighbor;
      }
      return jet;
    }
  };

  /** The piece that holds a point; on the border between several, any of them. */
  static Piece
  FindPiece(const PointType & point);

  /** The spline of the coefficients of a piece's sites, in their order. */
  static Cubic
  MakeCubic(const Piece & piece, const std::array<double, SupportSize> & coefficients);

private:
  /** An affine function of the piece's coordinates: the factors of 1, x, y and z. */
  using AffineType = std::array<IndexValueType, 4>;
  using MonomialsType = std::array<IndexValueType, NumberOfMonomials>;

  struct Table
  {
    SupportType sites{};                                  ///< in the piece's coordinates
    double polynomials[NumberOfMonomials][SupportSize]{}; ///< 24 phi(p - s)
  };

  static constexpr unsigned int
  MonomialOf(unsigned int a, unsigned int b, unsigned int c)
  {
    const unsigned int lowest = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const unsigned int highest = a > b ? (a > c ? a : c) : (b > c ? b : c);
    const unsigned int middle = a + b + c - lowest - highest;
    unsigned int monomial = 0;
    for (unsigned int first = 0; first < 4; ++first)
    {
      for (unsigned int second = first; second < 4; ++second)
      {
        for (unsigned int third = second; third < 4; ++third, ++monomial)
        {
          if (first == lowest && second == middle && third == highest)
          {
            return monomial;
          }
        }
      }
    }
    return NumberOfMonomials;
  }

  /** \a sum += \a scale * \a squared^2 * \a factor */
  static constexpr void
  AddTerm(MonomialsType & sum, IndexValueType scale, const AffineType & squared, const AffineType & factor)
  {
    for (unsigned int a = 0; a < 4; ++a)
    {
      for (unsigned int b = 0; b < 4; ++b)
      {
        for (unsigned int c = 0; c < 4; ++c)
        {
          sum[MonomialOf(a, b, c)] += scale * squared[a] * squared[b] * factor[c];
        }
      }
    }
  }

  /** 24 phi(p - site) for the points p of a piece; \a tenths is one of these points, in tenths of lattice units. */
  static constexpr MonomialsType
  PolynomialOf(const SiteType & site, const SiteType & tenths)
  {
    // |x|, |y| and |z| from the site, as affine functions, sorted by their values at the given point, greatest first.
    AffineType sorted[3]{};
    IndexValueType values[3]{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const IndexValueType difference = tenths[axis] - 10 * site[axis];
      const IndexValueType sign = difference < 0 ? -1 : 1;
      unsigned int place = axis;
      for (; place > 0 && values[place - 1] < sign * difference; --place)
      {
        values[place] = values[place - 1];
        sorted[place] = sorted[place - 1];
      }
      values[place] = sign * difference;
      sorted[place] = { -sign * site[axis], 0, 0, 0 };
      sorted[place][axis + 1] = sign;
    }
    const auto affine = [&sorted](IndexValueType one, IndexValueType x, IndexValueType y, IndexValueType z) {
      AffineType result{};
      for (unsigned int n = 0; n < 4; ++n)
      {
        result[n] = (n == 0 ? one : 0) + x * sorted[0][n] + y * sorted[1][n] + z * sorted[2][n];
      }
      return result;
    };
    MonomialsType sum{};
    const auto addWherePositive =
      [&sum, &tenths](IndexValueType scale, const AffineType & squared, const AffineType & factor) {
        const IndexValueType value =
          10 * squared[0] + squared[1] * tenths[0] + squared[2] * tenths[1] + squared[3] * tenths[2];
        if (value > 0)
        {
          AddTerm(sum, scale, squared, factor);
        }
      };
    addWherePositive(1, affine(3, -1, -1, -1), affine(3, -1, -1, 2));
    addWherePositive(-4, affine(1, -1, 0, 0), affine(1, -1, 0, 0));
    addWherePositive(-4, affine(1, 0, -1, 0), affine(1, 0, -1, 0));
    addWherePositive(-3, affine(1, -1, -1, -1), affine(1, 0, 0, 0));
    addWherePositive(-1, affine(1, -1, -1, 1), affine(4, -1, -1, -2));
    addWherePositive(1, affine(-1, 1, -1, 1), affine(4, -1, -2, -1));
    addWherePositive(1, affine(-1, 1, -1, -1), affine(5, -2, -1, -1));
    return sum;
  }

  static constexpr bool
  IsReached(const SiteType & site, const SiteType & tenths)
  {
    IndexValueType sum = 0;
    bool isNear = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const IndexValueType difference = tenths[axis] - 10 * site[axis];
      const IndexValueType distance = difference < 0 ? -difference : difference;
      sum += distance;
      isNear = isNear && distance < 20;
    }
    return isNear && sum < 30;
  }

  static constexpr Table
  MakeTable(const SiteType & tenths)
  {
    Table table;
    unsigned int size = 0;
    for (IndexValueType z = -1; z <= 2; ++z)
    {
      for (IndexValueType y = -1; y <= 2; ++y)
      {
        for (IndexValueType x = -1; x <= 2; ++x)
        {
          const SiteType site{ x, y, z };
          if (FCCLattice::IsSite(site) && IsReached(site, tenths))
          {
            const MonomialsType polynomial = PolynomialOf(site, tenths);
            for (unsigned int n = 0; n < NumberOfMonomials; ++n)
            {
              table.polynomials[n][size] = static_cast<double>(polynomial[n]);
            }
            table.sites[size++] = site;
          }
        }
      }
    }
    return table;
  }

  static const Table Tables[2]; ///< for each shape
};

inline constexpr FCCBoxSpline::Table FCCBoxSpline::Tables[2] = { FCCBoxSpline::MakeTable({ 3, 2, 1 }),
                                                                 FCCBoxSpline::MakeTable({ 6, 5, 4 }) };

inline auto
FCCBoxSpline::FindPiece(const PointType & point) -> Piece
{
  const FCCUnitCube cube(point);
  Piece piece{ Cube, cube.corner, { cube.xStep, 1, 1 }, {} };
  constexpr SiteType cubeSites[4] = { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } };
  for (const SiteType & site : cubeSites)
  {
    double distance = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      distance += site[axis] == 0 ? cube.local[axis] : 1.0 - cube.local[axis];
    }
    if (distance < 1.0)
    {
      piece.shape = Octant;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        piece.origin[axis] += piece.direction[axis] * site[axis];
        piece.direction[axis] *= 1 - 2 * site[axis];
      }
      break;
    }
  }
  for (unsigned int n = 0; n < SupportSize; ++n)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      piece.sites[n][axis] = piece.origin[axis] + piece.direction[axis] * Tables[piece.shape].sites[n][axis];
    }
  }
  return piece;
}

inline auto
FCCBoxSpline::MakeCubic(const Piece & piece, const std::array<double, SupportSize> & coefficients) -> Cubic
{
  Cubic cubic{ {}, piece.origin, piece.direction };
  for (unsigned int monomial = 0; monomial < NumberOfMonomials; ++monomial)
  {
    double sum = 0.0;
    for (unsigned int n = 0; n < SupportSize; ++n)
    {
      sum += Tables[piece.shape].polynomials[monomial][n] * coefficients[n];
    }
    cubic.coefficients[monomial] = sum;
  }
  return cubic;
}

} // namespace itk

#endif
