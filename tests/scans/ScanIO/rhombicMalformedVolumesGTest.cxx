#include "rhombicScanTest.h"

#include <cstdlib>
#include <optional>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::ReadScan;
using rhombic::ScanReadOptions;

/** Awkward files from elsewhere, which are no part of the project: RHOMBIC_SCANS says where they are. What is expected
 * of them was computed from their bytes by other means. */
class MalformedVolumes : public testing::Test
{
protected:
  void
  SetUp() override
  {
    const char * const folder = std::getenv("RHOMBIC_SCANS");
    if (folder == nullptr || !fs::exists(fs::path(folder) / "nifti_awkward") ||
        !fs::exists(fs::path(folder) / "../malformed"))
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set, or has no nifti_awkward and no ../malformed";
    }
    m_Scans = folder;
  }

  fs::path
  PathOf(const std::string & name) const
  {
    return m_Scans / (name.compare(0, 2, "n_") == 0 ? "../malformed" : "nifti_awkward") / name;
  }

  fs::path m_Scans;
};

struct Readable
{
  const char * name;
  std::optional<std::size_t> frame;
  double first[3]; ///< the place of the first voxel, in LPS mm
  double last[3];  ///< of the last
  double lowest;
  double highest;
  double sum;            ///< of the finite values
  std::size_t notFinite; ///< how many are not
  const char * note;     ///< a word of the first note; empty for none
};

