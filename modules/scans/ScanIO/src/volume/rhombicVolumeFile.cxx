#include "rhombicScanFormats.h"

#include "rhombicCompressedFile.h"
#include "rhombicFiniteValues.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicLabelLayers.h"
#include "rhombicMemoryBudget.h"
#include "rhombicTextHeader.h"
#include "rhombicStoredVolume.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkImageIOBase.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <type_traits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

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

/** \class FrameBytes
 * \brief The voxels of a region of one frame, x fastest, in this machine's byte order. */
class FrameBytes
{
public:
  FrameBytes(const StoredVolume & volume, std::uintmax_t frame, const itk::ImageRegion<3> & region)
    : m_Volume(volume)
    , m_Frame(frame)
    , m_Region(region)
    , m_VoxelSize(SizeOf(volume.type))
    , m_FrameSize(volume.geometry.GetNumberOfVoxels() * m_VoxelSize)
    , m_Stream(volume.voxels.path, volume.voxels.offset, volume.voxels.isDeflated)
  {
    m_Stream.Skip(volume.voxels.skip + (volume.areFramesInterleaved ? 0 : frame * m_FrameSize));
  }

  /** Reads the next \a size bytes, a whole number of voxels. Throws Failure when the file ends before. */
  void
  Read(std::byte * buffer, std::size_t size)
  {
    const bool isRead = m_Volume.areFramesInterleaved
                          ? ReadInterleaved(m_Stream, buffer, size, m_VoxelSize, m_Frame, m_Volume.numberOfFrames)
                          : this->ReadRuns(buffer, size);
    RefuseVolumeIf(!isRead, m_Volume.voxels.path, "its voxels are damaged or cut off; copy it again");
    if (m_Volume.voxels.isSwapped)
    {
      SwapBytes(buffer, size, m_VoxelSize);
    }
  }

  /** Throws Failure when a compressed stream is damaged behind the region, or does not end behind the last frame. */
  void
  RequireEnd()
  {
    const std::uintmax_t end = (m_Volume.numberOfFrames - m_Frame) * m_FrameSize;
    RefuseVolumeIf(
      m_Volume.voxels.isDeflated && !m_Stream.EndsAfter(m_Volume.areFramesInterleaved ? 0 : end - m_Position),
      m_Volume.voxels.path,
      "its compressed content is damaged, cut off, or goes on behind the voxels that its header announces; "
      "copy or export it again");
  }

private:
  /** Reads from runs of adjacent voxels. False at the end of the stream. */
  bool
  ReadRuns(std::byte * buffer, std::size_t size)
  {
    for (std::byte * const end = buffer + size; buffer != end;)
    {
      if (m_LeftInRun == 0)
      {
        this->GoToNextRun();
      }
      const std::size_t part = std::min(static_cast<std::size_t>(end - buffer), m_LeftInRun);
      if (m_Stream.Read(buffer, part) != part)
      {
        return false;
      }
      buffer += part;
      m_Position += part;
      m_LeftInRun -= part;
    }
    return true;
  }

  /** A run is a row of the region, or all of the region if that is whole slices. */
  void
  GoToNextRun()
  {
    const itk::Size<3> & size = m_Volume.geometry.size;
    const itk::Size<3> & part = m_Region.GetSize();
    const bool areSlicesWhole = part[0] == size[0] && part[1] == size[1];
    const std::size_t row = m_Region.GetIndex(1) + m_NextRow % part[1];
    const std::size_t slice = m_Region.GetIndex(2) + m_NextRow / part[1];
    const std::size_t begin = ((slice * size[1] + row) * size[0] + m_Region.GetIndex(0)) * m_VoxelSize;
    m_Stream.Skip(begin - m_Position);
    m_Position = begin;
    m_LeftInRun = (areSlicesWhole ? m_Region.GetNumberOfPixels() : part[0]) * m_VoxelSize;
    ++m_NextRow;
  }

