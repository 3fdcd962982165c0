#ifndef itkTriangleSurfaceToMesh_h
#define itkTriangleSurfaceToMesh_h

#include "itkMesh.h"
#include "itkQuadEdgeMesh.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** Copies the surface into an itk::Mesh of triangle cells, for ITK's mesh filters: the same ids of points and
 * triangles, in LPS mm, without normals. Triangles may have equal corners. It takes about 142 bytes per triangle,
 * where the surface itself has 18, or 24 with normals: itk::Mesh allocates each cell, and the cell its point ids.
 * Throws ExceptionObject if a triangle refers to a missing point. */
Mesh<float, 3>::Pointer
ConvertTriangleSurfaceToMesh(const TriangleSurface & surface);

/** Copies the surface into an itk::QuadEdgeMesh, whose filters walk along edges; otherwise as
 * ConvertTriangleSurfaceToMesh(). Throws ExceptionObject also if the surface is not an oriented manifold (a border is
 * allowed) or if a triangle has equal corners, which a QuadEdgeMesh cannot hold. It takes about 930 bytes per triangle
 * of a closed surface. */
QuadEdgeMesh<float, 3>::Pointer
ConvertTriangleSurfaceToQuadEdgeMesh(const TriangleSurface & surface);

} // namespace itk

#endif
