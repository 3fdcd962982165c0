#include "itkTriangleSurfaceMeshConversion.h"

#include "itkTriangleSurfaceTopology.h"

#include "itkTriangleCell.h"

#include <algorithm>

namespace itk
{
namespace
{

using MeshType = Mesh<float, 3>;
using QuadEdgeMeshType = QuadEdgeMesh<float, 3>;
using TriangleCellType = TriangleCell<MeshType::CellType>;

void
VerifyThreeCorners(const TriangleSurface & surface)
{
  for (const auto & [a, b, c] : surface.GetTriangles())
  {
    if (a == b || b == c || c == a)
    {
      itkGenericExceptionMacro(
        "The triangle of points "
        << a << ", " << b << " and " << c
        << " has a point twice, which no face of a QuadEdgeMesh can; use ConvertTriangleSurfaceToMesh(), or "
           "remove the triangle first");
    }
  }
}

void
VerifyManifold(const TriangleSurface & surface)
{
  const TriangleSurfaceTopology topology = ComputeTriangleSurfaceTopology(surface);
  if (topology.nonManifoldEdges + topology.nonManifoldPoints + topology.misorientedEdges > 0)
  {
    itkGenericExceptionMacro("The surface has " << topology.nonManifoldEdges << " edges and "
                                                << topology.nonManifoldPoints << " points that are not manifold, and "
                                                << topology.misorientedEdges
                                                << " misoriented edges, of which a QuadEdgeMesh can have none; use "
                                                   "ConvertTriangleSurfaceToMesh(), or mend the surface first");
  }
}

template <typename TMesh>
void
CopyPoints(const TriangleSurface & surface, TMesh & mesh)
{
  const auto points = TMesh::PointsContainer::New();
  points->Reserve(surface.GetNumberOfPoints());
  IdentifierType id = 0;
  for (const auto & point : surface.GetPoints())
  {
    points->SetElement(id++, typename TMesh::PointType(point.data()));
  }
  mesh.SetPoints(points);
}

} // namespace

Mesh<float, 3>::Pointer
ConvertTriangleSurfaceToMesh(const TriangleSurface & surface)
{
  surface.VerifyTriangles();
  const auto mesh = MeshType::New();
  CopyPoints(surface, *mesh);
  const auto cells = MeshType::CellsContainer::New();
  cells->Reserve(surface.GetNumberOfTriangles());
  mesh->SetCellsAllocationMethod(MeshType::CellsAllocationMethodType::CellsAllocatedDynamicallyCellByCell);
  mesh->SetCells(cells);
  IdentifierType id = 0;
  for (const auto & triangle : surface.GetTriangles())
  {
    auto * const cell = new TriangleCellType;
    std::copy(triangle.begin(), triangle.end(), cell->PointIdsBegin());
    cells->SetElement(id++, cell);
  }
  return mesh;
}

QuadEdgeMesh<float, 3>::Pointer
ConvertTriangleSurfaceToQuadEdgeMesh(const TriangleSurface & surface)
{
  surface.VerifyTriangles();
  VerifyThreeCorners(surface);
  VerifyManifold(surface);
  const auto mesh = QuadEdgeMeshType::New();
  CopyPoints(surface, *mesh);
  for (const auto & triangle : surface.GetTriangles())
  {
    const QuadEdgeMeshType::PointIdList corners(triangle.begin(), triangle.end());
    if (mesh->AddFaceWithSecurePointList(corners) == nullptr)
    {
      itkGenericExceptionMacro(
        "The triangle of points "
        << triangle[0] << ", " << triangle[1] << " and " << triangle[2]
        << " does not fit into a QuadEdgeMesh beside those before it; use ConvertTriangleSurfaceToMesh()");
    }
  }
  return mesh;
}

} // namespace itk
