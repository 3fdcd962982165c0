#ifndef itkFCCLeanMarching_h
#define itkFCCLeanMarching_h

#include "itkFCCClusterPlane.h"
#include "itkFCCTriangleUse.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** \file
 * The triangles of mode `lean`. Every crossing has moved to its nearer end (FCCNearerEnds), so a tetrahedron's triangle
 * keeps its area when its three corners have moved to three sites. What is left of a tetrahedron depends on which of
 * its sites have a crossing of its edges: three that do span one triangle, four span two, and fewer none. When four do,
 * each has one crossing of a quadrilateral, which FCCTetrahedronPolygon::FindFirstCorner() cuts from a site inside to a
 * site inside. For whole sites that is logic on bits: 64 steps of a column in one word. */

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
