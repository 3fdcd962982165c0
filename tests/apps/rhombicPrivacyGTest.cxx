#include "../scans/ScanIO/rhombicDicomTestFile.h"
#include "rhombicProgram.h"

#include "gdcmReader.h"
#include "gdcmStringFilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::TemporaryFolder;

struct Secret
{
  std::uint16_t group;
  std::uint16_t element;
  const char * representation;
  const char * text;
};

/** Tags that lead to the patient, with what they hold in the series that is made here. */
constexpr Secret secrets[] = {
  { 0x0008, 0x0012, "DA", "19831121" },           // InstanceCreationDate
  { 0x0008, 0x0018, "UI", "1.2.826.77001.11" },   // SOPInstanceUID
  { 0x0008, 0x0020, "DA", "19840712" },           // StudyDate
  { 0x0008, 0x0021, "DA", "19840713" },           // SeriesDate
  { 0x0008, 0x0022, "DA", "19840714" },           // AcquisitionDate
  { 0x0008, 0x0023, "DA", "19840715" },           // ContentDate
  { 0x0008, 0x0030, "TM", "101112.131415" },      // StudyTime
  { 0x0008, 0x0050, "SH", "ACC-5530417" },        // AccessionNumber
  { 0x0008, 0x0070, "LO", "Qzmanufacturer" },     // Manufacturer
  { 0x0008, 0x0080, "LO", "Qzhospital" },         // InstitutionName
  { 0x0008, 0x0081, "ST", "Qzstreet 17" },        // InstitutionAddress
  { 0x0008, 0x0090, "PN", "Qzreferrer^Ann" },     // ReferringPhysicianName
  { 0x0008, 0x1010, "SH", "Qzstation" },          // StationName
  { 0x0008, 0x1030, "LO", "Qzstudy of Qzname" },  // StudyDescription
  { 0x0008, 0x103e, "LO", "Qzseries of Qzname" }, // SeriesDescription
  { 0x0008, 0x1050, "PN", "Qzperformer^Bob" },    // PerformingPhysicianName
  { 0x0008, 0x1070, "PN", "Qzoperator^Eve" },     // OperatorsName
  { 0x0010, 0x0010, "PN", "Qzname^Secret" },      // PatientName
  { 0x0010, 0x0020, "LO", "PID-6640981" },        // PatientID
  { 0x0010, 0x0030, "DA", "19470231" },           // PatientBirthDate
  { 0x0010, 0x1000, "LO", "Qzotherid" },          // OtherPatientIDs
  { 0x0010, 0x1040, "LO", "Qzaddress" },          // PatientAddress
  { 0x0010, 0x2154, "SH", "0049-30-5550123" },    // PatientTelephoneNumbers
  { 0x0010, 0x4000, "LT", "Qzcomments" },         // PatientComments
  { 0x0018, 0x1000, "LO", "SN-9915503" },         // DeviceSerialNumber
  { 0x0018, 0x1030, "LO", "Qzprotocol" },         // ProtocolName
  { 0x0020, 0x000d, "UI", "1.2.826.77001.12" },   // StudyInstanceUID
  { 0x0020, 0x000e, "UI", "1.2.826.77001.13" },   // SeriesInstanceUID
  { 0x0020, 0x0010, "SH", "STUDY-118832" },       // StudyID
  { 0x0020, 0x0052, "UI", "1.2.826.77001.14" },   // FrameOfReferenceUID
  { 0x0020, 0x4000, "LT", "Qzimagecomments" },    // ImageComments
  { 0x0032, 0x1032, "PN", "Qzrequester^Tim" },    // RequestingPhysician
  { 0x0040, 0x0254, "LO", "Qzprocedure" },        // PerformedProcedureStepDescription
};

/** A ball of 1000 in water, with all of the secrets in its headers. */
void
WriteSeries(const fs::path & folder)
{
  constexpr std::uint16_t size = 24;
  fs::create_directory(folder);
  for (int k = 0; k < size; ++k)
  {
    DicomTestFile file(size, size);
    for (const Secret & secret : secrets)
    {
      file.SetText(std::uint32_t{ secret.group } << 16 | secret.element, secret.representation, secret.text);
    }
    file.SetText(0x00090010, "LO", "QZPRIVATE");
    file.SetText(0x00091001, "LO", "Qzprivate of Qzname");
    std::vector<std::int16_t> pixels;
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        const double radius = std::hypot(i - 11.5, j - 11.5, k - 11.5);
        pixels.push_back(static_cast<std::int16_t>(1024 + 1000 / (1 + std::exp(2 * (radius - 8)))));
      }
    }
    file.SetPixels(pixels);
    file.SetPosition("0\\0\\" + std::to_string(k));
    file.Write(folder / (std::to_string(k) + ".dcm"));
  }
}

/** The texts and dates that must not get out, and the part of them that names the patient. */
std::set<std::string>
SecretTexts()
{
  std::set<std::string> texts{ "Qzname", "QZPRIVATE", "Qzprivate" };
  for (const Secret & secret : secrets)
  {
    texts.insert(secret.text);
  }
  return texts;
}

