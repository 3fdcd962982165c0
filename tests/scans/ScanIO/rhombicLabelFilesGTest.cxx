#include "rhombicNIfTITestFile.h"
#include "rhombicDicomTestFile.h"
#include "itkScanFileReader.h"
#include "rhombicLabelMap.h"
#include "rhombicScanTest.h"

#include <fstream>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::LabelMap;

constexpr int Width = 6;
constexpr std::size_t Voxels = Width * 5 * 4;

/** Folders of masks of 6 x 5 x 4 voxels of 2 mm. */
class LabelFiles : public ScanTest
{
protected:
  LabelFiles()
  {
    fs::create_directories(m_Masks);
  }

  /** Writes values by voxel, the last of them for all further voxels. */
  fs::path
  Write(const std::string & name, std::vector<std::uint8_t> values, double origin = 0.0) const
  {
    NIfTITestFile file;
    file.dimensions = { 3, Width, 5, 4, 1, 1, 1, 1 };
    file.datatype = 2;
    file.bits = 8;
    file.sform = { 2, 0, 0, origin, 0, 2, 0, 0, 0, 0, 2, 0 };
    values.resize(Voxels, values.back());
    file.voxels = file.Values(values);
    std::ofstream(m_Masks / name, std::ios::binary) << file.Bytes();
    return m_Masks / name;
  }

  /** A mask of voxels [begin, end). */
  fs::path
  WriteMask(const std::string & name, std::size_t begin, std::size_t end, std::uint8_t value = 1) const
  {
    std::vector<std::uint8_t> values(Voxels, 0);
    std::fill(
      values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end), value);
    return this->Write(name, values);
  }

  /** Labels as "value name voxels". */
  static std::vector<std::string>
  Describe(const std::vector<rhombic::LabelSummary> & labels)
  {
    std::vector<std::string> texts;
    for (const auto & one : labels)
    {
      texts.push_back(std::to_string(one.label.value) + ' ' + one.label.name + ' ' +
                      std::to_string(one.numberOfVoxels));
    }
    return texts;
  }

  std::vector<std::string>
  DescribeFolder() const
  {
    const auto scan = rhombic::ReadScan(m_Masks);
    return Describe(rhombic::FindLabels(scan, { { m_Masks } }));
  }

  LabelMap
  Read(const std::vector<fs::path> & paths, const fs::path & table = {}) const
  {
    const auto scan = this->WriteMask("../scan.nii", 0, Voxels);
    return rhombic::ReadLabelMap({ paths, table }, {}, rhombic::ReadScan(scan), scan);
  }

  const fs::path m_Masks = m_Folder / "masks";
};

using Texts = std::vector<std::string>;

TEST_F(LabelFiles, AFolderOfMasksIsOneSegmentation)
{
  this->WriteMask("liver.nii", 0, 40);
  this->WriteMask("kidney_left.nii", 50, 60, 255);
  this->WriteMask("tumour.nii", 30, 45);
  this->WriteMask("spleen.nii", 0, 0);
  std::ofstream(m_Masks / "statistics.json") << "{}";
  std::ofstream(m_Masks / "._liver.nii") << "of another system";
  EXPECT_EQ(this->DescribeFolder(), (Texts{ "1 kidney_left 10", "2 liver 40", "3 tumour 15" }));
  const auto scan = rhombic::ReadScan(m_Masks);
  ASSERT_EQ(scan.furtherLayers.size(), 1u);
  EXPECT_EQ(scan.files.size(), 4u);
  ASSERT_EQ(scan.notes.size(), 3u);
  EXPECT_NE(scan.notes[0].find("So it is with 3 other files."), std::string::npos) << scan.notes[0];
  EXPECT_EQ(scan.notes[1].find("10 voxels belong to more than one label"), 0u) << scan.notes[1];
  EXPECT_EQ(scan.notes[2], "1 of 4 masks holds no voxels: spleen.");
  EXPECT_TRUE(rhombic::ListSeries(m_Masks).series.empty());
  const auto map = this->Read({ m_Masks });
  EXPECT_EQ(Describe(map.labels), this->DescribeFolder());
}

