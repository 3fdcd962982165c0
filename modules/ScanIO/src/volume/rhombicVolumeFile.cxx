#include "rhombicVolumeFile.h"

#include "rhombicCompressedFile.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicMemoryBudget.h"
#include "rhombicMetaImageHeader.h"
#include "rhombicNIfTIFile.h"
#include "rhombicNRRDHeader.h"
#include "rhombicNRRDVolume.h"
#include "rhombicVolumeFormat.h"
#include "rhombicVolumeFrame.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVolumePixels.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicVoxelDecoder.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

std::size_t
NumberOfVoxels(const VolumeGeometry & geometry)
{
  return geometry.size[0] * geometry.size[1] * geometry.size[2];
}

/** Reads one volume of a NRRD or MetaImage file that ITK unpacks. */
ScanImage
ReadUnpacked(const fs::path & path, const StoredVolume & volume, std::uintmax_t frame, const ScanReadOptions & options)
{
  const std::size_t voxelSize = SizeOf(volume.type);
  const std::size_t bytes = NumberOfVoxels(volume.geometry) * voxelSize;
  const auto unpacked =
    options.decoder->Decode({ VoxelRequest::Source::VolumeFile, path, bytes * volume.numberOfFrames });
  const std::byte * next = unpacked->GetData() + frame * (volume.areFramesInterleaved ? voxelSize : bytes);
  const std::size_t step = volume.areFramesInterleaved ? voxelSize * volume.numberOfFrames : voxelSize;
  const auto source = [&](std::byte * buffer, std::size_t size) {
    if (step == voxelSize)
    {
      std::memcpy(buffer, next, size);
      next += size;
      return;
    }
    for (std::byte * value = buffer; value != buffer + size; value += voxelSize, next += step)
    {
      std::memcpy(value, next, voxelSize);
    }
  };
  return ReadVolumePixels(volume.type, volume.scaling, volume.geometry, WithProgress(source, bytes, options.progress));
}

/** Reads one volume of a file whose voxels are a zlib stream, in one pass. */
ScanImage
ReadDeflated(const StoredVolume & volume, std::uintmax_t frame, const ScanReadOptions & options)
{
  const DeflatedVoxels & voxels = *volume.deflated;
  const auto refuseCutOff = [&voxels] {
    RefuseVolume(voxels.path, "its compressed voxels are damaged or cut off; copy it again");
  };
  InflatedStream stream(voxels.path, voxels.offset);
  const auto read = [&](std::byte * buffer, std::size_t size) {
    if (stream.Read(buffer, size) < size)
    {
      refuseCutOff();
    }
    if (voxels.isSwapped)
    {
      SwapBytes(buffer, size, SizeOf(volume.type));
    }
  };
  const std::size_t bytes = NumberOfVoxels(volume.geometry) * SizeOf(volume.type);
  stream.Skip(frame * bytes);
  ScanImage image =
    ReadVolumePixels(volume.type, volume.scaling, volume.geometry, WithProgress(read, bytes, options.progress));
  const std::size_t left = (volume.numberOfFrames - frame - 1) * bytes;
  const auto rest = stream.Finish(left);
  if (!rest || *rest < left)
  {
    refuseCutOff();
  }
  return image;
}

/** Fills the scan of a NRRD or MetaImage file, whose header was checked. */
UnreadScan
OpenStoredVolume(const fs::path & path, const StoredVolume & volume, const ScanReadOptions & options, Scan scan)
{
  ChooseFrame(volume.numberOfFrames, options, path, scan);
  CheckGeometry(volume.geometry, path, volume.matrix, options.onIrregular, scan.notes);
  scan.image = NewVolumeImage(volume.type, volume.scaling.has_value(), volume.geometry);
  scan.encoding = volume.encoding;
  scan.scaling = DescribeScaling(volume.scaling);
  scan.isOriented = volume.isOriented;
  if (!volume.note.empty())
  {
    scan.notes.push_back(path.string() + " " + volume.note + ".");
  }
  return { scan, [=](Scan & read) {
            const std::size_t voxels = NumberOfVoxels(volume.geometry);
            const std::size_t unpacked = volume.deflated ? 0 : voxels * SizeOf(volume.type) * volume.numberOfFrames;
            RequireMemory(unpacked + MemoryOfPixels(volume.type, volume.scaling.has_value(), voxels),
                          options.maximumMemory,
                          "Reading " + path.string());
            read.image = volume.deflated ? ReadDeflated(volume, read.frame, options)
                                         : ReadUnpacked(path, volume, read.frame, options);
          } };
}

/** Replaces values that are not finite, which would spread when the scan is resampled, by the lowest finite value.
 * Returns their number. */
std::size_t
ReplaceNotFinite(const ScanImage & image, const fs::path & path)
{
  const auto * const pointer = std::get_if<itk::Image<float, 3>::Pointer>(&image);
  if (pointer == nullptr)
  {
    return 0;
  }
  float * const begin = (*pointer)->GetBufferPointer();
  float * const end = begin + (*pointer)->GetBufferedRegion().GetNumberOfPixels();
  float lowest = std::numeric_limits<float>::infinity();
  std::size_t count = 0;
  for (const float * value = begin; value != end; ++value)
  {
    const bool isFinite = std::isfinite(*value);
    count += isFinite ? 0 : 1;
    lowest = isFinite ? std::min(lowest, *value) : lowest;
  }
  if (!std::isfinite(lowest))
  {
    RefuseVolume(path, "none of its values is a finite number; export it again from its source");
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
  return !VolumeFormatOf(path).empty();
}

UnreadScan
OpenVolumeFile(const fs::path & path, const ScanReadOptions & options)
{
  UnreadScan file;
  file.scan.format = VolumeFormatOf(path);
  if (file.scan.format == "NIfTI")
  {
    file = OpenNIfTIFile(path, options, file.scan);
  }
  else if (file.scan.format == "NRRD")
  {
    file = OpenStoredVolume(path, ReadNRRDVolume(path), options, file.scan);
    Scan & scan = file.scan;
    scan.labels = LabelsOfSegments(ReadNRRDKeyValues(path), path.string(), static_cast<int>(scan.frame));
  }
  else
  {
    file = OpenStoredVolume(path, ReadMetaImageVolume(path), options, file.scan);
  }
  file.readVoxels = [path, readAll = file.readVoxels](Scan & scan) {
    readAll(scan);
    if (const std::size_t count = ReplaceNotFinite(scan.image, path); count > 0)
    {
      scan.notes.push_back(path.string() + " holds " +
                           Count(count, "value that is no finite number", "values that are not finite numbers") +
                           "; the lowest value took their place.");
    }
  };
  return file;
}

} // namespace rhombic