  const StoredVolume & m_Volume;
  const std::uintmax_t m_Frame;
  const itk::ImageRegion<3> m_Region;
  const std::size_t m_VoxelSize;
  const std::size_t m_FrameSize; ///< in bytes
  ByteStream m_Stream;
  std::size_t m_NextRow = 0;
  std::size_t m_LeftInRun = 0;   ///< bytes
  std::uintmax_t m_Position = 0; ///< bytes of the frame that were passed
};

/** Reads one frame, in one pass. \a store see NewImage(). */
ScanImage
ReadStoredVoxels(const StoredVolume & volume,
                 std::uintmax_t frame,
                 const ScanReadOptions & options,
                 const TemporaryStore & store = {})
{
  FrameBytes bytes(volume, frame, volume.geometry.size);
  const auto total = static_cast<double>(volume.geometry.GetNumberOfVoxels() * SizeOf(volume.type));
  std::size_t done = 0;
  const auto read = [&](std::byte * buffer, std::size_t size) {
    bytes.Read(buffer, size);
    done += size;
    if (options.progress)
    {
      options.progress(static_cast<double>(done) / total);
    }
  };
  ScanImage image = ReadVolumePixels(volume.type, volume.scaling, volume.geometry, read, store);
  bytes.RequireEnd();
  return image;
}

/** How to unpack a compressed stream, as only a raw file need not fit into memory. */
std::string
AdviseUnpacking(const StoredVolume & volume, const fs::path & path)
{
  const std::string file = path.filename().string();
  const std::string raw = path.stem().string() + "-raw";
  const std::string format = VolumeFormatOf(path);
  const std::string voxels = volume.voxels.path.filename().string();
  const std::string header = "sed '/^ElementDataFile/q' " + file +
                             " | sed 's/^CompressedData .*/CompressedData = False/; /^CompressedDataSize/d; "
                             "s/^ElementDataFile .*/ElementDataFile = " +
                             raw + ".raw/' > " + raw + ".mhd";
  const std::string command = format == "NIfTI"  ? "gunzip -k " + voxels
                              : format == "NRRD" ? "unu save -e raw -f nrrd -i " + file + " -o " + raw + ".nhdr"
                                                 : header + "; tail -c +" + std::to_string(volume.voxels.offset + 1) +
                                                     ' ' + voxels + " | zlib-flate -uncompress > " + raw + ".raw";
  return "unpack it by " + command + ", as a raw file need not fit";
}

/** Where the voxels of one frame will be: the file is mapped when they would take more than half of the memory allowed.
 * Throws Failure(Memory) when they fit nowhere. */
VoxelPlace
FindPlace(const StoredVolume & volume, std::uintmax_t frame, const fs::path & path, const ScanReadOptions & options)
{
  const std::uintmax_t group = volume.areFramesInterleaved ? volume.numberOfFrames * SizeOf(volume.type) : 0;
  const std::uintmax_t bytes =
    group + MemoryOfPixels(volume.type, volume.scaling.has_value(), volume.geometry.GetNumberOfVoxels());
  const std::uintmax_t allowed = MemoryAllowance(options.maximumMemory);
  if (bytes > allowed / 2 && CanBeMapped(volume, frame))
  {
    return VoxelPlace::File;
  }
  if (volume.voxels.isDeflated)
  {
    RequireMemory(bytes, options.maximumMemory, "Reading " + path.string(), AdviseUnpacking(volume, path));
  }
  return FindPlaceToRead(VoxelStore(path, options.temporaryFolder), bytes, 0, options.maximumMemory);
}

/** Reads the voxels of one frame, or maps its file. */
ScanImage
ReadOrMapVoxels(const StoredVolume & volume,
                std::uintmax_t frame,
                const fs::path & path,
                const ScanReadOptions & options)
{
  const VoxelPlace place = FindPlace(volume, frame, path, options);
  const auto mapped = place == VoxelPlace::File ? MapVoxels(volume, frame) : std::nullopt;
  const TemporaryStore store =
    place == VoxelPlace::TemporaryFile ? VoxelStore(path, options.temporaryFolder) : TemporaryStore();
  return mapped ? *mapped : ReadStoredVoxels(volume, frame, options, store);
}

