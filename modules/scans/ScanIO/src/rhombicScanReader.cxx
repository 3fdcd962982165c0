#include "rhombicScanReader.h"

#include "rhombicFailure.h"
#include "rhombicOMEZarrImage.h"
#include "rhombicScanFormats.h"
#include "rhombicVolumeRefusal.h"

#include <new>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

void
RequireNoSeries(const fs::path & path, const ScanReadOptions & options)
{
  FailIf(!options.series.empty(),
         FailureKind::Usage,
         "Cannot choose a series of " + path.string() + ": only folders of DICOM files have series; leave it out.");
}

void
RequireNoLevel(const fs::path & path, const ScanReadOptions & options)
{
  FailIf(options.level > 0,
         FailureKind::Usage,
         "Cannot read level " + std::to_string(options.level) + " of " + path.string() +
           ": only OME-Zarr folders have levels; leave out ScanReadOptions::level.");
}

/** Throws Failure(Usage) for choices that the format of an input does not have. */
void
RequireNoFurtherChoices(const fs::path & path, bool isFolder, const ScanReadOptions & options)
{
  FailIf(options.raw && isFolder,
         FailureKind::Usage,
         "Cannot read " + path.string() +
           " as a file of bare voxels: it is a folder; leave out ScanReadOptions::raw, or name the file.");
  RequireNoLevel(path, options);
  FailIf(options.voxelSize && !options.raw,
         FailureKind::Usage,
         "The size of the voxels of " + path.string() +
           " can't be given, as only files of bare voxels, pictures and OME-Zarr folders may lack it; leave out "
           "ScanReadOptions::voxelSize.");
}

UnreadScan
Open(const fs::path & path, const ScanReadOptions & options)
{
  const bool isFolder = IsFolder(path);
  if (isFolder && IsZarr(path) && !options.raw)
  {
    RequireNoSeries(path, options);
    return OpenOMEZarr(path, options);
  }
  const std::vector<fs::path> masks =
    isFolder && !options.raw ? FindMasks(path, options.followsLinks) : std::vector<fs::path>();
  if (isFolder && !options.raw && masks.empty())
  {
    if (const std::vector<fs::path> pictures = FindPictures(path, options.followsLinks); !pictures.empty())
    {
      RequireNoSeries(path, options);
      RequireNoLevel(path, options);
      return OpenPictureStack(pictures, path, options);
    }
  }
  if (!isFolder && !options.raw && IsPicture(path))
  {
    RequireNoSeries(path, options);
    RequireNoLevel(path, options);
    return OpenPictureStack({ path }, path, options);
  }
  RequireNoFurtherChoices(path, isFolder, options);
  if (isFolder)
  {
    return masks.empty() ? OpenDicomFolder(path, options) : OpenLabelFiles(masks, options);
  }
  if (VolumeFormatOf(path).empty() && !options.raw)
  {
    return OpenDicomFile(path, options);
  }
  RequireNoSeries(path, options);
  return OpenVolumeFile(path, options);
}

/** Calls \a read. Turns its exceptions into Failures that name the path. */
template <typename TRead>
auto
ReadOrFail(const fs::path & path, const TRead & read)
{
  const auto outOfMemory = [&path] {
    return Failure(FailureKind::Memory,
                   "Cannot read " + path.string() + ": it does not fit into memory; free some or crop the scan.");
  };
  try
  {
    return read();
  }
  catch (const Failure &)
  {
    throw;
  }
  catch (const itk::ProcessAborted &)
  {
    throw;
  }
  catch (const itk::MemoryAllocationError &)
  {
    throw outOfMemory();
  }
  catch (const std::bad_alloc &)
  {
    throw outOfMemory();
  }
  catch (const std::exception & exception)
  {
    RefuseVolume(path, DescribeError(exception) + "; it may be damaged, so copy it again");
  }
}

} // namespace

bool
IsFolder(const fs::path & path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  FailIf(status.type() == fs::file_type::not_found,
         FailureKind::NotFound,
         "Cannot read " + path.string() + ": there is no such file or folder; check the spelling.");
  RefuseVolumeIf(!fs::exists(status), path, error.message() + "; check the path, and who may enter its folders");
  if (!fs::is_directory(status) && !fs::is_regular_file(status))
  {
    RefuseOther(path, "it is a device or pipe; give a file or folder");
  }
  return fs::is_directory(status);
}

UnreadScan
OpenScan(const fs::path & path, const ScanReadOptions & options)
{
  UnreadScan file = ReadOrFail(path, [&path, &options] { return Open(path, options); });
  file.readVoxels = [path, readVoxels = file.readVoxels](Scan & scan) { ReadOrFail(path, [&] { readVoxels(scan); }); };
  if (file.native)
  {
    file.native->read = [path, read = file.native->read](const itk::ImageRegion<3> & region, void * buffer) {
      ReadOrFail(path, [&] { read(region, buffer); });
    };
  }
  return file;
}

Scan
ReadVoxels(const UnreadScan & file)
{
  Scan scan = file.scan;
  file.readVoxels(scan);
  return scan;
}

SeriesList
ListSeries(const fs::path & path, const ScanReadOptions & options)
{
  return ReadOrFail(path, [&path, &options] {
    const bool isFolder = IsFolder(path);
    const bool hasSeries = isFolder ? !IsZarr(path) && FindMasks(path, options.followsLinks).empty() &&
                                        FindPictures(path, options.followsLinks).empty()
                                    : VolumeFormatOf(path).empty() && !options.raw && !IsPicture(path);
    return hasSeries ? ListDicomSeries(path, isFolder, options) : SeriesList();
  });
}

} // namespace rhombic
