#include "itkFCCIsosurfaceFilter.h"

#include "itkCommand.h"
#include "itkFCCTestImages.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{

using fcctest::ImageType;
using Filter = itk::FCCIsosurfaceFilter<ImageType>;
using Surface = itk::TriangleSurface;

constexpr double pi = 3.14159265358979323846;

Surface::Pointer
Extract(const ImageType * image, double isovalue, bool closed = true, unsigned int workUnits = 2)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetIsovalue(isovalue);
  filter->SetMode(itk::FCCIsosurfaceMode::Tetrahedra); // the other modes are tested apart
  filter->SetClosed(closed);
  filter->SetNumberOfWorkUnits(workUnits);
  filter->Update();
  Surface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

/** Triangles of the six-tetrahedra decomposition, found the slow way: by visiting every tetrahedron of the infinite
 * lattice near the image, everything outside the image being outside the surface. */
itk::SizeValueType
CountTrianglesByBruteForce(const ImageType & image, double isovalue)
{
  using Site = itk::FCCLattice::SiteType;
  const auto region = image.GetBufferedRegion();
  const auto isInside = [&](const Site & site) {
    const auto index = itk::FCCLattice::IndexOf(site);
    return region.IsInside(index) && image.GetPixel(index) >= isovalue;
  };
  const auto trianglesOf = [&](const std::array<Site, 4> & sites) -> itk::SizeValueType {
    int inside = 0;
    for (const Site & site : sites)
    {
      inside += isInside(site) ? 1 : 0;
    }
    return inside == 2 ? 2 : inside == 1 || inside == 3 ? 1 : 0;
  };
  const auto first = itk::FCCLattice::SiteOf(region.GetIndex());
  const auto last = itk::FCCLattice::SiteOf(region.GetUpperIndex());
  itk::SizeValueType triangles = 0;
  for (auto z = first[2] - 3; z <= last[2] + 3; ++z)
  {
    for (auto y = first[1] - 3; y <= last[1] + 3; ++y)
    {
      for (auto x = first[0] - 4; x <= last[0] + 4; ++x)
      {
        const auto flip = itk::FCCLattice::IsSite({ x, y, z }) ? 0 : 1;
        triangles += trianglesOf({ { { x + flip, y, z },
                                     { x + 1 - flip, y + 1, z },
                                     { x + 1 - flip, y, z + 1 },
                                     { x + flip, y + 1, z + 1 } } });
        if (flip == 1) // an odd point: the octahedron around it, cut about its x diagonal
        {
          const Site ring[4] = { { x, y + 1, z }, { x, y, z + 1 }, { x, y - 1, z }, { x, y, z - 1 } };
          for (int quarter = 0; quarter < 4; ++quarter)
          {
            triangles += trianglesOf({ { { x - 1, y, z }, { x + 1, y, z }, ring[quarter], ring[(quarter + 1) % 4] } });
          }
        }
      }
    }
  }
  return triangles;
}

TEST(FCCIsosurfaceFilter, PinsItsDefaults)
{
  const auto filter = Filter::New();
  EXPECT_EQ(filter->GetIsovalue(), 0.0);
  EXPECT_EQ(filter->GetIsovalues().size(), 1u);
  EXPECT_EQ(filter->GetMode(), itk::FCCIsosurfaceMode::Lean);
  EXPECT_TRUE(filter->GetComputeNormals());
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_FALSE(filter->GetInsideIsBelow());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfTriangles(), 0u);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Closed: On"), std::string::npos);
}

TEST(FCCIsosurfaceFilter, NoiseOfAnySizeIsWatertightAndComplete)
{
  std::mt19937 random(1);
  for (unsigned int trial = 0; trial < 300; ++trial)
  {
    ImageType::RegionType region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int longest = axis == 0 && trial % 10 == 0 ? 140 : 9; // more than two words of bits now and then
      region.SetIndex(axis, static_cast<itk::IndexValueType>(random() % 7) - 3);
      region.SetSize(axis, 1 + random() % longest);
    }
    const int levels = 2 + static_cast<int>(random() % 5);
    const auto image = fcctest::MakeNoise(region, trial, levels);
    const auto isovalue = static_cast<double>(random() % static_cast<unsigned int>(levels)); // equal to many samples
    const auto surface = Extract(image, isovalue);
    const auto topology = ComputeTriangleSurfaceTopology(*surface);
    ASSERT_TRUE(topology.IsWatertight()) << region << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
    ASSERT_EQ(surface->GetNumberOfTriangles(), CountTrianglesByBruteForce(*image, isovalue)) << region;
  }
}