/** What the same tags hold in a folder's files, read by GDCM; nothing that is too short to be told from chance. */
std::set<std::string>
SecretTextsOf(const fs::path & folder)
{
  std::set<std::string> texts;
  for (const auto & entry : fs::directory_iterator(folder))
  {
    gdcm::Reader reader;
    reader.SetFileName(entry.path().c_str());
    if (!reader.Read())
    {
      continue;
    }
    gdcm::StringFilter filter;
    filter.SetFile(reader.GetFile());
    for (const Secret & secret : secrets)
    {
      std::string text = filter.ToString(gdcm::Tag(secret.group, secret.element));
      text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
      const std::size_t shortest = secret.representation == std::string("UI") ? 10 : 7;
      if (text.size() >= shortest)
      {
        texts.insert(text);
      }
    }
  }
  return texts;
}

/** Runs every command on a scan and searches all that they say and write. */
void
ExpectNothingGetsOut(const fs::path & scan, const std::string & threshold, const std::set<std::string> & texts)
{
  const TemporaryFolder folder;
  ASSERT_GT(texts.size(), 3u);
  const std::string commands[] = {
    "info SCAN",
    "info --json SCAN",
    "-v info SCAN",
    "-v render SCAN --surface a=" + threshold + " --size 64 -o a.png",
    "render SCAN --surface a=" + threshold + " --size 64 -o a.tif",
    "render SCAN --surface a=" + threshold + " --size 64 -o a.jpg",
    "-v render SCAN --surface a=" + threshold + " -o a.html",
    // The one that is asked to; studies without a UID are refused.
    "render SCAN --surface a=" + threshold +
      " --size 64 --dicom-sc -o c.png && rm c.dcm || rhombic render SCAN --surface a=" + threshold +
      " --size 64 -o c.png",
    "-v mesh SCAN -t " + threshold + " -o a.stl",
    "mesh SCAN -t " + threshold + " -o a.ply",
    "mesh SCAN -t " + threshold + " -o a.vtp",
    "-v resample SCAN -o a.fcc.nrrd",
    "info --json a.fcc.nrrd",
    "resample a.fcc.nrrd -o a.nii",
    "resample a.fcc.nrrd -o a.nii.gz",
    "resample a.fcc.nrrd -o a.nrrd",
    "resample a.fcc.nrrd -o a.mha",
    "mesh SCAN/0.dcm -t 1 -o b.stl || true", // and what they say about mistakes
    "render SCAN --series 99 --preset ct-bone -o b.png || true",
    "mesh SCAN -t 99999 -o b.stl || true",
  };
  const auto search = [&texts](const std::string & bytes, const std::string & where) {
    for (const std::string & text : texts)
    {
      EXPECT_EQ(bytes.find(text), std::string::npos) << where << " holds " << text;
    }
  };
  for (std::string command : commands)
  {
    for (auto place = command.find("SCAN"); place != std::string::npos; place = command.find("SCAN", place))
    {
      command.replace(place, 4, "'" + scan.string() + "'");
    }
    const Outcome outcome = rhombictest::RunShell("rhombic " + command, folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << command << outcome.errors;
    search(outcome.output + outcome.errors, command);
  }
  std::size_t files = 0;
  for (const auto & entry : fs::directory_iterator(folder.Path()))
  {
    ++files;
    search(ReadText(entry.path()), entry.path().filename().string());
  }
  EXPECT_EQ(files, 26u) << "outputs and their sidecars";
}

TEST(Privacy, NothingAboutThePatientGetsOut)
{
  const TemporaryFolder folder;
  WriteSeries(folder.Path() / "scan");
  const auto texts = SecretTextsOf(folder.Path() / "scan");
  EXPECT_EQ(texts.size(), std::size(secrets)) << "the test's own series holds them all";
  ExpectNothingGetsOut(folder.Path() / "scan", "500.5", SecretTexts());
}

/** Copies the first slices of a series, under names of their own: the originals' are made of UIDs. */
void
CopySlices(const fs::path & from, const fs::path & to, std::size_t count)
{
  fs::create_directory(to);
  std::set<fs::path> files;
  for (const auto & entry : fs::directory_iterator(from))
  {
    if (entry.path().extension() != ".txt")
    {
      files.insert(entry.path());
    }
  }
  std::size_t copied = 0;
  for (const fs::path & file : files)
  {
    if (copied < count)
    {
      fs::copy_file(file, to / (std::to_string(copied++) + ".dcm"));
    }
  }
}

TEST(Privacy, NothingAboutRealPatientsGetsOut)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  struct Series
  {
    const char * folder;
    const char * threshold;
    std::size_t slices;
  };
  for (const Series & series :
       { Series{ "ct_head_ge8800_dicom", "500.5", 1000 }, Series{ "ct_body_totalseg_dicom_j2k", "200.5", 4 } })
  {
    SCOPED_TRACE(series.folder);
    if (fs::exists(fs::path(scans) / series.folder))
    {
      const TemporaryFolder folder;
      CopySlices(fs::path(scans) / series.folder, folder.Path() / "scan", series.slices);
      ExpectNothingGetsOut(folder.Path() / "scan", series.threshold, SecretTextsOf(folder.Path() / "scan"));
    }
  }
}

} // namespace
