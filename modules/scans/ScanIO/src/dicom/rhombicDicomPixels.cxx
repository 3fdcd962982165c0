#include "rhombicDicomStack.h"

#include "rhombicDicomFrames.h"
#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSandbox.h"
#include "rhombicStoredBytes.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <type_traits>

namespace rhombic
{
namespace
{

/** The slices that come from one file. */
struct FileSlices
{
  std::shared_ptr<const DicomImageFile> file;
  std::vector<std::size_t> indices; ///< positions of the slices in the stack
};

std::vector<FileSlices>
GroupByFile(const std::vector<DicomSlice> & slices)
{
  std::map<const DicomImageFile *, std::size_t> fileIndices;
  std::vector<FileSlices> files;
  for (std::size_t index = 0; index < slices.size(); ++index)
  {
    const auto [found, isNew] = fileIndices.emplace(slices[index].file.get(), files.size());
    if (isNew)
    {
      files.push_back({ slices[index].file, {} });
    }
    files[found->second].indices.push_back(index);
  }
  return files;
}

/** Converts stored pixels to numbers, before rescaling (PS3.5, 8.1.1). */
template <typename TRaw>
class StoredValue
{
public:
  using ValueType = std::conditional_t<sizeof(TRaw) < 4, std::int32_t, std::int64_t>;

  explicit StoredValue(const DicomPixelFormat & format)
    : m_LeftShift(static_cast<int>(8 * sizeof(ValueType)) - 1 - static_cast<int>(format.highBit))
    , m_RightShift(static_cast<int>(8 * sizeof(ValueType)) - static_cast<int>(format.bitsStored))
    , m_IsSigned(format.isSigned)
  {}

