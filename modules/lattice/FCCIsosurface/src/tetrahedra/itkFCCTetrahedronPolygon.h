#ifndef itkFCCTetrahedronPolygon_h
#define itkFCCTetrahedronPolygon_h

#include "itkFCCCells.h"

#include <cstdint>

namespace itk
{

/** \class FCCTetrahedronPolygon
 * \brief The surface in one tetrahedron of sites: a triangle, a quadrilateral, or nothing.
 *
 * Its corners are the crossings on the edges between sites inside and outside, counter-clockwise seen from outside when
 * the lattice's axes are right-handed.
 */
struct FCCTetrahedronPolygon
{
  /** The sites of the tetrahedron, 0 to 3, at the ends of a crossing's edge. */
  struct Crossing
  {
    std::uint8_t inside = 0;
    std::uint8_t outside = 0;
  };

  std::uint8_t size = 0;
  Crossing crossings[4] = {};
  std::uint8_t decider = 0; ///< index of the crossing between the lowest site inside and the lowest site outside

  /** The polygon with its first corner where a mesh with moved crossings cuts a quadrilateral into two triangles: from
   * the decider to the opposite corner when the decider's nearer end is inside, else along the other diagonal. All that
   * cut quadrilaterals at moved crossings use this rule. */
  constexpr unsigned int
  FindFirstCorner(bool isDeciderNearerToInside) const
  {
    return size == 4 ? (decider + (isDeciderNearerToInside ? 0u : 1u)) % 2 : 0;
  }

  /** \param pattern bit s: site s is inside */
  static constexpr FCCTetrahedronPolygon
  Of(const FCCLattice::SiteType (&sites)[4], unsigned int pattern)
  {
    std::uint8_t ordered[4] = {}; // the sites inside first
    unsigned int inside = 0;
    for (unsigned int pass = 0, place = 0; pass < 2; ++pass)
    {
      for (std::uint8_t site = 0; site < 4; ++site)
      {
        const bool isInside = (pattern >> site & 1) != 0;
        if (isInside == (pass == 0))
        {
          ordered[place++] = site;
          inside += isInside ? 1 : 0;
        }
      }
    }
    // With this order positive, the corners below run counter-clockwise around the way from inside to outside.
    if (FCCStep::Orientation(sites[ordered[0]], sites[ordered[1]], sites[ordered[2]], sites[ordered[3]]) < 0)
    {
      const unsigned int first = inside == 1 ? 2 : 0; // two on the same side of the surface
      const std::uint8_t swapped = ordered[first];
      ordered[first] = ordered[first + 1];
      ordered[first + 1] = swapped;
    }
    const std::uint8_t a = ordered[0];
    const std::uint8_t b = ordered[1];
    const std::uint8_t c = ordered[2];
    const std::uint8_t d = ordered[3];
    switch (inside)
    {
      case 1:
        return WithDecider({ 3, { { a, b }, { a, c }, { a, d } } }, sites);
      case 2:
        return WithDecider({ 4, { { a, c }, { a, d }, { b, d }, { b, c } } }, sites);
      case 3:
        return WithDecider({ 3, { { a, d }, { b, d }, { c, d } } }, sites);
      default:
        return {};
    }
  }

private:
  static constexpr FCCTetrahedronPolygon
  WithDecider(FCCTetrahedronPolygon polygon, const FCCLattice::SiteType (&sites)[4])
  {
    for (std::uint8_t n = 1; n < polygon.size; ++n)
    {
      const Crossing & lowest = polygon.crossings[polygon.decider];
      const Crossing & crossing = polygon.crossings[n];
      if (!FCCStep::IsLower(sites[lowest.inside], sites[crossing.inside]) &&
          !FCCStep::IsLower(sites[lowest.outside], sites[crossing.outside]))
      {
        polygon.decider = n;
      }
    }
    return polygon;
  }
};

} // namespace itk

#endif
