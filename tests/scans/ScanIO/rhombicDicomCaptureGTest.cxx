#include "rhombicDicomCapture.h"
#include "rhombicDicomTestFile.h"
#include "rhombicScanTest.h"

#include <gdcmImageReader.h>
#include <gdcmStringFilter.h>

#include <random>
#include <set>

namespace fs = std::filesystem;

namespace
{

using rhombic::DicomStudy;
using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::Picture;

class DicomCapture : public ScanTest
{
protected:
  /** A scan of three slices, with the elements that a test sets. */
  fs::path
  WriteScan(const std::vector<std::pair<std::uint32_t, std::string>> & texts = {}) const
  {
    for (int k = 0; k < 3; ++k)
    {
      DicomTestFile file(4, 4);
      for (const auto & [tag, text] : texts)
      {
        tag == 0x0020000d && text.empty() ? file.Remove(tag) : file.SetText(tag, "LO", text);
      }
      file.SetPosition("0\\0\\" + std::to_string(k));
      fs::create_directory(m_Folder / "scan");
      file.Write(m_Folder / "scan" / (std::to_string(k) + ".dcm"));
    }
    return m_Folder / "scan";
  }

  /** Writes frames as one file, and returns its bytes. */
  std::string
  Write(const DicomStudy & study, const std::vector<Picture> & frames, const std::string & name) const
  {
    rhombic::StagedFiles staged;
    rhombic::DicomCapture capture{ m_Folder / name, {}, 0.25 };
    for (const Picture & frame : frames)
    {
      capture.frames.push_back(&frame);
    }
    study.Stage({ capture }, "Rhombic 1", staged);
    staged.Commit();
    std::ifstream stream(m_Folder / name, std::ios::binary);
    return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
  }
};

Picture
RandomPicture(int width, int height, unsigned int seed)
{
  std::mt19937 random(seed);
  Picture picture(width, height);
  for (auto & byte : picture.pixels)
  {
    byte = static_cast<std::uint8_t>(random());
  }
  return picture;
}

std::string
TextOf(const gdcm::ImageReader & reader, std::uint32_t tag)
{
  gdcm::StringFilter filter;
  filter.SetFile(reader.GetFile());
  std::string text = filter.ToString(gdcm::Tag(tag));
  return text.substr(0, text.find_last_not_of(std::string(" \0", 2)) + 1);
}

TEST_F(DicomCapture, HoldsThePixelsAndTheStudy)
{
  const DicomStudy study(WriteScan({ { 0x00080005, "ISO_IR 192" },
                                     { 0x00080020, "20200102" },
                                     { 0x00100010, "M\xc3\xbcller^Eve" },
                                     { 0x00100020, "4711" } }),
                         {});
  for (int seed = 1; seed < 8; ++seed) // also pictures of an odd number of bytes
  {
    const std::vector<Picture> frames(static_cast<std::size_t>(1 + seed % 3),
                                      RandomPicture(20 + seed, 31 + seed % 2, static_cast<unsigned int>(seed)));
    Write(study, frames, "a.dcm");
    gdcm::ImageReader reader;
    reader.SetFileName((m_Folder / "a.dcm").c_str());
    ASSERT_TRUE(reader.Read());
    const auto & image = reader.GetImage();
    const bool isSingle = frames.size() == 1;
    EXPECT_EQ(image.GetNumberOfDimensions(), isSingle ? 2u : 3u);
    std::vector<char> pixels(image.GetBufferLength());
    ASSERT_TRUE(image.GetBuffer(pixels.data()));
    ASSERT_EQ(pixels.size(), frames.size() * frames.front().pixels.size());
    for (std::size_t n = 0; n < frames.size(); ++n)
    {
      EXPECT_TRUE(std::equal(frames[n].pixels.begin(),
                             frames[n].pixels.end(),
                             reinterpret_cast<const std::uint8_t *>(pixels.data()) + n * frames[n].pixels.size()));
    }
    EXPECT_EQ(TextOf(reader, 0x00080016), isSingle ? "1.2.840.10008.5.1.4.1.1.7" : "1.2.840.10008.5.1.4.1.1.7.4");
    EXPECT_EQ(TextOf(reader, 0x00100010), "M\xc3\xbcller^Eve");
    EXPECT_EQ(TextOf(reader, 0x00080005), "ISO_IR 192");
    EXPECT_EQ(TextOf(reader, 0x00100020), "4711");
    EXPECT_EQ(TextOf(reader, 0x00080020), "20200102");
    EXPECT_EQ(TextOf(reader, 0x0020000d), "1.2.3");
    EXPECT_NE(TextOf(reader, 0x0020000e), "1.2.3.4.5") << "a series of its own";
    EXPECT_EQ(TextOf(reader, 0x00280301), "YES");
    EXPECT_TRUE(reader.GetFile().GetDataSet().FindDataElement(gdcm::Tag(0x0010, 0x0030))) << "type 2: empty";
  }
}

TEST_F(DicomCapture, UIDsFollowFromStudyAndPictures)
{
  const DicomStudy study(WriteScan(), {});
  const std::vector<Picture> frames{ RandomPicture(8, 9, 1) };
  const std::string bytes = Write(study, frames, "a.dcm");
  EXPECT_EQ(Write(study, frames, "b.dcm"), bytes);
  EXPECT_EQ(Write(DicomStudy(WriteScan(), {}), frames, "c.dcm"), bytes);
  std::set<std::string> uids;
  const auto add = [&](const DicomStudy & other, const std::vector<Picture> & pictures) {
    Write(other, pictures, "d.dcm");
    gdcm::ImageReader reader;
    reader.SetFileName((m_Folder / "d.dcm").c_str());
    ASSERT_TRUE(reader.Read());
    for (const std::uint32_t tag : { 0x00080018u, 0x0020000eu })
    {
      const std::string uid = TextOf(reader, tag);
      EXPECT_EQ(uid.rfind("2.25.", 0), 0u);
      EXPECT_LE(uid.size(), 64u);
      EXPECT_NE(uid[5], '0');
      EXPECT_TRUE(uids.insert(uid).second) << uid;
    }
  };
  for (unsigned int seed = 1; seed < 30; ++seed)
  {
    add(study, { RandomPicture(8, 9, seed) });
  }
  add(study, { frames[0], frames[0] });
  add(DicomStudy(WriteScan({ { 0x0020000d, "1.2.9" } }), {}), frames);
}

TEST_F(DicomCapture, RefusesWhatHasNoStudyOrWouldBecomePartOfTheScan)
{
  const fs::path scan = WriteScan();
  const DicomStudy study(scan, {});
  EXPECT_THROW(study.CheckPath(scan / "picture.dcm"), Failure);
  EXPECT_THROW(study.CheckPath(scan / "sub" / "picture.dcm"), Failure);
  EXPECT_NO_THROW(study.CheckPath(m_Folder / "picture.dcm"));
  EXPECT_NO_THROW(study.CheckPath(m_Folder / "scan2" / "picture.dcm"));
  EXPECT_THROW(Write(study, { Picture(4, 4, 4) }, "alpha.dcm"), Failure);
  EXPECT_FALSE(fs::exists(m_Folder / "alpha.dcm"));
  try
  {
    DicomStudy(WriteScan({ { 0x0020000d, "" } }), {});
    FAIL();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Unreadable);
  }
  try
  {
    DicomStudy(RHOMBIC_TESTDATA "/phantom/phantom.nii.gz", {});
    FAIL();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Usage);
  }
}

} // namespace
