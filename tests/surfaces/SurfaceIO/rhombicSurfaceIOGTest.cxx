#include "rhombicSurfaceTest.h"

#include "rhombicGermanNumbers.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <clocale>
#include <limits>
#include <locale>

namespace
{

using rhombic::WriteSurfaces;

class SurfaceIO : public SurfaceTest
{};

std::array<long, 4>
Bytes(const SceneSurface & scene)
{
  const auto byte = [](double value) { return std::lround(255 * value); };
  return { byte(scene.colour[0]), byte(scene.colour[1]), byte(scene.colour[2]), byte(scene.opacity) };
}

/** Expects the same positions and normals, bit by bit, at the corners of all triangles. */
void
ExpectSameCorners(const Surface & read, const Surface & written, bool withNormals, const std::string & what)
{
  ASSERT_EQ(read.GetNumberOfTriangles(), written.GetNumberOfTriangles()) << what;
  EXPECT_EQ(read.HasNormals(), withNormals) << what;
  std::size_t differences = 0;
  for (std::size_t n = 0; n < read.GetNumberOfTriangles(); ++n)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto a = read.GetTriangles()[n][corner], b = written.GetTriangles()[n][corner];
      differences += read.GetPoints()[a] != written.GetPoints()[b];
      differences += withNormals && read.GetNormals()[a] != written.GetNormals()[b];
    }
  }
  EXPECT_EQ(differences, 0u) << what;
}

TEST_F(SurfaceIO, ScenesComeBackAsTheyWere)
{
  const auto scene = MakeScene();
  for (const std::string extension : SceneExtensions)
  {
    for (const auto space : { SurfaceFileSpace::LPS, SurfaceFileSpace::RAS })
    {
      const fs::path path = m_Folder / ("scene" + extension);
      WriteSurfaces(scene, path, { space });
      const auto read = ReadSurfaces(path);
      ASSERT_EQ(read.size(), scene.size()) << extension;
      for (std::size_t n = 0; n < scene.size(); ++n)
      {
        EXPECT_EQ(read[n].name, scene[n].name) << extension;
        EXPECT_EQ(Bytes(read[n]), Bytes(scene[n])) << extension;
        EXPECT_NEAR(read[n].opacity, scene[n].opacity, extension == ".3mf" ? 0.5 / 255 : 0) << extension;
        EXPECT_EQ(read[n].surface->GetPoints(), scene[n].surface->GetPoints()) << extension;
        if (rhombic::StoresNormals(path))
        {
          EXPECT_EQ(read[n].surface->GetNormals(), scene[n].surface->GetNormals()) << extension;
        }
        EXPECT_EQ(read[n].surface->GetTriangles(), scene[n].surface->GetTriangles()) << extension;
      }
    }
  }
}

TEST_F(SurfaceIO, AnyFloatsComeBackAsTheyWere)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    auto surface = MakeRandomSurface(seed);
    surface->GetPoints()[0] = { std::numeric_limits<float>::denorm_min(), -std::numeric_limits<float>::max(), 0 };
    for (const std::string extension : Extensions)
    {
      const fs::path path = m_Folder / ("any" + extension);
      const auto space = seed % 2 == 0 ? SurfaceFileSpace::LPS : SurfaceFileSpace::RAS;
      if (extension == ".3mf")
      {
        RemoveDegenerate(*surface);
      }
      WriteSurfaces({ { "any", surface } }, path, { space });
      const auto read = ReadSurfaces(path);
      ASSERT_EQ(read.size(), 1u);
      EXPECT_EQ(read[0].name, "any");
      ExpectSameCorners(*read[0].surface, *surface, rhombic::StoresNormals(path), extension);
    }
  }
}

TEST_F(SurfaceIO, StoredSurfacesAreThoseThatAreRead)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
  {
    const auto surface = MakeRandomSurface(seed);
    surface->GetPoints()[7] = surface->GetPoints()[3];
    surface->GetPoints()[5] = { 0, 1, 2 };
    surface->GetPoints()[6] = { -0.0f, 1, 2 };
    for (const std::string extension : Extensions)
    {
      const fs::path path = m_Folder / ("stored" + extension);
      if (extension == ".3mf")
      {
        RemoveDegenerate(*surface);
      }
      const auto stored = rhombic::SurfaceAsStored(*surface, path);
      WriteSurfaces({ { "stored", surface } }, path);
      const auto read = ReadSurfaces(path).at(0).surface;
      EXPECT_EQ(read->GetPoints(), stored->GetPoints()) << extension;
      EXPECT_EQ(read->GetTriangles(), stored->GetTriangles()) << extension;
      EXPECT_EQ(stored->GetNumberOfPoints(), surface->GetNumberOfPoints() - (extension == ".stl" ? 2 : 0));
    }
  }
}

