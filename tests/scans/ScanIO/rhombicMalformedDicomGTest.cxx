#include "rhombicScanTable.h"

#include <sys/resource.h>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Expected;
using rhombictest::Reading;

constexpr auto NotFound = rhombic::FailureKind::NotFound;
constexpr auto Unreadable = rhombic::FailureKind::Unreadable;
constexpr auto Geometry = rhombic::FailureKind::Geometry;

constexpr Expected singleSlice{ Geometry, "single slice" };
constexpr Expected noImages{ NotFound, "no DICOM images" };
constexpr Expected head{ {}, "CT int16 64x64x2 of 3.2x3.2x1 mm from 0,0,58.5, 0..3926" };
constexpr Expected brain{ {}, "MR uint16 256x256x2 of 1x1x1 mm from -103.79,-161.07,130.05, 0..254" };

/** Bytes were changed inside a slice's entropy-coded pixels so that they still are valid code, of other values, of the
 * right length: no reader can tell. The values are anything, the rest must be right. */
constexpr Expected alteredUndetectably{ {}, "MR uint16 256x256x2 of 1x1x1 mm from -103.79,-161.07,130.05" };

struct MalformedFile
{
  const char * name;
  Expected alone;              ///< as a file
  Expected pair;               ///< in a folder of two slices, whose pixels are decoded
  const char * like = nullptr; ///< the file that it has the voxels of...
  double times = 1.0;          ///< ...times this
};

constexpr MalformedFile malformedFiles[] = {
  { "d_bits_0.dcm", { Unreadable, "16 of 0 bits" }, { Unreadable, "16 of 0 bits" } },
  { "d_dicm_only.dcm", { Unreadable, "ends before its header begins" }, noImages },
  { "d_empty.dcm", { Unreadable, "neither DICOM nor" }, noImages },
  { "d_frames_2e9.dcm", { Unreadable, "where its frames are" }, { Unreadable, "where its frames are" } },
  { "d_j2k_dims_bigger.dcm", singleSlice, { Unreadable, "are 256x256, its header says 4096x4096" } },
  { "d_j2k_dims_smaller.dcm", singleSlice, { Unreadable, "are 256x256, its header says 8x8" } },
  { "d_j2k_mut1.dcm", singleSlice, alteredUndetectably },
  { "d_j2k_mut5.dcm", singleSlice, alteredUndetectably },
  { "d_j2k_ok.dcm", singleSlice, brain, "d_rle_ok.dcm" },
  { "d_j2k_trunc.dcm", { Unreadable, "more than are left in the file" }, { Unreadable, "more than are left" } },
  { "d_jls_dims_bigger.dcm", singleSlice, { Unreadable, "are 256x256, its header says 4096x4096" } },
  { "d_jls_mut0.dcm", singleSlice, { Unreadable, "can't be decoded" } },
  { "d_jls_mut1.dcm", singleSlice, { Unreadable, "can't be decoded" } },
  { "d_jls_mut2.dcm", singleSlice, { Unreadable, "can't be decoded" } },
  { "d_jls_mut5.dcm", singleSlice, { Unreadable, "can't be decoded" } },
  { "d_jls_ok.dcm", singleSlice, brain, "d_rle_ok.dcm" },
  { "d_jls_trunc.dcm", { Unreadable, "more than are left in the file" }, { Unreadable, "more than are left" } },
  { "d_jpg_dims_bigger.dcm", singleSlice, { Unreadable, "are 256x256, its header says 4096x4096" } },
  { "d_jpg_dims_smaller.dcm", singleSlice, { Unreadable, "are 256x256, its header says 8x8" } },
  { "d_jpg_mut0.dcm", singleSlice, { Unreadable, "more than the 12 bits" } },
  { "d_jpg_mut2.dcm", singleSlice, { Unreadable, "more than the 12 bits" } },
  { "d_jpg_ok.dcm", singleSlice, brain, "d_rle_ok.dcm" },
  { "d_jpg_trunc.dcm", { Unreadable, "more than are left in the file" }, { Unreadable, "more than are left" } },
  { "d_metaVR.dcm", { Unreadable, "(0002,0001) claims 4294967280 bytes" }, noImages },
  { "d_metalen.dcm", singleSlice, head, "d_ok.dcm" },
  { "d_noiop.dcm", singleSlice, { Geometry, "no usable ImageOrientationPatient" } },
  { "d_noipp.dcm", singleSlice, { Geometry, "no usable ImagePositionPatient" } },
  { "d_nopixel.dcm", { Unreadable, "holds no image" }, noImages },
  { "d_ok.dcm", singleSlice, head },
  { "d_pixlen_4G.dcm", { Unreadable, "8192 of 4294967294 bytes" }, { Unreadable, "8192 of 4294967294 bytes" } },
  { "d_pixlen_undef_native.dcm", { Unreadable, "type that does not exist" }, { Unreadable, "type that does not" } },
  { "d_rle_mut0.dcm", singleSlice, alteredUndetectably },
  { "d_rle_mut1.dcm", singleSlice, alteredUndetectably },
  { "d_rle_mut2.dcm", singleSlice, alteredUndetectably },
  { "d_rle_ok.dcm", singleSlice, brain },
  { "d_rows_65535.dcm", { Unreadable, "8192 of 8589672450 bytes" }, { Unreadable, "8192 of 8589672450 bytes" } },
  { "d_samples_3.dcm", { Unreadable, "colour image" }, { Unreadable, "colour image" } },
  { "d_short_pixels.dcm", { Unreadable, "1000 of 8192 bytes" }, { Unreadable, "1000 of 8192 bytes" } },
  { "d_slope_frac.dcm", singleSlice, { {}, "CT float 64x64x2 of 3.2x3.2x1 mm" }, "d_ok.dcm", 0.0025 },
  { "d_slope_nan.dcm", { Unreadable, "no usable number" }, { Unreadable, "no usable number" } },
  { "d_slope_neg.dcm", singleSlice, { {}, "CT int16 64x64x2 of 3.2x3.2x1 mm" }, "d_ok.dcm", -1.0 },
  { "d_spacing_neg.dcm", singleSlice, { Geometry, "no usable PixelSpacing" } },
  { "d_stored_gt_alloc.dcm", { Unreadable, "32 of 16 bits" }, { Unreadable, "32 of 16 bits" } },
  { "d_trunc200.dcm", { Unreadable, "claims 64 bytes, more than are left" }, noImages },
};

