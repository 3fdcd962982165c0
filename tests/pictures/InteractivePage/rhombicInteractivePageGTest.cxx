#include "itkExampleSurfaces.h"
#include "rhombicFailure.h"
#include "rhombicFewerTriangles.h"
#include "rhombicInteractivePage.h"
#include "rhombicPageBytes.h"
#include "rhombicPageMesh.h"
#include "rhombicPageVolume.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace
{

using namespace rhombic;
using Surface = itk::TriangleSurface;

std::string
Inflate(const std::string & stream, std::size_t size)
{
  std::string bytes(size, '\0');
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(bytes.data()),
                       &length,
                       reinterpret_cast<const Bytef *>(stream.data()),
                       static_cast<uLong>(stream.size())),
            Z_OK);
  bytes.resize(length);
  return bytes;
}

struct Decoded
{
  std::vector<Vector3> points;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint16_t> numbers; ///< of values
};

/** What a browser makes of a mesh's bytes. */
Decoded
Decode(const PageMesh & mesh)
{
  const std::size_t room = 1000 + 20 * (mesh.points + mesh.triangles);
  const std::string points = Inflate(mesh.pointBytes, room);
  const std::string triangles = Inflate(mesh.triangleBytes, room);
  std::vector<std::array<std::uint16_t, 4>> positions(mesh.points);
  EXPECT_EQ(meshopt_decodeVertexBuffer(
              positions.data(), mesh.points, 8, reinterpret_cast<const unsigned char *>(points.data()), points.size()),
            0);
  Decoded decoded;
  decoded.corners.resize(3 * mesh.triangles);
  EXPECT_EQ(meshopt_decodeIndexBuffer(decoded.corners.data(),
                                      decoded.corners.size(),
                                      4,
                                      reinterpret_cast<const unsigned char *>(triangles.data()),
                                      triangles.size()),
            0);
  for (const auto & position : positions)
  {
    decoded.numbers.push_back(position[3]);
    decoded.points.push_back(
      Add(mesh.origin, Scaled({ double(position[0]), double(position[1]), double(position[2]) }, mesh.quantum)));
  }
  return decoded;
}

SceneSurface
Named(const std::string & name, const Surface::Pointer & surface)
{
  SceneSurface scene;
  scene.name = name;
  scene.surface = surface;
  return scene;
}

/** The corners of a triangle, the first of them the lowest, as they follow each other. */
std::array<Vector3, 3>
InOrder(std::array<Vector3, 3> corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/** A scan whose values are x + 2 y + 3 z of LPS, with axes that are turned by \a degrees about z. */
Scan
MakeRamp(double degrees)
{
  using Image = itk::Image<float, 3>;
  const auto image = Image::New();
  image->SetRegions(Image::SizeType{ { 20, 16, 12 } });
  const double spacing[] = { 2.0, 2.0, 3.0 };
  image->SetSpacing(spacing);
  const double angle = degrees * 3.14159265358979 / 180.0;
  Image::DirectionType direction;
  direction.SetIdentity();
  direction[0][0] = direction[1][1] = std::cos(angle);
  direction[1][0] = std::sin(angle);
  direction[0][1] = -std::sin(angle);
  image->SetDirection(direction);
  image->Allocate();
  for (Image::IndexValueType z = 0; z < 12; ++z)
  {
    for (Image::IndexValueType y = 0; y < 16; ++y)
    {
      for (Image::IndexValueType x = 0; x < 20; ++x)
      {
        itk::Point<double, 3> point;
        const Image::IndexType index{ { x, y, z } };
        image->TransformIndexToPhysicalPoint(index, point);
        image->SetPixel(index, static_cast<float>(point[0] + 2.0 * point[1] + 3.0 * point[2]));
      }
    }
  }
  Scan scan;
  scan.image = image;
  scan.modality = "MR";
  return scan;
}

PageContent
MakeContent(const Scan * scan)
{
  PageContent content;
  content.title = "a </title><script>alert(1)</script> title";
  content.surfaces.push_back({ Named("</script><b>\"'&", itk::example::MakeSphere(30.0, 3)), "", 12.5, 3.0, {} });
  content.surfaces.push_back({ Named("\xd7\x9b\xd7\x91\xd7\x93", itk::example::MakeSphere(10.0, 2)), "", {}, {}, {} });
  content.views.push_back({ Picture(40, 30), "anterior" });
  content.turntable.assign(3, "a JPEG file");
  if (scan != nullptr)
  {
    content.scan = *scan;
    content.box = BoxOf(*scan);
  }
  return content;
}

std::string
JsonOf(const std::string & html)
{
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto first = html.find(begin) + begin.size();
  return html.substr(first, html.find("</script>", first) - first);
}

} // namespace