TEST(FCCIsosurfaceFilter, CheckerboardsAndSingleSamplesAreWatertight)
{
  const ImageType::RegionType region({ { 0, 0, 0 } }, { { 12, 13, 14 } });
  auto image = fcctest::MakeNoise(region, 1, 2);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>((it.GetIndex()[0] + it.GetIndex()[2]) % 2));
  }
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*Extract(image, 1.0)).IsWatertight());

  image->FillBuffer(0.0f);
  image->SetPixel({ { 5, 5, 5 } }, 1.0f);
  const auto surface = Extract(image, 0.5);
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_TRUE(topology.IsWatertight());
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
  // The 12 nearest neighbours and two of the octahedra's diagonals: one point on each edge.
  EXPECT_EQ(surface->GetNumberOfPoints(), 14u);
}

TEST(FCCIsosurfaceFilter, NothingInsideOrUnknownValuesGiveNoSurface)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 4, 4, 4 } } }, 1, 2);
  EXPECT_EQ(Extract(image, 5.0)->GetNumberOfTriangles(), 0u);
  EXPECT_EQ(Extract(image, -1.0, false)->GetNumberOfTriangles(), 0u) << "all inside, and not closed";
  image->FillBuffer(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(Extract(image, -1.0)->GetNumberOfTriangles(), 0u) << "not-a-number is outside";
}

TEST(FCCIsosurfaceFilter, NotANumberAndInfinityLeaveTheSurfaceWatertight)
{
  const ImageType::RegionType region({ { 0, 0, 0 } }, { { 9, 9, 9 } });
  const float odd[3] = { std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity() };
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const auto image = fcctest::MakeNoise(region, seed, 4);
    std::mt19937 random(seed);
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
    {
      const auto draw = random() % 8;
      it.Set(draw < 3 ? odd[draw] : it.Get());
    }
    const auto surface = Extract(image, 2.0);
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
    for (const auto & normal : surface->GetNormals())
    {
      ASSERT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0, 1e-5);
    }
  }
}

TEST(FCCIsosurfaceFilter, SphereHasItsAreaVolumeAndDistance)
{
  const double radius = 10.0;
  const double s = std::sqrt(3.0) / 2.0; // the density of the default lattice on a grid of spacing 1
  const auto image = fcctest::MakeImage(s, 13.0, [radius](const auto & p) { return fcctest::Sphere(p, radius); });
  const auto surface = Extract(image, 0.0);
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.eulerCharacteristic, 2);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface) / (4.0 / 3.0 * pi * radius * radius * radius), 1.0, 0.006);
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*surface) / (4.0 * pi * radius * radius), 1.0, 0.006);
  const double sagitta = (2.0 * s) * (2.0 * s) / (8.0 * radius); // of the longest edge, along a row
  for (itk::SizeValueType n = 0; n < surface->GetNumberOfPoints(); ++n)
  {
    const auto & point = surface->GetPoints()[n];
    const auto & normal = surface->GetNormals()[n];
    const double distance = std::hypot(point[0], point[1], point[2]);
    ASSERT_NEAR(distance, radius, sagitta);
    const double cosine = (point[0] * normal[0] + point[1] * normal[1] + point[2] * normal[2]) / distance;
    ASSERT_GT(cosine, 0.999) << "normals point outside";
  }
}

TEST(FCCIsosurfaceFilter, TorusHasItsGenusAreaAndVolume)
{
  const double major = 9.0;
  const double minor = 4.0;
  const auto image = fcctest::MakeImage(0.6, 15.0, [=](const auto & p) { return fcctest::Torus(p, major, minor); });
  const auto surface = Extract(image, 0.0);
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.eulerCharacteristic, 0);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface) / (2.0 * pi * pi * major * minor * minor), 1.0, 0.01);
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*surface) / (4.0 * pi * pi * major * minor), 1.0, 0.01);
}

