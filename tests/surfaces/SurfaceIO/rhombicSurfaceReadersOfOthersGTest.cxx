// Other programs read our files: VTK, ITK, F3D, and Khronos' glTF-Validator.

#include "rhombicReadersOfOthers.h"
#include "rhombicSurfaceTest.h"

#include "itkTriangleSurfaceMeasures.h"

#include <itkMesh.h>
#include <itkMeshFileReader.h>
#include <itkOBJMeshIO.h>

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace
{

using rhombic::WriteSurfaces;
using rhombictest::ReadGLTF;
using rhombictest::ReadWith;

class SurfaceReadersOfOthers : public SurfaceTest
{
protected:
  /** Writes two spheres, or one if the format holds only one, and returns them. */
  std::vector<SceneSurface>
  Write(const std::string & extension, SurfaceFileSpace space = SurfaceFileSpace::LPS)
  {
    std::vector<SceneSurface> scene = MakeScene();
    scene.resize(extension == ".stl" ? 1 : 2);
    WriteSurfaces(scene, this->PathOf(extension), { space });
    return scene;
  }

  fs::path
  PathOf(const std::string & extension) const
  {
    return m_Folder / ("scene" + extension);
  }
};

double
SumOver(const std::vector<SceneSurface> & scene, double (*measure)(const Surface &))
{
  double sum = 0;
  for (const SceneSurface & surface : scene)
  {
    sum += measure(*surface.surface);
  }
  return sum;
}

std::array<double, 6>
BoundsOf(const std::vector<SceneSurface> & scene)
{
  auto bounds = scene[0].surface->GetBounds();
  for (const SceneSurface & surface : scene)
  {
    for (int side = 0; side < 6; ++side)
    {
      const double other = surface.surface->GetBounds()[side];
      bounds[side] = side % 2 == 0 ? std::min(bounds[side], other) : std::max(bounds[side], other);
    }
  }
  return bounds;
}

/** Bounds, area and volume by VTK, in units of \a unit mm. Its volume is positive whatever the triangles' direction. */
void
ExpectSameMeasures(vtkPolyData & polyData,
                   const std::vector<SceneSurface> & scene,
                   double unit,
                   const std::array<double, 6> & bounds)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(&polyData);
  vtkNew<vtkMassProperties> measures;
  measures->SetInputConnection(triangles->GetOutputPort());
  measures->Update();
  const double area = SumOver(scene, itk::ComputeTriangleSurfaceArea),
               volume = SumOver(scene, itk::ComputeTriangleSurfaceVolume);
  EXPECT_NEAR(measures->GetSurfaceArea() * unit * unit, area, 1e-5 * area);
  EXPECT_NEAR(measures->GetVolume() * unit * unit * unit, volume, 1e-4 * volume);
  for (int side = 0; side < 6; ++side)
  {
    EXPECT_NEAR(polyData.GetBounds()[side] * unit, bounds[side], unit == 1 ? 0 : 1e-4) << side;
  }
}

TEST_F(SurfaceReadersOfOthers, VTKMeasuresTheSame)
{
  const auto check = [this](const std::string & extension, auto read) {
    SCOPED_TRACE(extension);
    const auto scene = this->Write(extension);
    ExpectSameMeasures(*read(this->PathOf(extension)), scene, 1, BoundsOf(scene));
  };
  check(".stl", ReadWith<vtkSTLReader>);
  check(".ply", ReadWith<vtkPLYReader>);
  check(".obj", ReadWith<vtkOBJReader>);
  check(".vtp", ReadWith<vtkXMLPolyDataReader>);
}

TEST_F(SurfaceReadersOfOthers, VTKMeasuresGLTFInMetresWithYUp)
{
  for (const auto space : { SurfaceFileSpace::LPS, SurfaceFileSpace::RAS })
  {
    const auto scene = this->Write(".glb", space);
    const auto [left, right, front, back, feet, head] = BoundsOf(scene);
    ExpectSameMeasures(*ReadGLTF(this->PathOf(".glb")), scene, 1000, { left, right, feet, head, -back, -front });
  }
}

