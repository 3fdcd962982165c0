#include "rhombicSurfaceToPolyData.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <string>

namespace
{

itk::TriangleSurface::Pointer
MakeSurface()
{
  auto surface = itk::TriangleSurface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface->GetNormals() = { { 0, 0, -1 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return surface;
}

TEST(SurfaceToPolyData, SharesTheSurfacesMemory)
{
  const auto surface = MakeSurface();
  const auto polyData = rhombic::SurfaceToPolyData(surface);
  EXPECT_EQ(polyData->GetPoints()->GetVoidPointer(0), surface->GetPoints().data());
  EXPECT_EQ(polyData->GetPolys()->GetConnectivityArray()->GetVoidPointer(0), surface->GetTriangles().data());
  EXPECT_EQ(polyData->GetPointData()->GetNormals()->GetVoidPointer(0), surface->GetNormals().data());
}

TEST(SurfaceToPolyData, HasTheSamePointsAndCells)
{
  const auto polyData = rhombic::SurfaceToPolyData(MakeSurface());
  ASSERT_EQ(polyData->GetNumberOfPoints(), 4);
  ASSERT_EQ(polyData->GetNumberOfCells(), 4);
  EXPECT_EQ(polyData->GetPoint(3)[2], 1.0);
  vtkIdType size = 0;
  const vtkIdType * corners = nullptr;
  polyData->GetPolys()->GetCellAtId(3, size, corners);
  ASSERT_EQ(size, 3);
  EXPECT_EQ(corners[0], 1);
  EXPECT_EQ(corners[2], 3);
}

TEST(SurfaceToPolyData, KeepsTheSurfaceAliveAsLongAsAnyArray)
{
  vtkSmartPointer<vtkDataArray> points;
  itk::WeakPointer<itk::TriangleSurface> weak;
  {
    const auto surface = MakeSurface();
    weak = surface.GetPointer();
    const auto polyData = rhombic::SurfaceToPolyData(surface);
    points = polyData->GetPoints()->GetData();
    EXPECT_GT(surface->GetReferenceCount(), 1);
  }
  EXPECT_EQ(weak->GetReferenceCount(), 1) << "the points' array holds the last reference";
  EXPECT_EQ(points->GetTuple3(2)[1], 1.0);
}

TEST(SurfaceToPolyData, EmptySurfacesAndSurfacesWithoutNormalsAreFine)
{
  const auto empty = itk::TriangleSurface::New();
  EXPECT_EQ(rhombic::SurfaceToPolyData(empty)->GetNumberOfCells(), 0);
  auto bare = MakeSurface();
  bare->GetNormals().clear();
  EXPECT_EQ(rhombic::SurfaceToPolyData(bare)->GetPointData()->GetNormals(), nullptr);
}

TEST(SurfaceToPolyData, ANullPointerIsRefused)
{
  try
  {
    rhombic::SurfaceToPolyData(nullptr);
    FAIL() << "it was converted";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("; give "), std::string::npos) << error;
  }
}

} // namespace
