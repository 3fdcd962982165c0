#include "rhombicLatticeToSurfaces.h"
#include "rhombicMeshEstimate.h"
#include "rhombicPhantom.h"
#include "rhombicReadScan.h"
#include "rhombicScanToLattice.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

/** Numbers of triangles that are known before the work. */

namespace
{

using Mode = itk::FCCIsosurfaceMode;

/** The estimate of an isosurface, relative to the triangles that it has. */
double
CompareEstimate(const rhombic::Scan & scan, double isovalue, Mode mode)
{
  rhombic::SurfaceRequest request;
  request.name = "surface";
  request.isovalue = isovalue;
  const itk::Size<3> size = rhombic::GeometryOf(scan.image).GetLargestPossibleRegion().GetSize();
  const rhombic::MeshEstimate estimate =
    rhombic::EstimateMesh({ scan.image, rhombic::FindSlicePairs(size), size[2] }, { request }, mode, {});
  const auto lattice = rhombic::ScanToLattice(scan, {}, {});
  const auto surface = rhombic::LatticeToSurfaces(lattice, { request }, mode, {}).front().surface;
  return estimate.triangles / static_cast<double>(surface->GetNumberOfTriangles());
}

} // namespace

TEST(MeshEstimate, IsRightForAPhantomInAllModes)
{
  rhombic::Scan scan;
  scan.image = rhombic::MakePhantomScan();
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    EXPECT_NEAR(CompareEstimate(scan, 250.5, mode), 1.0, 0.05) << mode;
    EXPECT_NEAR(CompareEstimate(scan, -300.5, mode), 1.0, 0.05) << mode;
  }
}

TEST(MeshEstimate, CountsWhatClosesASurfaceAtTheBordersOfAScan)
{
  const auto image = itk::Image<std::int16_t, 3>::New();
  image->SetRegions(itk::Size<3>{ { 80, 80, 40 } });
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<itk::Image<std::int16_t, 3>> it(image, image->GetBufferedRegion());
       !it.IsAtEnd();
       ++it) // half of a ball
  {
    const auto & [x, y, z] = it.GetIndex().m_InternalArray;
    const double depth = 35.0 - std::hypot(x - 39.3, y - 40.1, static_cast<double>(z));
    it.Set(static_cast<std::int16_t>(std::lround(1000.0 * std::erf(depth))));
  }
  rhombic::Scan scan;
  scan.image = image;
  EXPECT_NEAR(CompareEstimate(scan, 0.5, Mode::Lean), 1.0, 0.12);
}

TEST(MeshEstimate, IsRightForRealScans)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const std::filesystem::path folder = scans;
  const auto chest = rhombic::ReadScan(folder / "ct_chest_lidc0314_dicom_jpegls");
  EXPECT_NEAR(CompareEstimate(chest, 250.5, Mode::Lean), 1.0, 0.05);
  EXPECT_NEAR(CompareEstimate(chest, -300.5, Mode::Lean), 1.0, 0.05);
  const auto head = rhombic::ReadScan(folder / "mr_head_t1_defaced_dicom_j2k");
  EXPECT_NEAR(CompareEstimate(head, 60.5, Mode::Lean), 1.0, 0.05);
  EXPECT_NEAR(CompareEstimate(head, 20.5, Mode::Lean), 1.0, 0.05);
}

TEST(SlicePairs, AreAllOfSmallScansAndSomeOfLargeOnesWithFirstAndLast)
{
  const auto find = [](std::size_t width, std::size_t depth) {
    return rhombic::FindSlicePairs({ { width, width, depth } });
  };
  EXPECT_EQ(find(10, 1), std::vector<std::size_t>({ 0 }));
  EXPECT_EQ(find(10, 2), std::vector<std::size_t>({ 0 }));
  EXPECT_EQ(find(10, 4), std::vector<std::size_t>({ 0, 1, 2 }));
  EXPECT_EQ(find(8000, 100), std::vector<std::size_t>({ 0, 19, 39, 58, 78, 98 }));
  const auto pairs = find(1024, 1024);
  EXPECT_EQ(pairs.size(), 8u);
  EXPECT_EQ(pairs.back(), 1022u);
}
