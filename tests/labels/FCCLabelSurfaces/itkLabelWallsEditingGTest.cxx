#include "itkBruteForceCrossings.h"
#include "itkExampleCloseSheets.h"
#include "itkExampleLabelWalls.h"
#include "itkLabelWallsEditing.h"

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceIntersections.h"

#include <cmath>

namespace
{

using namespace itk::example;

Walls::Pointer
Copy(const Walls & walls)
{
  const auto copy = Walls::New();
  copy->Graft(&walls);
  return copy;
}

itk::SizeValueType
CountCrossings(const Walls & walls)
{
  const auto found = itk::FindTriangleSurfaceSelfIntersections(itk::TriangleTree(walls));
  return found.crossingPairs + found.touchingPairs;
}

/** Random volumes of 2 to 50 labels: noise and blobs by turns. */
LabelImage::Pointer
MakeVolume(unsigned int seed)
{
  const int labels = 2 + static_cast<int>(7 * seed % 49);
  return seed % 2 == 0 ? MakeNoise(Region(static_cast<int>(seed % 5) - 2, 4 + seed % 6, 7, 5 + seed % 4), seed, labels)
                       : MakeBlobs(Region(static_cast<int>(seed % 7) - 3, 9, 14 + seed % 6, 15), seed, labels);
}

itk::TriangleSurfaceSmoothingSettings
MovesUpTo(double maximumMove)
{
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.maximumMove = maximumMove;
  return settings;
}

itk::TriangleSurfaceSimplificationSettings
ErrorUpTo(double maximumError)
{
  itk::TriangleSurfaceSimplificationSettings settings;
  settings.maximumError = maximumError;
  return settings;
}

double
LargestMove(const Walls & walls, const Walls & start)
{
  double largest = 0.0;
  for (std::size_t n = 0; n < start.GetNumberOfPoints(); ++n)
  {
    const auto & a = start.GetPoints()[n];
    const auto & b = walls.GetPoints()[n];
    largest = std::max(largest, std::hypot(double{ b[0] } - a[0], double{ b[1] } - a[1], double{ b[2] } - a[2]));
  }
  return largest;
}

using Position = std::array<float, 3>;

/** The labels that meet at each point, where curves of walls meet or end. */
std::map<Position, std::set<std::uint16_t>>
FindJunctions(const Walls & walls)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::map<Position, std::set<std::uint16_t>> labels;
  const auto positionOf = [&walls](std::uint32_t point) {
    const auto & position = walls.GetPoints()[point];
    return Position{ position[0], position[1], position[2] };
  };
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    const auto & triangle = walls.GetTriangles()[n];
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      ++edges[std::minmax(triangle[corner], triangle[(corner + 1) % 3])];
      labels[positionOf(triangle[corner])].insert(walls.GetTriangleLabels()[n].begin(),
                                                  walls.GetTriangleLabels()[n].end());
    }
  }
  std::map<std::uint32_t, int> curves;
  for (const auto & [edge, triangles] : edges)
  {
    if (triangles > 2)
    {
      ++curves[edge.first];
      ++curves[edge.second];
    }
  }
  std::map<Position, std::set<std::uint16_t>> junctions;
  for (const auto & [point, count] : curves)
  {
    if (count != 2)
    {
      junctions[positionOf(point)] = labels[positionOf(point)];
    }
  }
  return junctions;
}

/** The triangles between each two labels. */
std::map<Walls::LabelPairType, itk::TriangleSurface::Pointer>
FindWalls(const Walls & walls)
{
  std::map<Walls::LabelPairType, itk::TriangleSurface::Pointer> found;
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    auto & wall = found[walls.GetTriangleLabels()[n]];
    if (!wall)
    {
      wall = itk::TriangleSurface::New();
      wall->GetPoints() = walls.GetPoints();
    }
    wall->GetTriangles().push_back(walls.GetTriangles()[n]);
  }
  for (const auto & [pair, wall] : found)
  {
    wall->RemoveUnusedPoints();
  }
  return found;
}

