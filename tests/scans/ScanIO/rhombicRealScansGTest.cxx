#include "rhombicScanTest.h"

#include <cstdlib>
#include <cstring>
#include <numeric>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::ReadScan;

/** Real scans, which are no part of the project: RHOMBIC_SCANS says where they are. */
class RealScans : public testing::Test
{
protected:
  void
  SetUp() override
  {
    const char * const folder = std::getenv("RHOMBIC_SCANS");
    if (folder == nullptr)
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set";
    }
    m_Scans = folder;
  }

  fs::path m_Scans;
};

std::string
Describe(const rhombic::Scan & scan)
{
  const auto size = rhombic::GeometryOf(scan.image).GetLargestPossibleRegion().GetSize();
  const auto [lowest, highest] = rhombictest::IntensityRange(scan.image);
  return scan.modality + " " + rhombic::PixelTypeName(scan.image) + " " + std::to_string(size[0]) + "x" +
         std::to_string(size[1]) + "x" + std::to_string(size[2]) + " " + std::to_string(std::lround(lowest)) + ".." +
         std::to_string(std::lround(highest));
}

/** The mean position of voxels above 40. */
itk::Point<double, 3>
BrainCentroid(const itk::Image<float, 3> & image)
{
  itk::Vector<double, 3> sum;
  sum.Fill(0);
  double count = 0;
  const auto size = image.GetLargestPossibleRegion().GetSize();
  itk::Index<3> index;
  for (index[2] = 0; index[2] < static_cast<long>(size[2]); ++index[2])
  {
    for (index[1] = 0; index[1] < static_cast<long>(size[1]); ++index[1])
    {
      for (index[0] = 0; index[0] < static_cast<long>(size[0]); ++index[0])
      {
        if (image.GetPixel(index) > 40)
        {
          itk::Point<double, 3> point;
          image.TransformIndexToPhysicalPoint(index, point);
          sum += point.GetVectorFromOrigin();
          ++count;
        }
      }
    }
  }
  sum /= count;
  return itk::Point<double, 3>(sum.GetDataPointer());
}

TEST_F(RealScans, AllOrientationsOfABrainLieAtTheSamePlace)
{
  const double expected[3] = { -0.58, 21.6, 8.12 };
  int files = 0;
  for (const auto & entry : fs::directory_iterator(m_Scans / "nifti_orientations_48"))
  {
    if (entry.path().string().find(".nii") != std::string::npos)
    {
      ++files;
      SCOPED_TRACE(entry.path());
      ExpectNear(BrainCentroid(ImageOf<float>(ReadScan(entry.path()))), itk::Point<double, 3>(expected), 0.05);
    }
  }
  EXPECT_EQ(files, 48);
}

TEST_F(RealScans, ChestInJPEGLS)
{
  const auto scan = ReadScan(m_Scans / "ct_chest_lidc0314_dicom_jpegls");
  EXPECT_EQ(Describe(scan), "CT int16 512x512x138 -1000..1979");
  const double expected[3] = { 0.78125, 0.78125, 2 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(rhombic::GeometryOf(scan.image).GetSpacing()[axis], expected[axis], 1e-6);
  }
}

TEST_F(RealScans, SmallHead)
{
  const auto scan = ReadScan(m_Scans / "ct_head_ge8800_dicom");
  EXPECT_EQ(Describe(scan), "CT int16 64x64x93 0..3926");
  EXPECT_EQ(scan.filesSkipped.at("not DICOM"), 1u) << "its SOURCE.txt";
}

TEST_F(RealScans, ObliqueHeadInJPEG2000)
{
  const auto scan = ReadScan(m_Scans / "mr_head_t1_defaced_dicom_j2k");
  EXPECT_EQ(Describe(scan), "MR int16 274x384x384 0..278");
  const auto & geometry = rhombic::GeometryOf(scan.image);
  const double orientation[6] = { 0.999, -0.0218, 0.0382, 0.0265, 0.9914, -0.128 };
  for (unsigned int row = 0; row < 3; ++row)
  {
    EXPECT_NEAR(geometry.GetDirection()[row][0], orientation[row], 1e-4);
    EXPECT_NEAR(geometry.GetDirection()[row][1], orientation[row + 3], 1e-4);
  }
}