TEST(InteractivePage, TrianglesAreThoseOfTheSurface)
{
  const auto sphere = itk::example::MakeSphere(50.0, 3, { 100.0, -200.0, 300.0 });
  const PageMesh mesh = MakePageMesh({ Named("sphere", sphere) });
  ASSERT_EQ(mesh.triangles, sphere->GetNumberOfTriangles());
  EXPECT_LT(mesh.quantum, 0.002);
  const Decoded decoded = Decode(mesh);
  std::vector<std::array<Vector3, 3>> expected;
  std::vector<std::array<Vector3, 3>> found;
  const auto snap = [&mesh](const Surface::PointType & point) {
    Vector3 snapped{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      snapped[axis] = mesh.origin[axis] + mesh.quantum * std::round((point[axis] - mesh.origin[axis]) / mesh.quantum);
      EXPECT_NEAR(snapped[axis], point[axis], 0.51 * mesh.quantum);
    }
    return snapped;
  };
  const auto & points = sphere->GetPoints();
  for (const auto & [a, b, c] : sphere->GetTriangles())
  {
    expected.push_back(InOrder({ snap(points[a]), snap(points[b]), snap(points[c]) }));
  }
  for (std::size_t n = 0; n < decoded.corners.size(); n += 3)
  {
    found.push_back(InOrder({ decoded.points[decoded.corners[n]],
                              decoded.points[decoded.corners[n + 1]],
                              decoded.points[decoded.corners[n + 2]] }));
  }
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

TEST(InteractivePage, SharedWallsAreHeldOnce)
{
  // Two tetrahedra on both sides of one triangle.
  const auto first = itk::example::MakeTetrahedron(10.0f);
  const auto second = Surface::New();
  second->GetPoints() = { { 10, 10, 10 }, { 10, 0, 0 }, { 0, 10, 0 }, { 0, 0, 10 } };
  second->GetTriangles() = { { 1, 3, 2 }, { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 } };
  const PageMesh mesh = MakePageMesh({ Named("a", first), Named("b", second) });
  EXPECT_EQ(mesh.triangles, 7u);
  EXPECT_EQ(mesh.points, 5u);
  std::size_t shared = 0;
  for (const PageSheet & sheet : mesh.sheets)
  {
    shared += sheet.back != 0 ? sheet.triangles : 0;
  }
  EXPECT_EQ(shared, 1u);
}

/** The heights of points of two balls that touch, after simplification; one point has no value. */
TEST(InteractivePage, NumbersAreThoseOfTheValuesBeforeSimplification)
{
  std::vector<SceneSurface> surfaces;
  for (const double x : { 0.0, 41.0 })
  {
    SceneSurface ball = Named("ball", itk::example::MakeSphere(20.0, 6, { x, 0.0, 0.0 }));
    PointValues values{ "height", {} };
    for (const auto & point : ball.surface->GetPoints())
    {
      values.values.push_back(x > 0.0 ? std::numeric_limits<float>::quiet_NaN() : point[2]);
    }
    ball.pointValues = std::make_shared<PointValues>(values);
    surfaces.push_back(ball);
  }
  const PageMesh mesh = MakePageMesh(InFewerTriangles(surfaces, 0.4), ColourScale{ "viridis", -10.0, 30.0, "" });
  EXPECT_LT(mesh.triangles, 5000u);
  const Decoded decoded = Decode(mesh);
  for (std::size_t n = 0; n < decoded.points.size(); ++n)
  {
    const auto & [x, y, z] = decoded.points[n];
    const double share = std::min(1.0, std::max(0.0, (z + 10.0) / 40.0));
    EXPECT_NEAR(decoded.numbers[n], x > 20.5 ? 0.0 : 1.0 + 254.0 * share, x > 20.5 ? 0.0 : 4.0) << x << ' ' << z;
  }
}

TEST(InteractivePage, SurfacesWithValuesHaveTheirOwnWalls)
{
  std::vector<SceneSurface> surfaces{ Named("a", itk::example::MakeTetrahedron(10.0f)),
                                      Named("b", itk::example::MakeTetrahedron(10.0f)) };
  for (SceneSurface & surface : surfaces)
  {
    surface.pointValues = std::make_shared<PointValues>(PointValues{ "", itk::BulkVector<float>(4, 1.0f) });
  }
  const PageMesh mesh = MakePageMesh(surfaces, ColourScale{ "viridis", 0.0, 2.0, "" });
  EXPECT_EQ(mesh.triangles, 8u);
  EXPECT_EQ(mesh.points, 8u);
  EXPECT_EQ(Decode(mesh).numbers, std::vector<std::uint16_t>(8, 128));
}

TEST(InteractivePage, TheBarIsThatOfTheScale)
{
  PageContent content = MakeContent(nullptr);
  content.scale = ColourScale{ "inferno", 0.0, 8.0, "SUV" };
  content.scale->marks = { -2.0, 4.0, 6.0, 9.0 };
  const auto colours = nlohmann::json::parse(JsonOf(MakeInteractivePage(content, {}).html))["colours"];
  EXPECT_EQ(colours["title"], "SUV");
  EXPECT_EQ(colours["numbers"], (std::vector<std::string>{ "0", "2", "4", "6", "8" }));
  EXPECT_EQ(colours["marks"], (std::vector<double>{ 0.5, 0.75 })) << "of the bar, from below; others are outside";
  EXPECT_EQ(colours["map"].get<std::string>().size(), 255u * 6u);
  EXPECT_EQ(colours["map"].get<std::string>().substr(0, 6), "000004");
  EXPECT_EQ(colours["map"].get<std::string>().substr(254 * 6), "fcffa4");
}

TEST(InteractivePage, SurfacesThatAreNoManifoldAreShown)
{
  const auto fan = Surface::New(); // three triangles at one edge, all of one surface
  fan->GetPoints() = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, -1, 0 } };
  fan->GetTriangles() = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 }, { 0, 0, 1 } };
  PageContent content = MakeContent(nullptr);
  content.surfaces.resize(1);
  content.surfaces[0].scene.surface = fan;
  EXPECT_GE(MakeInteractivePage(content, {}).weight.triangles, 3u);
}

