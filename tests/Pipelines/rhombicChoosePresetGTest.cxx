#include "../scans/ScanIO/rhombicDicomTestFile.h"
#include "rhombicDescribeScan.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t BodyPartExamined = 0x00180015;
constexpr std::uint32_t Units = 0x00541001;

/** A scan of 8 x 8 x 8 voxels with values from lowest to highest. */
rhombic::Scan
MakeScan(const std::string & modality, float lowest, float highest)
{
  using ImageType = itk::Image<float, 3>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 8, 8, 8 } });
  image->Allocate();
  for (std::size_t n = 0; n < 512; ++n)
  {
    const auto share = static_cast<float>(n * 37 % 512) / 511.0f; // neighbours differ: no label map
    image->GetBufferPointer()[n] = lowest + share * (highest - lowest);
  }
  rhombic::Scan scan;
  scan.image = image;
  scan.modality = modality;
  return scan;
}

/** The choice for a scan, with its reason: "ct-bone, as ...". */
std::string
ChoiceFor(const rhombic::Scan & scan, bool hasLabels = false)
{
  return rhombic::ChoosePreset(scan, hasLabels).Describe();
}

void
ExpectChoice(const std::string & choice, const std::string & preset, const std::string & word)
{
  EXPECT_EQ(choice.substr(0, choice.find(',')), preset) << choice;
  EXPECT_NE(choice.find(word), std::string::npos) << choice;
}

TEST(ChoosePreset, TakesCTsByTheirValues)
{
  ExpectChoice(ChoiceFor(MakeScan("CT", -1024.0f, 1500.0f)), "ct-bone-skin", "CT in HU");
  ExpectChoice(ChoiceFor(MakeScan("CT", -1024.0f, 1500.0f), true), "ct-organs", "labels");
  ExpectChoice(ChoiceFor(MakeScan("CT", -1024.0f, 200.0f)), "ct-skin", "without values of bone");
  ExpectChoice(ChoiceFor(MakeScan("CT", -250.0f, 900.0f)), "ct-bone", "without air");
  ExpectChoice(ChoiceFor(MakeScan("CT", -1024.0f, -770.0f)), "outline", "of both sides of skin or bone");
  ExpectChoice(ChoiceFor(MakeScan("CT", 0.0f, 3926.0f)), "uncalibrated-ct", "(0 to 3926) are not taken for HU");
  ExpectChoice(ChoiceFor(MakeScan("CT", 0.0f, 3926.0f), true), "none", "labels");
  ExpectChoice(ChoiceFor(MakeScan("", -1024.0f, 1500.0f)), "ct-bone-skin", "are those of a CT");
}

TEST(ChoosePreset, CallsNothingAHeadThatMayBeNone)
{
  ExpectChoice(ChoiceFor(MakeScan("MR", 0.0f, 900.0f)), "mr-outline", "no body part");
  ExpectChoice(ChoiceFor(MakeScan("PT", 0.0f, 60000.0f)), "pet-hot-spots", "PET");
  ExpectChoice(ChoiceFor(MakeScan("", 0.0f, 900.0f)), "outline", "does not say what it is");
  ExpectChoice(ChoiceFor(MakeScan("NM", 0.0f, 900.0f)), "outline", "modality NM");
  ExpectChoice(ChoiceFor(MakeScan("MR", 0.0f, 900.0f), true), "none", "labels");
}

TEST(ChoosePreset, TakesBodyPartAndUnitsFromDicom)
{
  const rhombictest::TemporaryFolder folder;
  const fs::path path = folder.Path() / "slice.dcm";
  DicomTestFile file(8, 8);
  const auto choiceFor = [&](const std::string & modality) {
    file.Write(path);
    rhombic::Scan scan = MakeScan(modality, 0.0f, 900.0f);
    scan.format = "DICOM";
    scan.files = { path };
    return ChoiceFor(scan);
  };
  for (const char * part : { "HEAD", "BRAIN", "SKULL" })
  {
    file.SetText(BodyPartExamined, "CS", part);
    ExpectChoice(choiceFor("MR"), "mr-head", part);
  }
  file.SetText(BodyPartExamined, "CS", "ABDOMEN");
  ExpectChoice(choiceFor("MR"), "mr-outline", "ABDOMEN");
  file.SetText(BodyPartExamined, "CS", "Head of J. Doe");
  const std::string freeText = choiceFor("MR");
  ExpectChoice(freeText, "mr-outline", "no body part");
  file.SetText(Units, "CS", "BQML");
  ExpectChoice(choiceFor("PT"), "pet-hot-spots", "in Bq/ml (not turned into SUV)");
  file.SetText(Units, "CS", "GML");
  const std::string standardized = choiceFor("PT");
  ExpectChoice(standardized, "pet-hot-spots", "in g/ml;");
}

TEST(ChoosePreset, OfRealScans)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const std::vector<std::pair<std::string, std::string>> expected{
    { "pet_slope_per_slice_dicom_rle", "pet-hot-spots" },
    { "ct_head_ge8800_dicom", "uncalibrated-ct" },
    { "ct_body_totalseg_dicom_j2k", "ct-bone-skin" },
    { "ct_mr_dicom2stl_nifti/ct_example.nii.gz", "ct-bone-skin" },
    { "ct_mr_dicom2stl_nifti/mri_t1_example.nii.gz", "outline" },
    { "mr_head_t1_defaced_dicom_j2k", "mr-outline" },
  };
  for (const auto & [name, preset] : expected)
  {
    rhombic::ScanSource source;
    source.path = fs::path(scans) / name;
    const auto choice = rhombic::ChoosePreset(rhombic::LoadVolume(source, {}), false);
    EXPECT_EQ(choice.preset, preset) << choice.Describe();
  }
}

} // namespace
