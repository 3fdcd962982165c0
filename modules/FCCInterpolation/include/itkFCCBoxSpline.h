#ifndef itkFCCBoxSpline_h
#define itkFCCBoxSpline_h

#include "itkFCCLattice.h"

#include <algorithm>
#include <utility>

namespace itk
{

/** \class FCCBoxSpline
 * \brief The six-direction box spline of the face-centered cubic lattice.
 *
 * The projection of a six-dimensional cube along the six pairs of nearest neighbours: a function phi of lattice
 * coordinates, piecewise cubic, with continuous first derivatives, not zero within the truncated octahedron |x| < 2,
 * |y| < 2, |z| < 2, |x| + |y| + |z| < 3. Its sum over the sites is 1 everywhere, and the sums of phi(p - s) c(s) over
 * the sites s contain all quadratic polynomials. At a site phi is 1/2, at its nearest neighbours 1/24, at those beyond
 * 0.
 *
 * The pieces are those of M. Kim, A. Entezari and J. Peters, "Box spline reconstruction on the face-centered cubic
 * lattice", IEEE Trans. Visualization and Computer Graphics 14 (2008). Here they are joined: for x >= y >= z >= 0 in
 * the support, with (t)+ = max(t, 0),
 *
 *   24 phi = (3 - x - y - z)^2 (3 - x - y + 2 z) - 4 (1 - x)+^3 - 4 (1 - y)+^3
 *            - 3 (1 - x - y - z)+^2 - (1 - x - y + z)+^2 (4 - x - y - 2 z)
 *            + (x - y + z - 1)+^2 (4 - x - 2 y - z) + (x - y - z - 1)+^2 (5 - 2 x - y - z)
 *
 * Everything here is pure, so thread safe.
 *
 * \ingroup FCCInterpolation
 */
struct FCCBoxSpline
{
  using SiteType = FCCLattice::SiteType;
  using PointType = std::array<double, 3>; ///< in lattice coordinates

  static constexpr double AtSite = 1.0 / 2.0;
  static constexpr double AtNearestNeighbor = 1.0 / 24.0;

  /** Sites around a point in whose support it can lie: no fewer but on the border of a support. */
  static constexpr unsigned int SupportSize = 16;
  using SupportType = std::array<SiteType, SupportSize>;

  /** phi and its gradient, in lattice coordinates. */
  struct Jet
  {
    double value = 0.0;
    PointType gradient{};
  };

  static double
  Value(const PointType & point)
  {
    return ValueAndGradient(point).value;
  }

  static Jet
  ValueAndGradient(const PointType & point)
  {
    // All permutations and reflections of the axes are symmetries: sort.
    unsigned int axes[3] = { 0, 1, 2 };
    const PointType absolute{ std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) };
    const auto order = [&axes, &absolute](unsigned int a, unsigned int b) {
      if (absolute[axes[a]] < absolute[axes[b]])
      {
        std::swap(axes[a], axes[b]);
      }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    const double x = absolute[axes[0]];
    const double y = absolute[axes[1]];
    const double z = absolute[axes[2]];
    Jet jet;
    if (!(x < 2.0 && x + y + z < 3.0))
    {
      return jet;
    }

    const auto positive = [](double t) { return std::max(t, 0.0); };
    const double a = 3.0 - x - y - z;
    const double aFactor = 3.0 - x - y + 2.0 * z;
    const double b = positive(1.0 - x);
    const double c = positive(1.0 - y);
    const double d = positive(1.0 - x - y - z);
    const double e = positive(1.0 - x - y + z);
    const double eFactor = 4.0 - x - y - 2.0 * z;
    const double f = positive(x - y + z - 1.0);
    const double fFactor = 4.0 - x - 2.0 * y - z;
    const double g = positive(x - y - z - 1.0);
    const double gFactor = 5.0 - 2.0 * x - y - z;
    jet.value = (a * a * aFactor - 4.0 * (b * b * b + c * c * c) - 3.0 * d * d - e * e * eFactor + f * f * fFactor +
                 g * g * gFactor) /
                24.0;

    // Terms of the derivatives that several share: of t^2 F, 2 t F dt + t^2 dF.
    const double a1 = 2.0 * a * aFactor;
    const double e1 = 2.0 * e * eFactor;
    const double f1 = 2.0 * f * fFactor;
    const double g1 = 2.0 * g * gFactor;
    const double common = -a1 + 6.0 * d;
    const double sorted[3] = {
      common - a * a + 12.0 * b * b + e1 + e * e + f1 - f * f + g1 - 2.0 * g * g,
      common - a * a + 12.0 * c * c + e1 + e * e - f1 - 2.0 * f * f - g1 - g * g,
      common + 2.0 * a * a - e1 + 2.0 * e * e + f1 - f * f - g1 - g * g,
    };
    for (unsigned int place = 0; place < 3; ++place)
    {
      const unsigned int axis = axes[place];
      jet.gradient[axis] = (point[axis] < 0.0 ? -sorted[place] : sorted[place]) / 24.0;
    }
    return jet;
  }