TEST_F(SurfaceReadersOfOthers, VTKFindsNormalsColoursAndFields)
{
  const auto scene = this->Write(".ply");
  this->Write(".vtp");
  for (const auto & polyData :
       { ReadWith<vtkPLYReader>(this->PathOf(".ply")), ReadWith<vtkXMLPolyDataReader>(this->PathOf(".vtp")) })
  {
    auto * const normals = polyData->GetPointData()->GetNormals();
    ASSERT_NE(normals, nullptr);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(static_cast<float>(normals->GetComponent(100, axis)), scene[0].surface->GetNormals()[100][axis]);
    }
  }
  const auto ply = ReadWith<vtkPLYReader>(this->PathOf(".ply"));
  auto * const pointColours = ply->GetPointData()->GetArray("RGBA");
  ASSERT_NE(pointColours, nullptr);
  EXPECT_EQ(pointColours->GetComponent(0, 0), 220);

  const auto polyData = ReadWith<vtkXMLPolyDataReader>(this->PathOf(".vtp"));
  auto * const colours = polyData->GetCellData()->GetScalars();
  ASSERT_NE(colours, nullptr);
  EXPECT_EQ(colours->GetComponent(colours->GetNumberOfTuples() - 1, 2), 206);
  EXPECT_EQ(colours->GetComponent(colours->GetNumberOfTuples() - 1, 3), 77) << "opacity 0.3";
  const auto stringAt = [&](const char * name, vtkIdType number) {
    auto * const strings = vtkStringArray::SafeDownCast(polyData->GetFieldData()->GetAbstractArray(name));
    return strings == nullptr ? std::string() : std::string(strings->GetValue(number));
  };
  EXPECT_EQ(stringAt("SPACE", 0), "LPS");
  EXPECT_EQ(stringAt("UNIT", 0), "mm");
  EXPECT_EQ(stringAt("SurfaceNames", 0), "left kidney");
  EXPECT_EQ(stringAt("SurfaceNames", 1), scene[1].name);
  auto * const opacities = polyData->GetFieldData()->GetArray("SurfaceOpacities");
  ASSERT_NE(opacities, nullptr);
  EXPECT_EQ(opacities->GetComponent(1, 0), 0.3);
}

/** Two spheres whose points have numbers and colours: dark ones, which linear colours of 8 bits would lose. */
std::vector<SceneSurface>
MakeNumberedScene()
{
  std::vector<SceneSurface> scene = MakeScene();
  scene.resize(2);
  for (SceneSurface & surface : scene)
  {
    surface.label = 3; // surfaces of labels share no walls here
    rhombic::PointValues values{ "thickness, mm", {} };
    std::vector<std::array<std::uint8_t, 3>> colours;
    for (std::size_t n = 0; n < surface.surface->GetNumberOfPoints(); ++n)
    {
      values.values.push_back(0.25f * static_cast<float>(n));
      colours.push_back({ static_cast<std::uint8_t>(n % 256), 7, static_cast<std::uint8_t>(255 - n % 256) });
    }
    values.values.front() = std::numeric_limits<float>::quiet_NaN();
    surface.pointValues = std::make_shared<rhombic::PointValues>(values);
    surface.pointColours = std::make_shared<rhombic::PointColours>(colours.begin(), colours.end());
  }
  return scene;
}

TEST_F(SurfaceReadersOfOthers, VTKFindsColoursAndNumbersOfPoints)
{
  const auto scene = MakeNumberedScene();
  const std::size_t first = scene[0].surface->GetNumberOfPoints();
  for (const char * const extension : { ".ply", ".vtp", ".glb" })
  {
    WriteSurfaces(scene, this->PathOf(extension));
  }
  const auto ply = ReadWith<vtkPLYReader>(this->PathOf(".ply"));
  auto * const bytes = ply->GetPointData()->GetArray("RGBA");
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(bytes->GetComponent(20, 0), 20);
  EXPECT_EQ(bytes->GetComponent(static_cast<vtkIdType>(first) + 9, 2), 246);
  EXPECT_EQ(bytes->GetComponent(static_cast<vtkIdType>(first) + 9, 3), 77) << "opacity 0.3";

  const auto vtp = ReadWith<vtkXMLPolyDataReader>(this->PathOf(".vtp"));
  auto * const numbers = vtp->GetPointData()->GetArray("thickness__mm");
  ASSERT_NE(numbers, nullptr);
  EXPECT_TRUE(std::isnan(numbers->GetComponent(0, 0)));
  EXPECT_EQ(numbers->GetComponent(5, 0), 1.25);
  EXPECT_EQ(numbers->GetComponent(static_cast<vtkIdType>(first) + 5, 0), 1.25);

  const auto glb = ReadGLTF(this->PathOf(".glb"));
  auto * const linear = glb->GetPointData()->GetArray("COLOR_0");
  ASSERT_NE(linear, nullptr);
  for (const vtkIdType point : { 1, 10, 40, 100 })
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const double value = linear->GetComponent(point, channel) / (linear->GetDataType() == VTK_FLOAT ? 1.0 : 65535.0);
      EXPECT_NEAR(
        value, rhombic::SRGBToLinear((*scene[0].pointColours)[static_cast<std::size_t>(point)][channel] / 255.0), 1e-5)
        << point;
    }
  }
  EXPECT_EQ(rhombic::ReadSurfaces(this->PathOf(".vtp")).size(), 2u);
  EXPECT_EQ(rhombic::ReadSurfaces(this->PathOf(".glb")).size(), 2u);
  EXPECT_EQ(rhombic::ReadSurfaces(this->PathOf(".ply")).size(), 2u);
}