TEST(InteractivePage, ValuesAreThoseOfTheScan)
{
  for (const double degrees : { 0.0, 30.0 })
  {
    const Scan scan = MakeRamp(degrees);
    const PageVolume volume = MakePageVolume(scan, BoxOf(scan));
    EXPECT_EQ(volume.isResampled, degrees != 0.0);
    std::size_t inside = 0;
    for (int z = 0; z < volume.size[2]; ++z)
    {
      for (int y = 2; y < volume.size[1] - 2; ++y)
      {
        for (int x = 2; x < volume.size[0] - 2; ++x)
        {
          const auto number = volume.numbers[static_cast<std::size_t>((z * volume.size[1] + y) * volume.size[0] + x)];
          if (number < 3 || number > volume.levels.size() - 2 || z == 0 || z == volume.size[2] - 1)
          {
            continue;
          }
          const double value = volume.levels[number - 1u];
          const double truth = volume.origin[0] + x * volume.spacing[0] +
                               2.0 * (volume.origin[1] + y * volume.spacing[1]) +
                               3.0 * (volume.origin[2] + z * volume.spacing[2]);
          // At the oblique scan's rim, values beyond the outermost voxel's centre are that voxel's.
          inside += std::abs(value - truth) <= 1.01 * volume.largestError ? 1 : 0;
        }
      }
    }
    EXPECT_GT(inside, degrees == 0.0 ? 1900u : 1500u) << degrees;
  }
}

TEST(InteractivePage, SlicesAreReadBackAsTheyWere)
{
  const Scan scan = MakeRamp(30.0);
  const PageVolume volume = MakePageVolume(scan, BoxOf(scan));
  const auto columns = static_cast<std::size_t>(volume.size[0]);
  const std::size_t slice = columns * static_cast<std::size_t>(volume.size[1]);
  std::vector<std::uint8_t> read;
  for (const std::string & block : EncodeVolume(volume, 5))
  {
    const std::string differences = Inflate(block, 5 * slice);
    const std::size_t first = read.size();
    for (std::size_t n = 0; n < differences.size(); ++n)
    {
      const bool hasLeft = n % slice % columns > 0;
      const bool hasUpper = n % slice >= columns;
      const int left = hasLeft ? read[first + n - 1] : 0;
      const int upper = hasUpper ? read[first + n - columns] : 0;
      const int corner = hasLeft && hasUpper ? read[first + n - columns - 1] : 0;
      const int guess = std::clamp(left + upper - corner, std::min(left, upper), std::max(left, upper));
      read.push_back(static_cast<std::uint8_t>(guess + differences[n]));
    }
  }
  EXPECT_EQ(read, volume.numbers);
  const PageVolume coarse = Coarsen(volume, 4, 2);
  EXPECT_EQ(coarse.size[2], (volume.size[2] + 1) / 2);
  EXPECT_EQ(coarse.numbers.size(), static_cast<std::size_t>(coarse.size[2]) * slice);
  for (std::size_t n = 0; n < slice; ++n)
  {
    const std::uint8_t number = volume.numbers[n];
    ASSERT_EQ(coarse.numbers[n] == 0, number == 0);
    if (number != 0)
    {
      ASSERT_NEAR(coarse.levels[coarse.numbers[n] - 1u], volume.levels[number - 1u], 1.01 * coarse.largestError);
    }
  }
}

