#include "itkTriangleSurfaceToMesh.h"

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

/** Bytes that glibc's malloc takes for a block. */
constexpr SizeValueType
HeapBlock(SizeValueType bytes)
{
  constexpr SizeValueType header = 8, alignment = 16, least = 32;
  return std::max(least, (bytes + header + alignment - 1) / alignment * alignment);
}

/** Bytes of a node of a std::map. */
template <typename TKey, typename TValue>
constexpr SizeValueType
MapNode()
{
  constexpr SizeValueType links = 32;
  return HeapBlock(links + sizeof(std::pair<const TKey, TValue>));
}

void
VerifyThreeCorners(const TriangleSurface & surface)
{
  for (const auto & [a, b, c] : surface.GetTriangles())
  {
    if (a == b || b == c || c == a)
    {
      itkGenericExceptionMacro("The triangle of points "
                               << a << ", " << b << " and " << c
                               << " has a point twice, which no face of a QuadEdgeMesh can; use ConvertToMesh(), or "
                                  "remove the triangle first");
    }
  }
}

void
VerifyManifold(const TriangleSurface & surface)
{
  const TriangleSurfaceTopology topology = ComputeTopology(surface);
  if (topology.nonManifoldEdges + topology.nonManifoldPoints + topology.misorientedEdges > 0)
  {
    itkGenericExceptionMacro(
      "The surface has "
      << topology.nonManifoldEdges << " edges and " << topology.nonManifoldPoints
      << " points that are not manifold, and " << topology.misorientedEdges
      << " misoriented edges, of which a QuadEdgeMesh can have none; use ConvertToMesh(), or mend the surface first");
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

SizeValueType
EstimateMeshMemory(const TriangleSurface & surface)
{
  const SizeValueType perTriangle = sizeof(MeshType::CellType *) + HeapBlock(sizeof(TriangleCellType)) +
                                    HeapBlock(3 * sizeof(MeshType::PointIdentifier));
  return surface.GetNumberOfTriangles() * perTriangle + surface.GetNumberOfPoints() * sizeof(MeshType::PointType);
}

SizeValueType
EstimateQuadEdgeMeshMemory(const TriangleSurface & surface)
{
  using CellPointer = QuadEdgeMeshType::CellType *;
  const SizeValueType cellNode = MapNode<QuadEdgeMeshType::CellIdentifier, CellPointer>();
  const SizeValueType perEdge = cellNode + HeapBlock(sizeof(QuadEdgeMeshType::EdgeCellType)) +
                                2 * HeapBlock(sizeof(QuadEdgeMeshType::QEPrimal)) +
                                2 * HeapBlock(sizeof(QuadEdgeMeshType::QEDual));
  const SizeValueType perTriangle = cellNode + HeapBlock(sizeof(QuadEdgeMeshType::PolygonCellType));
  const SizeValueType perPoint = MapNode<QuadEdgeMeshType::PointIdentifier, QuadEdgeMeshType::PointType>();
  const SizeValueType triangles = surface.GetNumberOfTriangles();
  return triangles * perTriangle + triangles * 3 / 2 * perEdge + surface.GetNumberOfPoints() * perPoint;
}

Mesh<float, 3>::Pointer
ConvertToMesh(const TriangleSurface & surface)
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
ConvertToQuadEdgeMesh(const TriangleSurface & surface)
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
      itkGenericExceptionMacro("The triangle of points "
                               << triangle[0] << ", " << triangle[1] << " and " << triangle[2]
                               << " does not fit into a QuadEdgeMesh beside those before it; use ConvertToMesh()");
    }
  }
  return mesh;
}

} // namespace itk