/** Expects the same walls with the same topology, none farther from the other than \a error. */
void
ExpectNearWalls(const Walls & walls, const Walls & before, double error)
{
  const auto found = FindWalls(walls);
  const auto wanted = FindWalls(before);
  ASSERT_EQ(found.size(), wanted.size());
  for (const auto & [pair, wall] : wanted)
  {
    ASSERT_EQ(found.count(pair), 1u);
    const auto & same = *found.at(pair);
    const auto topology = itk::ComputeTriangleSurfaceTopology(same);
    const auto topologyBefore = itk::ComputeTriangleSurfaceTopology(*wall);
    ASSERT_EQ(topology.components, topologyBefore.components);
    ASSERT_EQ(topology.eulerCharacteristic, topologyBefore.eulerCharacteristic);
    ASSERT_EQ(topology.nonManifoldEdges, 0u);
    ASSERT_LE(itk::ComputeTriangleSurfaceDistances(same, *wall).GetMaximum(), 1.0001 * error);
  }
}

/** Relaxes and simplifies walls of noise or blobs, and expects all that is promised. */
void
ExpectSoundEdits(unsigned int seed)
{
  SCOPED_TRACE(seed);
  const auto image = MakeVolume(seed);
  const auto walls = MakeWalls(image);
  const auto start = Copy(*walls);
  const auto moves = RelaxLabelWalls(*walls, MovesUpTo(0.5));
  ExpectSoundWalls(*walls, *image);
  ASSERT_EQ(CountCrossings(*walls), 0u);
  ASSERT_LE(LargestMove(*walls, *start), 0.5);
  ASSERT_DOUBLE_EQ(LargestMove(*walls, *start), moves.largestMove);
  const auto junctions = FindJunctions(*start);
  ASSERT_EQ(FindJunctions(*walls), junctions);

  const auto relaxed = Copy(*walls);
  const double error = 0.05 + 0.05 * (seed % 8);
  const auto report = SimplifyLabelWalls(*walls, ErrorUpTo(error));
  EXPECT_EQ(report.trianglesAfter, walls->GetNumberOfTriangles());
  ASSERT_EQ(FindJunctions(*walls), junctions);
  ExpectNearWalls(*walls, *relaxed, error);
  ExpectSoundWalls(*walls, *image);
  ASSERT_EQ(CountCrossings(*walls), 0u);
  auto labels = walls->FindLabels();
  labels.push_back(0);
  for (const std::uint16_t label : labels)
  {
    const auto surface = walls->ExtractLabel(label);
    const auto before = relaxed->ExtractLabel(label);
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    const auto topologyBefore = itk::ComputeTriangleSurfaceTopology(*before);
    ASSERT_EQ(topology.components, topologyBefore.components);
    ASSERT_EQ(topology.genus, topologyBefore.genus);
    ASSERT_LE(itk::ComputeTriangleSurfaceDistances(*surface, *before).GetMaximum(), 1.0001 * error) << label;
  }
}

TEST(LabelWallsEditing, EditedWallsAreSound)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    ExpectSoundEdits(seed);
  }
}

/** Takes many minutes: the label long. */
TEST(LabelWallsEditing, AThousandVolumesStaySound)
{
  for (unsigned int seed = 0; seed < 1000 && !HasFatalFailure(); ++seed)
  {
    ExpectSoundEdits(seed);
  }
}

/** The walls of label 1 around label 2: two spheres or two tori. */
Walls::Pointer
MakeThinLabel(unsigned int seed)
{
  const auto sheets = MakeCloseSheets(seed % 2 == 0 ? CloseSheets::Spheres : CloseSheets::Tori, seed);
  const auto walls = Walls::New();
  walls->GetPoints() = sheets->GetPoints();
  walls->GetTriangles() = sheets->GetTriangles();
  auto & triangles = walls->GetTriangles();
  walls->GetTriangleLabels().assign(triangles.size(), { 0, 1 });
  for (std::size_t n = triangles.size() / 2; n < triangles.size(); ++n)
  {
    std::swap(triangles[n][1], triangles[n][2]); // seen from label 1
    walls->GetTriangleLabels()[n] = { 1, 2 };
  }
  return walls;
}

