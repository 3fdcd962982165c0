#ifndef rhombicScanTest_h
#define rhombicScanTest_h

#include "rhombicFailure.h"
#include "rhombicReadScan.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

/** A test with a folder of its own for input files. */
class ScanTest : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  const std::filesystem::path m_Folder = m_TemporaryFolder.Path();
};

namespace rhombictest
{

/** The smallest and the largest of the finite values. */
inline std::pair<double, double>
IntensityRange(const rhombic::ScanImage & image)
{
  std::pair<double, double> range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
  std::visit(
    [&range](const auto & pixels) {
      for (std::size_t n = 0; n < pixels->GetBufferedRegion().GetNumberOfPixels(); ++n)
      {
        const auto value = static_cast<double>(pixels->GetBufferPointer()[n]);
        if (std::isfinite(value))
        {
          range.first = std::min(range.first, value);
          range.second = std::max(range.second, value);
        }
      }
    },
    image);
  return range;
}

} // namespace rhombictest

/** Options that choose a series. */
inline rhombic::ScanReadOptions
Series(const std::string & name)
{
  rhombic::ScanReadOptions options;
  options.series = name;
  return options;
}

/** A sentence without the folder of temporary files, whose name may have several lines. */
inline std::string
WithoutTemporaryFolder(std::string sentence)
{
  std::error_code isMissing;
  const std::string folder = std::filesystem::temp_directory_path(isMissing).string();
  if (folder.empty())
  {
    return sentence;
  }
  for (auto found = sentence.find(folder); found != std::string::npos; found = sentence.find(folder))
  {
    sentence.erase(found, folder.size());
  }
  return sentence;
}

/** Reads a path that must fail without output, with one sentence that contains \a named; returns the kind of failure.
 */
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
    EXPECT_EQ(WithoutTemporaryFolder(sentence).find('\n'), std::string::npos) << sentence;
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
