#ifndef rhombicScanTest_h
#define rhombicScanTest_h

#include "rhombicFailure.h"
#include "rhombicScanReader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <unistd.h>

/** A test with a folder of its own for input files. */
class ScanTest : public testing::Test
{
protected:
  void
  SetUp() override
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "rhombic-scan-io-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    m_Folder = pattern;
  }

  void
  TearDown() override
  {
    std::filesystem::remove_all(m_Folder);
  }

  std::filesystem::path m_Folder;
};

/** Reads what must fail, silently, with one sentence that names \a named, and returns how. */
inline rhombic::FailureKind
KindOfReading(const std::filesystem::path & path,
              const std::string & named,
              const rhombic::ScanReadOptions & options = {})
{
  rhombic::FailureKind kind = rhombic::FailureKind::Internal;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  try
  {
    rhombic::ReadScan(path, options);
    ADD_FAILURE() << path << " was read";
  }
  catch (const rhombic::Failure & failure)
  {
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find(named), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
    kind = failure.GetKind();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "") << path;
  return kind;
}

template <typename TPixel>
const itk::Image<TPixel, 3> &
ImageOf(const rhombic::Scan & scan)
{
  return *std::get<typename itk::Image<TPixel, 3>::Pointer>(scan.image);
}

inline void
ExpectNear(const itk::Point<double, 3> & actual, const itk::Point<double, 3> & expected, double tolerance)
{
  EXPECT_LE(actual.EuclideanDistanceTo(expected), tolerance) << actual << " is not " << expected;
}

#endif
