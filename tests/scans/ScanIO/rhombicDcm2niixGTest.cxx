#include "rhombicScanTest.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace fs = std::filesystem;

namespace
{

using rhombic::ReadScan;
using Point = itk::Point<double, 3>;

/** The positions of a volume's eight corner voxels, in an order that does not depend on its axes. */
std::array<Point, 8>
Corners(const itk::ImageBase<3> & grid)
{
  const auto & size = grid.GetLargestPossibleRegion().GetSize();
  std::array<Point, 8> corners;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::Index<3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = (corner >> axis & 1) != 0 ? static_cast<itk::IndexValueType>(size[axis]) - 1 : 0;
    }
    grid.TransformIndexToPhysicalPoint(index, corners[corner]);
  }
  return corners;
}

double
DistanceToNearest(const Point & point, const std::array<Point, 8> & others)
{
  double nearest = std::numeric_limits<double>::max();
  for (const Point & other : others)
  {
    nearest = std::min(nearest, point.EuclideanDistanceTo(other));
  }
  return nearest;
}

/** Compares with dcm2niix, an independent reader of DICOM (C. Rorden), through the NIfTI files that it writes. */
class Dcm2niix
  : public ScanTest
  , public testing::WithParamInterface<const char *>
{};

TEST_P(Dcm2niix, PutsSeriesIntoTheSamePlace)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr || std::system("command -v dcm2niix >/dev/null") != 0)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set, or dcm2niix is not installed";
  }
  const fs::path series = fs::path(scans) / GetParam();
  const std::string command =
    "dcm2niix -z n -b n -f series -o '" + m_Folder.string() + "' '" + series.string() + "' >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto ours = ReadScan(series);
  const auto theirs = ReadScan(m_Folder / "series.nii");
  const auto corners = Corners(rhombic::GeometryOf(theirs.image));
  for (const Point & corner : Corners(rhombic::GeometryOf(ours.image)))
  {
    EXPECT_LE(DistanceToNearest(corner, corners), 0.005) << corner;
  }
  EXPECT_EQ(rhombictest::IntensityRange(ours.image), rhombictest::IntensityRange(theirs.image));
}

// Debian's dcm2niix has no JPEG-LS, and ignores the tilt of a series.
INSTANTIATE_TEST_SUITE_P(Series,
                         Dcm2niix,
                         testing::Values("ct_head_ge8800_dicom",
                                         "ct_body_totalseg_dicom_j2k",
                                         "mr_head_t1_defaced_dicom_j2k",
                                         "dicom_awkward_dicom2nifti/siemens_multiframe/anatomical",
                                         "dicom_awkward_dicom2nifti/generic/compressed_j2k/001"));

} // namespace
