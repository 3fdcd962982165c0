#include "rhombicScanFormats.h"

#include "rhombicFiniteValues.h"
#include "rhombicMemoryBudget.h"
#include "rhombicOMEZarrImage.h"
#include "rhombicStoredVolume.h"

#include "itkImageIOBase.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** \class ZarrBands
 * \brief The voxels of a frame in order, read by bands of as many slices as chunks have, so that each chunk is read
 * once. */
class ZarrBands
{
public:
  ZarrBands(const OMEZarrImage & image, std::size_t frame, const ProgressFunction & progress)
    : m_Image(image)
    , m_Frame(frame)
    , m_Progress(progress)
    , m_SliceBytes(image.GetSize()[0] * image.GetSize()[1] * SizeOf(image.GetType()))
  {}

  /** The memory of a band. */
  static std::uintmax_t
  MemoryOf(const OMEZarrImage & image)
  {
    const std::uintmax_t slices = std::min<std::uintmax_t>(image.GetSlicesOfChunks(), image.GetSize()[2]);
    return slices * image.GetSize()[0] * image.GetSize()[1] * SizeOf(image.GetType());
  }

  /** Copies the next \a size bytes of the voxels. */
  void
  Read(std::byte * buffer, std::size_t size)
  {
    while (size > 0)
    {
      if (m_Used == m_Band.size())
      {
        this->ReadBand();
      }
      const std::size_t count = std::min(size, m_Band.size() - m_Used);
      std::memcpy(buffer, m_Band.data() + m_Used, count);
      m_Used += count;
      buffer += count;
      size -= count;
    }
  }

private:
  void
  ReadBand()
  {
    itk::ImageRegion<3> region = m_Image.GetSize();
    const std::size_t depth = region.GetSize(2);
    region.SetIndex(2, static_cast<itk::IndexValueType>(m_NextSlice));
    region.SetSize(2, std::min(m_Image.GetSlicesOfChunks(), depth - m_NextSlice));
    m_Band.resize(region.GetSize(2) * m_SliceBytes);
    m_Used = 0;
    m_Image.Read(m_Frame, region, m_Band.data());
    m_NextSlice += region.GetSize(2);
    if (m_Progress)
    {
      m_Progress(static_cast<double>(m_NextSlice) / static_cast<double>(depth));
    }
  }

  const OMEZarrImage & m_Image;
  const std::size_t m_Frame;
  const ProgressFunction m_Progress;
  const std::size_t m_SliceBytes;
  std::vector<std::byte> m_Band;
  std::size_t m_Used = 0; ///< bytes of the band
  std::size_t m_NextSlice = 0;
};

/** Whether ScanImage has voxels of the stored type. */
template <typename TStored>
constexpr bool IsPixel = std::is_constructible_v<ScanImage, typename itk::Image<TStored, 3>::Pointer>;

/** Where the voxels will be. Throws Failure(Memory) when they fit nowhere. */
VoxelPlace
FindPlace(const OMEZarrImage & image, const ScanReadOptions & options, const fs::path & path)
{
  const bool isDirect = std::visit([](auto stored) { return IsPixel<decltype(stored)>; }, image.GetType());
  const std::uintmax_t size = itk::ImageRegion<3>(image.GetSize()).GetNumberOfPixels();
  const std::uintmax_t pixels = MemoryOfPixels(image.GetType(), false, size);
  const std::uintmax_t working = image.GetWorkingMemory() + (isDirect ? 0 : ZarrBands::MemoryOf(image));
  RequireMemory(working,
                0,
                "Unpacking chunks of " + path.string(),
                image.GetNumberOfLevels() > options.level + 1
                  ? "choose a coarser level of its pyramid with ScanReadOptions::level"
                  : "");
  return FindPlaceToRead(VoxelStore(path, options.temporaryFolder), pixels, working, options.maximumMemory);
}