// Triangles per unit of area at one sample per unit of volume, averaged over directions: rho times the sum of the mean
// projected edge lengths, 8.322 for six tetrahedra with the row diagonal.
TEST(FCCIsosurfaceFilter, TrianglesPerAreaAreThoseOfTheDecomposition)
{
  const double radius = 24.0;
  const double s = std::cbrt(0.5);
  const auto image =
    fcctest::MakeImage(s, radius + 2.0, [radius](const auto & p) { return fcctest::Sphere(p, radius); });
  const auto surface = Extract(image, 0.0);
  const double perArea = static_cast<double>(surface->GetNumberOfTriangles()) / (4.0 * pi * radius * radius);
  EXPECT_NEAR(perArea / 8.322, 1.0, 0.01);
  // The same truth from the edges' lengths alone: a plane cuts each edge with a chance proportional to its projection.
  double lengths = 0.0;
  for (const auto & edge : itk::FCCLattice::OwnedEdges)
  {
    lengths += s * std::sqrt(static_cast<double>(edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]));
  }
  EXPECT_NEAR(lengths / 8.322, 1.0, 0.001) << "points are half of that, triangles twice the points";
}

TEST(FCCIsosurfaceFilter, ABodyThatFillsTheImageIsClosedOnItsExtent)
{
  auto image = ImageType::New();
  image->SetRegions(ImageType::RegionType({ { 2, -1, 3 } }, { { 10, 16, 14 } }));
  image->Allocate();
  image->FillBuffer(1.0f);
  const double spacing[3] = { 0.5, 0.7, 0.9 };
  image->SetSpacing(spacing);
  const auto surface = Extract(image, 0.5);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  const std::array<double, 6> extent{ 0.5 * 3.5, 0.5 * 23.5, 0.7 * -1.5, 0.7 * 14.5, 0.9 * 2.5, 0.9 * 16.5 };
  const auto bounds = surface->GetBounds();
  for (unsigned int n = 0; n < 6; ++n)
  {
    EXPECT_NEAR(bounds[n], extent[n], 1e-5);
  }
  const double box = 0.5 * 20.0 * 0.7 * 16.0 * 0.9 * 14.0;
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface) / box, 1.0, 0.03) << "but for bevelled edges";
  EXPECT_LT(ComputeTriangleSurfaceVolume(*surface), box);

  itk::SizeValueType onFaces = 0;
  for (itk::SizeValueType n = 0; n < surface->GetNumberOfPoints(); ++n)
  {
    const auto & normal = surface->GetNormals()[n];
    const bool axial = std::abs(normal[0]) > 0.999f || std::abs(normal[1]) > 0.999f || std::abs(normal[2]) > 0.999f;
    onFaces += axial ? 1 : 0;
  }
  EXPECT_GT(onFaces, surface->GetNumberOfPoints() * 3 / 4) << "the caps are flat";
}

TEST(FCCIsosurfaceFilter, OpenSurfacesEndAtTheOutermostTetrahedra)
{
  const auto image = fcctest::MakeImage(0.5, 4.0, [](const auto & p) { return 0.3 * p[0] + 0.5 * p[1] + p[2]; });
  const auto open = Extract(image, 0.1, false);
  const auto topology = ComputeTriangleSurfaceTopology(*open);
  EXPECT_GT(topology.boundaryEdges, 0u);
  EXPECT_EQ(topology.nonManifoldEdges + topology.misorientedEdges + topology.nonManifoldPoints, 0u) << topology;
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.eulerCharacteristic, 1) << "a disk";
  const double steepest = 0.5 * (0.5 + 1.0); // difference of the field along the edge (0, 1, 1)
  for (const auto & point : open->GetPoints())
  {
    ASSERT_NEAR(0.3 * point[0] + 0.5 * point[1] + point[2], 0.1, steepest * Filter::MinimumFraction + 1e-5);
  }
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*Extract(image, 0.1, true)).IsWatertight());

  // Inside the image, both are the same.
  const auto sphere = fcctest::MakeImage(0.5, 6.0, [](const auto & p) { return fcctest::Sphere(p, 4.0); });
  EXPECT_EQ(Extract(sphere, 0.0, false)->GetTriangles().size(), Extract(sphere, 0.0, true)->GetTriangles().size());
}

