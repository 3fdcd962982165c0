#include "rhombicStoredVolume.h"

#include "rhombicWording.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

namespace rhombic
{
namespace
{

constexpr std::size_t ChunkVoxels = 1 << 18;

template <typename TStored>
constexpr bool IsWide = std::is_integral_v<TStored> && (sizeof(TStored) > 4 || std::is_same_v<TStored, std::uint32_t>);

/** The pixel type of ScanImage that holds all values; for wide integers the one that is tried first. */
template <typename TStored>
using PixelFor =
  std::conditional_t<std::is_same_v<TStored, std::int8_t>,
                     std::int16_t,
                     std::conditional_t<IsWide<TStored>,
                                        std::int32_t,
                                        std::conditional_t<std::is_same_v<TStored, double>, float, TStored>>>;

/** Calls \a use with each chunk of the voxels: its values, their number, and the index of the first. */
template <typename TStored, typename TUse>
void
ForEachChunk(std::size_t total, const VoxelSource & source, const TUse & use)
{
  std::vector<TStored> chunk(std::min(total, ChunkVoxels));
  for (std::size_t first = 0; first < total; first += chunk.size())
  {
    const std::size_t count = std::min(chunk.size(), total - first);
    source(reinterpret_cast<std::byte *>(chunk.data()), count * sizeof(TStored));
    use(chunk.data(), count, first);
  }
}

template <typename TPixel>
ScanImage
ReadDirectly(const VolumeGeometry & geometry, const VoxelSource & source, const TemporaryStore & store)
{
  const auto image = NewImage<TPixel>(geometry, store);
  auto * const begin = reinterpret_cast<std::byte *>(image->GetBufferPointer());
  const std::size_t total = image->GetBufferedRegion().GetNumberOfPixels() * sizeof(TPixel);
  constexpr std::size_t step = ChunkVoxels * sizeof(TPixel);
  for (std::size_t first = 0; first < total; first += step)
  {
    source(begin + first, std::min(step, total - first));
  }
  return image;
}

/** Reads voxels and converts them. */
template <typename TStored, typename TPixel, typename TConvert>
void
ReadConverted(std::size_t total, const VoxelSource & source, const TConvert & convert, TPixel * pixels)
{
  ForEachChunk<TStored>(total, source, [&](const TStored * values, std::size_t count, std::size_t first) {
    std::transform(values, values + count, pixels + first, convert);
  });
}

template <typename TStored>
void
ReadScaled(std::size_t total, const VoxelSource & source, const ValueScaling & scaling, float * pixels)
{
  const auto scale = [&scaling](TStored value) {
    return static_cast<float>(scaling.slope * static_cast<double>(value) + scaling.intercept);
  };
  ReadConverted<TStored>(total, source, scale, pixels);
}

/** Converts values to the pixels of an image from the \a first on. */
template <typename TStored, typename TPixel>
void
Convert(const TStored * values, std::size_t count, itk::Image<TPixel, 3> & image, std::size_t first)
{
  std::transform(
    values, values + count, image.GetBufferPointer() + first, [](TStored value) { return static_cast<TPixel>(value); });
}

/** For integers wider than any pixel type of ScanImage: int32 if all values fit, else float. */
template <typename TStored>
ScanImage
ReadWide(const VolumeGeometry & geometry, const VoxelSource & source, const TemporaryStore & store)
{
  using Limits = std::numeric_limits<std::int32_t>;
  const auto fits = [](TStored value) {
    return value <= static_cast<TStored>(Limits::max()) &&
           (std::is_unsigned_v<TStored> || value >= static_cast<TStored>(Limits::min()));
  };
  const std::size_t total = geometry.GetNumberOfVoxels();
  auto integers = NewImage<std::int32_t>(geometry, store);
  itk::Image<float, 3>::Pointer floats;
  ForEachChunk<TStored>(total, source, [&](const TStored * values, std::size_t count, std::size_t first) {
    if (!floats && !std::all_of(values, values + count, fits))
    {
      floats = NewImage<float>(geometry, store);
      Convert(integers->GetBufferPointer(), first, *floats, 0);
      integers = nullptr;
    }
    floats ? Convert(values, count, *floats, first) : Convert(values, count, *integers, first);
  });
  return floats ? ScanImage(floats) : ScanImage(integers);
}

} // namespace

std::size_t
SizeOf(StoredType type)
{
  return std::visit([](auto stored) { return sizeof(stored); }, type);
}

std::string
DescribeScaling(const std::optional<ValueScaling> & scaling)
{
  if (!scaling)
  {
    return "";
  }
  return "slope " + FormatNumber(scaling->slope) + ", intercept " + FormatNumber(scaling->intercept);
}

std::uintmax_t
MemoryOfPixels(StoredType type, bool isScaled, std::uintmax_t numberOfVoxels)
{
  const auto bytesOf = [isScaled](auto stored) {
    using Stored = decltype(stored);
    return isScaled ? sizeof(float) : IsWide<Stored> ? sizeof(std::int32_t) + sizeof(float) : sizeof(PixelFor<Stored>);
  };
  return numberOfVoxels * std::visit(bytesOf, type);
}

ScanImage
NewVolumeImage(StoredType type, bool isScaled, const VolumeGeometry & geometry)
{
  const auto newFrame = [&](auto stored) {
    return isScaled ? ScanImage(NewFrame<float>(geometry)) : ScanImage(NewFrame<PixelFor<decltype(stored)>>(geometry));
  };
  return std::visit(newFrame, type);
}

void
SwapBytes(std::byte * buffer, std::size_t size, std::size_t valueSize)
{
  for (std::byte * value = buffer; value != buffer + size; value += valueSize)
  {
    std::reverse(value, value + valueSize);
  }
}

ScanImage
ReadVolumePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 const VolumeGeometry & geometry,
                 const VoxelSource & source,
                 const TemporaryStore & store)
{
  const auto read = [&](auto stored) -> ScanImage {
    using Stored = decltype(stored);
    using Pixel = PixelFor<Stored>;
    if (scaling)
    {
      const auto image = NewImage<float>(geometry, store);
      ReadScaled<Stored>(geometry.GetNumberOfVoxels(), source, *scaling, image->GetBufferPointer());
      return image;
    }
    if constexpr (IsWide<Stored>)
    {
      return ReadWide<Stored>(geometry, source, store);
    }
    else if constexpr (std::is_same_v<Stored, Pixel>)
    {
      return ReadDirectly<Pixel>(geometry, source, store);
    }
    else
    {
      const auto image = NewImage<Pixel>(geometry, store);
      const auto convert = [](Stored value) { return static_cast<Pixel>(value); };
      ReadConverted<Stored>(geometry.GetNumberOfVoxels(), source, convert, image->GetBufferPointer());
      return image;
    }
  };
  return std::visit(read, type);
}

void
ReadNativePixels(StoredType type,
                 const std::optional<ValueScaling> & scaling,
                 std::size_t count,
                 const VoxelSource & source,
                 void * buffer)
{
  const auto read = [&](auto stored) {
    using Stored = decltype(stored);
    scaling ? ReadScaled<Stored>(count, source, *scaling, static_cast<float *>(buffer))
            : source(static_cast<std::byte *>(buffer), count * sizeof(Stored));
  };
  std::visit(read, type);
}

} // namespace rhombic
