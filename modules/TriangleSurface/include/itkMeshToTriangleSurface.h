#ifndef itkMeshToTriangleSurface_h
#define itkMeshToTriangleSurface_h

#include "itkMesh.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** The triangles of an itk::Mesh, or of an itk::QuadEdgeMesh, as a surface: points and triangles in the order of their
 * ids, which may have gaps; coordinates as float32; no normals. Polygons of three points are triangles, too. Points of
 * no triangle are kept, as are triangles of any orientation.
 *
 * Throws an ExceptionObject when a cell is anything else than a triangle, when a triangle has a point that the mesh has
 * not, or when there are 2^32 points or more. Thread safe, but not for one QuadEdgeMesh, whose cells collect their
 * points on demand. */
template <typename TPixel, typename TTraits>
TriangleSurface::Pointer
ConvertToTriangleSurface(const Mesh<TPixel, 3, TTraits> & mesh);

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkMeshToTriangleSurface.hxx"
#endif

#endif
