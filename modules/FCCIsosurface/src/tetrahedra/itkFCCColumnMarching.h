#ifndef itkFCCColumnMarching_h
#define itkFCCColumnMarching_h

#include "itkFCCCutEdges.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** Number of triangles between the planes \a k and \a k + 1. */
SizeValueType
CountColumnTriangles(const FCCSigns & signs, SizeValueType k);

/** The triangles between the planes \a k and \a k + 1, from the cut edges of plane \a k within it, of plane \a k + 1
 * within it, and between the two. Writes as many as CountColumnTriangles() says; \a reversed turns them all over. */
void
FillColumnTriangles(const FCCSigns & signs,
                    SizeValueType k,
                    const FCCCutEdges & lower,
                    const FCCCutEdges & upper,
                    const FCCCutEdges & between,
                    bool reversed,
                    TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