const Readable readable[] = {
  { "n_ok.nii", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "n_ext_neg.nii", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "n_meter.nii", {}, { 100, 0, 0 }, { 85, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "n_micron.nii", {}, { 1, 1, -1 }, { -6.5, -6.5, 6.5 }, 0, 4095, 8386560, 0, "" },
  { "n_q_s_differ.nii", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "42.4" },
  { "n_reflect_left.nii", {}, { 0, 0, 0 }, { 15, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "n_sform_shear_only.nii", {}, { 0, 0, 0 }, { -19.5, -15, 15 }, 0, 4095, 8386560, 0, "16.7 degrees" },
  { "n_sform_wrongscale_vinci.nii", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "pixdim" },
  { "n_slope_nan.nii", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "n_small_voxel_10um.nii", {}, { 0, 0, 0 }, { -0.15, -0.15, 0.15 }, 0, 4095, 8386560, 0, "" },
  { "n_dim4_2.nii", 1, { -10, -20, 30 }, { 5, -5, 37 }, 2048, 4095, 6290432, 0, "" },
  { "n_pair.hdr", {}, { 0, 0, 0 }, { -15, -15, 15 }, 0, 4095, 8386560, 0, "" },
  { "anatomical.nii", {}, { -32, 40, -16 }, { 32, -40, 32 }, -610, 30393, 284166082, 0, "" },
  { "avg152T1_LR_nifti.nii.gz", {}, { -90, 126, -72 }, { 90, -90, 108 }, 0, 255, 74825382, 0, "" },
  { "avg152T1_LR_nifti2.nii.gz", {}, { -90, 126, -72 }, { 90, -90, 108 }, 0, 255, 74825382, 0, "" },
  { "big.nii.gz", {}, { 0, 0, 0 }, { 252, -252, 120 }, -8.71075, 18.5825, 11648.37202, 0, "" },
  { "little.nii.gz", {}, { 0, 0, 0 }, { 252, -252, 120 }, -8.71075, 18.5825, 11648.37202, 0, "" },
  { "low_res.nii.gz", {}, { 0, 0, 0 }, { -12, -8, 4 }, 0, 1, 53, 0, "" },
  { "minimal.nii.gz", {}, { 0, 0, 0 }, { 189, 189, 27 }, 0, 63, 1290240, 0, "left and right" },
  { "narps-4965_9U7M-hypo1_unthresh.nii.gz",
    {},
    { -90, 126, -72 },
    { 90, -90, 108 },
    -6.75466,
    4.95083,
    -243024.8901,
    0,
    "" },
  { "resampled_anat_moved.nii", {}, { -32, 40, 0 }, { 32, -40, 16 }, 409.3, 13361, 7749957.099, 153, "153 values" },
  { "shear.nii.gz",
    {},
    { 94.3794, 117.106, -102.204 },
    { -52.7593, -75.4981, 87.8938 },
    -1024,
    789,
    -5577896245,
    0,
    "18.5 degrees" },
  { "standard.nii.gz", {}, { 0, 0, 0 }, { -3, -12, 12 }, 0, 255, 7650, 0, "" },
  { "with_extension.nii.gz", {}, { -80, -80, 85 }, { 80, 110, -65 }, 0, 1, 1472871, 0, "" },
  { "ras.hdr", {}, { 73.3773, 65.3572, -31.5323 }, { -72.1219, -30.2329, 46.5618 }, 0, 255, 15024169, 0, "" },
  { "example4d.nii.gz", 1, { -117.855, 35.7229, -7.2488 }, { 136.145, -143.602, 73.3908 }, 0, 1140, 50990959, 0, "" },
  { "example_nifti2.nii.gz",
    1,
    { -117.855, 35.7229, -7.2488 },
    { -55.8551, 2.13323, 22.774 },
    46,
    757,
    3465054,
    0,
    "" },
  { "functional.nii", 19, { -32, 40, 0 }, { 32, -40, 16 }, 829.73, 5541.08, 3888072.273, 0, "" },
};

TEST_F(MalformedVolumes, WhatCanBeReadIsReadRight)
{
  for (const Readable & expected : readable)
  {
    SCOPED_TRACE(expected.name);
    ScanReadOptions options;
    options.frame = expected.frame;
    const auto scan = ReadScan(this->PathOf(expected.name), options);
    const auto & geometry = rhombic::GeometryOf(scan.image);
    itk::Point<double, 3> last;
    itk::Index<3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = static_cast<itk::IndexValueType>(geometry.GetLargestPossibleRegion().GetSize()[axis]) - 1;
    }
    geometry.TransformIndexToPhysicalPoint(index, last);
    ExpectNear(geometry.GetOrigin(), itk::Point<double, 3>(expected.first), 1e-3);
    ExpectNear(last, itk::Point<double, 3>(expected.last), 1e-3);

    const auto [lowest, highest] = rhombictest::IntensityRange(scan.image);
    EXPECT_NEAR(lowest, expected.lowest, 1e-4 * (1 + std::abs(expected.lowest)));
    EXPECT_NEAR(highest, expected.highest, 1e-4 * (1 + std::abs(expected.highest)));
    double sum = -static_cast<double>(expected.notFinite) * lowest;
    std::visit(
      [&sum](const auto & pixels) {
        const auto * const begin = pixels->GetBufferPointer();
        for (std::size_t n = 0; n < pixels->GetBufferedRegion().GetNumberOfPixels(); ++n)
        {
          sum += static_cast<double>(begin[n]);
        }
      },
      scan.image);
    EXPECT_NEAR(sum, expected.sum, 1e-6 * std::abs(expected.sum));
    const bool hasNote = *expected.note != '\0';
    ASSERT_EQ(!scan.notes.empty(), hasNote) << scan.notes.front();
    if (hasNote)
    {
      EXPECT_NE(scan.notes[0].find(expected.note), std::string::npos) << scan.notes[0];
    }
  }
}

struct Refused
{
  const char * name;
  FailureKind kind;
  const char * word; ///< in the sentence
};

const Refused refused[] = {
  { "n_bitpix_mismatch.nii", FailureKind::Unreadable, "bitpix" },
  { "n_crc.nii.gz", FailureKind::Unreadable, "compressed content is damaged" },
  { "n_dim0_0.nii", FailureKind::Unreadable, "0 dimensions" },
  { "n_dim0_9.nii", FailureKind::Unreadable, "9 dimensions" },
  { "n_dim4_2.nii", FailureKind::Unreadable, "2 volumes" },
  { "n_dim_huge.nii", FailureKind::Unreadable, "more voxels" },
  { "n_dim_zero.nii", FailureKind::Unreadable, "size along axis 0" },
  { "n_dt_float128.nii", FailureKind::Unreadable, "128-bit" },
  { "n_dt_unknown.nii", FailureKind::Unreadable, "9999" },
  { "n_empty.nii", FailureKind::Unreadable, "not NIfTI" },
  { "n_ni1_single.nii", FailureKind::Unreadable, ".img" },
  { "n_pair_missing.hdr", FailureKind::Unreadable, ".img" },
  { "n_pix_neg.nii", FailureKind::Geometry, "pixdim" },
  { "n_sform_zero.nii", FailureKind::Geometry, "sform" },
  { "n_symmatrix_bad.nii", FailureKind::Unreadable, "intent 1005" },
  { "n_vec_dim5_0.nii", FailureKind::Unreadable, "size along axis 4" },
  { "n_vox_huge.nii", FailureKind::Unreadable, "vox_offset" },
  { "n_vox_neg.nii", FailureKind::Unreadable, "vox_offset" },
  { "5D_small.nii", FailureKind::Unreadable, "intent 1007" },
  { "V1.nii.gz", FailureKind::Unreadable, "intent 2003" },
  { "analyze.hdr", FailureKind::Unreadable, "Analyze" },
  { "complex.nii.gz", FailureKind::Unreadable, "complex" },
  { "ct_perfusion.nii.gz", FailureKind::Unreadable, "RGB" },
  { "example4d.nii.gz", FailureKind::Unreadable, "2 volumes" },
  { "example_nifti2.nii.gz", FailureKind::Unreadable, "2 volumes" },
  { "functional.nii", FailureKind::Unreadable, "20 volumes" },
  { "minc2_baddim.mnc", FailureKind::Unreadable, "minc2_baddim.mnc" },
  { "nifti1.hdr", FailureKind::Unreadable, ".img" },
  { "not-nifti.nii", FailureKind::Unreadable, "not NIfTI" },
};

TEST_F(MalformedVolumes, TheRestIsRefusedByName)
{
  for (const Refused & expected : refused)
  {
    const fs::path path = this->PathOf(expected.name);
    EXPECT_EQ(KindOfReading(path, expected.word), expected.kind) << expected.name;
  }
}

TEST_F(MalformedVolumes, EveryFileIsJudged)
{
  const auto isJudged = [](const std::string & name) {
    const auto hasName = [&name](const auto & expected) { return name == expected.name; };
    return std::any_of(std::begin(readable), std::end(readable), hasName) ||
           std::any_of(std::begin(refused), std::end(refused), hasName);
  };
  for (const fs::path & folder : { m_Scans / "nifti_awkward", m_Scans / "../malformed" })
  {
    for (const auto & entry : fs::directory_iterator(folder))
    {
      const std::string name = entry.path().filename().string();
      const bool isOther = name == "SOURCE.txt" || name.compare(0, 2, "d_") == 0 || entry.path().extension() == ".img";
      EXPECT_TRUE(isOther || isJudged(name)) << name;
    }
  }
}

TEST_F(MalformedVolumes, ShearIsRefusedWhenAskedFor)
{
  ScanReadOptions options;
  options.onTilted = ScanReadOptions::Policy::Refuse;
  EXPECT_EQ(KindOfReading(this->PathOf("shear.nii.gz"), "sform", options), FailureKind::Geometry);
  EXPECT_EQ(KindOfReading(this->PathOf("n_sform_shear_only.nii"), "16.7 degrees", options), FailureKind::Geometry);
}

} // namespace
