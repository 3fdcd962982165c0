#include "itkFCCIsosurfaceFilter.h"
#include "rhombicSurfaceToPolyData.h"

#include "itkFCCTestImages.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

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

/** All coordinates, normals and corners, as VTK reads them. */
std::vector<double>
ReadAll(vtkPolyData & polyData)
{
  std::vector<double> values;
  for (vtkDataArray * const vectors : { polyData.GetPoints()->GetData(), polyData.GetPointData()->GetNormals() })
  {
    for (vtkIdType n = 0; n < vectors->GetNumberOfTuples(); ++n)
    {
      const double * const vector = vectors->GetTuple3(n);
      values.insert(values.end(), vector, vector + 3);
    }
  }
  for (vtkIdType n = 0; n < polyData.GetNumberOfCells(); ++n)
  {
    vtkIdType size = 0;
    const vtkIdType * corners = nullptr;
    polyData.GetPolys()->GetCellAtId(n, size, corners);
    values.insert(values.end(), corners, corners + size);
  }
  return values;
}

TEST(SurfaceToPolyData, SharesTheSurfacesMemory)
{
  const itk::TriangleSurface::ConstPointer surface = MakeSurface().GetPointer();
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

TEST(SurfaceToPolyData, ArraysAndTheirShallowCopiesOutliveSurfaceAndPolyData)
{
  const auto copy = vtkSmartPointer<vtkFloatArray>::New();
  vtkSmartPointer<vtkDataArray> points;
  {
    const auto polyData = rhombic::SurfaceToPolyData(MakeSurface());
    points = polyData->GetPoints()->GetData();
    copy->ShallowCopy(polyData->GetPointData()->GetNormals());
  }
  EXPECT_EQ(points->GetTuple3(2)[1], 1.0);
  points = nullptr;
  EXPECT_EQ(copy->GetTuple3(0)[2], -1.0);
}

TEST(SurfaceToPolyData, StaysAsItIsWhenTheFilterRunsAgainAndAllElseIsDeleted)
{
  using Filter = itk::FCCIsosurfaceFilter<fcctest::ImageType>;
  for (const bool releases : { true, false })
  {
    auto filter = Filter::New();
    filter->SetInput(
      fcctest::MakeImage(1.0, 24.0, [](const fcctest::PointType & p) { return fcctest::Sphere(p, 20.0); }));
    filter->SetReleaseDataBeforeUpdateFlag(releases);
    std::vector<std::pair<vtkSmartPointer<vtkPolyData>, std::vector<double>>> made;
    for (const double isovalue : { 0.0, 5.0, -2.0 })
    {
      filter->SetIsovalue(isovalue);
      filter->Update();
      const auto polyData = rhombic::SurfaceToPolyData(filter->GetOutput());
      made.emplace_back(polyData, ReadAll(*polyData));
    }
    filter = nullptr;
    for (const auto & [polyData, values] : made)
    {
      EXPECT_GT(polyData->GetNumberOfCells(), 1000);
      EXPECT_EQ(ReadAll(*polyData), values) << releases;
    }
    EXPECT_NE(made.front().second, made.back().second);
  }
}

TEST(SurfaceToPolyData, StaysAsItIsWhenTheSurfaceIsEdited)
{
  const auto surface = MakeSurface();
  const auto polyData = rhombic::SurfaceToPolyData(surface);
  const std::vector<double> values = ReadAll(*polyData);
  surface->GetPoints()[1] = { 7, 7, 7 };
  surface->GetNormals()[1] = { 0, 0, 1 };
  std::reverse(surface->GetTriangles().begin(), surface->GetTriangles().end());
  EXPECT_EQ(ReadAll(*polyData), values);
  surface->Initialize();
  EXPECT_EQ(ReadAll(*polyData), values);
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
