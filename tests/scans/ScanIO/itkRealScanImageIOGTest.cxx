#include "itkNativeScanFileReader.h"
#include "itkRefusal.h"
#include "itkScanImageIO.h"
#include "rhombicScanTable.h"

#include "itkGDCMImageIO.h"
#include "itkImageFileReader.h"
#include "itkImageSeriesReader.h"

#include <algorithm>

/** Every path of the real scans, and of damaged ones beside them, by itk::ImageFileReader and by the readers of scans.
 */
namespace
{

namespace fs = std::filesystem;
using DoubleImage = itk::Image<double, 3>;
using FloatImage = itk::Image<float, 3>;

class RealScanImageIO : public ScanTable
{
protected:
  /** All folders and files. */
  std::vector<fs::path>
  ListPaths() const
  {
    std::vector<fs::path> paths{ m_Scans };
    for (const fs::path & root : { m_Scans, m_Scans.parent_path() / "malformed" })
    {
      for (const auto & entry : fs::recursive_directory_iterator(root, fs::directory_options::skip_permission_denied))
      {
        paths.push_back(entry.path());
      }
    }
    return paths;
  }
};

/** The scan at a path; nothing when it is refused. */
std::optional<rhombic::Scan>
ReadNative(const fs::path & path)
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(path.string());
  try
  {
    reader->Update();
  }
  catch (const rhombic::Failure &)
  {
    return {};
  }
  return *reader->GetOutput()->Get();
}

template <typename TImage>
typename itk::ImageFileReader<TImage>::Pointer
MakeReader(const fs::path & path, itk::ImageIOBase * io)
{
  const auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetImageIO(io);
  reader->SetFileName(path.string());
  return reader;
}

void
ExpectSameGeometry(const itk::ImageBase<3> & actual, const itk::ImageBase<3> & expected, const fs::path & path)
{
  EXPECT_EQ(actual.GetLargestPossibleRegion(), expected.GetLargestPossibleRegion()) << path;
  EXPECT_EQ(actual.GetOrigin(), expected.GetOrigin()) << path;
  EXPECT_EQ(actual.GetSpacing(), expected.GetSpacing()) << path;
  EXPECT_EQ(actual.GetDirection(), expected.GetDirection()) << path;
}

void
ExpectSame(const DoubleImage & actual, const rhombic::Scan & scan, const fs::path & path)
{
  ExpectSameGeometry(actual, rhombic::GeometryOf(scan.image), path);
  std::visit(
    [&](const auto & image) {
      using Pixel = typename std::decay_t<decltype(*image)>::PixelType;
      const Pixel * const begin = image->GetBufferPointer();
      const Pixel * const end = begin + image->GetBufferedRegion().GetNumberOfPixels();
      const auto isSame = [](Pixel value, double other) { return value == static_cast<Pixel>(other); }; // of 64 bits
      EXPECT_TRUE(std::equal(begin, end, actual.GetBufferPointer(), isSame)) << path;
    },
    scan.image);
}

TEST_F(RealScanImageIO, ReadsAllPathsAsScanFileReaderDoes)
{
  std::size_t read = 0;
  for (const fs::path & path : this->ListPaths())
  {
    const auto scan = ReadNative(path);
    const auto io = itk::ScanImageIO::New();
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const bool isOurs = io->CanReadFile(path.c_str());
    const auto reader = MakeReader<DoubleImage>(path, io);
    const std::string refusal = Refusal([&] { reader->Update(); });
    EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "") << path;
    const bool isImage = scan && scan->furtherLayers.empty();
    if (isImage)
    {
      EXPECT_TRUE(isOurs) << path;
      EXPECT_EQ(refusal, "") << path;
      ExpectSame(*reader->GetOutput(), *scan, path);
      ++read;
    }
    else if (refusal.empty())
    {
      EXPECT_TRUE(isOurs && fs::is_regular_file(path)) << path;
      EXPECT_EQ(reader->GetOutput()->GetLargestPossibleRegion().GetSize(2), 1u) << path << " is not a single slice";
    }
  }
  EXPECT_GT(read, 50u);
}

/** Reads files as a series. */
FloatImage::Pointer
ReadSeries(const std::vector<std::string> & files, itk::ImageIOBase * io)
{
  const auto reader = itk::ImageSeriesReader<FloatImage>::New();
  reader->SetImageIO(io);
  reader->SetFileNames(files);
  reader->Update();
  return reader->GetOutput();
}

TEST_F(RealScanImageIO, GivesImageSeriesReaderWhatGDCMGivesIt)
{
  itk::Object::GlobalWarningDisplayOff(); // ImageSeriesReader's about files that are not in the order of their slices
  std::size_t compared = 0;
  for (const fs::path & path : this->ListPaths())
  {
    const auto scan = fs::is_directory(path) ? ReadNative(path) : std::nullopt;
    if (!scan || scan->format != "DICOM" ||
        scan->files.size() != rhombic::GeometryOf(scan->image).GetLargestPossibleRegion().GetSize(2))
    {
      continue;
    }
    const std::vector<std::string> files(scan->files.begin(), scan->files.end());
    const auto ours = ReadSeries(files, itk::ScanImageIO::New());
    testing::internal::CaptureStderr(); // GDCM prints
    const auto theirs = ReadSeries(files, itk::GDCMImageIO::New());
    testing::internal::GetCapturedStderr();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(ours->GetOrigin()[axis], theirs->GetOrigin()[axis], 1e-6) << path;
      EXPECT_NEAR(ours->GetSpacing()[axis], theirs->GetSpacing()[axis], 1e-6) << path;
      for (unsigned int row = 0; row < 3; ++row)
      {
        EXPECT_NEAR(ours->GetDirection()[row][axis], theirs->GetDirection()[row][axis], 1e-5) << path;
      }
    }
    ASSERT_EQ(ours->GetBufferedRegion(), theirs->GetBufferedRegion()) << path;
    const float * const values = ours->GetBufferPointer();
    const std::size_t count = ours->GetBufferedRegion().GetNumberOfPixels();
    const auto [own, other] = std::mismatch(values, values + count, theirs->GetBufferPointer());
    EXPECT_EQ(own, values + count) << path << ": " << *own << " is " << *other << " at " << own - values;
    ++compared;
  }
  itk::Object::GlobalWarningDisplayOn();
  EXPECT_GT(compared, 5u);
}

} // namespace