/** Smooths and simplifies walls that are close to each other, and expects that none cross. */
void
ExpectSoundThinLabels(unsigned int pairs)
{
  for (unsigned int seed = 0; seed < pairs; ++seed)
  {
    SCOPED_TRACE(seed);
    const auto walls = MakeThinLabel(seed);
    if (seed % 4 > 1)
    {
      RelaxLabelWalls(*walls, MovesUpTo(1.0));
      EXPECT_EQ(bruteforce::CountCrossings(*walls), 0u);
    }
    auto settings = ErrorUpTo(seed % 3 == 0 ? 5.0 : std::numeric_limits<double>::infinity());
    settings.targetTriangles = walls->GetNumberOfTriangles() / (3 + seed % 20);
    const auto report = SimplifyLabelWalls(*walls, settings);
    EXPECT_LT(report.trianglesAfter, report.trianglesBefore);
    EXPECT_EQ(bruteforce::CountCrossings(*walls), 0u);
    EXPECT_EQ(CountCrossings(*walls), 0u) << "or touch";
  }
}

TEST(LabelWallsEditing, WallsOfThinLabelsDoNotMeet)
{
  ExpectSoundThinLabels(80);
}

/** The other 750 are in itkTriangleSurfaceCloseSheetsGTest.cxx: the label long. */
TEST(LabelWallsEditing, AThousandPairsDoNotMeet)
{
  ExpectSoundThinLabels(250);
}

TEST(LabelWallsEditing, SmoothLabelsKeepTheirVolumes)
{
  const auto image = MakeBlobs(Region(0, 14, 28, 28), 3, 9);
  const auto walls = MakeWalls(image);
  const auto before = walls->ComputeVolumes();
  RelaxLabelWalls(*walls, MovesUpTo(0.5));
  const auto relaxed = walls->ComputeVolumes();
  SimplifyLabelWalls(*walls, ErrorUpTo(0.3));
  const auto simplified = walls->ComputeVolumes();
  for (const std::uint16_t label : walls->FindLabels())
  {
    EXPECT_NEAR(before[label], itk::ComputeTriangleSurfaceVolume(*MakeWalls(image)->ExtractLabel(label)), 1e-2);
    EXPECT_NEAR(relaxed[label], before[label], 0.01 * before[label]) << label;
    EXPECT_NEAR(simplified[label], relaxed[label], 0.01 * before[label]) << label;
  }
}

TEST(LabelWallsEditing, RelaxedWallsAreSmoother)
{
  const auto ball = MakeLabels(Region(0, 12, 24, 24), [](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    const auto isInside = std::hypot(site[0] - 12.0, site[1] - 12.0, site[2] - 12.0) < 9.0;
    return static_cast<std::uint16_t>(isInside ? 1 + (site[0] < 12 ? 1 : 0) : 0);
  });
  const auto walls = MakeWalls(ball);
  const auto before = walls->ComputeVolumes();
  const auto turnFromRadius = [](const Walls & of) { // mean sine of the angle between normals and radii
    double sum = 0.0;
    double area = 0.0;
    const auto outside = of.ExtractLabel(0);
    for (const auto & triangle : outside->GetTriangles())
    {
      const auto & a = outside->GetPoints()[triangle[0]];
      const auto & b = outside->GetPoints()[triangle[1]];
      const auto & c = outside->GetPoints()[triangle[2]];
      std::array<double, 3> normal{};
      std::array<double, 3> radius{};
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const unsigned int next = (axis + 1) % 3;
        const unsigned int last = (axis + 2) % 3;
        normal[axis] = (double{ b[next] } - a[next]) * (double{ c[last] } - a[last]) -
                       (double{ b[last] } - a[last]) * (double{ c[next] } - a[next]);
        radius[axis] = (double{ a[axis] } + b[axis] + c[axis]) / 3.0 - 12.0;
      }
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      const double dot = normal[0] * radius[0] + normal[1] * radius[1] + normal[2] * radius[2];
      const double cosine = dot / (length * std::hypot(radius[0], radius[1], radius[2]));
      sum += length * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
      area += length;
    }
    return sum / area;
  };
  const double turn = turnFromRadius(*walls);
  std::vector<double> areas;
  for (const std::uint16_t label : { 0, 1, 2 })
  {
    areas.push_back(itk::ComputeTriangleSurfaceArea(*walls->ExtractLabel(label)));
  }
  RelaxLabelWalls(*walls, MovesUpTo(0.5));
  const auto after = walls->ComputeVolumes();
  EXPECT_LT(turnFromRadius(*walls), 0.6 * turn);
  for (const std::size_t label : { 0u, 1u, 2u })
  {
    EXPECT_LT(itk::ComputeTriangleSurfaceArea(*walls->ExtractLabel(static_cast<std::uint16_t>(label))), areas[label]);
    EXPECT_NEAR(after[label], before[label], 1e-3 * std::abs(before[label]));
  }
}

