#include "rhombicVolumePixels.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace rhombic
{
namespace
{

template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
ReadAs(itk::ImageIOBase & io, const VolumeGeometry & geometry)
{
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    region.SetSize(axis, io.GetDimensions(axis));
  }
  io.SetIORegion(region);

  auto image = NewImage<TPixel>(geometry);
  const auto bytes = image->GetBufferedRegion().GetNumberOfPixels() * sizeof(TPixel);
  if (static_cast<itk::SizeValueType>(io.GetImageSizeInBytes()) != bytes)
  {
    itkGenericExceptionMacro("it announces " << io.GetImageSizeInBytes() << " bytes of pixels, but has " << bytes);
  }
  io.Read(image->GetBufferPointer());
  return image;
}

template <typename TPixel, typename TStored>
typename itk::Image<TPixel, 3>::Pointer
Convert(const itk::Image<TStored, 3> & stored, const VolumeGeometry & geometry)
{
  const auto image = NewImage<TPixel>(geometry);
  const TStored * const begin = stored.GetBufferPointer();
  std::transform(begin,
                 begin + stored.GetBufferedRegion().GetNumberOfPixels(),
                 image->GetBufferPointer(),
                 [](TStored value) { return static_cast<TPixel>(value); });
  return image;
}

/** For integers wider than any in ScanImage. */
template <typename TStored>
ScanImage
ConvertToInt32OrFloat(const itk::Image<TStored, 3> & stored, const VolumeGeometry & geometry)
{
  using Limits = std::numeric_limits<std::int32_t>;
  const TStored * const begin = stored.GetBufferPointer();
  const auto [lowest, highest] = std::minmax_element(begin, begin + stored.GetBufferedRegion().GetNumberOfPixels());
  const bool fits = *highest <= static_cast<TStored>(Limits::max()) &&
                    (std::is_unsigned_v<TStored> || *lowest >= static_cast<TStored>(Limits::min()));
  return fits ? ScanImage(Convert<std::int32_t>(stored, geometry)) : ScanImage(Convert<float>(stored, geometry));
}

} // namespace

ScanImage
ReadVolumePixels(itk::ImageIOBase & io, const VolumeGeometry & geometry)
{
  using Component = itk::IOComponentEnum;
  switch (io.GetComponentType())
  {
    case Component::UCHAR:
      return ReadAs<std::uint8_t>(io, geometry);
    case Component::CHAR:
      return Convert<std::int16_t>(*ReadAs<std::int8_t>(io, geometry), geometry);
    case Component::SHORT:
      return ReadAs<std::int16_t>(io, geometry);
    case Component::USHORT:
      return ReadAs<std::uint16_t>(io, geometry);
    case Component::INT:
      return ReadAs<std::int32_t>(io, geometry);
    case Component::UINT:
      return ConvertToInt32OrFloat(*ReadAs<std::uint32_t>(io, geometry), geometry);
    case Component::LONG:
    case Component::LONGLONG:
      static_assert(sizeof(long) == sizeof(std::int64_t));
      return ConvertToInt32OrFloat(*ReadAs<std::int64_t>(io, geometry), geometry);
    case Component::ULONG:
    case Component::ULONGLONG:
      return ConvertToInt32OrFloat(*ReadAs<std::uint64_t>(io, geometry), geometry);
    case Component::FLOAT:
      return ReadAs<float>(io, geometry);
    case Component::DOUBLE:
      return Convert<float>(*ReadAs<double>(io, geometry), geometry);
    default:
      itkGenericExceptionMacro("its pixel type " << itk::ImageIOBase::GetComponentTypeAsString(io.GetComponentType())
                                                 << " is not supported");
  }
}

} // namespace rhombic