  ValueType
  operator()(TRaw raw) const
  {
    const auto atTop = static_cast<std::make_unsigned_t<ValueType>>(raw) << m_LeftShift;
    return m_IsSigned ? static_cast<ValueType>(atTop) >> m_RightShift : static_cast<ValueType>(atTop >> m_RightShift);
  }

private:
  int m_LeftShift;
  int m_RightShift;
  bool m_IsSigned;
};

/** The range of values of a slice, and its padding. */
struct SliceValues
{
  double lowest = std::numeric_limits<double>::max(); ///< without padding
  double highest = std::numeric_limits<double>::lowest();
  std::vector<bool> isPadding; ///< for each pixel; empty when there is no padding
  std::size_t numberOfPadding = 0;
};

/** Finds the range of a slice's rescaled values, and its padding. */
template <typename TRaw>
SliceValues
FindValues(const DicomSlice & slice, const TRaw * stored, std::size_t count)
{
  const DicomPixelFormat & format = slice.file->format;
  const StoredValue<TRaw> valueOf(format);
  using ValueType = typename StoredValue<TRaw>::ValueType;
  ValueType lowest = std::numeric_limits<ValueType>::max();
  ValueType highest = std::numeric_limits<ValueType>::lowest();
  const auto take = [&](TRaw raw) {
    lowest = std::min(lowest, valueOf(raw));
    highest = std::max(highest, valueOf(raw));
  };
  SliceValues values;
  if (!format.padding)
  {
    std::for_each(stored, stored + count, take);
  }
  for (std::size_t n = 0; n < count && format.padding; ++n)
  {
    if (format.IsPadding(stored[n]))
    {
      values.isPadding.resize(count);
      values.isPadding[n] = true;
      ++values.numberOfPadding;
    }
    else
    {
      take(stored[n]);
    }
  }
  if (lowest <= highest)
  {
    const double first = slice.slope * static_cast<double>(lowest) + slice.intercept;
    const double last = slice.slope * static_cast<double>(highest) + slice.intercept;
    std::tie(values.lowest, values.highest) = std::minmax(first, last);
  }
  return values;
}

template <typename TPixel>
bool
FitsInto(const SliceValues & values)
{
  const bool isEmpty = values.lowest > values.highest;
  return !std::is_integral_v<TPixel> || isEmpty ||
         (values.lowest >= static_cast<double>(std::numeric_limits<TPixel>::lowest()) &&
          values.highest <= static_cast<double>(std::numeric_limits<TPixel>::max()));
}

/** Writes rescaled values; those of padding are arbitrary. Writes nothing when the values are beyond the pixel type. */
template <typename TRaw, typename TPixel>
SliceValues
Rescale(const DicomSlice & slice, const TRaw * stored, TPixel * pixels)
{
  const DicomPixelFormat & format = slice.file->format;
  const StoredValue<TRaw> valueOf(format);
  const std::size_t count = static_cast<std::size_t>(format.columns) * format.rows;
  const SliceValues values = FindValues(slice, stored, count);
  if (!FitsInto<TPixel>(values) || values.numberOfPadding == count)
  {
    return values;
  }
  if (std::is_integral_v<TPixel> && slice.slope == 1 && !format.padding)
  {
    // The intercept is a whole number too, or the pixels would be float.
    const auto intercept = static_cast<typename StoredValue<TRaw>::ValueType>(slice.intercept);
    std::transform(
      stored, stored + count, pixels, [&](TRaw raw) { return static_cast<TPixel>(valueOf(raw) + intercept); });
  }
  else
  {
    const auto rescale = [&](TRaw raw) {
      const double value = slice.slope * static_cast<double>(valueOf(raw)) + slice.intercept;
      return static_cast<TPixel>(std::clamp(value, values.lowest, values.highest));
    };
    std::transform(stored, stored + count, pixels, rescale);
  }
  return values;
}

template <typename TPixel>
SliceValues
Rescale(const DicomSlice & slice, const std::byte * stored, TPixel * pixels)
{
  switch (slice.file->format.bitsAllocated)
  {
    case 8:
      return Rescale(slice, reinterpret_cast<const std::uint8_t *>(stored), pixels);
    case 16:
      return Rescale(slice, reinterpret_cast<const std::uint16_t *>(stored), pixels);
    default:
      return Rescale(slice, reinterpret_cast<const std::uint32_t *>(stored), pixels);
  }
}

/** Calls `take(index, stored)` for each slice of a file: its index in the stack, and its stored pixels. */
template <typename TTake>
void
ForEachFrame(const FileSlices & fileSlices, const std::vector<DicomSlice> & slices, TTake take)
{
  const DicomImageFile & file = *fileSlices.file;
  const std::size_t frameBytes = file.format.FrameBytes();
  if (file.format.isEncapsulated)
  {
    SandboxRun run({ DicomHelper, file.path, nlohmann::json(file).dump(), frameBytes });
    for (std::size_t frame = 0; frame <= file.format.frames; ++frame) // nothing comes after the last one
    {
      const auto stored = run.Next();
      if (stored.has_value() != (frame < file.format.frames) || (stored && stored->size != frameBytes))
      {
        throw Failure(FailureKind::Internal,
                      "Cannot read " + file.path.string() + ": it was not unpacked to its number of frames.");
      }
      for (const std::size_t index : fileSlices.indices)
      {
        if (slices[index].frame == frame)
        {
          take(index, stored->data);
        }
      }
    }
    return;
  }
  for (const std::size_t index : fileSlices.indices)
  {
    take(index, ReadStoredBytes(file, slices[index].frame * frameBytes, frameBytes).data());
  }
}

std::optional<double>
PaddingValueOf(const std::vector<DicomSlice> & slices)
{
  const DicomSlice & first = slices.front();
  return first.file->format.padding
           ? std::optional<double>(first.slope * static_cast<double>(first.file->format.padding->first) +
                                   first.intercept)
           : std::nullopt;
}

/** Whether padding is the background of a mask or label map: there is only one other value, or it is next to padding.
 */
bool
IsBackground(double padding, double lowest, double highest, double slope)
{
  return lowest == highest || std::abs(lowest - padding) <= std::abs(slope);
}

/** Replaces padding by the lowest other value, unless it is a background. */
template <typename TPixel>
void
ReplacePadding(const std::vector<SliceValues> & values,
               const std::vector<DicomSlice> & slices,
               TPixel * pixels,
               std::size_t sliceSize,
               DicomPixels & result)
{
  double lowest = std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::lowest();
  for (const SliceValues & slice : values)
  {
    lowest = std::min(lowest, slice.lowest);
    highest = std::max(highest, slice.highest);
    result.numberOfPaddingSamples += slice.numberOfPadding;
  }
  result.paddingValue = PaddingValueOf(slices);
  double replacement = lowest <= highest ? lowest : 0;
  if (result.numberOfPaddingSamples > 0 && lowest <= highest &&
      IsBackground(*result.paddingValue, lowest, highest, slices.front().slope))
  {
    replacement = std::clamp(*result.paddingValue,
                             static_cast<double>(std::numeric_limits<TPixel>::lowest()),
                             static_cast<double>(std::numeric_limits<TPixel>::max()));
    result.numberOfPaddingSamples = 0;
    result.paddingValue.reset();
  }
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    for (std::size_t n = 0; n < values[k].isPadding.size(); ++n)
    {
      TPixel & pixel = pixels[k * sliceSize + n];
      pixel = values[k].isPadding[n] ? static_cast<TPixel>(replacement) : pixel;
    }
  }
}

/** The memory for reading besides the volume, in bytes: a bit for each pixel of slices with padding, and the data of
 * each thread. A compressed file is in memory as a whole, and its frames are unpacked twice: one by the helper's
 * library, and up to two in the memory shared with this process. */
std::uintmax_t
MemoryToRead(const std::vector<DicomSlice> & slices, const std::vector<FileSlices> & files)
{
  const std::size_t threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  std::uintmax_t bytes = 0;
  std::uintmax_t largest = 0;
  for (const FileSlices & fileSlices : files)
  {
    const DicomPixelFormat & format = fileSlices.file->format;
    const std::uintmax_t unpacked = format.frames > 1 ? 3 : 2;
    const std::uintmax_t held = format.isEncapsulated ? format.frames + unpacked : 1;
    largest = std::max(largest, held * format.FrameBytes());
  }
  for (const DicomSlice & slice : slices)
  {
    const DicomPixelFormat & format = slice.file->format;
    bytes += format.padding ? std::uintmax_t{ format.columns } * format.rows / 8 : 0;
  }
  return bytes + largest * std::min(threads, files.size());
}

std::filesystem::path
FolderOf(const std::vector<DicomSlice> & slices)
{
  return slices.front().file->path.parent_path();
}

/** Where a volume of \a bytes will be. Throws Failure(Memory) when it fits nowhere. */
VoxelPlace
FindPlace(const std::vector<DicomSlice> & slices,
          const std::vector<FileSlices> & files,
          std::uintmax_t bytes,
          const ScanReadOptions & options)
{
  const std::uintmax_t besideVolume = MemoryToRead(slices, files);
  RequireMemory(besideVolume, options.maximumMemory, "Reading " + FolderOf(slices).string());
  const TemporaryStore store = VoxelStore(FolderOf(slices), options.temporaryFolder);
  return FindPlaceToRead(store, bytes, besideVolume, options.maximumMemory);
}

/** Reads the volume with a pixel type; nothing when a value is beyond an integer type. */
template <typename TPixel>
std::optional<DicomPixels>
ReadAs(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry, const ScanReadOptions & options)
{
  const std::vector<FileSlices> files = GroupByFile(slices);
  const VoxelPlace place = FindPlace(slices, files, geometry.GetNumberOfVoxels() * sizeof(TPixel), options);
  const auto image = NewImage<TPixel>(
    geometry, place == VoxelPlace::Memory ? TemporaryStore() : VoxelStore(FolderOf(slices), options.temporaryFolder));
  const std::size_t sliceSize = geometry.size[0] * geometry.size[1];
  std::vector<SliceValues> values(slices.size());
  std::atomic<bool> fits{ true };
  DicomPixels result;
  std::mutex guard;
  const auto readFile = [&](std::size_t n) {
    if (!fits)
    {
      return;
    }
    try
    {
      ForEachFrame(files[n], slices, [&](std::size_t index, const std::byte * stored) {
        values[index] = Rescale(slices[index], stored, image->GetBufferPointer() + index * sliceSize);
        if (!FitsInto<TPixel>(values[index]))
        {
          fits = false;
        }
      });
    }
    catch (const Failure & failure)
    {
      if (failure.GetKind() != FailureKind::Unreadable)
      {
        throw;
      }
      const std::lock_guard<std::mutex> lock(guard);
      result.failures.emplace(files[n].file->path, failure.GetDescription());
    }
  };
  ForEachOnThreads(files.size(), readFile, options.progress);
  if (!result.failures.empty())
  {
    return result;
  }
  if (!fits)
  {
    return {};
  }
  ReplacePadding(values, slices, image->GetBufferPointer(), sliceSize, result);
  result.image = image;
  return result;
}

bool
AreStoredAsIs(const std::vector<DicomSlice> & slices, unsigned int bits)
{
  return std::all_of(slices.begin(), slices.end(), [bits](const DicomSlice & slice) {
    return slice.slope == 1 && slice.intercept == 0 && slice.file->format.bitsAllocated == bits &&
           !slice.file->format.isSigned;
  });
}

bool
AreWholeNumbers(const std::vector<DicomSlice> & slices)
{
  return std::all_of(slices.begin(), slices.end(), [](const DicomSlice & slice) {
    return std::floor(slice.slope) == slice.slope && std::floor(slice.intercept) == slice.intercept;
  });
}

} // namespace

