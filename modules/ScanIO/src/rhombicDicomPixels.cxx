#include "rhombicDicomPixels.h"

#include "rhombicDicomFrame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace rhombic
{
namespace
{

/** False, with nothing written, when a value is beyond an integer pixel type. */
template <typename TPixel, typename TStored>
bool
Rescale(const DicomSlice & slice, const std::vector<TStored> & stored, TPixel * pixels)
{
  const auto rescale = [&slice](TStored value) { return slice.slope * static_cast<double>(value) + slice.intercept; };
  if constexpr (std::is_integral_v<TPixel>)
  {
    const auto [lowest, highest] = std::minmax_element(stored.begin(), stored.end());
    const auto [first, last] = std::minmax({ rescale(*lowest), rescale(*highest) });
    if (first < std::numeric_limits<TPixel>::lowest() || last > std::numeric_limits<TPixel>::max())
    {
      return false;
    }
  }
  std::transform(
    stored.begin(), stored.end(), pixels, [&rescale](TStored value) { return static_cast<TPixel>(rescale(value)); });
  return true;
}

/** Nothing when a value is beyond an integer pixel type. */
template <typename TPixel>
std::optional<ScanImage>
ReadAs(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry)
{
  const auto image = NewImage<TPixel>(geometry);
  TPixel * pixels = image->GetBufferPointer();
  for (const DicomSlice & slice : slices)
  {
    const DicomFrame frame = DecodeDicomFrame(slice);
    if (!std::visit([&](const auto & stored) { return Rescale(slice, stored, pixels); }, frame))
    {
      return {};
    }
    pixels += geometry.size[0] * geometry.size[1];
  }
  return ScanImage(image);
}

bool
AreStoredAsIs(const std::vector<DicomSlice> & slices, unsigned int bits)
{
  return std::all_of(slices.begin(), slices.end(), [bits](const DicomSlice & slice) {
    return slice.slope == 1 && slice.intercept == 0 && slice.bitsAllocated == bits && !slice.isSigned;
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
ReadDicomPixels(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry)
{
  std::optional<ScanImage> image;
  if (AreStoredAsIs(slices, 8))
  {
    image = ReadAs<std::uint8_t>(slices, geometry);
  }
  else if (AreStoredAsIs(slices, 16))
  {
    image = ReadAs<std::uint16_t>(slices, geometry);
  }
  // Headers promise more than the values use (GE's 16 bits less 1024), so the smallest type is tried first.
  if (!image && AreWholeNumbers(slices))
  {
    image = ReadAs<std::int16_t>(slices, geometry);
    image = image ? image : ReadAs<std::uint16_t>(slices, geometry);
    image = image ? image : ReadAs<std::int32_t>(slices, geometry);
  }
  return image ? *image : *ReadAs<float>(slices, geometry);
}

} // namespace rhombic
