#ifndef itkMeshToTriangleSurface_h
#define itkMeshToTriangleSurface_h

#include "itkMesh.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** Copies the triangles of an itk::Mesh or itk::QuadEdgeMesh into a surface: points and triangles in the order of their
 * ids, which may have gaps; coordinates rounded to float32; no normals. Polygons of three points count as triangles.
 * Points of no triangle are kept.
 *
 * Throws ExceptionObject if a cell is not a triangle, if a triangle refers to a missing point, or if there are 2^32
 * points or more. Not thread safe for a QuadEdgeMesh, whose cells collect their points on demand. */
template <typename TPixel, typename TTraits>
TriangleSurface::Pointer
ConvertMeshToTriangleSurface(const Mesh<TPixel, 3, TTraits> & mesh);

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkMeshToTriangleSurface.hxx"
#endif

#endif