/** The largest memory of a process, in MiB. */
long
PeakMemory(int who)
{
  rusage usage{};
  getrusage(who, &usage);
  return usage.ru_maxrss / 1024;
}

class MalformedDicom : public ScanTable
{
protected:
  void
  SetUp() override
  {
    ScanTable::SetUp();
    m_Files = m_Scans.parent_path() / "malformed";
    if (!IsSkipped() && !IsThere(m_Files))
    {
      GTEST_SKIP() << m_Files << " is not there";
    }
  }

  Reading
  ReadPair(const std::string & name)
  {
    const bool isSagittal = name.rfind("d_j", 0) == 0 || name.rfind("d_rle", 0) == 0;
    return rhombictest::Read(rhombictest::MakePair(m_Files / name, m_Folder / name, isSagittal ? 0 : 2), m_Options);
  }

  rhombic::ScanReadOptions m_Options = rhombic::AcceptUneven();
  fs::path m_Files;
};

TEST_F(MalformedDicom, EveryFileHasARow)
{
  std::size_t files = 0;
  for (const auto & entry : fs::directory_iterator(m_Files))
  {
    const std::string name = entry.path().filename().string();
    files += name.rfind("d_", 0) == 0 ? 1 : 0;
  }
  EXPECT_EQ(files, std::size(malformedFiles));
}

TEST_F(MalformedDicom, FilesAloneAreRefused)
{
  for (const MalformedFile & file : malformedFiles)
  {
    SCOPED_TRACE(file.name);
    rhombictest::ExpectReading(rhombictest::Read(m_Files / file.name, m_Options), file.alone);
  }
}

TEST_F(MalformedDicom, FoldersAreReadRightOrRefused)
{
  const long before = PeakMemory(RUSAGE_SELF);
  for (const MalformedFile & file : malformedFiles)
  {
    SCOPED_TRACE(file.name);
    rhombictest::ExpectReading(this->ReadPair(file.name), file.pair);
  }
  EXPECT_LT(PeakMemory(RUSAGE_SELF) - before, 200) << "MiB; two slices of 4096x4096 take 64";
}

TEST_F(MalformedDicom, SoundFilesHaveTheVoxelsOfTheirSiblings)
{
  for (const MalformedFile & file : malformedFiles)
  {
    if (file.like == nullptr)
    {
      continue;
    }
    SCOPED_TRACE(file.name);
    const Reading one = this->ReadPair(file.name);
    const Reading other = this->ReadPair(file.like);
    ASSERT_TRUE(one.scan && other.scan) << one.text << other.text;
    const std::vector<double> values = rhombictest::VoxelsOf(*one.scan);
    const std::vector<double> siblings = rhombictest::VoxelsOf(*other.scan);
    ASSERT_EQ(values.size(), siblings.size());
    std::size_t different = 0;
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      different += values[n] == static_cast<float>(file.times * siblings[n]) ? 0 : 1;
    }
    EXPECT_EQ(different, 0u);
  }
}

} // namespace