TEST(FCCIsosurfaceFilter, NoiseLeftOpenHasManifoldEdges)
{
  std::mt19937 random(5);
  for (unsigned int trial = 0; trial < 100; ++trial)
  {
    ImageType::RegionType region;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      region.SetIndex(axis, static_cast<itk::IndexValueType>(random() % 3));
      region.SetSize(axis, 1 + random() % 8);
    }
    const auto topology = ComputeTriangleSurfaceTopology(*Extract(fcctest::MakeNoise(region, trial, 3), 1.0, false));
    // Two parts of the surface may end at one point of the border, so points need not be manifold there.
    ASSERT_EQ(topology.nonManifoldEdges + topology.misorientedEdges + topology.degenerateTriangles, 0u) << topology;
    ASSERT_EQ(topology.unusedPoints, 0u);
  }
}

TEST(FCCIsosurfaceFilter, TheSameWorldIsFoundInAnyOrientation)
{
  const double radius = 6.0;
  const auto field = [radius](const ImageType::PointType & p) {
    return radius - std::hypot(p[0] - 40.0, 1.3 * (p[1] + 25.0), p[2] - 3.0);
  };
  for (unsigned int variant = 0; variant < 16; ++variant)
  {
    ImageType::DirectionType direction;
    direction.Fill(0.0);
    const unsigned int rotation = variant % 2;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[(axis + rotation) % 3][axis] = (variant >> (axis + 1) & 1) != 0 ? -1.0 : 1.0;
    }
    auto image = ImageType::New();
    image->SetRegions(ImageType::RegionType({ { -10, -20, -20 } }, { { 21, 41, 41 } }));
    image->SetSpacing(ImageType::SpacingType(0.5));
    const double origin[3] = { 40.0, -25.0, 3.0 };
    image->SetOrigin(origin);
    image->SetDirection(direction);
    image->Allocate();
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(static_cast<float>(field(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
    }
    const auto surface = Extract(image, 0.0);
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 4.0 / 3.0 * pi * radius * radius * radius / 1.3, 10.0)
      << "positive: not inside out";
    const auto bounds = surface->GetBounds();
    EXPECT_NEAR(bounds[0], 34.0, 0.05);
    EXPECT_NEAR(bounds[3], -25.0 + radius / 1.3, 0.05);
    for (itk::SizeValueType n = 0; n < surface->GetNumberOfPoints(); ++n)
    {
      const auto & point = surface->GetPoints()[n];
      const auto & normal = surface->GetNormals()[n];
      const double cosine =
        (point[0] - 40.0) * normal[0] + 1.69 * (point[1] + 25.0) * normal[1] + (point[2] - 3.0) * normal[2];
      ASSERT_GT(cosine, 0.0);
    }
  }
}

TEST(FCCIsosurfaceFilter, InsideIsBelowTurnsTheSameSurfaceOver)
{
  // A hollow in a filled image: its surface is that of a ball of low values.
  const double radius = 5.0;
  const auto image = fcctest::MakeImage(0.5, 7.0, [radius](const auto & p) { return fcctest::Sphere(p, radius); });
  const auto ball = Extract(image, 0.25);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(-it.Get());
  }
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetIsovalue(-0.25);
  filter->SetMode(itk::FCCIsosurfaceMode::Tetrahedra);
  filter->InsideIsBelowOn();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetTriangles(), ball->GetTriangles());
  EXPECT_EQ(filter->GetOutput()->GetPoints(), ball->GetPoints());
  EXPECT_EQ(filter->GetOutput()->GetNormals(), ball->GetNormals());
  EXPECT_GT(ComputeTriangleSurfaceVolume(*filter->GetOutput()), 0.0);

  image->SetPixel({ { 0, 0, 0 } }, std::numeric_limits<float>::quiet_NaN());
  image->Modified();
  filter->Update();
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*filter->GetOutput()).components, 2u) << "not-a-number is outside here, too";
}