TEST(LabelWallsEditing, ThinTubesBecomeRoundAndKeepTheirRadius)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.4, 0.4);
  const auto tube = MakeLabels(Region(0, 8, 16, 80), [&](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    const double radius = std::hypot(site[0] - 8.0, site[1] - 8.0);
    return static_cast<std::uint16_t>(radius < 2.5 + noise(random) && site[2] > 4 && site[2] < 75 ? 1 : 0);
  });
  const auto walls = MakeWalls(tube);
  const auto start = Copy(*walls);
  const auto radii = [](const Walls & of) { // mean, and deviation
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (const auto & point : of.GetPoints())
    {
      if (point[2] > 12.0f && point[2] < 68.0f)
      {
        const double radius = std::hypot(point[0] - 8.0, point[1] - 8.0);
        sum += radius;
        squares += radius * radius;
        ++count;
      }
    }
    return std::array{ sum / count, std::sqrt(squares / count - sum / count * sum / count) };
  };
  auto settings = MovesUpTo(2.0);
  settings.iterations = 40;
  RelaxLabelWalls(*walls, settings);
  ExpectSoundWalls(*walls, *tube);
  EXPECT_NEAR(radii(*walls)[0], radii(*start)[0], 0.1);
  EXPECT_LT(radii(*walls)[1], 0.5 * radii(*start)[1]);
  EXPECT_LT(ComputeTriangleSurfaceBending(*walls), 0.8 * ComputeTriangleSurfaceBending(*start));
  EXPECT_NEAR(walls->ComputeVolumes()[1], start->ComputeVolumes()[1], 3e-3 * start->ComputeVolumes()[1]);
}

TEST(LabelWallsEditing, PointsStayInTheEllipsoidOfTheHalfAxes)
{
  const auto image = MakeBlobs(Region(0, 9, 18, 18), 4, 5);
  const auto walls = MakeWalls(image);
  const auto start = Copy(*walls);
  auto settings = MovesUpTo(3.0);
  settings.iterations = 40;
  settings.halfAxes = { { { 0.12, 0.16, 0.0 }, { -0.24, 0.18, 0.0 }, { 0.0, 0.0, 2.0 } } }; // 0.2, 0.3 and 2 mm long
  const auto report = RelaxLabelWalls(*walls, settings);
  EXPECT_GT(report.pointsAtLimit, 0u);
  EXPECT_GT(report.largestMove, 0.31) << "along the longest axis";
  for (std::size_t point = 0; point < start->GetNumberOfPoints(); ++point)
  {
    const auto & a = start->GetPoints()[point];
    const auto & b = walls->GetPoints()[point];
    const std::array<double, 3> way{ double{ b[0] } - a[0], double{ b[1] } - a[1], double{ b[2] } - a[2] };
    ASSERT_LE(std::hypot((0.6 * way[0] + 0.8 * way[1]) / 0.2, (-0.8 * way[0] + 0.6 * way[1]) / 0.3, way[2] / 2.0),
              1.0 + 1e-9);
  }
  settings.halfAxes->back() = { 0.1, 0.2, 0.0 };
  EXPECT_THROW(RelaxLabelWalls(*walls, settings), itk::ExceptionObject) << "three axes in a plane";
}

