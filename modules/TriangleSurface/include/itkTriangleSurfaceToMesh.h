#ifndef itkTriangleSurfaceToMesh_h
#define itkTriangleSurfaceToMesh_h

#include "itkMesh.h"
#include "itkQuadEdgeMesh.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** Bytes that ConvertToMesh() will take from the heap: itk::Mesh allocates each cell, and the cell its point ids. About
 * 142 bytes a triangle with its share of the points, where the surface has 18, 24 with normals. Thread safe. */
SizeValueType
EstimateMeshMemory(const TriangleSurface & surface);

/** Bytes that ConvertToQuadEdgeMesh() will take from the heap: about 930 a triangle of a closed surface, more if it is
 * open. Thread safe. */
SizeValueType
EstimateQuadEdgeMeshMemory(const TriangleSurface & surface);

/** The surface as an itk::Mesh of triangle cells, for ITK's mesh filters: points and triangles with the same ids, in
 * LPS mm; without normals, which a mesh of scalars can't hold. Triangles may have equal corners. See
 * EstimateMeshMemory() before. Throws ExceptionObject if a triangle has a point that the surface has not. Thread safe.
 */
Mesh<float, 3>::Pointer
ConvertToMesh(const TriangleSurface & surface);

/** The surface as an itk::QuadEdgeMesh, whose filters walk along edges; otherwise as ConvertToMesh(). See
 * EstimateQuadEdgeMeshMemory() before. Throws ExceptionObject if the surface is not an oriented manifold, with or
 * without border, or a triangle has equal corners: such a mesh can't be anything else. Thread safe. */
QuadEdgeMesh<float, 3>::Pointer
ConvertToQuadEdgeMesh(const TriangleSurface & surface);

} // namespace itk

#endif
