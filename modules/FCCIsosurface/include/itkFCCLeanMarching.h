#ifndef itkFCCLeanMarching_h
#define itkFCCLeanMarching_h

#include "itkFCCClusterPlane.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** Adds the triangles between the planes \a k and \a k + 1, as they would be if no site were split, to the counts of
 * both planes. Returns how many they are. */
SizeValueType
CountTriangleUse(const FCCSigns & signs,
                 SizeValueType k,
                 const FCCClusterPlane & lower,
                 const FCCClusterPlane & upper,
                 FCCTriangleUse & lowerUse,
                 FCCTriangleUse & upperUse);

/** The triangles between the planes \a k and \a k + 1, with numbered vertices. Returns how many they are.
 * \a reversed turns them all over. */
SizeValueType
FillLeanTriangles(const FCCSigns & signs,
                  SizeValueType k,
                  const FCCClusterPlane & lower,
                  const FCCClusterPlane & upper,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