TEST_F(SurfaceIO, SurfacesWithoutNormals)
{
  auto scene = MakeScene();
  const auto bare = MakeSphere(2);
  bare->GetNormals().clear();
  scene[1].surface = bare;
  for (const std::string extension : SceneExtensions)
  {
    const fs::path path = m_Folder / ("scene" + extension);
    WriteSurfaces(scene, path);
    const auto read = ReadSurfaces(path);
    ASSERT_EQ(read.size(), 3u);
    const bool keepsNormals = extension == ".obj" || extension == ".glb";
    for (std::size_t n = 0; n < 3; ++n)
    {
      ExpectSameCorners(*read[n].surface, *scene[n].surface, keepsNormals && n != 1, extension);
    }
  }
}

TEST_F(SurfaceIO, STLIsWeldedByPosition)
{
  const auto sphere = MakeSphere(5);
  WriteSurfaces({ { "sphere", sphere } }, m_Folder / "sphere.STL");
  const auto read = ReadSurfaces(m_Folder / "sphere.STL");
  EXPECT_EQ(read[0].surface->GetNumberOfPoints(), sphere->GetNumberOfPoints());
  const auto topology = ComputeTriangleSurfaceTopology(*read[0].surface);
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.eulerCharacteristic, 2);
  EXPECT_EQ(read[0].surface->GetBounds(), sphere->GetBounds());
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*read[0].surface),
              ComputeTriangleSurfaceVolume(*sphere),
              1e-9 * ComputeTriangleSurfaceVolume(*sphere));
}

TEST_F(SurfaceIO, STLTakesZeroAndMinusZeroForOne)
{
  auto surface = Surface::New();
  surface->GetPoints() = { { 0.0f, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -0.0f, -0.0f, 0 }, { 0, 0, 1 } };
  surface->GetTriangles() = { { 0, 1, 2 }, { 3, 4, 1 } };
  WriteSurfaces({ { "zero", surface } }, m_Folder / "zero.stl");
  EXPECT_EQ(ReadSurfaces(m_Folder / "zero.stl")[0].surface->GetNumberOfPoints(), 4u);
}

TEST_F(SurfaceIO, FilesSayTheirSpaceAndUnit)
{
  for (const auto space : { SurfaceFileSpace::LPS, SurfaceFileSpace::RAS })
  {
    const std::string name = space == SurfaceFileSpace::LPS ? "LPS" : "RAS";
    const auto bytesOf = [&](const std::string & extension) {
      const fs::path path = m_Folder / ("sphere" + extension);
      WriteSurfaces({ { "sphere", MakeSphere(1) } }, path, { space });
      return ReadBytes(path);
    };
    const auto holds = [](const std::string & bytes, const std::string & part) {
      return bytes.find(part) != std::string::npos;
    };
    EXPECT_TRUE(holds(bytesOf(".stl").substr(0, 80), "SPACE=" + name + " UNIT=mm"));
    EXPECT_TRUE(holds(bytesOf(".ply"), "\ncomment SPACE=" + name + "\ncomment UNIT=mm\n"));
    EXPECT_TRUE(holds(bytesOf(".obj"), "\n# SPACE=" + name + "\n# UNIT=mm\n"));
    EXPECT_TRUE(holds(bytesOf(".vtp"), name + std::string(1, '\0')));
    EXPECT_TRUE(holds(bytesOf(".glb"), "\"extras\":{\"SPACE\":\"" + name + "\",\"unit\":\"mm\",\"scale\":0.001}"));
  }
}

TEST_F(SurfaceIO, RASIsHalfATurnAboutTheLongAxis)
{
  auto surface = Surface::New();
  surface->GetPoints() = { { 1, 2, 3 }, { 5, 2, 3 }, { 1, 7, 4 } };
  surface->GetTriangles() = { { 0, 1, 2 } };
  WriteSurfaces({ { "one", surface } }, m_Folder / "one.obj", { SurfaceFileSpace::RAS });
  EXPECT_NE(ReadBytes(m_Folder / "one.obj").find("\nv -1 -2 3\nv -5 -2 3\nv -1 -7 4\nf 1 2 3\n"), std::string::npos);
}

