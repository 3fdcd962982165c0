#include "itkTriangleSurfaceMeshConversion.h"

#include "itkExampleSurfaces.h"

#include "itkLineCell.h"
#include "itkQuadrilateralCell.h"
#include "itkTriangleCell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <malloc.h>

namespace
{

using itk::TriangleSurface;
using MeshType = itk::Mesh<float, 3>;

/** Bytes that the program has allocated by malloc. */
double
HeapInUse()
{
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

void
ExpectSame(const TriangleSurface & a, const TriangleSurface & b)
{
  EXPECT_EQ(a.GetPoints(), b.GetPoints());
  EXPECT_EQ(a.GetTriangles(), b.GetTriangles());
}

/** The same triangles, whichever of its points each begins with. */
void
ExpectSameUpToRotation(const TriangleSurface & a, const TriangleSurface & b)
{
  const auto fromLeast = [](const TriangleSurface & surface) {
    std::vector<TriangleSurface::TriangleType> triangles(surface.GetTriangles().begin(), surface.GetTriangles().end());
    for (auto & triangle : triangles)
    {
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    return triangles;
  };
  EXPECT_EQ(a.GetPoints(), b.GetPoints());
  EXPECT_EQ(fromLeast(a), fromLeast(b));
}

TEST(TriangleSurfaceToMesh, HasTheSamePointsAndCells)
{
  const auto surface = itk::example::MakeTetrahedron(2.0f);
  const auto mesh = itk::ConvertTriangleSurfaceToMesh(*surface);
  ASSERT_EQ(mesh->GetNumberOfPoints(), 4u);
  ASSERT_EQ(mesh->GetNumberOfCells(), 4u);
  EXPECT_EQ(mesh->GetPoint(1)[0], 2.0f);
  MeshType::CellAutoPointer cell;
  ASSERT_TRUE(mesh->GetCell(3, cell));
  EXPECT_EQ(cell->GetType(), itk::CellGeometryEnum::TRIANGLE_CELL);
  EXPECT_TRUE(std::equal(cell->PointIdsBegin(), cell->PointIdsEnd(), surface->GetTriangles()[3].begin()));
}

TEST(TriangleSurfaceToMesh, ComesBackTheSame)
{
  for (const auto & surface : { itk::example::MakeSphere(10.0, 3),
                                itk::example::MakeTorus(8.0, 3.0, 12),
                                itk::example::MakeRandomTriangles(50, 10.0f, 1.0f, 7),
                                TriangleSurface::New() })
  {
    ExpectSame(*surface, *itk::ConvertMeshToTriangleSurface(*itk::ConvertTriangleSurfaceToMesh(*surface)));
  }
}

TEST(TriangleSurfaceToMesh, QuadEdgeMeshComesBackTheSame)
{
  const auto open = itk::example::MakeSphere(10.0, 2);
  open->GetTriangles().resize(64); // the upper half
  for (const auto & surface : { itk::example::MakeSphere(10.0, 3), itk::example::MakeTorus(8.0, 3.0, 12), open })
  {
    const auto mesh = itk::ConvertTriangleSurfaceToQuadEdgeMesh(*surface);
    EXPECT_EQ(mesh->GetNumberOfFaces(), surface->GetNumberOfTriangles());
    ExpectSameUpToRotation(*surface, *itk::ConvertMeshToTriangleSurface(*mesh));
  }
}

TEST(TriangleSurfaceToMesh, MemoryIsAsDocumented)
{
  const auto surface = itk::example::MakeSphere(10.0, 6); // 32768 triangles
  const auto triangles = static_cast<double>(surface->GetNumberOfTriangles());
  const double before = HeapInUse();
  if (before == 0.0)
  {
    GTEST_SKIP() << "a sanitizer's malloc keeps no account";
  }
  const auto mesh = itk::ConvertTriangleSurfaceToMesh(*surface);
  const double ofMesh = HeapInUse() - before;
  EXPECT_NEAR(ofMesh / triangles, 142.0, 7.0);
  const auto quadEdge = itk::ConvertTriangleSurfaceToQuadEdgeMesh(*surface);
  EXPECT_NEAR((HeapInUse() - before - ofMesh) / triangles, 930.0, 46.0);
}

template <typename TConvert>
std::string
MessageOf(const TConvert & convert)
{
  try
  {
    convert();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

TEST(TriangleSurfaceToMesh, RefusesWhatAMeshCannotBe)
{
  const auto surface = itk::example::MakeTetrahedron();
  const auto toMesh = [&] { itk::ConvertTriangleSurfaceToMesh(*surface); };
  const auto toQuadEdgeMesh = [&] { itk::ConvertTriangleSurfaceToQuadEdgeMesh(*surface); };
  surface->GetTriangles().push_back({ 0, 1, 4 });
  const std::string missing = "has point 4, but the surface has only 4 points; write the surface again";
  EXPECT_NE(MessageOf(toMesh).find(missing), std::string::npos);
  EXPECT_NE(MessageOf(toQuadEdgeMesh).find(missing), std::string::npos);
  surface->GetPoints().push_back({ -1, -1, -1 });
  EXPECT_EQ(MessageOf(toMesh), "");
  EXPECT_NE(MessageOf(toQuadEdgeMesh).find("; use ConvertTriangleSurfaceToMesh()"), std::string::npos)
    << "an edge with three triangles";
}

TEST(TriangleSurfaceToMesh, TrianglesWithEqualCornersAreNoFacesOfAQuadEdgeMesh)
{
  for (const TriangleSurface::TriangleType & triangle :
       { TriangleSurface::TriangleType{ 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 }, { 1, 1, 1 } })
  {
    const auto surface = TriangleSurface::New();
    surface->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 } };
    surface->GetTriangles() = { triangle };
    const std::string message = MessageOf([&] { itk::ConvertTriangleSurfaceToQuadEdgeMesh(*surface); });
    EXPECT_NE(message.find("has a point twice"), std::string::npos) << message;
    EXPECT_NE(message.find("; use ConvertTriangleSurfaceToMesh()"), std::string::npos) << message;
    ExpectSame(*surface, *itk::ConvertMeshToTriangleSurface(*itk::ConvertTriangleSurfaceToMesh(*surface)));
  }
}

std::string
MessageOfConverting(const MeshType & mesh)
{
  return MessageOf([&] { itk::ConvertMeshToTriangleSurface(mesh); });
}

/** A tetrahedron's triangles, and one more cell. */
MeshType::Pointer
MakeMeshWith(MeshType::CellType * another)
{
  const auto mesh = itk::ConvertTriangleSurfaceToMesh(*itk::example::MakeTetrahedron());
  MeshType::CellAutoPointer cell;
  cell.TakeOwnership(another);
  mesh->SetCell(4, cell);
  return mesh;
}

TEST(MeshToTriangleSurface, RefusesOtherCellsThanTriangles)
{
  const auto withLine = MakeMeshWith(new itk::LineCell<MeshType::CellType>);
  EXPECT_NE(MessageOfConverting(*withLine).find("Cell 4 of the mesh has 2 points and dimension 1"), std::string::npos);
  const auto withQuadrilateral = MakeMeshWith(new itk::QuadrilateralCell<MeshType::CellType>);
  EXPECT_NE(MessageOfConverting(*withQuadrilateral).find("; triangulate the mesh"), std::string::npos);
}

TEST(MeshToTriangleSurface, RefusesPointsThatTheMeshHasNot)
{
  auto * const triangle = new itk::TriangleCell<MeshType::CellType>;
  for (int corner = 0; corner < 3; ++corner)
  {
    triangle->SetPointId(corner, static_cast<itk::IdentifierType>(2 + corner));
  }
  const auto mesh = MakeMeshWith(triangle);
  EXPECT_NE(MessageOfConverting(*mesh).find("point 4, which the mesh has not"), std::string::npos);
}

TEST(MeshToTriangleSurface, TakesIdsWithGapsAndDoublePrecision)
{
  using QuadEdgeMeshType = itk::QuadEdgeMesh<double, 3>;
  const auto mesh = QuadEdgeMeshType::New();
  for (const itk::IdentifierType id : { 3, 5, 40 })
  {
    QuadEdgeMeshType::PointType point;
    point.Fill(static_cast<float>(id));
    mesh->SetPoint(id, point);
  }
  mesh->AddFaceTriangle(40, 3, 5);
  const auto surface = itk::ConvertMeshToTriangleSurface(*mesh);
  ASSERT_EQ(surface->GetNumberOfPoints(), 3u);
  EXPECT_EQ(surface->GetPoints()[2][0], 40.0f);
  EXPECT_EQ(surface->GetTriangles()[0], (TriangleSurface::TriangleType{ 2, 0, 1 }));
  EXPECT_EQ(itk::ConvertMeshToTriangleSurface(*itk::Mesh<double, 3>::New())->GetNumberOfTriangles(), 0u);
}

} // namespace