  /** The sites with phi(point - site) > 0, and where the point is on the border of supports, some more, with 0 there.
   *
   * The borders of all supports cut each unit cube into the regular tetrahedron of its odd corners and four pieces at
   * its sites, so which sites reach a point is the same within each of these. */
  static SupportType
  FindSupport(const PointType & point)
  {
    // Within the unit cube, mirrored along x when needed so that its lowest corner is a site.
    SiteType corner;
    PointType local;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double lower = std::floor(point[axis]);
      corner[axis] = static_cast<IndexValueType>(lower);
      local[axis] = point[axis] - lower;
    }
    SiteType direction{ 1, 1, 1 };
    if (!FCCLattice::IsSite(corner))
    {
      corner[0] += 1;
      local[0] = 1.0 - local[0];
      direction[0] = -1;
    }

    constexpr SiteType cubeSites[4] = { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } };
    for (const SiteType & site : cubeSites)
    {
      double distance = 0.0;
      SiteType near;
      SiteType inward;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        distance += site[axis] == 0 ? local[axis] : 1.0 - local[axis];
        near[axis] = corner[axis] + direction[axis] * site[axis];
        inward[axis] = site[axis] == 0 ? direction[axis] : -direction[axis];
      }
      if (distance < 1.0)
      {
        return Place(SupportAtSite, near, inward);
      }
    }
    return Place(SupportOfCube, corner, direction);
  }

private:
  static SupportType
  Place(const SupportType & steps, const SiteType & origin, const SiteType & direction)
  {
    SupportType sites;
    for (unsigned int n = 0; n < SupportSize; ++n)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sites[n][axis] = origin[axis] + direction[axis] * steps[n][axis];
      }
    }
    return sites;
  }

  /** The sites that reach a point, given in quarters of the lattice's unit. */
  static constexpr SupportType
  SitesThatReach(const SiteType & quarters)
  {
    SupportType sites{};
    unsigned int size = 0;
    for (IndexValueType z = -2; z <= 2; ++z)
    {
      for (IndexValueType y = -2; y <= 2; ++y)
      {
        for (IndexValueType x = -2; x <= 2; ++x)
        {
          const SiteType site{ x, y, z };
          bool isReached = FCCLattice::IsSite(site);
          IndexValueType sum = 0;
          for (unsigned int axis = 0; axis < 3; ++axis)
          {
            const IndexValueType difference = quarters[axis] - 4 * site[axis];
            const IndexValueType distance = difference < 0 ? -difference : difference;
            sum += distance;
            isReached = isReached && distance < 8;
          }
          if (isReached && sum < 12)
          {
            sites[size++] = site;
          }
        }
      }
    }
    return sites;
  }

  static const SupportType SupportAtSite; ///< in the octant x, y, z > 0 of the site (0, 0, 0)
  static const SupportType SupportOfCube; ///< in the middle of the unit cube on the site (0, 0, 0)
};

inline constexpr FCCBoxSpline::SupportType FCCBoxSpline::SupportAtSite = FCCBoxSpline::SitesThatReach({ 1, 1, 1 });
inline constexpr FCCBoxSpline::SupportType FCCBoxSpline::SupportOfCube = FCCBoxSpline::SitesThatReach({ 2, 2, 2 });

} // namespace itk

#endif
