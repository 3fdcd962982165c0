#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicReadScan.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTemporaryFolder.h"

#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleSurfaceAudit.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleTree.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{

using Mode = itk::FCCIsosurfaceMode;

struct RealSurface
{
  const char * scan; ///< in the folder of real scans
  double isovalue;
};

/** For GoogleTest, which prints bytes otherwise. */
std::ostream &
operator<<(std::ostream & stream, const RealSurface & surface)
{
  return stream << surface.scan << " at " << surface.isovalue;
}

constexpr RealSurface realSurfaces[] = { { "ct_head_ge8800_dicom", 500.5 },
                                         { "ct_head_ge8800_dicom", 1150.5 },
                                         { "ct_mr_dicom2stl_nifti/ct_example.nii.gz", 300.5 },
                                         { "ct_mr_dicom2stl_nifti/mri_t1_example.nii.gz", 150.5 },
                                         { "ct_body_totalseg_nifti/example_ct_sm.nii.gz", 150.5 },
                                         { "ct_head_tilt_varspacing_dicom_rle", 300.5 } };

class RealSurfaces : public testing::TestWithParam<RealSurface>
{};

TEST_P(RealSurfaces, AreSolidsInTheirFiles)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const auto scan = rhombic::ReadScan(std::filesystem::path(scans) / GetParam().scan);
  const auto lattice = rhombic::ScanToLattice(scan, {}, {});
  const auto * const grid = rhombic::IsSlanted(scan) ? nullptr : &rhombic::GeometryOf(scan.image);
  const double spacing = std::visit([](const auto & image) { return rhombic::MeanSpacingOf(*image); }, lattice);
  const rhombictest::TemporaryFolder folder;
  rhombic::SurfaceRequest request;
  request.name = "surface";
  request.isovalue = GetParam().isovalue;
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    const auto extracted = rhombic::LatticeToSurfaces(lattice, { request }, mode, {}, grid).front().surface;
    const auto surface = itk::TriangleSurface::New();
    surface->Graft(extracted);
    rhombic::RefineSurface(*surface, {}, spacing, "surface", {});
    rhombic::WriteSurfaces({ { "surface", surface.GetPointer() } }, folder.Path() / "surface.stl");
    const auto audit = AuditTriangleSurface(*rhombic::ReadSurfaces(folder.Path() / "surface.stl").front().surface);
    EXPECT_TRUE(audit.BoundsSolid()) << mode << ": " << audit;
    EXPECT_FALSE(audit.intersections.isSampled);
  }
}

TEST(RealSurfacesOfAChest, HaveNoFoldsThatAreHardToUntangle)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const auto scan = rhombic::ReadScan(std::filesystem::path(scans) / "ct_chest_lidc0314_dicom_jpegls");
  const auto lattice = rhombic::ScanToLattice(scan, {}, {});
  rhombic::SurfaceRequest request;
  request.name = "bone";
  request.isovalue = 250.5;
  const auto & grid = rhombic::GeometryOf(scan.image);
  const auto extracted = rhombic::LatticeToSurfaces(lattice, { request }, Mode::Tetrahedra, {}, &grid).front().surface;
  const auto surface = itk::TriangleSurface::New();
  surface->Graft(extracted);
  const double spacing = std::visit([](const auto & image) { return rhombic::MeanSpacingOf(*image); }, lattice);
  rhombic::RefineSurface(*surface, {}, spacing, "bone", {});
  const itk::TriangleTree tree(*surface);
  EXPECT_EQ(itk::FindCrossingTriangles(tree, itk::TrianglesOfPoints(*surface)).size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RealSurfaces, testing::ValuesIn(realSurfaces), [](const auto & surface) {
  std::string name = surface.param.scan;
  for (char & letter : name)
  {
    letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  }
  return name + '_' + std::to_string(surface.index);
});

} // namespace
