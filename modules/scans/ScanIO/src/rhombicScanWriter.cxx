#include "rhombicScanWriter.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicScanReader.h"

#include "itkImageFileWriter.h"
#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <cstring>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

itk::ImageIOBase::Pointer
MakeImageIO(const fs::path & path)
{
  const fs::path extension = path.extension();
  if (extension == ".nrrd")
  {
    return itk::NrrdImageIO::New().GetPointer();
  }
  if (extension == ".nii" || (extension == ".gz" && path.stem().extension() == ".nii"))
  {
    return itk::NiftiImageIO::New().GetPointer();
  }
  if (extension == ".mha")
  {
    return itk::MetaImageIO::New().GetPointer();
  }
  throw Failure(FailureKind::Usage,
                "Cannot write " + path.string() +
                  ": its extension names no volume format; use one of .nrrd, .nii, .nii.gz, .mha.");
}

/** NIfTI keeps positions as 32-bit floats. */
bool
HasSameGeometry(const itk::ImageBase<3> & a, const itk::ImageBase<3> & b)
{
  constexpr double coordinateTolerance = 1e-3; // mm
  constexpr double directionTolerance = 1e-5;
  const auto isNear = [](double first, double second, double tolerance) {
    return std::abs(first - second) < tolerance;
  };
  bool isSame = a.GetLargestPossibleRegion().GetSize() == b.GetLargestPossibleRegion().GetSize();
  for (unsigned int row = 0; row < 3; ++row)
  {
    isSame = isSame && isNear(a.GetOrigin()[row], b.GetOrigin()[row], coordinateTolerance) &&
             isNear(a.GetSpacing()[row] / b.GetSpacing()[row], 1.0, directionTolerance);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isSame = isSame && isNear(a.GetDirection()[row][axis], b.GetDirection()[row][axis], directionTolerance);
    }
  }
  return isSame;
}

template <typename TImage>
bool
IsSame(const TImage & image, const ScanImage & other)
{
  const auto * const read = std::get_if<typename TImage::Pointer>(&other);
  return read != nullptr && HasSameGeometry(image, **read) &&
         std::memcmp(image.GetBufferPointer(),
                     (*read)->GetBufferPointer(),
                     image.GetBufferedRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType)) == 0;
}

template <typename TImage>
void
WriteImage(const TImage & image, const fs::path & file, const fs::path & target)
{
  try
  {
    const auto writer = itk::ImageFileWriter<TImage>::New();
    writer->SetImageIO(MakeImageIO(target));
    writer->SetFileName(file.string());
    writer->SetInput(&image);
    writer->Update();
  }
  catch (const itk::ExceptionObject &)
  {
    throw Failure(FailureKind::Output, "Cannot write " + target.string() + ": writing failed; is the disk full?");
  }
}

} // namespace

void
CheckScanPath(const fs::path & path)
{
  MakeImageIO(path);
}

void
StageScan(const ScanImage & image, const fs::path & path, StagedFiles & staged)
{
  CheckScanPath(path);
  AtomicFile & file = staged.Begin(path);
  std::visit(
    [&](const auto & pixels) {
      WriteImage(*pixels, file.GetTemporaryPath(), path);
      bool isComplete = false;
      ScanReadOptions options;
      options.maximumMemory = std::numeric_limits<std::uintmax_t>::max(); // there was enough for the image itself
      try
      {
        isComplete = IsSame(*pixels, ReadVoxels(OpenScan(file.GetTemporaryPath(), options)).image);
      }
      catch (const Failure &)
      {
        isComplete = false; // the file is cut off
      }
      FailIf(!isComplete,
             FailureKind::Output,
             "Cannot write " + path.string() + ": the file does not hold the same volume; is the disk full?");
    },
    image);
  constexpr std::uintmax_t smallestHeader = 64;
  file.Flush(smallestHeader);
}

void
WriteScan(const ScanImage & image, const fs::path & path)
{
  StagedFiles staged;
  StageScan(image, path, staged);
  staged.Commit();
}

} // namespace rhombic