TEST_F(SurfaceIO, SameBytesAgainAndInAnotherLocale)
{
  const auto scene = MakeScene();
  for (const std::string extension : Extensions)
  {
    const std::vector<SceneSurface> surfaces(scene.begin(), extension == ".stl" ? scene.begin() + 1 : scene.end());
    WriteSurfaces(surfaces, m_Folder / ("first" + extension));
    fs::create_directory(m_Folder / "second");
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new rhombictest::GermanNumbers));
    const std::string beforeC = std::setlocale(LC_ALL, nullptr);
    std::setlocale(LC_ALL, "de_DE.UTF-8"); // where it is installed
    EXPECT_NO_THROW(WriteSurfaces(surfaces, m_Folder / "second" / ("first" + extension))) << extension;
    const auto read = ReadSurfaces(m_Folder / ("first" + extension));
    std::setlocale(LC_ALL, beforeC.c_str());
    std::locale::global(before);
    EXPECT_EQ(ReadBytes(m_Folder / ("first" + extension)), ReadBytes(m_Folder / "second" / ("first" + extension)));
    EXPECT_EQ(read[0].surface->GetPoints().size(), scene[0].surface->GetPoints().size()) << extension;
    const double opacity = extension == ".stl" ? 1.0 : 0.75;
    EXPECT_NEAR(read.back().opacity, opacity, extension == ".3mf" ? 0.5 / 255 : 0) << extension;
  }
  EXPECT_EQ(ReadBytes(m_Folder / "first.mtl"), ReadBytes(m_Folder / "second" / "first.mtl"));
}

TEST_F(SurfaceIO, RefusesWhatMakesNoSense)
{
  const SceneSurface sphere{ "sphere", MakeSphere(1) };
  using Kind = rhombic::FailureKind;
  EXPECT_EQ(KindOf([&] { WriteSurfaces({ sphere }, m_Folder / "sphere.xyz"); }, "sphere.xyz"), Kind::Usage);
  EXPECT_EQ(KindOf([&] { WriteSurfaces({ sphere }, m_Folder / "sphere"); }, ".stl, .ply, .obj, .vtp, .glb, .3mf"),
            Kind::Usage);
  EXPECT_EQ(KindOf(
              [&] {
                WriteSurfaces({ sphere, sphere }, m_Folder / "two.stl");
              },
              ".ply, .obj, .vtp, .glb, .3mf"),
            Kind::Usage);
  EXPECT_EQ(KindOf([&] { rhombic::CheckSurfacePath("two.stl", 2); }, "two.stl"), Kind::Usage);
  EXPECT_NO_THROW(rhombic::CheckSurfacePath("two.glb", 2));
  EXPECT_EQ(KindOf([&] { WriteSurfaces({}, m_Folder / "none.ply"); }, "none.ply"), Kind::Empty);
  EXPECT_EQ(KindOf(
              [&] {
                WriteSurfaces({ sphere, { "void", Surface::New() } }, m_Folder / "a.ply");
              },
              "void"),
            Kind::Empty);
  for (const float wrong : { std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN() })
  {
    const auto broken = MakeSphere(1);
    broken->GetPoints()[3][1] = wrong;
    EXPECT_EQ(KindOf(
                [&] {
                  WriteSurfaces({ { "broken", broken } }, m_Folder / "broken.glb");
                },
                "broken"),
              Kind::Output);
  }
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(SurfaceIO, NamesThatFilesCannotHoldAreMended)
{
  for (const std::string extension : SceneExtensions)
  {
    const auto nameOf = [&](const std::string & name) {
      WriteSurfaces({ { name, MakeSphere(0) } }, m_Folder / ("name" + extension));
      return ReadSurfaces(m_Folder / ("name" + extension))[0].name;
    };
    EXPECT_EQ(nameOf("two\nlines"), "two lines") << extension;
    EXPECT_EQ(nameOf("no UTF-8 \xff!"), "no UTF-8 \xef\xbf\xbd!") << extension;
    EXPECT_EQ(nameOf("comment end_header"), "comment end_header") << extension;
  }
}

TEST_F(SurfaceIO, ReplacesAFileThatExists)
{
  for (const std::string extension : Extensions)
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    WriteBytes(path, "older");
    WriteSurfaces({ { "sphere", MakeSphere(1) } }, path);
    EXPECT_EQ(ReadSurfaces(path)[0].surface->GetNumberOfTriangles(), 32u);
  }
  EXPECT_EQ(CountFiles(), 7u) << "with the materials of OBJ";
}

TEST_F(SurfaceIO, GLBStandsUprightInMetres)
{
  auto surface = Surface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 250, 0, 0 }, { 0, 0, 1700 } }; // to the left, to the head
  surface->GetTriangles() = { { 0, 1, 2 } };
  WriteSurfaces({ { "one", surface } }, m_Folder / "one.glb");
  const std::string bytes = ReadBytes(m_Folder / "one.glb");
  EXPECT_NE(bytes.find("\"matrix\":[0.001,0.0,0.0,0.0,0.0,0.0,-0.001,0.0,0.0,0.001,0.0,0.0,0.0,0.0,0.0,1.0]"),
            std::string::npos);
  EXPECT_NE(bytes.find("\"min\":[0.0,0.0,0.0],\"max\":[250.0,0.0,1700.0]"), std::string::npos);
}

} // namespace
