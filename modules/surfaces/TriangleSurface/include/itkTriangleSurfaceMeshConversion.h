#ifndef itkTriangleSurfaceMeshConversion_h
#define itkTriangleSurfaceMeshConversion_h

#include "itkMesh.h"
#include "itkQuadEdgeMesh.h"
#include "itkTriangleSurface.h"

#include <algorithm>
#include <limits>

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

/** Copies the triangles of an itk::Mesh or itk::QuadEdgeMesh into a surface: points and triangles in the order of their
 * ids, which may have gaps; coordinates rounded to float32; no normals. Polygons of three points count as triangles.
 * Points of no triangle are kept.
 *
 * Throws ExceptionObject if a cell is not a triangle, if a triangle refers to a missing point, or if there are 2^32
 * points or more. Not thread safe for a QuadEdgeMesh, whose cells collect their points on demand. */
template <typename TPixel, typename TTraits>
TriangleSurface::Pointer
ConvertMeshToTriangleSurface(const Mesh<TPixel, 3, TTraits> & mesh)
{
  using PointIdentifier = typename Mesh<TPixel, 3, TTraits>::PointIdentifier;
  auto surface = TriangleSurface::New();

  std::vector<PointIdentifier> ids; // ascending: containers are walked in the order of their ids
  if (const auto * const points = mesh.GetPoints())
  {
    if (points->Size() > std::numeric_limits<std::uint32_t>::max())
    {
      itkGenericExceptionMacro("The mesh has "
                               << points->Size()
                               << " points, but a TriangleSurface holds fewer than 2^32; simplify or split it first");
    }
    ids.reserve(points->Size());
    surface->GetPoints().reserve(points->Size());
    for (auto it = points->Begin(); it != points->End(); ++it)
    {
      const auto & point = it.Value();
      ids.push_back(it.Index());
      surface->GetPoints().push_back(
        { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
    }
  }

  if (const auto * const cells = mesh.GetCells())
  {
    surface->GetTriangles().reserve(cells->Size());
    for (auto it = cells->Begin(); it != cells->End(); ++it)
    {
      auto * const cell = it.Value();
      if (cell->GetDimension() != 2 || cell->GetNumberOfPoints() != 3)
      {
        itkGenericExceptionMacro(
          "Cell " << it.Index() << " of the mesh has " << cell->GetNumberOfPoints() << " points and dimension "
                  << cell->GetDimension()
                  << ", but a TriangleSurface has triangles alone; triangulate the mesh or remove its other cells");
      }
      TriangleSurface::TriangleType triangle;
      const auto corners = cell->PointIdsBegin(); // a QuadEdgeMesh's cell makes its list on this call
      std::transform(corners, corners + 3, triangle.begin(), [&](PointIdentifier id) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), id);
        if (found == ids.end() || *found != id)
        {
          itkGenericExceptionMacro("Cell " << it.Index() << " of the mesh has point " << id
                                           << ", which the mesh has not; add the point or remove the cell");
        }
        return static_cast<std::uint32_t>(found - ids.begin());
      });
      surface->GetTriangles().push_back(triangle);
    }
  }
  return surface;
}

} // namespace itk

#endif