TEST_F(SurfaceReadersOfOthers, FormatsWithoutColoursOfPointsAreNamed)
{
  for (const char * const extension : { ".stl", ".obj", ".3mf" })
  {
    EXPECT_THROW(rhombic::CheckPointColours(this->PathOf(extension)), rhombic::Failure) << extension;
  }
  for (const char * const extension : { ".ply", ".vtp", ".glb" })
  {
    EXPECT_NO_THROW(rhombic::CheckPointColours(this->PathOf(extension))) << extension;
  }
}

TEST_F(SurfaceReadersOfOthers, ITKReadsOBJ)
{
  using Mesh = itk::Mesh<float, 3>;
  const auto scene = this->Write(".obj");
  const auto reader = itk::MeshFileReader<Mesh>::New();
  reader->SetMeshIO(itk::OBJMeshIO::New());
  reader->SetFileName(this->PathOf(".obj").string());
  reader->Update();
  const Mesh & mesh = *reader->GetOutput();
  ASSERT_EQ(mesh.GetNumberOfPoints(), scene[0].surface->GetNumberOfPoints() + scene[1].surface->GetNumberOfPoints());
  EXPECT_EQ(mesh.GetNumberOfCells(),
            scene[0].surface->GetNumberOfTriangles() + scene[1].surface->GetNumberOfTriangles());
  for (itk::SizeValueType n = 0; n < scene[0].surface->GetNumberOfPoints(); ++n)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(mesh.GetPoint(n)[axis], scene[0].surface->GetPoints()[n][axis]);
    }
  }
}

/** The output of a command and its exit code as of std::system(). */
std::pair<std::string, int>
RunCommand(const std::string & command, const fs::path & folder)
{
  const fs::path output = folder / "output.txt";
  const int status = std::system((command + " >'" + output.string() + "' 2>&1").c_str());
  return { ReadBytes(output), status };
}

/** F3D is a viewer for files of many kinds (M. Westphal and others); --no-render needs no display. */
TEST_F(SurfaceReadersOfOthers, F3DLoadsAllFormatsButThreeMF)
{
  if (RunCommand("command -v f3d", m_Folder).second != 0)
  {
    GTEST_SKIP() << "f3d is not installed";
  }
  for (const std::string extension : { ".stl", ".ply", ".obj", ".vtp", ".glb" })
  {
    const auto scene = this->Write(extension);
    const auto [output, status] =
      RunCommand("f3d --dry-run --no-render --verbose '" + this->PathOf(extension).string() + "'", m_Folder);
    EXPECT_EQ(status, 0) << extension << output;
    if (extension == ".glb")
    {
      EXPECT_NE(output.find("Number of polygons: 512\n"), std::string::npos) << output;
      EXPECT_NE(output.find("Number of polygons: 128\n"), std::string::npos) << output;
      EXPECT_NE(output.find(scene[1].name), std::string::npos) << output;
    }
    else if (extension == ".obj") // of which it tells the materials only
    {
      EXPECT_NE(output.find("diffuse color (0, 0.592157, 0.807843)"), std::string::npos) << output;
      EXPECT_NE(output.find("opacity 0.3\n"), std::string::npos) << output;
    }
    else
    {
      const std::string polygons = extension == ".stl" ? "512" : "640";
      EXPECT_NE(output.find("Number of polygons: " + polygons + "\n"), std::string::npos) << extension << output;
    }
  }
}

/** Khronos' glTF-Validator, where validate-gltf.sh says it is. */
TEST_F(SurfaceReadersOfOthers, GLTFValidatorFindsNothing)
{
  const char * const validator = std::getenv("RHOMBIC_GLTF_VALIDATOR");
  if (validator == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_GLTF_VALIDATOR is not set: tests/surfaces/SurfaceIO/validate-gltf.sh sets it";
  }
  const auto validate = [&](const std::vector<SceneSurface> & scene, SurfaceFileSpace space) {
    const fs::path path = m_Folder / "scene.glb";
    WriteSurfaces(scene, path, { space });
    const std::string script = std::string(RHOMBIC_SOURCE) + "/tests/surfaces/SurfaceIO/validate-gltf.js";
    const auto [output, status] =
      RunCommand("node '" + script + "' '" + validator + "' '" + path.string() + "'", m_Folder);
    EXPECT_EQ(status, 0);
    EXPECT_NE(output.find("\"numErrors\":0,\"numWarnings\":0,\"numInfos\":0,\"numHints\":0"), std::string::npos)
      << output;
  };
  validate(MakeScene(), SurfaceFileSpace::LPS);
  validate(MakeScene(), SurfaceFileSpace::RAS);
  validate(MakeNumberedScene(), SurfaceFileSpace::LPS);
  const auto bare = MakeSphere(0);
  bare->GetNormals().clear();
  validate({ { "bare", bare } }, SurfaceFileSpace::LPS);
}

} // namespace
