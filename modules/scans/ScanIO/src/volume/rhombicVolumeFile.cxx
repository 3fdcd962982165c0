#include "rhombicScanFormats.h"

#include "rhombicCompressedFile.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicLabelLayers.h"
#include "rhombicMemoryBudget.h"
#include "rhombicTextHeader.h"
#include "rhombicStoredVolume.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Sets Scan::frame, the volume of a file to read, and Scan::numberOfFrames. Throws Failure: Unreadable when there are
 * several volumes without a choice, unless the options accept the first; Usage when there is no such volume. */
void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan)
{
  const std::size_t frame = options.frame.value_or(0);
  RefuseVolumeIf(!options.frame && numberOfFrames > 1 && options.onSeveralFrames == ScanReadOptions::Policy::Refuse,
                 path,
                 "it holds " + std::to_string(numberOfFrames) +
                   " volumes; choose one with ScanReadOptions::frame, from 0 to " + std::to_string(numberOfFrames - 1));
  FailIf(options.frame && frame >= numberOfFrames,
         FailureKind::Usage,
         "Cannot read volume " + std::to_string(frame) + " of " + path.string() + ": it holds " +
           std::to_string(numberOfFrames) + ", counted from 0; choose another with ScanReadOptions::frame.");
  scan.numberOfFrames = numberOfFrames;
  scan.frame = frame;
}

/** Reads the values of one frame from groups of a value for each frame. False at the end of the stream. */
bool
ReadInterleaved(ByteStream & stream,
                std::byte * buffer,
                std::size_t size,
                std::size_t voxelSize,
                std::uintmax_t frame,
                std::uintmax_t frames)
{
  const std::size_t groupSize = voxelSize * frames;
  std::vector<std::byte> groups(std::max<std::size_t>(1, (1 << 20) / groupSize) * groupSize);
  for (std::byte * const end = buffer + size; buffer != end;)
  {
    const std::size_t missing = static_cast<std::size_t>(end - buffer) / voxelSize * groupSize;
    const std::size_t count = stream.Read(groups.data(), std::min(groups.size(), missing));
    if (count % groupSize != 0 || count == 0)
    {
      return false;
    }
    for (std::size_t group = 0; group < count; group += groupSize, buffer += voxelSize)
    {
      std::memcpy(buffer, groups.data() + group + frame * voxelSize, voxelSize);
    }
  }
  return true;
}

/** Reads one frame, in one pass. */
ScanImage
ReadStoredVoxels(const StoredVolume & volume, std::uintmax_t frame, const ScanReadOptions & options)
{
  const StoredVoxels & voxels = volume.voxels;
  const std::size_t voxelSize = SizeOf(volume.type);
  const std::size_t frameSize = volume.geometry.GetNumberOfVoxels() * voxelSize;
  ByteStream stream(voxels.path, voxels.offset, voxels.isDeflated);
  stream.Skip(voxels.skip + (volume.areFramesInterleaved ? 0 : frame * frameSize));
  std::size_t done = 0;
  const auto read = [&](std::byte * buffer, std::size_t size) {
    const bool isRead = volume.areFramesInterleaved
                          ? ReadInterleaved(stream, buffer, size, voxelSize, frame, volume.numberOfFrames)
                          : stream.Read(buffer, size) == size;
    RefuseVolumeIf(!isRead, voxels.path, "its voxels are damaged or cut off; copy it again");
    if (voxels.isSwapped)
    {
      SwapBytes(buffer, size, voxelSize);
    }
    done += size;
    if (options.progress)
    {
      options.progress(static_cast<double>(done) / static_cast<double>(frameSize));
    }
  };
  ScanImage image = ReadVolumePixels(volume.type, volume.scaling, volume.geometry, read);
  const std::uintmax_t framesBehind = volume.areFramesInterleaved ? 0 : volume.numberOfFrames - frame - 1;
  RefuseVolumeIf(voxels.isDeflated && !stream.EndsAfter(framesBehind * frameSize),
                 voxels.path,
                 "its compressed content is damaged, cut off, or goes on behind the voxels that its header announces; "
                 "copy or export it again");
  return image;
}

/** Reads and checks the header. Describes in \a scan what the result can't hold. */
StoredVolume
ReadHeader(const fs::path & path, const ScanReadOptions & options, Scan & scan)
{
  if (scan.format == "NIfTI")
  {
    return ReadNIfTIVolume(path, options, scan);
  }
  const StoredVolume volume = scan.format == "NRRD" ? ReadNRRDVolume(path) : ReadMetaImageVolume(path);
  CheckGeometry(volume.geometry, path, volume.matrix, options.onTilted, scan.notes);
  return volume;
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
  RefuseVolumeIf(
    !std::isfinite(lowest), path, "none of its values is a finite number; export it again from its source");
  if (count > 0)
  {
    std::replace_if(
      begin, end, [](float value) { return !std::isfinite(value); }, lowest);
  }
  return count;
}

