#include "rhombicVolumeVoxels.h"

#include "rhombicFailure.h"
#include "rhombicQuietLibraries.h"
#include "rhombicVolumeFormat.h"
#include "rhombicVolumeRefusal.h"

#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"

#include <string>

namespace rhombic
{
namespace
{

itk::ImageIOBase::Pointer
NewImageIO(const std::filesystem::path & path)
{
  if (VolumeFormatOf(path) == "NRRD")
  {
    return itk::NrrdImageIO::New().GetPointer();
  }
  return itk::MetaImageIO::New().GetPointer();
}

} // namespace

void
DecodeVolumeFile(const std::filesystem::path & path, void * voxels, std::size_t size)
{
  const QuietLibraries quiet;
  try
  {
    const auto io = NewImageIO(path);
    io->SetFileName(path.string());
    io->ReadImageInformation();
    if (static_cast<std::size_t>(io->GetImageSizeInBytes()) != size)
    {
      RefuseVolume(path,
                   "ITK finds " + std::to_string(io->GetImageSizeInBytes()) + " bytes of voxels in it, not " +
                     std::to_string(size) + "; export it again from its source");
    }
    itk::ImageIORegion region(io->GetNumberOfDimensions());
    for (unsigned int axis = 0; axis < io->GetNumberOfDimensions(); ++axis)
    {
      region.SetSize(axis, io->GetDimensions(axis));
    }
    io->SetIORegion(region);
    io->Read(voxels);
  }
  catch (const Failure &)
  {
    throw;
  }
  catch (const itk::ExceptionObject & exception)
  {
    RefuseVolume(path, DescribeError(exception) + "; it may be damaged, so copy it again");
  }
}

} // namespace rhombic