ScanImage
NewDicomImage(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry)
{
  return AreStoredAsIs(slices, 8)    ? ScanImage(NewFrame<std::uint8_t>(geometry))
         : AreStoredAsIs(slices, 16) ? ScanImage(NewFrame<std::uint16_t>(geometry))
         : AreWholeNumbers(slices)   ? ScanImage(NewFrame<std::int16_t>(geometry))
                                     : ScanImage(NewFrame<float>(geometry));
}

bool
HoldsAllValues(const ScanImage & image, const std::vector<DicomSlice> & slices)
{
  using Limits = std::numeric_limits<std::int16_t>;
  const auto fits = [](const DicomSlice & slice) {
    const DicomPixelFormat & format = slice.file->format;
    const double count = std::ldexp(1.0, static_cast<int>(format.bitsStored));
    const double lowest = format.isSigned ? -count / 2 : 0.0;
    const auto [low, high] =
      std::minmax({ slice.slope * lowest + slice.intercept, slice.slope * (lowest + count - 1) + slice.intercept });
    return low >= Limits::lowest() && high <= Limits::max();
  };
  return !std::holds_alternative<itk::Image<std::int16_t, 3>::Pointer>(image) ||
         std::all_of(slices.begin(), slices.end(), fits);
}

VoxelPlace
FindPlaceOfPixels(const std::vector<DicomSlice> & slices,
                  const VolumeGeometry & geometry,
                  const ScanReadOptions & options)
{
  const auto sizeOf = [](const auto & image) { return sizeof(typename std::decay_t<decltype(*image)>::PixelType); };
  const std::uintmax_t sizeOfVoxel = std::visit(sizeOf, NewDicomImage(slices, geometry));
  return FindPlace(slices, GroupByFile(slices), geometry.GetNumberOfVoxels() * sizeOfVoxel, options);
}

DicomPixels
ReadDicomPixels(const std::vector<DicomSlice> & slices,
                const VolumeGeometry & geometry,
                const ScanReadOptions & options)
{
  // Headers allow larger values than there are (GE: 16 bits and an intercept of -1024), so the smallest type is tried
  // first.
  const auto readAs = [&](const auto & frame) {
    return ReadAs<typename std::decay_t<decltype(*frame)>::PixelType>(slices, geometry, options);
  };
  auto pixels = std::visit(readAs, NewDicomImage(slices, geometry));
  pixels = pixels ? std::move(pixels) : ReadAs<std::uint16_t>(slices, geometry, options);
  pixels = pixels ? std::move(pixels) : ReadAs<std::int32_t>(slices, geometry, options);
  pixels = pixels ? std::move(pixels) : ReadAs<float>(slices, geometry, options);
  return std::move(*pixels);
}

} // namespace rhombic
