#include "rhombicVolumeFile.h"

#include "rhombicFailure.h"
#include "rhombicMetaImageHeader.h"
#include "rhombicNIfTIHeader.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVolumePixels.h"

#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** "NIfTI", "NRRD" or "MetaImage" as the extension has it, or empty. */
std::string
FormatOf(const fs::path & path)
{
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  const auto endsWith = [&name](const std::string & extension) {
    return name.size() > extension.size() &&
           name.compare(name.size() - extension.size(), extension.size(), extension) == 0;
  };
  const auto endsWithAny = [&endsWith](std::initializer_list<const char *> extensions) {
    return std::any_of(extensions.begin(), extensions.end(), endsWith);
  };
  return endsWithAny({ ".nii", ".nii.gz", ".hdr", ".img", ".img.gz" }) ? "NIfTI"
         : endsWithAny({ ".nrrd", ".nhdr" })                           ? "NRRD"
         : endsWithAny({ ".mha", ".mhd" })                             ? "MetaImage"
                                                                       : "";
}

itk::ImageIOBase::Pointer
NewImageIO(const std::string & format)
{
  if (format == "NIfTI")
  {
    return itk::NiftiImageIO::New().GetPointer();
  }
  if (format == "NRRD")
  {
    return itk::NrrdImageIO::New().GetPointer();
  }
  return itk::MetaImageIO::New().GetPointer();
}

/** Refuses what is not one volume of single numbers, and the sizes along its three axes otherwise. */
itk::Size<3>
SizeOfScalarVolume(const itk::ImageIOBase & io, const fs::path & path)
{
  if (io.GetPixelType() != itk::IOPixelEnum::SCALAR || io.GetNumberOfComponents() != 1)
  {
    Refuse(path,
           "its pixels are " + itk::ImageIOBase::GetPixelTypeAsString(io.GetPixelType()) + "s of " +
             std::to_string(io.GetNumberOfComponents()) + " numbers, not single numbers; extract one component first");
  }
  itk::Size<3> size;
  size.Fill(1);
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    if (axis < 3)
    {
      size[axis] = io.GetDimensions(axis);
    }
    else if (io.GetDimensions(axis) != 1)
    {
      Refuse(path, "it has more than three dimensions; extract one volume first");
    }
  }
  if (io.GetNumberOfDimensions() < 3)
  {
    Refuse(path, "it is a flat picture of " + std::to_string(io.GetNumberOfDimensions()) + " dimensions, not a volume");
  }
  if (size[0] == 0 || size[1] == 0 || size[2] == 0)
  {
    Refuse(path, "it has no voxels");
  }
  return size;
}

/** The geometry as NRRD and MetaImage files have it: ITK's image IO gives it in LPS. */
VolumeGeometry
GeometryOf(const itk::ImageIOBase & io, const itk::Size<3> & size)
{
  VolumeGeometry geometry;
  geometry.size = size;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    geometry.origin[axis] = io.GetOrigin(axis);
    geometry.spacing[axis] = io.GetSpacing(axis);
    const std::vector<double> direction = io.GetDirection(axis);
    for (unsigned int row = 0; row < 3; ++row)
    {
      geometry.direction[row][axis] = direction.at(row);
    }
  }
  return geometry;
}

void
ReadInformation(itk::ImageIOBase & io, const fs::path & path, const std::string & format)
{
  io.SetFileName(path.string());
  if (!io.CanReadFile(path.c_str()))
  {
    Refuse(path, "its content is not " + format + ", as its name says; check where it came from");
  }
  try
  {
    io.ReadImageInformation();
  }
  catch (const itk::ExceptionObject & exception)
  {
    if (std::string(exception.GetDescription()).find("orthonormal") == std::string::npos)
    {
      throw;
    }
    throw Failure(FailureKind::Geometry,
                  "Cannot place " + path.string() +
                    " in the patient: ITK does not take its axes as perpendicular; resample it first.");
  }
}

/** Puts the lowest finite value in the place of values that are not finite, which would spread when the scan is
 * resampled. Returns how many there were. */
std::size_t
ReplaceNotFinite(const ScanImage & image)
{
  const auto * const pointer = std::get_if<itk::Image<float, 3>::Pointer>(&image);
  if (pointer == nullptr)
  {
    return 0;
  }
  float * const begin = (*pointer)->GetBufferPointer();
  float * const end = begin + (*pointer)->GetBufferedRegion().GetNumberOfPixels();
  float lowest = std::numeric_limits<float>::max();
  std::size_t count = 0;
  for (const float * value = begin; value != end; ++value)
  {
    const bool isFinite = std::isfinite(*value);
    count += isFinite ? 0 : 1;
    lowest = isFinite ? std::min(lowest, *value) : lowest;
  }
  if (count > 0)
  {
    std::replace_if(
      begin, end, [](float value) { return !std::isfinite(value); }, lowest);
  }
  return count;
}

} // namespace

bool
IsVolumeFileName(const fs::path & path)
{
  return !FormatOf(path).empty();
}

Scan
ReadVolumeFile(const fs::path & path)
{
  Scan scan;
  scan.format = FormatOf(path);

  // ITK aborts or corrupts memory on some NIfTI headers, and MetaIO prints on short files: these are read first.
  VolumeGeometry geometry;
  if (scan.format == "NIfTI")
  {
    geometry = ReadNIfTIGeometry(path, scan);
    CheckGeometry(geometry, path);
  }
  else if (scan.format == "MetaImage")
  {
    CheckMetaImageData(path);
  }

  const auto io = NewImageIO(scan.format);
  ReadInformation(*io, path, scan.format);
  const itk::Size<3> size = SizeOfScalarVolume(*io, path);
  if (scan.format != "NIfTI")
  {
    geometry = GeometryOf(*io, size);
    CheckGeometry(geometry, path);
  }
  if (scan.format == "NRRD" && !io->GetMetaDataDictionary().HasKey("NRRD_space"))
  {
    scan.isOriented = false;
    scan.notes.push_back(path.string() + " does not say how it lies in the patient; left and right are a guess.");
  }
  scan.image = ReadVolumePixels(*io, geometry);

  if (const std::size_t count = ReplaceNotFinite(scan.image); count > 0)
  {
    scan.notes.push_back(path.string() + " holds " + std::to_string(count) +
                         " values that are not finite numbers; the lowest value took their place.");
  }
  return scan;
}

} // namespace rhombic