TEST_F(RealScans, BodyInJPEG2000AndNIfTI)
{
  EXPECT_EQ(Describe(ReadScan(m_Scans / "ct_body_totalseg_dicom_j2k")), "CT int16 512x512x20 -1024..1839");
  EXPECT_EQ(Describe(ReadScan(m_Scans / "ct_body_totalseg_nifti/example_ct.nii.gz")), " int32 122x101x112 -1207..3382");
}

TEST_F(RealScans, CompressedCopiesAreIdentical)
{
  const fs::path generic = m_Scans / "dicom_awkward_dicom2nifti/generic";
  const auto plain = ReadScan(generic / "compressed/001");
  const auto & expected = ImageOf<std::uint16_t>(plain);
  for (const char * copy :
       { "compressed_j2k/001", "compressed_jpeg/001", "compressed_jpegls/001", "compressed_rle/001" })
  {
    const auto scan = ReadScan(generic / copy);
    const auto & image = ImageOf<std::uint16_t>(scan);
    ASSERT_EQ(image.GetLargestPossibleRegion(), expected.GetLargestPossibleRegion()) << copy;
    EXPECT_EQ(std::memcmp(image.GetBufferPointer(),
                          expected.GetBufferPointer(),
                          image.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(std::uint16_t)),
              0)
      << copy;
    EXPECT_EQ(image.GetOrigin(), expected.GetOrigin()) << copy;
  }
}

TEST_F(RealScans, IrregularSeriesKeepTheirPlaces)
{
  const auto head = ReadScan(m_Scans / "ct_head_tilt_varspacing_dicom_rle");
  EXPECT_EQ(Describe(head), "CT int16 512x512x28 -1023..2121") << "without padding";
  EXPECT_NEAR(head.stack->tiltDegrees, 18.5, 1e-3);
  ASSERT_EQ(head.stack->blocks.size(), 3u);
  EXPECT_NEAR(head.stack->blocks[0].step, 4.002, 1e-3);
  EXPECT_NEAR(head.stack->blocks[2].step, 6.999, 1e-3);
  EXPECT_EQ(head.sliceOrigins.size(), 28u);

  const fs::path failing = m_Scans / "dicom_awkward_dicom2nifti/failing";
  EXPECT_NEAR(ReadScan(failing / "gantrytilting/001").stack->tiltDegrees, 14, 1e-3);
  EXPECT_EQ(KindOfReading(failing / "sliceincrement/001", "1 slice is missing at"), FailureKind::Geometry);
  EXPECT_EQ(KindOfReading(failing / "notavolume/001", "only one slice"), FailureKind::Geometry);
}

TEST_F(RealScans, FrogLabels)
{
  const auto scan = ReadScan(m_Scans / "frog_labels_metaimage/frogtissue.mhd");
  EXPECT_EQ(Describe(scan), " uint8 500x470x136 0..29");
  EXPECT_EQ(rhombic::GeometryOf(scan.image).GetSpacing()[2], 1.5);
  const auto & image = ImageOf<std::uint8_t>(scan);
  const auto * const begin = image.GetBufferPointer();
  EXPECT_EQ(std::accumulate(begin, begin + image.GetBufferedRegion().GetNumberOfPixels(), 0L), 12279472L)
    << "its CompressedDataSize is too small";
}

TEST_F(RealScans, MetaImageAndNRRD)
{
  const auto head = ReadScan(m_Scans / "frog_labels_metaimage/HeadMRVolume.mhd");
  EXPECT_EQ(Describe(head), " uint8 48x62x42 0..255");
  EXPECT_FALSE(head.isOriented);
  const auto liver = ReadScan(m_Scans / "dicom_seg_dcmqi/segmentations/liver_seg.nrrd");
  EXPECT_EQ(Describe(liver), " int16 512x512x3 0..1");
  EXPECT_EQ(liver.encoding, "gzip");
  EXPECT_TRUE(liver.isOriented);
  EXPECT_NEAR(rhombic::GeometryOf(liver.image).GetOrigin()[0], -235.2, 1e-3);
}

} // namespace
