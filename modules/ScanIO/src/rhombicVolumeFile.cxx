#include "rhombicVolumeFile.h"

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

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Reads a NRRD or MetaImage file whose header and length are sound. */
void
ReadStoredVolume(const fs::path & path, const StoredVolume & volume, const ScanReadOptions & options, Scan & scan)
{
  const std::uintmax_t frame = ChooseFrame(volume.numberOfFrames, options.frame, path);
  CheckGeometry(volume.geometry, path, volume.matrix, options.onIrregular, scan.notes);
  const auto & size = volume.geometry.size;
  const std::size_t voxels = size[0] * size[1] * size[2];
  const std::size_t voxelSize = SizeOf(volume.type);
  const std::size_t bytes = voxels * voxelSize * volume.numberOfFrames;
  RequireMemory(bytes + MemoryOfPixels(volume.type, volume.scaling.has_value(), voxels),
                options.maximumMemory,
                "Reading " + path.string());

  const auto unpacked = options.decoder->Decode({ VoxelRequest::Source::VolumeFile, path, bytes });
  const std::byte * next = unpacked->GetData() + frame * (volume.areFramesInterleaved ? voxelSize : voxels * voxelSize);
  const std::size_t step = volume.areFramesInterleaved ? voxelSize * volume.numberOfFrames : voxelSize;
  scan.image =
    ReadVolumePixels(volume.type, volume.scaling, volume.geometry, [&](std::byte * buffer, std::size_t count) {
      for (std::byte * value = buffer; step != voxelSize && value != buffer + count; value += voxelSize, next += step)
      {
        std::memcpy(value, next, voxelSize);
      }
      if (step == voxelSize)
      {
        std::memcpy(buffer, next, count);
        next += count;
      }
    });

  scan.encoding = volume.encoding;
  scan.scaling = DescribeScaling(volume.scaling);
  scan.isOriented = volume.isOriented;
  if (!volume.note.empty())
  {
    scan.notes.push_back(path.string() + " " + volume.note + ".");
  }
}

/** Puts the lowest finite value in the place of values that are not finite, which would spread when the scan is
 * resampled. Returns how many there were. */
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

Scan
ReadVolumeFile(const fs::path & path, const ScanReadOptions & options)
{
  Scan scan;
  scan.format = VolumeFormatOf(path);
  if (scan.format == "NIfTI")
  {
    ReadNIfTIFile(path, options, scan);
  }
  else
  {
    const StoredVolume volume = scan.format == "NRRD" ? ReadNRRDVolume(path) : ReadMetaImageVolume(path);
    ReadStoredVolume(path, volume, options, scan);
    if (scan.format == "NRRD")
    {
      scan.labels =
        LabelsOfSegments(ReadNRRDKeyValues(path), path.string(), static_cast<int>(options.frame.value_or(0)));
    }
  }
  if (const std::size_t count = ReplaceNotFinite(scan.image, path); count > 0)
  {
    scan.notes.push_back(path.string() + " holds " + std::to_string(count) +
                         " values that are not finite numbers; the lowest value took their place.");
  }
  return scan;
}

} // namespace rhombic
