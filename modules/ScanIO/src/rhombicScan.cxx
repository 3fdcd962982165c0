#include "rhombicScan.h"

namespace rhombic
{

const itk::ImageBase<3> &
GeometryOf(const ScanImage & image)
{
  return std::visit([](const auto & pointer) -> const itk::ImageBase<3> & { return *pointer; }, image);
}

const char *
PixelTypeName(const ScanImage & image)
{
  constexpr std::array<const char *, std::variant_size_v<ScanImage>> names{
    "uint8", "int16", "uint16", "int32", "float"
  };
  return names[image.index()];
}

} // namespace rhombic
