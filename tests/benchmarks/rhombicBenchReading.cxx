#include "rhombicBenchReading.h"

#include "itkScanFileReader.h"
#include "rhombicFailure.h"

#include "itkGDCMImageIO.h"
#include "itkGDCMSeriesFileNames.h"
#include "itkImageSeriesReader.h"

#include <cstring>
#include <filesystem>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<std::int16_t, 3>;

VolumeType::Pointer
ReadWithITK(const std::vector<std::string> & names)
{
  const auto reader = itk::ImageSeriesReader<VolumeType>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names);
  reader->Update();
  return reader->GetOutput();
}

VolumeType::Pointer
ReadWithRhombic(const std::string & path)
{
  const auto reader = itk::ScanFileReader<VolumeType>::New();
  reader->SetFileName(path);
  reader->Update();
  return reader->GetOutput();
}

bool
AreSame(const VolumeType & first, const VolumeType & second)
{
  const auto & region = first.GetBufferedRegion();
  return second.GetBufferedRegion() == region && std::memcmp(first.GetBufferPointer(),
                                                             second.GetBufferPointer(),
                                                             region.GetNumberOfPixels() * sizeof(std::int16_t)) == 0;
}

} // namespace

std::vector<BenchResult>
MeasureReading(const std::string & path, const BenchSettings & settings)
{
  if (!std::filesystem::is_directory(path))
  {
    return {};
  }
  const auto search = itk::GDCMSeriesFileNames::New();
  search->SetInputDirectory(path);
  const std::vector<std::string> names = search->GetInputFileNames();

  if (!AreSame(*ReadWithITK(names), *ReadWithRhombic(path)))
  {
    throw Failure(FailureKind::Internal, "Two readers of " + path + " do not agree; the times mean nothing.");
  }
  BenchResult result;
  result.section = "reading";
  result.candidate = "itk::ScanFileReader";
  result.reference = "itk::ImageSeriesReader";
  result.threads = settings.threads;
  result.times = TimePairs(
    settings.repeats, [&] { return ReadWithITK(names); }, [&] { return ReadWithRhombic(path); });
  result.target = settings.threads > 1 ? std::optional<double>(1.5) : std::nullopt;
  return { result };
}

} // namespace rhombic
