#ifndef rhombicScanTable_h
#define rhombicScanTable_h

#include "rhombicScanTest.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

/** \file
 * Tests that read many files, each with its expected result. */
namespace rhombictest
{

/** The expected result of reading. */
struct Expected
{
  std::optional<rhombic::FailureKind> failure;
  const char * says; ///< part of the failure's sentence, or of the volume's description
};

/** The result of reading. */
struct Reading
{
  std::optional<rhombic::Scan> scan;
  std::optional<rhombic::FailureKind> failure;
  std::string text; ///< the failure's sentence, or the volume's description
};

inline std::string
Join(const double * numbers, char separator)
{
  std::ostringstream text;
  text.precision(5);
  for (int axis = 0; axis < 3; ++axis)
  {
    text << (axis > 0 ? std::string(1, separator) : "") << numbers[axis] + 0.0; // no -0
  }
  return text.str();
}

/** Modality, pixel type, size, spacing, first voxel's position (LPS) and range, in words. */
inline std::string
Describe(const rhombic::Scan & scan)
{
  const auto & geometry = rhombic::GeometryOf(scan.image);
  const auto size = geometry.GetLargestPossibleRegion().GetSize();
  const double counts[3] = { double(size[0]), double(size[1]), double(size[2]) };
  const auto [lowest, highest] = IntensityRange(scan.image);
  std::ostringstream text;
  text << scan.modality << ' ' << rhombic::PixelTypeName(scan.image) << ' ' << Join(counts, 'x') << " of "
       << Join(geometry.GetSpacing().GetDataPointer(), 'x') << " mm from "
       << Join(geometry.GetOrigin().GetDataPointer(), ',') << ", " << lowest << ".." << highest;
  return text.str();
}

/** Reads without output to the terminal. */
inline Reading
Read(const std::filesystem::path & path, const rhombic::ScanReadOptions & options)
{
  Reading reading;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  try
  {
    reading.scan = rhombic::ReadScan(path, options);
    reading.text = Describe(*reading.scan);
  }
  catch (const rhombic::Failure & failure)
  {
    reading.failure = failure.GetKind();
    reading.text = failure.GetDescription();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "") << path;
  return reading;
}

inline void
ExpectReading(const Reading & reading, const Expected & expected)
{
  const auto codeOf = [](const auto & failure) { return failure ? static_cast<int>(*failure) : 0; };
  EXPECT_EQ(codeOf(reading.failure), codeOf(expected.failure)) << reading.text;
  EXPECT_NE(reading.text.find(expected.says), std::string::npos) << reading.text << "\nis not: " << expected.says;
}

/** Values in the order in which they are stored. */
inline std::vector<double>
VoxelsOf(const rhombic::Scan & scan)
{
  return std::visit(
    [](const auto & image) {
      const auto * const first = image->GetBufferPointer();
      return std::vector<double>(first, first + image->GetBufferedRegion().GetNumberOfPixels());
    },
    scan.image);
}

inline std::string
ReadBytes(const std::filesystem::path & path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/** A DICOM file's bytes with one of the three numbers of its ImagePositionPatient changed by 1; unchanged when there
 * are none. Made without a parser, since files may be damaged. */
inline std::string
MoveSlice(std::string bytes, int axis)
{
  using namespace std::string_literals;
  const auto changeDigit = [&bytes, axis](std::size_t digit, std::size_t length) {
    const std::size_t end = digit + length;
    if (end > bytes.size() || length > 100)
    {
      return;
    }
    for (int n = 0; n < axis; ++n)
    {
      digit = bytes.find('\\', digit) + 1;
    }
    while (digit + 1 < end && std::isdigit(bytes[digit + 1]) != 0)
    {
      ++digit; // to the one before the point
    }
    bytes[digit] = static_cast<char>(bytes[digit] == '9' ? '8' : bytes[digit] + 1);
  };
  const auto byteAt = [&bytes](std::size_t n) { return std::size_t{ static_cast<unsigned char>(bytes.at(n)) }; };
  if (const auto tag = bytes.find("\x20\x00\x32\x00"s
                                  "DS");
      tag != std::string::npos)
  {
    changeDigit(tag + 8, byteAt(tag + 6));
  }
  else if (const auto bigEndian = bytes.find("\x00\x20\x00\x32"s
                                             "DS");
           bigEndian != std::string::npos)
  {
    changeDigit(bigEndian + 8, byteAt(bigEndian + 7));
  }
  else if (const auto implicit = bytes.find("\x20\x00\x32\x00"s); implicit != std::string::npos)
  {
    changeDigit(implicit + 8, byteAt(implicit + 4));
  }
  return bytes;
}

/** Makes a folder of a file and its copy, moved along an axis, so that there is something to decode. */
inline std::filesystem::path
MakePair(const std::filesystem::path & file, const std::filesystem::path & folder, int axis)
{
  std::filesystem::create_directory(folder);
  const std::string bytes = ReadBytes(file);
  std::ofstream(folder / "0.dcm", std::ios::binary) << bytes;
  std::ofstream(folder / "1.dcm", std::ios::binary) << MoveSlice(bytes, axis);
  return folder;
}

} // namespace rhombictest

/** Tests with real scans, which are no part of the project: RHOMBIC_SCANS says where they are. */
class ScanTable : public ScanTest
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
    m_Scans = std::filesystem::path(folder);
  }

  /** Leaves out files that are missing. */
  static bool
  IsThere(const std::filesystem::path & path)
  {
    return std::filesystem::exists(path);
  }

  std::filesystem::path m_Scans;
};

#endif
