#include "rhombicDicomTestFile.h"
#include "rhombicScanTest.h"
#include "rhombicUnpackDicom.h"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>

#include <cstring>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;

constexpr const char * RunLengths = "1.2.840.10008.1.2.5";
constexpr std::uint16_t Size = 8;
constexpr std::size_t Bytes = 2 * Size * Size;

/** A frame of 16-bit pixels that all have one value, as run lengths (PS3.5, annex G). */
std::string
RunLengthFrame(std::uint16_t value)
{
  const auto number = [](std::uint32_t n) {
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &n, 4);
    return bytes;
  };
  const std::string run{ static_cast<char>(-(Size * Size - 1)) };
  const std::string high = run + static_cast<char>(value >> 8);
  const std::string low = run + static_cast<char>(value & 255);
  return number(2) + number(64) + number(66) + std::string(52, '\0') + high + low;
}

DicomTestFile
MakeSlice(std::size_t k)
{
  DicomTestFile file(Size, Size);
  file.SetFragments({ RunLengthFrame(static_cast<std::uint16_t>(300 + k)) });
  file.SetPosition("0\\0\\" + std::to_string(2 * k));
  return file;
}

/** A file with a private sequence that is so deep that GDCM would crash. */
DicomTestFile
MakeDeadlySlice(std::size_t k)
{
  DicomTestFile file = MakeSlice(k);
  file.SetText(0x00090010, "LO", "RHOMBIC TEST");
  file.SetNestedSequences(0x00091001, 20000);
  return file;
}

class DicomFrames : public ScanTest
{
protected:
  fs::path
  Write(const DicomTestFile & file, const std::string & name) const
  {
    file.Write(m_Folder / name, RunLengths);
    return m_Folder / name;
  }

  /** The message with which decoding fails. */
  static std::string
  FailureOf(const fs::path & path)
  {
    try
    {
      EXPECT_EQ(rhombictest::UnpackFirstFrame(path).size(), Bytes);
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Unreadable);
      const std::string sentence = failure.GetDescription();
      EXPECT_NE(sentence.find(path.string()), std::string::npos) << sentence;
      return sentence;
    }
    return "none";
  }
};

TEST_F(DicomFrames, HeadersDoNotReachTheChild)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    this->Write(MakeSlice(k), "slice" + std::to_string(k));
    fs::create_directory(m_Folder / "deadly");
    this->Write(MakeDeadlySlice(k), "deadly/slice" + std::to_string(k));
  }
  const auto scan = rhombic::ReadScan(m_Folder / "deadly");
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 3, 4, static_cast<long>(k) } }),
              300 + static_cast<int>(k) - 1024);
  }
}

TEST_F(DicomFrames, FolderNamesTheFileThatIsDamaged)
{
  for (std::size_t k = 0; k < 5; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    if (k == 2)
    {
      file.SetFragments({ "damaged" });
    }
    this->Write(file, "slice" + std::to_string(k));
  }
  rhombic::ScanReadOptions options;
  EXPECT_EQ(KindOfReading(m_Folder, "slice2: the table before its run lengths", options), FailureKind::Unreadable);
  options.onGap = rhombic::ScanReadOptions::Policy::Accept;
  options.onUneven = rhombic::ScanReadOptions::Policy::Accept;
  const auto scan = rhombic::ReadScan(m_Folder, options);
  EXPECT_EQ(scan.sliceOrigins.size(), 4u);
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 2 } }), 303 - 1024);
  EXPECT_NE(scan.fileNotes.at(0).find("slice2"), std::string::npos) << scan.fileNotes[0];
}

// Only the header says so, long after the stream was made.
TEST_F(DicomFrames, RefusesValuesOfMoreBitsThanAnnounced)
{
  for (const bool isSigned : { false, true })
  {
    std::vector<std::uint16_t> pixels(std::size_t{ Size } * Size, isSigned ? 0xf800 : 4095);
    DicomTestFile file(Size, Size);
    file.SetShort(0x00280103, isSigned ? 1 : 0);
    const auto recompress = [&](std::uint16_t value) {
      pixels[9] = value;
      file.SetPixels(pixels);
      file.Write(m_Folder / "raw");
      gdcm::ImageReader reader;
      reader.SetFileName((m_Folder / "raw").c_str());
      EXPECT_TRUE(reader.Read());
      gdcm::ImageChangeTransferSyntax change;
      change.SetTransferSyntax(gdcm::TransferSyntax::JPEG2000Lossless);
      change.SetInput(reader.GetImage());
      EXPECT_TRUE(change.Change());
      const auto & stream = change.GetOutput().GetDataElement().GetSequenceOfFragments()->GetFragment(0);
      const gdcm::ByteValue & bytes = *stream.GetByteValue();
      DicomTestFile compressed = file;
      compressed.SetShort(0x00280101, 12);
      compressed.SetShort(0x00280102, 11);
      compressed.SetFragments({ std::string(bytes.GetPointer(), bytes.GetLength()) });
      compressed.Write(m_Folder / "compressed", "1.2.840.10008.1.2.4.90");
      return FailureOf(m_Folder / "compressed");
    };
    EXPECT_EQ(recompress(17), "none");
    const std::string sentence = recompress(isSigned ? 0x0801 : 4097);
    EXPECT_NE(sentence.find("more than the 12 bits"), std::string::npos) << sentence << " for " << isSigned;
  }
}

TEST_F(DicomFrames, RefusesDamagedRunLengths)
{
  const auto sentenceOf = [&](std::string frame) {
    DicomTestFile file = MakeSlice(0);
    file.SetFragments({ std::move(frame) });
    return FailureOf(this->Write(file, "damaged"));
  };
  std::string tooShort = RunLengthFrame(300);
  tooShort[64] = static_cast<char>(-(Size * Size - 2));
  std::string tooLong = RunLengthFrame(300);
  tooLong[66] = static_cast<char>(-(Size * Size));
  std::string noTable = RunLengthFrame(300);
  noTable[0] = 15;
  std::string behindEnd = RunLengthFrame(300);
  behindEnd[8] = 127;
  for (const std::string & frame : { tooShort, tooLong, noTable, behindEnd, std::string("short") })
  {
    EXPECT_NE(sentenceOf(frame).find("run lengths"), std::string::npos) << sentenceOf(frame);
  }
}

} // namespace
