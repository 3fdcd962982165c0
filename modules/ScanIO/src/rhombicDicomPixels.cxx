#include "rhombicDicomPixels.h"

#include "rhombicDicomFrame.h"
#include "rhombicFailure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace rhombic
{
namespace
{

template <typename TPixel, typename TStored>
void
Rescale(const DicomSlice & slice, const TStored * stored, std::size_t count, TPixel * pixels)
{
  const auto rescale = [&slice](TStored value) { return slice.slope * static_cast<double>(value) + slice.intercept; };
  if constexpr (std::is_integral_v<TPixel>)
  {
    const auto [lowest, highest] = std::minmax_element(stored, stored + count);
    const auto [first, last] = std::minmax(rescale(*lowest), rescale(*highest));
    if (first < std::numeric_limits<TPixel>::lowest() || last > std::numeric_limits<TPixel>::max())
    {
      throw Failure(FailureKind::Unreadable,
                    "Cannot read " + slice.path.string() +
                      ": its values exceed the bits that its header says they have; export it again from its source.");
    }
  }
  std::transform(
    stored, stored + count, pixels, [&rescale](TStored value) { return static_cast<TPixel>(rescale(value)); });
}

template <typename TPixel>
void
RescaleFrame(const DicomSlice & slice, const DicomFrame & frame, std::size_t count, TPixel * pixels)
{
  std::visit([&](const auto & stored) { Rescale(slice, stored.data(), count, pixels); }, frame);
}

template <typename TPixel>
ScanImage
ReadAs(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry)
{
  const auto image = NewImage<TPixel>(geometry);
  const std::size_t count = geometry.size[0] * geometry.size[1];
  TPixel * pixels = image->GetBufferPointer();
  for (const DicomSlice & slice : slices)
  {
    RescaleFrame(slice, DecodeDicomFrame(slice), count, pixels);
    pixels += count;
  }
  return ScanImage(image);
}

/** What the values of slices can be, by their headers. */
struct ValueRange
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  bool isWhole = true; ///< all values are whole numbers

  template <typename TPixel>
  bool
  FitsInto() const
  {
    return isWhole && lowest >= std::numeric_limits<TPixel>::lowest() && highest <= std::numeric_limits<TPixel>::max();
  }
};

ValueRange
FindRange(const std::vector<DicomSlice> & slices)
{
  ValueRange range;
  for (const DicomSlice & slice : slices)
  {
    const double values = std::ldexp(1.0, static_cast<int>(slice.bitsStored));
    const double smallest = slice.isSigned ? -values / 2 : 0;
    for (const double stored : { smallest, smallest + values - 1 })
    {
      range.lowest = std::min(range.lowest, slice.slope * stored + slice.intercept);
      range.highest = std::max(range.highest, slice.slope * stored + slice.intercept);
    }
    range.isWhole =
      range.isWhole && std::floor(slice.slope) == slice.slope && std::floor(slice.intercept) == slice.intercept;
  }
  return range;
}

bool
IsStoredAsIs(const std::vector<DicomSlice> & slices, unsigned int bits, bool isSigned)
{
  return std::all_of(slices.begin(), slices.end(), [=](const DicomSlice & slice) {
    return slice.slope == 1 && slice.intercept == 0 && slice.bitsAllocated == bits && slice.isSigned == isSigned;
  });
}

} // namespace

ScanImage
ReadDicomPixels(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry)
{
  const ValueRange range = FindRange(slices);
  if (IsStoredAsIs(slices, 8, false))
  {
    return ReadAs<std::uint8_t>(slices, geometry);
  }
  if (!IsStoredAsIs(slices, 16, false) && range.FitsInto<std::int16_t>())
  {
    return ReadAs<std::int16_t>(slices, geometry);
  }
  if (range.FitsInto<std::uint16_t>())
  {
    return ReadAs<std::uint16_t>(slices, geometry);
  }
  if (range.FitsInto<std::int32_t>())
  {
    return ReadAs<std::int32_t>(slices, geometry);
  }
  return ReadAs<float>(slices, geometry);
}

} // namespace rhombic
