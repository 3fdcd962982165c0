#ifndef itkFCCLeanTables_h
#define itkFCCLeanTables_h

#include "itkFCCLeanMarching.h"
#include "itkFCCMarchingCases.h"

namespace itk
{

/** \class FCCLeanTables
 * \brief The tables of mode `lean` for the tetrahedra of one kind of step (see FCCMarchingCases), derived at compile
 * time.
 */
struct FCCLeanTables
{
  using Cases = FCCMarchingCases;

  /** The triangle of three corners of a tetrahedron. */
  struct Triangle
  {
    std::uint8_t corners[3] = {};           ///< counter-clockwise seen from outside when the corner left out is outside
    FCCTriangleUse::CountsType use[3] = {}; ///< counts that it adds at these corners
  };

  std::uint8_t edges[Cases::Tetrahedra][4][4] = {};           ///< between two corners of a tetrahedron
  FCCTetrahedronPolygon polygons[Cases::Tetrahedra][16] = {}; ///< by the corners inside
  Triangle triangles[Cases::Tetrahedra][4] = {};              ///< by the corner left out

  static constexpr FCCLeanTables
  Of(unsigned int kind)
  {
    FCCLeanTables tables;
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & sites = Cases::TetrahedronSites[tetrahedron];
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        for (unsigned int other = 0; other < 4; ++other)
        {
          tables.edges[tetrahedron][corner][other] =
            other == corner ? std::uint8_t{ 0 } : Cases::EdgeBetween(sites[corner], sites[other]);
        }
        tables.triangles[tetrahedron][corner] = MakeTriangle(kind, sites, corner);
      }
      for (unsigned int inside = 0; inside < 16; ++inside)
      {
        tables.polygons[tetrahedron][inside] = Cases::PolygonOf(kind, tetrahedron, inside);
      }
    }
    return tables;
  }

private:
  static constexpr Triangle
  MakeTriangle(unsigned int kind, const std::uint8_t (&sites)[4], unsigned int leftOut)
  {
    Triangle triangle;
    auto & corners = triangle.corners;
    for (std::uint8_t corner = 0, n = 0; corner < 4; ++corner)
    {
      if (corner != leftOut)
      {
        corners[n++] = corner;
      }
    }
    if (Cases::Orientation(kind, sites[corners[0]], sites[corners[1]], sites[corners[2]], sites[leftOut]) < 0)
    {
      const std::uint8_t second = corners[1];
      corners[1] = corners[2];
      corners[2] = second;
    }
    for (unsigned int n = 0; n < 3; ++n)
    {
      triangle.use[n] = FCCTriangleUse::OfSite();
      for (unsigned int other = 0; other < 3; ++other)
      {
        if (other != n)
        {
          const std::uint8_t edge = Cases::EdgeBetween(sites[corners[n]], sites[corners[other]]);
          const Cases::StoredEdge stored = Cases::FindStoredEdge(kind, edge);
          const bool isStoredHere = stored.start == Cases::EndOf(edge, sites[corners[n]]);
          triangle.use[n] += isStoredHere ? FCCTriangleUse::OfEdge(stored.type) : 0;
        }
      }
    }
    return triangle;
  }
};

inline constexpr FCCLeanTables FCCLeanTablesOfKind[FCCMarchingCases::Kinds] = { FCCLeanTables::Of(0),
                                                                                FCCLeanTables::Of(1) };

} // namespace itk

#endif