TEST(InteractivePage, NamesCanNotEndTheirElement)
{
  const MadePage page = MakeInteractivePage(MakeContent(nullptr), {});
  EXPECT_EQ(page.html.find("</script><b>"), std::string::npos);
  EXPECT_EQ(page.html.find("<script>alert"), std::string::npos);
  const auto data = nlohmann::json::parse(JsonOf(page.html));
  EXPECT_EQ(data["surfaces"][0]["name"], "</script><b>\"'&");
  EXPECT_EQ(data["surfaces"][1]["name"], "\xd7\x9b\xd7\x91\xd7\x93");
  EXPECT_FALSE(data.contains("volume"));
  EXPECT_EQ(page.html.find("{{"), std::string::npos);
  EXPECT_EQ(page.html.find("http://"),
            page.html.find("http://www.w3.org/2000/svg")); // a name, that nothing is read from
  EXPECT_EQ(page.html.find("src=\"http"), std::string::npos);
}

TEST(InteractivePage, BytesDoNotDependOnThreads)
{
  const Scan scan = MakeRamp(30.0);
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const std::string one = MakeInteractivePage(MakeContent(&scan), {}).html;
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(5);
  const std::string five = MakeInteractivePage(MakeContent(&scan), {}).html;
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  EXPECT_EQ(one, five);
}

TEST(InteractivePage, ASmallPageSaysWhatIsReduced)
{
  const Scan scan = MakeRamp(0.0);
  PageContent content = MakeContent(&scan);
  const PageWeight whole = MakeInteractivePage(content, {}).weight;
  EXPECT_EQ(whole.triangles, whole.trianglesBefore) << "the spheres are too bent for fewer triangles within 0.1 mm";
  EXPECT_EQ(whole.measuredError, 0.0);
  EXPECT_EQ(whole.notes.size(), 2u);
  content.largestSize = 1000;
  const PageWeight least = MakeInteractivePage(content, {}).weight;
  EXPECT_GT(least.measuredError, 0.5);
  EXPECT_LT(least.triangles, whole.triangles);
  EXPECT_GT(least.valueError, whole.valueError);
  ASSERT_EQ(least.notes.size(), 3u);
  EXPECT_NE(least.notes[2].find("more than the 0.001 MB"), std::string::npos) << least.notes[2];
}

TEST(InteractivePage, SmallPagesHaveFewerPicturesToTurn)
{
  PageContent content = MakeContent(nullptr);
  content.turntable.clear();
  for (int n = 0; n < 24; ++n)
  {
    content.turntable.push_back(std::string(30'000, static_cast<char>('a' + n)));
  }
  for (const auto & [size, turns] :
       std::map<std::uintmax_t, int>{ { 8'000'000, 24 }, { 1'000'000, 12 }, { 400'000, 6 } })
  {
    content.largestSize = size;
    const MadePage page = MakeInteractivePage(content, {});
    EXPECT_EQ(nlohmann::json::parse(JsonOf(page.html))["turntable"], turns);
    EXPECT_EQ(page.weight.notes.size(), turns == 24 ? 1u : 2u);
    EXPECT_LE(page.html.size(), size);
    const std::string last = ToBase64(std::string(30'000, static_cast<char>('a' + 24 - 24 / turns)));
    EXPECT_NE(page.html.find("id=\"turn-" + std::to_string(turns - 1) + "\">" + last), std::string::npos);
    EXPECT_EQ(page.html.find("id=\"turn-" + std::to_string(turns)), std::string::npos);
  }
}

TEST(InteractivePage, APageNeedsASurface)
{
  EXPECT_THROW(MakeInteractivePage(PageContent(), {}), Failure);
}

TEST(InteractivePage, Base64IsThatOfTheStandard)
{
  EXPECT_EQ(ToBase64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(ToBase64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(ToBase64("foob"), "Zm9vYg==");
  EXPECT_EQ(HashToBase64("00ff10"), "AP8Q");
}
