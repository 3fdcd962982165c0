#ifndef itkFCCLattice_h
#define itkFCCLattice_h

#include "itkIndex.h"
#include "itkOffset.h"

#include <array>
#include <cmath>

/** \namespace itk
 * \brief The classes that Rhombic adds to ITK: the lattice, its filters, and triangle surfaces. */
namespace itk
{

/** \class FCCLattice
 * \brief Geometry of the face-centered cubic lattice and of its storage in parity rows.
 *
 * The lattice is D3, the integer points (x, y, z) with an even sum: *lattice coordinates*. Its points are *sites*; the
 * Voronoi cell of a site is a rhombic dodecahedron of volume 2. The Delaunay cells are one regular tetrahedron in each
 * unit cube (its four even corners) and one octahedron around each odd point (its six axis neighbours).
 *
 * Sites are stored densely in *rows* along x. Index (i, j, k) is the site (2 i + p, j, k), where p = (j + k) mod 2 is
 * the *parity* of the row: neighbouring rows are shifted by one unit, half the distance of the sites in a row.
 *
 * \ingroup FCCLattice
 */
struct FCCLattice
{
  /** A site, or the step from one site to another, in lattice coordinates. */
  using SiteType = std::array<IndexValueType, 3>;

  /** Sites per Cartesian sample at which both lattices represent the same band of frequencies in all directions,
   * 4 / (3 sqrt 3): the ball inside the Brillouin zone has the same radius. */
  static constexpr double NyquistDensity = 0.76980035891950104;

  /** Sites per Cartesian sample wherever no other density is asked for. */
  static constexpr double DefaultDensity = NyquistDensity;

  /** Volume of a site's Voronoi cell in units of the lattice coordinates. */
  static constexpr double CellVolume = 2.0;

  /** The nearest neighbours, at distance sqrt(2). The sum of d d^T over them is 8 times the identity. */
  static constexpr std::array<SiteType, 12> NearestNeighbors{ { { 1, 1, 0 },
                                                                { -1, 1, 0 },
                                                                { 1, 0, 1 },
                                                                { -1, 0, 1 },
                                                                { 0, 1, 1 },
                                                                { 0, -1, 1 },
                                                                { -1, -1, 0 },
                                                                { 1, -1, 0 },
                                                                { -1, 0, -1 },
                                                                { 1, 0, -1 },
                                                                { 0, -1, -1 },
                                                                { 0, 1, -1 } } };

  /** The edges of the six-tetrahedra decomposition that are assigned to a site; the other seven at the site are
   * assigned to its neighbours. First the edge along the row, which is the diagonal of an octahedron, then the edges to
   * the nearest neighbours that come later in storage: in the same plane of constant z (1 and 2) and in the next one (3
   * to 6). */
  static constexpr std::array<SiteType, 7> OwnedEdges{
    { { 2, 0, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 1, 0, 1 }, { -1, 0, 1 }, { 0, 1, 1 }, { 0, -1, 1 } }
  };

  /** 0 or 1: the x coordinate of the site with i = 0 in row (j, k). */
  static constexpr IndexValueType
  Parity(IndexValueType j, IndexValueType k)
  {
    return (j + k) & 1;
  }

  /** Whether a point with integer lattice coordinates is a site: their sum is even. */
  static constexpr bool
  IsSite(const SiteType & point)
  {
    return ((point[0] + point[1] + point[2]) & 1) == 0;
  }

  /** The site that is stored at an index. */
  static constexpr SiteType
  SiteOf(const Index<3> & index)
  {
    return { 2 * index.m_InternalArray[0] + Parity(index.m_InternalArray[1], index.m_InternalArray[2]),
             index.m_InternalArray[1],
             index.m_InternalArray[2] };
  }

  /** The storage index of a site. The point must be a site. */
  static constexpr Index<3>
  IndexOf(const SiteType & site)
  {
    return { { (site[0] - Parity(site[1], site[2])) / 2, site[1], site[2] } };
  }

  /** The step in storage that corresponds to a step of the lattice from a row of the given parity. */
  static constexpr Offset<3>
  OffsetOf(const SiteType & step, IndexValueType parity)
  {
    const IndexValueType arrival = (parity + step[1] + step[2]) & 1;
    return { { (parity + step[0] - arrival) / 2, step[1], step[2] } };
  }

  /** The site whose Voronoi cell holds a point: each coordinate is rounded, and when the sum comes out odd, the
   * coordinate with the largest rounding error is rounded the other way (Conway and Sloane, "Fast quantizing and
   * decoding algorithms for lattice quantizers and codes", 1982). */
  static SiteType
  NearestSite(const std::array<double, 3> & point)
  {
    SiteType site;
    unsigned int worst = 0;
    double worstError = -1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double rounded = std::floor(point[axis] + 0.5);
      const double error = std::abs(point[axis] - rounded);
      site[axis] = static_cast<IndexValueType>(rounded);
      if (error > worstError)
      {
        worst = axis;
        worstError = error;
      }
    }
    if (!IsSite(site))
    {
      site[worst] += point[worst] < static_cast<double>(site[worst]) ? -1 : 1;
    }
    return site;
  }
};

} // namespace itk

#endif