TEST(LabelWallsEditing, WallsOfANarrowGapDoNotMeet)
{
  const auto slabs = MakeLabels(Region(0, 9, 18, 18), [](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    const bool isInside = std::all_of(site.begin(), site.end(), [](auto at) { return at >= 2 && at <= 15; });
    const bool isGap = site[0] >= 8 && site[0] <= 9 && site[1] > 4;
    return static_cast<std::uint16_t>(isInside && !isGap ? 1 : 0);
  });
  const auto walls = MakeWalls(slabs);
  const auto start = Copy(*walls);
  const double volume = 3.0 * walls->ComputeVolumes()[1];
  const auto report = RelaxLabelWalls(*walls, MovesUpTo(4.0), { 0.0, volume });
  ExpectSoundWalls(*walls, *slabs);
  EXPECT_EQ(CountCrossings(*walls), 0u);
  EXPECT_LT(walls->ComputeVolumes()[1], volume) << "more than the gap has room for";
  EXPECT_DOUBLE_EQ(report.largestMove, LargestMove(*walls, *start));
  itk::SizeValueType unmoved = 0;
  for (std::size_t point = 0; point < start->GetNumberOfPoints(); ++point)
  {
    unmoved += walls->GetPoints()[point] == start->GetPoints()[point] ? 1 : 0;
  }
  EXPECT_GT(unmoved, 0u);
  EXPECT_LT(unmoved, start->GetNumberOfPoints());
}

TEST(LabelWallsEditing, WallsOfAShortGapInALargeBlockDoNotMeet)
{
  const auto block = MakeLabels(Region(0, 25, 50, 50), [](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    const bool isInside = std::all_of(site.begin(), site.end(), [](auto at) { return at >= 2 && at <= 47; });
    const bool isGap = site[0] >= 24 && site[0] <= 25 && site[1] > 42 && site[2] > 42;
    return static_cast<std::uint16_t>(isInside && !isGap ? 1 : 0);
  });
  const auto walls = MakeWalls(block);
  const double volume = 1.15 * walls->ComputeVolumes()[1];
  RelaxLabelWalls(*walls, MovesUpTo(4.0), { 0.0, volume });
  ExpectSoundWalls(*walls, *block);
  EXPECT_EQ(CountCrossings(*walls), 0u);
  EXPECT_NEAR(walls->ComputeVolumes()[1], volume, 1e-4 * volume) << "the rest makes up for the gap";
}

TEST(LabelWallsEditing, SimplifiedWallsReachATarget)
{
  const auto image = MakeBlobs(Region(0, 14, 28, 28), 2, 6);
  const auto walls = MakeWalls(image);
  auto settings = ErrorUpTo(2.0);
  settings.targetTriangles = walls->GetNumberOfTriangles() / 3;
  const auto report = SimplifyLabelWalls(*walls, settings);
  EXPECT_EQ(report.end, itk::SimplificationEnd::Target);
  EXPECT_LE(walls->GetNumberOfTriangles(), settings.targetTriangles);
  EXPECT_GT(walls->GetNumberOfTriangles(), settings.targetTriangles * 99 / 100);
  ExpectSoundWalls(*walls, *image);
}

