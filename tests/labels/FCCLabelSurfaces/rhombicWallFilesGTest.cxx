#include "rhombicSurfaceIO.h"
#include "rhombicTemporaryFolder.h"
#include "rhombicWallAudit.h"

#include "itkExampleLabelWalls.h"

namespace
{

using rhombic::SceneSurface;

std::vector<SceneSurface>
SurfacesOf(const itk::LabelWalls & walls)
{
  std::vector<SceneSurface> surfaces;
  for (const std::uint16_t label : walls.FindLabels())
  {
    SceneSurface & scene = surfaces.emplace_back();
    scene.name = "region " + std::to_string(label);
    scene.surface = walls.ExtractLabel(label);
    scene.colour = { label / 255.0, 0.2, 0.4 };
    scene.label = label;
  }
  return surfaces;
}

/** Writes the walls of labels, reads them back, and checks what the file holds. */
void
ExpectSoundFile(const itk::FCCLabelSurfaceFilter::InputImageType * labels, const std::filesystem::path & path)
{
  const auto walls = itk::example::MakeWalls(labels);
  const auto written = SurfacesOf(*walls);
  rhombic::WriteSurfaces(written, path);
  const auto read = rhombic::ReadSurfaces(path);
  ASSERT_EQ(read.size(), written.size());
  std::size_t triangles = 0;
  for (std::size_t n = 0; n < read.size(); ++n)
  {
    EXPECT_EQ(read[n].name, written[n].name);
    EXPECT_NEAR(read[n].colour[0], written[n].colour[0], 1e-6);
    const auto audit = itk::AuditTriangleSurface(*read[n].surface);
    ASSERT_TRUE(audit.IsWatertight()) << audit;
    ASSERT_EQ(audit.topology.repeatedPositions, 0u);
    ASSERT_NEAR(audit.volume, itk::ComputeTriangleSurfaceVolume(*written[n].surface), 1e-6 * audit.volume);
    triangles += audit.triangles;
  }
  const rhombic::WallAudit audit = rhombic::AuditWalls(read);
  ASSERT_TRUE(audit.IsSound()) << audit.oneSidedTriangles << ' ' << audit.repeatedTriangles << ' '
                               << audit.loneJunctions << ' ' << audit.intersections.crossingPairs;
  ASSERT_EQ(triangles - audit.sharedTriangles, walls->GetNumberOfTriangles());
}

void
ExpectSoundFiles(unsigned int first, unsigned int count, const char * extension)
{
  const rhombictest::TemporaryFolder folder;
  for (unsigned int seed = first; seed < first + count; ++seed)
  {
    using namespace itk::example;
    const int labels = 2 + static_cast<int>(seed % 49);
    const auto path = folder.Path() / (std::string("walls") + extension);
    ExpectSoundFile(MakeNoise(Region(static_cast<int>(seed % 5) - 2, 4 + seed % 6, 7, 5 + seed % 4), seed, labels),
                    path);
    ExpectSoundFile(MakeBlobs(Region(static_cast<int>(seed % 7) - 3, 9, 14 + seed % 6, 15), seed, labels), path);
    if (testing::Test::HasFatalFailure())
    {
      FAIL() << "seed " << seed;
    }
  }
}

TEST(WallFiles, AreSound)
{
  for (const char * const extension : { ".vtp", ".ply", ".obj", ".glb" })
  {
    ExpectSoundFiles(0, 5, extension);
  }
}

/** Takes minutes: the label long. */
TEST(WallFiles, AThousandVolumesAreSound)
{
  ExpectSoundFiles(0, 500, ".vtp");
}

TEST(WallFiles, FlawsBetweenSurfacesAreFound)
{
  using namespace itk::example;
  const auto walls = MakeWalls(MakeBlobs(Region(0, 8, 12, 12), 3, 6));
  auto surfaces = SurfacesOf(*walls);
  EXPECT_TRUE(rhombic::AuditWalls(surfaces).IsSound());
  surfaces.push_back(surfaces.front());
  EXPECT_GT(rhombic::AuditWalls(surfaces).repeatedTriangles, 0u);
  const auto moved = itk::TriangleSurface::New();
  moved->Graft(surfaces.front().surface);
  for (auto & point : moved->GetPoints())
  {
    point[0] += 0.3f;
  }
  surfaces.back().surface = moved;
  EXPECT_GT(rhombic::AuditWalls(surfaces).intersections.crossingPairs, 0u);
}

} // namespace