/** Reads all voxels, converted as OpenScan() documents. */
ScanImage
ReadZarrVoxels(const OMEZarrImage & image,
               const VolumeGeometry & geometry,
               std::size_t frame,
               const ScanReadOptions & options,
               const fs::path & path)
{
  const bool isInMemory = FindPlace(image, options, path) == VoxelPlace::Memory;
  const TemporaryStore store = isInMemory ? TemporaryStore() : VoxelStore(path, options.temporaryFolder);
  const auto read = [&](auto stored) -> ScanImage {
    using Stored = decltype(stored);
    if constexpr (IsPixel<Stored>)
    {
      const auto voxels = NewImage<Stored>(geometry, store);
      image.Read(frame, geometry.size, voxels->GetBufferPointer(), options.progress);
      return voxels;
    }
    else
    {
      ZarrBands bands(image, frame, options.progress);
      const auto source = [&bands](std::byte * buffer, std::size_t size) { bands.Read(buffer, size); };
      return ReadVolumePixels(image.GetType(), std::nullopt, geometry, source, store);
    }
  };
  return std::visit(read, image.GetType());
}

/** The lowest finite value of a frame. */
template <typename TValue>
TValue
FindLowestOfZarr(const OMEZarrImage & image, std::size_t frame)
{
  ZarrBands bands(image, frame, {});
  std::vector<TValue> slice(image.GetSize()[0] * image.GetSize()[1]);
  TValue lowest = std::numeric_limits<TValue>::infinity();
  for (std::size_t n = 0; n < image.GetSize()[2]; ++n)
  {
    bands.Read(reinterpret_cast<std::byte *>(slice.data()), slice.size() * sizeof(TValue));
    lowest = std::min(lowest, LowestFinite(slice.data(), slice.data() + slice.size()));
  }
  return lowest;
}

/** The voxels of a frame as they are stored (see UnreadScan::native). */
NativeVoxels
NativeVoxelsOfZarr(const OMEZarrImage & image, std::size_t frame, const fs::path & path)
{
  const auto lowest = std::make_shared<std::optional<double>>(); // found once for all regions
  const auto read = [=](const itk::ImageRegion<3> & region, void * buffer) {
    image.Read(frame, region, buffer);
    const auto replace = [&](auto stored) {
      using Value = decltype(stored);
      if constexpr (std::is_floating_point_v<Value>)
      {
        auto * const values = static_cast<Value *>(buffer);
        ReplaceNotFinite(values, values + region.GetNumberOfPixels(), path, [&] {
          *lowest = *lowest ? *lowest : FindLowestOfZarr<Value>(image, frame);
          return static_cast<Value>(**lowest);
        });
      }
    };
    std::visit(replace, image.GetType());
  };
  const auto typeOf = [](auto stored) { return itk::ImageIOBase::MapPixelType<decltype(stored)>::CType; };
  return { std::visit(typeOf, image.GetType()), true, read };
}

} // namespace

UnreadScan
OpenOMEZarr(const fs::path & folder, const ScanReadOptions & options)
{
  const OMEZarrImage image(folder, { options.level, options.followsLinks, options.voxelSize });
  UnreadScan file;
  Scan & scan = file.scan;
  scan.format = "OME-Zarr";
  scan.encoding = image.GetEncoding();
  scan.isOriented = false;
  scan.files = image.GetMetadataFiles();
  scan.level = options.level;
  scan.numberOfLevels = image.GetNumberOfLevels();
  ChooseFrame(image.GetNumberOfFrames(), options, folder, scan);
  for (const std::string & note : image.GetNotes())
  {
    scan.notes.push_back(folder.string() + " " + note + ".");
  }
  const VolumeGeometry geometry = MakeGeometry(image.GetSize(), image.GetOrigin(), image.GetSteps().data());
  CheckGeometry(geometry, folder, "scale", options.onTilted, scan.notes);
  scan.image = NewVolumeImage(image.GetType(), false, geometry);
  file.readVoxels = [=](Scan & read) {
    read.image = ReadZarrVoxels(image, geometry, read.frame, options, folder);
    read.files = image.FindFiles(read.frame);
    ReplaceNotFinite(folder, read);
  };
  file.findPlace = [=] { return FindPlace(image, options, folder); };
  file.native = NativeVoxelsOfZarr(image, scan.frame, folder);
  return file;
}

} // namespace rhombic