TEST(LabelWallsEditing, RelaxedWallsNeedFewerTriangles)
{
  for (const unsigned int seed : { 3u, 7u })
  {
    const auto image = MakeBlobs(Region(0, 9, 14, 15), seed, 3 + static_cast<int>(seed));
    for (const double error : { 0.35, 0.75 })
    {
      const auto cut = MakeWalls(image);
      const auto relaxed = MakeWalls(image);
      RelaxLabelWalls(*relaxed, MovesUpTo(0.5));
      const auto ofCut = SimplifyLabelWalls(*cut, ErrorUpTo(error));
      const auto ofRelaxed = SimplifyLabelWalls(*relaxed, ErrorUpTo(error));
      EXPECT_EQ(ofRelaxed.end, itk::SimplificationEnd::MaximumError);
      EXPECT_LT(ofRelaxed.trianglesAfter, 3 * ofCut.trianglesAfter / 4);
    }
  }
}

TEST(LabelWallsEditing, LabelsOfOneSiteKeepTheirVolumes)
{
  const auto image = MakeLabels(Region(0, 8, 16, 16), [](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    return static_cast<std::uint16_t>(site == itk::FCCLattice::SiteType{ 8, 8, 8 } ? 2 : site[0] < 8 ? 1 : 0);
  });
  const auto walls = MakeWalls(image);
  const double volume = walls->ComputeVolumes()[2];
  ASSERT_GT(volume, 0.0);
  RelaxLabelWalls(*walls, MovesUpTo(0.5));
  EXPECT_NEAR(walls->ComputeVolumes()[2], volume, 0.02 * volume);
  ExpectSoundWalls(*walls, *image);
}

TEST(LabelWallsEditing, RefusesSenselessSettings)
{
  const auto walls = MakeWalls(MakeBlobs(Region(0, 5, 9, 9), 2, 3));
  const auto points = walls->GetPoints();
  EXPECT_THROW(RelaxLabelWalls(*walls, MovesUpTo(-1.0)), itk::ExceptionObject);
  EXPECT_THROW(RelaxLabelWalls(*walls, MovesUpTo(std::nan(""))), itk::ExceptionObject);
  EXPECT_THROW(SimplifyLabelWalls(*walls, {}), itk::ExceptionObject);
  EXPECT_THROW(SimplifyLabelWalls(*walls, ErrorUpTo(0.0)), itk::ExceptionObject);
  EXPECT_EQ(walls->GetPoints(), points);
}

TEST(LabelWallsEditing, LabelsTakeTheVolumesAsked)
{
  const auto image = MakeBlobs(Region(0, 14, 28, 28), 3, 4);
  const auto walls = MakeWalls(image);
  std::vector<double> volumes{ 0.0, 0.0, 1.02 * walls->ComputeVolumes()[2] };
  RelaxLabelWalls(*walls, MovesUpTo(0.5), volumes);
  EXPECT_NEAR(walls->ComputeVolumes()[2], volumes[2], 0.003 * volumes[2]);
}

TEST(LabelWallsEditing, SmoothBlobsLoseMostTriangles)
{
  const auto image = MakeBlobs(Region(0, 14, 28, 28), 1, 4);
  const auto walls = MakeWalls(image);
  RelaxLabelWalls(*walls, MovesUpTo(0.5));
  const auto report = SimplifyLabelWalls(*walls, ErrorUpTo(0.3));
  EXPECT_LT(report.trianglesAfter, report.trianglesBefore / 4);
  ExpectSoundWalls(*walls, *image);
}

TEST(LabelWallsEditing, BytesDoNotDependOnThreads)
{
  const auto image = MakeBlobs(Region(-2, 12, 21, 17), 5, 8);
  const auto start = MakeWalls(image);
  const itk::ThreadIdType before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  Walls::Pointer one;
  for (const itk::ThreadIdType threads : { 1, 2, 3, 8 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const auto walls = Copy(*start);
    RelaxLabelWalls(*walls, MovesUpTo(0.4));
    SimplifyLabelWalls(*walls, ErrorUpTo(0.1));
    one = one ? one : walls;
    EXPECT_EQ(one->GetPoints(), walls->GetPoints());
    EXPECT_EQ(one->GetTriangles(), walls->GetTriangles());
    EXPECT_EQ(one->GetTriangleLabels(), walls->GetTriangleLabels());
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
}

} // namespace