TEST_F(LabelFiles, SeveralFilesAreOneSegmentation)
{
  const auto liver = this->WriteMask("liver.nii", 0, 40);
  const auto map = this->Write("organs.nii", { 0, 0, 1, 1, 1, 5, 5, 0 });
  std::ofstream(m_Masks / "organs.tsv") << "index\tname\n1\tspleen\n";
  fs::create_directories(m_Folder / "more");
  const auto tumour = this->WriteMask("../more/tumour.nii", 100, 110);
  EXPECT_EQ(Describe(this->Read({ liver, map, tumour.parent_path() }).labels),
            (Texts{ "1 liver 40", "2 spleen 3", "5 label 5 2", "6 tumour 10" }));
  EXPECT_EQ(Describe(this->Read({ map, liver }).labels), (Texts{ "1 spleen 3", "5 label 5 2", "6 liver 40" }));
  std::ofstream(m_Folder / "table.txt") << "1 left lobe\n6 right lobe\n";
  EXPECT_THROW(this->Read({ map, liver }, m_Folder / "table.txt"), Failure) << "numbers are by the files' order";
  EXPECT_THROW(this->Read({ m_Masks }, m_Folder / "table.txt"), Failure);
  EXPECT_EQ(Describe(this->Read({ map }, m_Folder / "table.txt").labels), (Texts{ "1 left lobe 3", "5 label 5 2" }));
}

TEST_F(LabelFiles, AMaskIsCalledAsItsFileUnlessThatIsUnwanted)
{
  const auto liver = this->WriteMask("liver.nii", 0, 40);
  EXPECT_EQ(Describe(this->Read({ liver }).labels), (Texts{ "1 liver 40" }));
  rhombic::LabelMapSource source{ { liver } };
  source.namesMask = false;
  EXPECT_EQ(Describe(rhombic::FindLabels(rhombic::ReadScan(liver), source)), (Texts{ "1 label 1 40" }));
}

TEST_F(LabelFiles, LabelsThatOverlapAreNoImage)
{
  this->WriteMask("liver.nii", 0, 40);
  this->WriteMask("spleen.nii", 50, 60);
  const auto reader = itk::ScanFileReader<itk::Image<std::uint8_t, 3>>::New();
  reader->SetFileName(m_Masks.string());
  reader->Update();
  this->WriteMask("tumour.nii", 30, 45);
  const auto other = itk::ScanFileReader<itk::Image<std::uint8_t, 3>>::New();
  other->SetFileName(m_Masks.string());
  EXPECT_THROW(other->Update(), Failure);
}

TEST_F(LabelFiles, WhatIsNoMaskOfTheGridIsRefused)
{
  this->WriteMask("liver.nii", 0, 40);
  const auto moved = this->Write("moved.nii", { 1, 0 }, 0.1);
  EXPECT_EQ(KindOfReading(m_Masks, "moved.nii for one segmentation"), FailureKind::Geometry);
  EXPECT_EQ(KindOfReading(m_Masks, "liver.nii"), FailureKind::Geometry);
  fs::remove(moved);
  std::vector<std::uint8_t> values;
  for (std::size_t n = 0; n < Voxels; ++n)
  {
    values.push_back(static_cast<std::uint8_t>(n + 1));
  }
  this->Write("ct.nii", values);
  EXPECT_EQ(KindOfReading(m_Masks, "ct.nii for a mask"), FailureKind::Unreadable);
}

TEST_F(LabelFiles, FoldersWithDicomFilesStaySo)
{
  this->WriteMask("liver.nii", 0, 40);
  fs::create_directories(m_Masks / "slices");
  for (int k = 0; k < 3; ++k)
  {
    DicomTestFile file(4, 4);
    file.SetPosition("0\\0\\" + std::to_string(k));
    file.Write(m_Masks / "slices" / (std::to_string(k) + ".dcm"));
  }
  EXPECT_EQ(rhombic::ReadScan(m_Masks).format, "DICOM");
}

TEST_F(LabelFiles, ASingleMaskIsCalledAsItsFile)
{
  EXPECT_EQ(Describe(this->Read({ this->WriteMask("liver.nii", 0, 40) }).labels), Texts{ "1 liver 40" });
  EXPECT_EQ(Describe(this->Read({ this->WriteMask("liver.nii", 0, 40, 255) }).labels), Texts{ "255 liver 40" });
  EXPECT_EQ(Describe(this->Read({ this->WriteMask("liver.nii", 0, 40, 4) }).labels), Texts{ "4 label 4 40" });
  this->WriteMask("liver.nii", 0, 40);
  std::ofstream(m_Folder / "dataset.json") << "{\"labels\": {\"background\": 0, \"spleen\": 1}}";
  EXPECT_EQ(Describe(this->Read({ m_Masks / "liver.nii" }).labels), Texts{ "1 spleen 40" });
}

TEST_F(LabelFiles, ADatasetMakesNoLabelMapOfIntensities)
{
  std::vector<std::uint8_t> values;
  for (std::size_t n = 0; n < Voxels; ++n)
  {
    values.push_back(static_cast<std::uint8_t>(n + 1));
  }
  std::ofstream(m_Folder / "dataset.json") << "{\"labels\": {\"background\": 0, \"spleen\": 1}}";
  EXPECT_THROW(this->Read({ this->Write("ct.nii", values) }), Failure);
}

} // namespace
