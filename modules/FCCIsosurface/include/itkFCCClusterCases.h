#ifndef itkFCCClusterCases_h
#define itkFCCClusterCases_h

#include "itkFCCMarchingCases.h"

namespace itk
{

/** \class FCCClusterCases
 * \brief Triangles between sites that have gathered the surface's crossings with their edges.
 *
 * Every crossing has moved to the nearer end of its edge, its *owner*. A triangle of a tetrahedron keeps its area when
 * its three corners have three owners. So what is left of a tetrahedron depends on which of its sites own a crossing
 * in it: three that do span one triangle, four span two, and fewer none. Four owners own one crossing each of the
 * quadrilateral between two sites inside and two outside; it is cut from owner inside to owner inside.
 *
 * A case is a number of eight bits for the corners of one of the tetrahedra of FCCMarchingCases: bit c is set when
 * corner c is inside, bit 4 + c when it owns a crossing.
 *
 * \ingroup FCCIsosurface
 */
struct FCCClusterCases
{
  static constexpr unsigned int Cases = 256;

  struct Case
  {
    std::uint8_t triangles = 0;
    std::uint8_t corners[2][3] = {}; ///< of the tetrahedron, counter-clockwise seen from outside
  };

  /** The triangle of three corners, turned so that its outside is away from \a inside, or towards it when that corner
   * is outside. */
  static constexpr void
  AddTriangle(Case & result,
              unsigned int kind,
              unsigned int tetrahedron,
              unsigned int a,
              unsigned int b,
              unsigned int c,
              unsigned int opposite,
              bool oppositeIsInside)
  {
    const auto & sites = FCCMarchingCases::TetrahedronSites[tetrahedron];
    const bool facesOpposite = FCCMarchingCases::Orientation(kind, sites[a], sites[b], sites[c], sites[opposite]) > 0;
    auto & corners = result.corners[result.triangles++];
    corners[0] = static_cast<std::uint8_t>(a);
    corners[1] = static_cast<std::uint8_t>(facesOpposite == oppositeIsInside ? c : b);
    corners[2] = static_cast<std::uint8_t>(facesOpposite == oppositeIsInside ? b : c);
  }

  static constexpr Case
  MakeCase(unsigned int kind, unsigned int tetrahedron, unsigned int pattern)
  {
    Case result;
    const auto isInside = [pattern](unsigned int corner) { return (pattern >> corner & 1) != 0; };
    unsigned int owners[4] = {};
    unsigned int count = 0;
    unsigned int other = 0; // the last corner that owns nothing
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      if ((pattern >> (4 + corner) & 1) != 0)
      {
        owners[count++] = corner;
      }
      else
      {
        other = corner;
      }
    }
    if (count == 3)
    {
      AddTriangle(result, kind, tetrahedron, owners[0], owners[1], owners[2], other, isInside(other));
    }
    else if (count == 4)
    {
      unsigned int inside[4] = {};
      unsigned int outside[4] = {};
      unsigned int insides = 0;
      unsigned int outsides = 0;
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        if (isInside(corner))
        {
          inside[insides++] = corner;
        }
        else
        {
          outside[outsides++] = corner;
        }
      }
      if (insides == 2)
      {
        AddTriangle(result, kind, tetrahedron, inside[0], inside[1], outside[0], outside[1], false);
        AddTriangle(result, kind, tetrahedron, inside[0], inside[1], outside[1], outside[0], false);
      }
    }
    return result;
  }

  struct Tables
  {
    Case cases[FCCMarchingCases::Kinds][FCCMarchingCases::Tetrahedra][Cases] = {};
  };

  static constexpr Tables
  MakeTables()
  {
    Tables tables;
    for (unsigned int kind = 0; kind < FCCMarchingCases::Kinds; ++kind)
    {
      for (unsigned int tetrahedron = 0; tetrahedron < FCCMarchingCases::Tetrahedra; ++tetrahedron)
      {
        for (unsigned int pattern = 0; pattern < Cases; ++pattern)
        {
          tables.cases[kind][tetrahedron][pattern] = MakeCase(kind, tetrahedron, pattern);
        }
      }
    }
    return tables;
  }
};

inline constexpr FCCClusterCases::Tables FCCClusterTables = FCCClusterCases::MakeTables();

} // namespace itk

#endif