/** Reads and checks the header. Describes in \a scan what the result can't hold. */
StoredVolume
ReadHeader(const fs::path & path, const ScanReadOptions & options, Scan & scan)
{
  if (scan.format == "NIfTI")
  {
    return ReadNIfTIVolume(path, options, scan);
  }
  const StoredVolume volume = scan.format == "raw"    ? DescribeRawVolume(path, options)
                              : scan.format == "NRRD" ? ReadNRRDVolume(path)
                                                      : ReadMetaImageVolume(path);
  CheckGeometry(volume.geometry, path, volume.matrix, options.onTilted, scan.notes);
  return volume;
}

/** The lowest finite value of a file's only frame, read in pieces. */
template <typename TValue>
TValue
FindLowest(const StoredVolume & volume)
{
  FrameBytes bytes(volume, 0, volume.geometry.size);
  const auto source = [&bytes](std::byte * buffer, std::size_t size) { bytes.Read(buffer, size); };
  std::vector<TValue> piece(volume.geometry.size[0] * volume.geometry.size[1]);
  TValue lowest = std::numeric_limits<TValue>::infinity();
  for (std::size_t slice = 0; slice < volume.geometry.size[2]; ++slice)
  {
    ReadNativePixels(volume.type, volume.scaling, piece.size(), source, piece.data());
    lowest = std::min(lowest, LowestFinite(piece.data(), piece.data() + piece.size()));
  }
  return lowest;
}

/** The voxels of a file's only frame (see UnreadScan::native). */
NativeVoxels
NativeVoxelsOf(const StoredVolume & volume, const fs::path & path)
{
  const auto typeOf = [&volume](auto stored) {
    return volume.scaling ? itk::IOComponentEnum::FLOAT : itk::ImageIOBase::MapPixelType<decltype(stored)>::CType;
  };
  const auto lowest = std::make_shared<std::optional<double>>(); // found once for all regions
  const auto read = [=](const itk::ImageRegion<3> & region, void * buffer) {
    FrameBytes bytes(volume, 0, region);
    const std::size_t count = region.GetNumberOfPixels();
    const auto source = [&bytes](std::byte * piece, std::size_t size) { bytes.Read(piece, size); };
    ReadNativePixels(volume.type, volume.scaling, count, source, buffer);
    bytes.RequireEnd();
    const auto replace = [&](auto stored) {
      using Value = decltype(stored);
      if constexpr (std::is_floating_point_v<Value>)
      {
        auto * const values = static_cast<Value *>(buffer);
        ReplaceNotFinite(values, values + count, path, [&] {
          *lowest = *lowest ? *lowest : FindLowest<Value>(volume);
          return static_cast<Value>(**lowest);
        });
      }
    };
    volume.scaling ? replace(float()) : std::visit(replace, volume.type);
  };
  return { std::visit(typeOf, volume.type), !volume.voxels.isDeflated, read };
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
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan)
{
  const std::size_t frame = options.frame.value_or(0);
  RefuseOtherIf(!options.frame && numberOfFrames > 1 && options.onSeveralFrames == ScanReadOptions::Policy::Refuse,
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
  scan.format = options.raw ? "raw" : VolumeFormatOf(path);
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
  UnreadScan file;
  file.scan = scan;
  file.readVoxels = [=](Scan & read) {
    if (isLayered)
    {
      RequireMemory(MemoryOfPixels(volume.type, false, volume.geometry.GetNumberOfVoxels()),
                    options.maximumMemory,
                    "Reading " + path.string());
      ReadLayers(volume, segments, path, options, read);
      return;
    }
    read.image = ReadOrMapVoxels(volume, read.frame, path, options);
    ReplaceNotFinite(path, read);
  };
  if (!isLayered)
  {
    file.findPlace = [=, frame = scan.frame] { return FindPlace(volume, frame, path, options); };
  }
  if (volume.numberOfFrames == 1)
  {
    file.native = NativeVoxelsOf(volume, path);
  }
  return file;
}

} // namespace rhombic
