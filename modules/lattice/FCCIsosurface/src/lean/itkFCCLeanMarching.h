#ifndef itkFCCLeanMarching_h
#define itkFCCLeanMarching_h

#include "itkFCCClusterPlane.h"
#include "itkFCCMarchingCases.h"
#include "itkTriangleSurface.h"

#include <utility>

namespace itk
{

/** \file
 * The triangles of mode `lean`. Every crossing has moved to its nearer end (FCCNearerEnds), so a tetrahedron's triangle
 * keeps its area when its three corners have moved to three sites. What remains of a tetrahedron depends on which of
 * its sites have a crossing of its edges: three such sites span one triangle, four span two, and fewer none. Each of
 * four sites has one crossing of a quadrilateral, which FCCTetrahedronPolygon::FindFirstCorner() cuts from a site
 * inside to a site inside. For whole sites that is logic on bits: 64 steps of a column in one word. */

/** \class FCCTriangleUse
 * \brief How many triangles between whole sites use each site of a plane and the edges that it stores.
 *
 * The counts of a site and its edges are the bytes of one word: a site has at most 48 triangles, an edge fewer.
 */
class FCCTriangleUse
{
public:
  using CountsType = std::uint64_t;

  static constexpr CountsType
  OfEdge(std::uint8_t type)
  {
    return CountsType{ 1 } << (8 * type);
  }
  static constexpr CountsType
  OfSite()
  {
    return OfEdge(FCCCells::Edges);
  }
  static_assert(FCCCells::Edges == 7, "a word has one byte for each type, and one for the site");

  /** Whether the counts break condition 2 or 3 of FCCSplitSites. All triangles have been counted, so the counts of
   * edges are even. */
  static constexpr bool
  BreakCondition(CountsType counts)
  {
    constexpr CountsType moreThanTwo = 0xFC * (OfSite() - 1) / 0xFF; // bits of counts above 2 of any edge
    constexpr CountsType fewest = 3 * OfSite();
    return (counts & moreThanTwo) != 0 || counts < fewest;
  }

  FCCTriangleUse(const FCCSigns & signs, std::pmr::memory_resource * scratch)
    : m_Stride(signs.GetNumberOfWords() * FCCBits::WordBits + 1)
    , m_Counts(m_Stride * signs.GetHeight(), scratch)
  {}

  CountsType *
  GetRow(SizeValueType j)
  {
    return m_Counts.data() + j * m_Stride;
  }

  /** The counts of a site, which are 0 afterwards. */
  CountsType
  Take(SizeValueType j, SizeValueType i)
  {
    return std::exchange(this->GetRow(j)[i], 0);
  }

  void
  Clear()
  {
    std::fill(m_Counts.begin(), m_Counts.end(), 0);
  }

private:
  SizeValueType m_Stride; ///< sites from a row to the next
  std::pmr::vector<CountsType> m_Counts;
};

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
    std::uint8_t corners[3] = {};           ///< counter-clockwise seen from outside when the omitted corner is outside
    FCCTriangleUse::CountsType use[3] = {}; ///< counts that it adds at these corners
  };

  std::uint8_t edges[Cases::Tetrahedra][4][4] = {};           ///< between two corners of a tetrahedron
  FCCTetrahedronPolygon polygons[Cases::Tetrahedra][16] = {}; ///< by the corners inside
  Triangle triangles[Cases::Tetrahedra][4] = {};              ///< by the omitted corner

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
  MakeTriangle(unsigned int kind, const std::uint8_t (&sites)[4], unsigned int omitted)
  {
    Triangle triangle;
    auto & corners = triangle.corners;
    for (std::uint8_t corner = 0, n = 0; corner < 4; ++corner)
    {
      if (corner != omitted)
      {
        corners[n++] = corner;
      }
    }
    if (Cases::Orientation(kind, sites[corners[0]], sites[corners[1]], sites[corners[2]], sites[omitted]) < 0)
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

/** Two consecutive planes, \a k and \a k + 1, and their vertices. */
struct FCCLeanLayer
{
  const FCCSigns & signs;
  SizeValueType k;
  const FCCClusterPlane & lower;
  const FCCClusterPlane & upper;
};

/** Adds the triangles of a layer, as they would be if no site were split, to the counts of both planes. Returns how
 * many they are. */
SizeValueType
CountTriangleUse(const FCCLeanLayer & layer, FCCTriangleUse & lowerUse, FCCTriangleUse & upperUse);

/** The triangles of a layer, with numbered vertices. Returns how many they are. \a reversed turns them all over. */
SizeValueType
FillLeanTriangles(const FCCLeanLayer & layer, bool reversed, TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