/** Reads all layers of a 3D Slicer segmentation, each of which numbers its segments independently. */
void
ReadLayers(const StoredVolume & volume,
           const std::map<std::string, std::string> & segments,
           const fs::path & path,
           const ScanReadOptions & options,
           Scan & scan)
{
  LabelUnion labels(GeometryOf(scan.image), options.maximumMemory);
  for (std::uintmax_t layer = 0; layer < volume.numberOfFrames; ++layer)
  {
    labels.Add(ReadStoredVoxels(volume, layer, options),
               LabelsOfSegments(segments, path.string(), static_cast<int>(layer)));
  }
  labels.Take(scan);
}

} // namespace

void
RequireVoxels(const std::vector<std::uintmax_t> & sizes,
              bool areAtEnd,
              const std::filesystem::path & header,
              StoredVolume & volume)
{
  std::vector<std::uintmax_t> factors = sizes;
  factors.push_back(SizeOf(volume.type));
  const auto needed = ProductOf(factors);
  if (!needed)
  {
    RefuseVolume(header, "its dimensions are larger than any volume; export it again from its source");
  }
  StoredVoxels & voxels = volume.voxels;
  const std::uintmax_t size = std::filesystem::file_size(voxels.path);
  const std::uintmax_t stored = size - std::min(voxels.offset, size);
  if ((voxels.isDeflated ? stored * LargestRatio : stored) < voxels.skip + *needed)
  {
    RefuseVolume(header,
                 "its header announces more voxels than " + voxels.path.filename().string() + " can hold (" +
                   std::to_string(stored) + " bytes for " + std::to_string(*needed + voxels.skip) +
                   " bytes of voxels); it is cut off or damaged, so copy it again");
  }
  if (areAtEnd)
  {
    voxels.offset = size - *needed;
  }
}

std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes)
{
  constexpr std::uintmax_t largest = std::uintmax_t(1) << 60;
  std::uintmax_t product = 1;
  for (const std::uintmax_t size : sizes)
  {
    if (size > 0 && product > largest / size)
    {
      return std::nullopt;
    }
    product *= size;
  }
  return product;
}

std::string
VolumeExtension(const fs::path & path)
{
  const fs::path lower(LowerCase(path.filename().string()));
  return lower.extension() == ".gz" ? lower.stem().extension().string() + ".gz" : lower.extension().string();
}

std::string
VolumeFormatOf(const fs::path & path)
{
  static const std::map<std::string, std::string> formats{ { ".nii", "NIfTI" },     { ".nii.gz", "NIfTI" },
                                                           { ".hdr", "NIfTI" },     { ".hdr.gz", "NIfTI" },
                                                           { ".img", "NIfTI" },     { ".img.gz", "NIfTI" },
                                                           { ".nrrd", "NRRD" },     { ".nhdr", "NRRD" },
                                                           { ".mha", "MetaImage" }, { ".mhd", "MetaImage" } };
  const auto found = formats.find(VolumeExtension(path));
  return found == formats.end() ? "" : found->second;
}

UnreadScan
OpenVolumeFile(const fs::path & path, const ScanReadOptions & options)
{
  Scan scan;
  scan.format = VolumeFormatOf(path);
  const StoredVolume volume = ReadHeader(path, options, scan);
  const auto segments = scan.format == "NRRD" ? ReadNRRDHeader(path).keyValues : TextHeader::Texts();
  const bool isLayered = volume.numberOfFrames > 1 && !options.frame && HasSegments(segments);
  if (!isLayered)
  {
    ChooseFrame(volume.numberOfFrames, options, path, scan);
    scan.labels = LabelsOfSegments(segments, path.string(), static_cast<int>(scan.frame));
  }
  const std::set<fs::path> files{ path, volume.voxels.path };
  scan.files.assign(files.begin(), files.end());
  scan.image = isLayered ? ScanImage(NewFrame<std::uint16_t>(volume.geometry))
                         : NewVolumeImage(volume.type, volume.scaling.has_value(), volume.geometry);
  scan.encoding = volume.encoding;
  scan.scaling = DescribeScaling(volume.scaling);
  scan.isOriented = volume.isOriented;
  if (!volume.note.empty())
  {
    scan.notes.push_back(path.string() + " " + volume.note + ".");
  }
  return { scan, [=](Scan & read) {
            const std::uintmax_t group = volume.areFramesInterleaved ? volume.numberOfFrames * SizeOf(volume.type) : 0;
            RequireMemory(
              group + MemoryOfPixels(volume.type, volume.scaling.has_value(), volume.geometry.GetNumberOfVoxels()),
              options.maximumMemory,
              "Reading " + path.string());
            if (isLayered)
            {
              ReadLayers(volume, segments, path, options, read);
              return;
            }
            read.image = ReadStoredVoxels(volume, read.frame, options);
            if (const std::size_t count = ReplaceNotFinite(read.image, path); count > 0)
            {
              read.notes.push_back(
                path.string() + " holds " +
                Count(count, "value that is no finite number", "values that are not finite numbers") +
                "; the lowest value took their place.");
            }
          } };
}

} // namespace rhombic