TEST(FCCIsosurfaceFilter, NormalsOfALinearFieldAreExactAlsoAtTheFaces)
{
  auto image = fcctest::MakeImage(0.5, 3.0, [](const auto &) { return 0.0; });
  const double spacing[3] = { 0.4, 0.6, 1.1 };
  image->SetSpacing(spacing);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto p = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    it.Set(static_cast<float>(2.0 * p[0] - p[1] + 2.0 * p[2]));
  }
  const auto surface = Extract(image, 0.3, false);
  ASSERT_GT(surface->GetNumberOfPoints(), 100u);
  const auto bounds = image->GetBufferedRegion();
  for (itk::SizeValueType n = 0; n < surface->GetNumberOfPoints(); ++n)
  {
    const auto & point = surface->GetPoints()[n];
    const auto & normal = surface->GetNormals()[n];
    int faces = 0; // of the image that are near
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double unitsPerIndex = axis == 0 ? 2.0 : 1.0;
      const double reach = 2.0;
      const double coordinate = point[axis] / spacing[axis];
      faces += coordinate < unitsPerIndex * static_cast<double>(bounds.GetIndex(axis)) + reach ? 1 : 0;
      faces += coordinate > unitsPerIndex * static_cast<double>(bounds.GetUpperIndex()[axis]) + 1.0 - reach ? 1 : 0;
    }
    // Along the image's edges some directions have no neighbour at all.
    const double tolerance = faces < 2 ? 1e-5 : 0.2;
    ASSERT_NEAR(normal[0], -2.0 / 3.0, tolerance);
    ASSERT_NEAR(normal[1], 1.0 / 3.0, tolerance);
    ASSERT_NEAR(normal[2], -2.0 / 3.0, tolerance);
  }
}

TEST(FCCIsosurfaceFilter, GivesTheSameBytesForAnyNumberOfThreads)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 40, 60, 70 } } }, 3, 50);
  const auto single = Extract(image, 25.0, true, 1);
  for (const unsigned int units : { 2u, 3u, 8u, 61u })
  {
    const auto many = Extract(image, 25.0, true, units);
    ASSERT_EQ(single->GetPoints(), many->GetPoints());
    ASSERT_EQ(single->GetNormals(), many->GetNormals());
    ASSERT_EQ(single->GetTriangles(), many->GetTriangles());
  }
}

TEST(FCCIsosurfaceFilter, PointsStayApartFarFromTheOriginAndInFineImages)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 12, 20, 20 } } }, 3, 4);
  for (const double spacing : { 0.05, 0.02, 0.01, 0.005 })
  {
    image->SetSpacing(ImageType::SpacingType(spacing));
    image->SetOrigin(ImageType::PointType(300.0));
    const auto topology = ComputeTriangleSurfaceTopology(*Extract(image, 2.0));
    EXPECT_TRUE(topology.IsWatertight()) << spacing << " mm: " << topology;
  }
  image->SetOrigin(ImageType::PointType(1e6));
  EXPECT_THROW(Extract(image, 2.0), itk::ExceptionObject) << "32-bit positions can't tell the points apart";
}

TEST(FCCIsosurfaceFilter, ReportsProgressStopsOnAbortAndRefusesNonsense)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 30, 60, 200 } } }, 3, 50);
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetIsovalue(25.0);
  std::set<float> reported;
  float last = 0.0f;
  bool monotonic = true;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    monotonic = monotonic && filter->GetProgress() >= last;
    last = filter->GetProgress();
    reported.insert(last);
  });
  filter->Update();
  EXPECT_TRUE(monotonic);
  EXPECT_EQ(last, 1.0f);
  EXPECT_GT(reported.size(), 5u);

  filter->SetIsovalue(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);
  EXPECT_THROW(Filter::New()->Update(), itk::ExceptionObject);
}

// Whichever thread notices the abort: none may return a surface that is not finished.
TEST(FCCIsosurfaceFilter, AnAbortAtAnyTimeIsAnException)
{
  const auto image = fcctest::MakeNoise({ { { 0, 0, 0 } }, { { 20, 30, 300 } } }, 3, 50);
  for (int stopAt = 1; stopAt < 12; ++stopAt)
  {
    const auto filter = Filter::New();
    filter->SetInput(image);
    filter->SetIsovalue(25.0);
    filter->SetNumberOfWorkUnits(16);
    int reports = 0;
    bool aborted = false;
    filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      if (++reports == stopAt && filter->GetProgress() < 0.9f)
      {
        filter->AbortGenerateDataOn();
        aborted = true;
      }
    });
    bool thrown = false;
    try
    {
      filter->Update();
    }
    catch (const itk::ProcessAborted &)
    {
      thrown = true;
    }
    EXPECT_EQ(thrown || ComputeTriangleSurfaceTopology(*filter->GetOutput()).IsWatertight(), true)
      << "report " << stopAt;
    EXPECT_TRUE(thrown || !aborted || filter->GetProgress() == 1.0f);
  }
}

} // namespace
