#include "rhombicSurfaceIO.h"

#include "rhombicFailure.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "rhombicGermanNumbers.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <locale>
#include <map>

#include <sys/resource.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::WriteSurface;
using Surface = itk::TriangleSurface;

/** A closed sphere around (10, -20, 30) mm by subdividing an octahedron, with 4^\a levels * 8 triangles, facing
 * outwards. */
Surface::Pointer
MakeSphere(int levels, float radius = 15.0f)
{
  auto surface = Surface::New();
  auto & points = surface->GetPoints();
  points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  Surface::TrianglesContainer triangles{ { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                         { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew)
      {
        Surface::PointType sum{ points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2] };
        const float length = std::hypot(sum[0], sum[1], sum[2]);
        points.push_back({ sum[0] / length, sum[1] / length, sum[2] / length });
      }
      return place->second;
    };
    Surface::TrianglesContainer finer;
    for (const auto & [a, b, c] : triangles)
    {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles.swap(finer);
  }
  surface->GetTriangles() = triangles;
  surface->GetNormals() = points;
  for (auto & point : points)
  {
    point = { 10 + radius * point[0], -20 + radius * point[1], 30 + radius * point[2] };
  }
  return surface;
}

template <typename TReader>
vtkSmartPointer<vtkPolyData>
ReadWith(const fs::path & path)
{
  vtkNew<TReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

Surface::Pointer
FromPolyData(vtkPolyData & polyData)
{
  auto surface = Surface::New();
  for (vtkIdType i = 0; i < polyData.GetNumberOfPoints(); ++i)
  {
    const double * const point = polyData.GetPoint(i);
    surface->GetPoints().push_back(
      { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
  }
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < polyData.GetNumberOfPolys(); ++i)
  {
    polyData.GetPolys()->GetCellAtId(i, cell);
    EXPECT_EQ(cell->GetNumberOfIds(), 3);
    surface->GetTriangles().push_back({ static_cast<std::uint32_t>(cell->GetId(0)),
                                        static_cast<std::uint32_t>(cell->GetId(1)),
                                        static_cast<std::uint32_t>(cell->GetId(2)) });
  }
  return surface;
}

std::string
ReadBytes(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/** The kind of the failure of an action, or of none a success: fails the test then. */
template <typename TAction>
rhombic::FailureKind
KindOf(TAction action, const std::string & named)
{
  try
  {
    action();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find(named), std::string::npos) << failure.GetDescription();
    return failure.GetKind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return rhombic::FailureKind::Internal;
}

class SurfaceIO : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  std::size_t
  CountFiles() const
  {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_Folder), fs::directory_iterator()));
  }

  const fs::path m_Folder = m_TemporaryFolder.Path();
};

void
ExpectSameSurface(const Surface & read, const Surface & written)
{
  EXPECT_EQ(read.GetNumberOfTriangles(), written.GetNumberOfTriangles());
  EXPECT_EQ(read.GetNumberOfPoints(), written.GetNumberOfPoints());
  EXPECT_EQ(read.GetBounds(), written.GetBounds());
  EXPECT_NEAR(ComputeVolume(read), ComputeVolume(written), 1e-6 * ComputeVolume(written));
  const auto topology = ComputeTopology(read);
  EXPECT_TRUE(topology.IsWatertight()) << topology;
}

TEST_F(SurfaceIO, STLWeldedByItsReaderIsTheClosedSurfaceAgain)
{
  const auto sphere = MakeSphere(4);
  WriteSurface(*sphere, m_Folder / "sphere.STL");
  ExpectSameSurface(*FromPolyData(*ReadWith<vtkSTLReader>(m_Folder / "sphere.STL")), *sphere);
  EXPECT_NE(ReadBytes(m_Folder / "sphere.STL").substr(0, 80).find("SPACE=LPS"), std::string::npos);
}

TEST_F(SurfaceIO, PLYKeepsPointsTrianglesAndNormals)
{
  const auto sphere = MakeSphere(3);
  WriteSurface(*sphere, m_Folder / "sphere.ply");
  const auto polyData = ReadWith<vtkPLYReader>(m_Folder / "sphere.ply");
  const auto read = FromPolyData(*polyData);
  ExpectSameSurface(*read, *sphere);
  EXPECT_EQ(read->GetPoints(), sphere->GetPoints());
  EXPECT_EQ(read->GetTriangles(), sphere->GetTriangles());
  auto * const normals = polyData->GetPointData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  EXPECT_FLOAT_EQ(static_cast<float>(normals->GetComponent(100, 1)), sphere->GetNormals()[100][1]);
  EXPECT_NE(ReadBytes(m_Folder / "sphere.ply").find("comment SPACE=LPS\n"), std::string::npos);
}

TEST_F(SurfaceIO, VTPKeepsPointsTrianglesNormalsAndSpace)
{
  const auto sphere = MakeSphere(3);
  WriteSurface(*sphere, m_Folder / "sphere.vtp");
  const auto polyData = ReadWith<vtkXMLPolyDataReader>(m_Folder / "sphere.vtp");
  const auto read = FromPolyData(*polyData);
  ExpectSameSurface(*read, *sphere);
  EXPECT_EQ(read->GetTriangles(), sphere->GetTriangles());
  ASSERT_NE(polyData->GetPointData()->GetNormals(), nullptr);
  auto * const space = vtkStringArray::SafeDownCast(polyData->GetFieldData()->GetAbstractArray("SPACE"));
  ASSERT_NE(space, nullptr);
  EXPECT_EQ(space->GetValue(0), "LPS");
}

TEST_F(SurfaceIO, SurfaceWithoutNormals)
{
  const auto sphere = MakeSphere(2);
  sphere->GetNormals().clear();
  WriteSurface(*sphere, m_Folder / "sphere.ply");
  WriteSurface(*sphere, m_Folder / "sphere.vtp");
  ExpectSameSurface(*FromPolyData(*ReadWith<vtkPLYReader>(m_Folder / "sphere.ply")), *sphere);
  ExpectSameSurface(*FromPolyData(*ReadWith<vtkXMLPolyDataReader>(m_Folder / "sphere.vtp")), *sphere);
}

TEST_F(SurfaceIO, SameBytesAgainAndInAnotherLocale)
{
  const auto sphere = MakeSphere(4);
  for (const std::string extension : { ".stl", ".ply", ".vtp" })
  {
    WriteSurface(*sphere, m_Folder / ("first" + extension));
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new rhombictest::GermanNumbers));
    EXPECT_NO_THROW(WriteSurface(*sphere, m_Folder / ("second" + extension))) << extension;
    std::locale::global(before);
    EXPECT_EQ(ReadBytes(m_Folder / ("first" + extension)), ReadBytes(m_Folder / ("second" + extension))) << extension;
  }
}

TEST_F(SurfaceIO, RefusesWhatMakesNoSense)
{
  const auto sphere = MakeSphere(1);
  EXPECT_EQ(KindOf([&] { WriteSurface(*sphere, m_Folder / "sphere.xyz"); }, "sphere.xyz"), rhombic::FailureKind::Usage);
  EXPECT_EQ(KindOf([&] { WriteSurface(*sphere, m_Folder / "sphere"); }, rhombic::GetSurfaceFileExtensions()),
            rhombic::FailureKind::Usage);
  EXPECT_EQ(KindOf([&] { WriteSurface(*sphere, m_Folder / "no-such-folder/sphere.ply"); }, "no-such-folder"),
            rhombic::FailureKind::Output);
  EXPECT_EQ(KindOf([&] { WriteSurface(*Surface::New(), m_Folder / "sphere.stl"); }, "sphere.stl"),
            rhombic::FailureKind::Empty);
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(SurfaceIO, ReplacesAFileThatExists)
{
  for (const std::string extension : { ".stl", ".ply", ".vtp" })
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    std::ofstream(path) << "older";
    WriteSurface(*MakeSphere(1), path);
    EXPECT_GT(fs::file_size(path), 100u);
  }
  EXPECT_EQ(CountFiles(), 3u);
}

/** Lets no file of this process grow beyond some bytes, as a full disk would. */
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &m_Before);
    const rlimit limit{ bytes, m_Before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limit);
  }

  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &m_Before);
    std::signal(SIGXFSZ, SIG_DFL);
  }

private:
  rlimit m_Before{};
};

TEST_F(SurfaceIO, FullDiskLeavesTheOldFileAndNothingElse)
{
  const auto sphere = MakeSphere(5);
  for (const std::string extension : { ".stl", ".ply", ".vtp" })
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    std::ofstream(path) << "older";
    testing::internal::CaptureStderr();
    {
      const FileSizeLimit limit(20000);
      EXPECT_EQ(KindOf([&] { WriteSurface(*sphere, path); }, extension), rhombic::FailureKind::Output);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << extension;
    EXPECT_EQ(ReadBytes(path), "older") << extension;
  }
  EXPECT_EQ(CountFiles(), 3u);
}

} // namespace
