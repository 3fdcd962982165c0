#include "rhombicPictureFormat.h"

#include "rhombicFailure.h"

#include <itksys/SystemTools.hxx>

#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

const std::vector<std::pair<std::string, PictureFormat>> &
KnownFormats()
{
  static const PictureFormat png{ "png", OIIO::TypeDesc::UINT8, "zip", false, true, false };
  static const PictureFormat jpeg{ "jpeg", OIIO::TypeDesc::UINT8, "jpeg:95", false, false, false };
  static const PictureFormat tiff{ "tiff", OIIO::TypeDesc::UINT8, "zip", false, true, true };
  static const PictureFormat exr{ "openexr", OIIO::TypeDesc::HALF, "zip", true, true, false };
  static const std::vector<std::pair<std::string, PictureFormat>> formats{ { ".png", png },   { ".jpg", jpeg },
                                                                           { ".jpeg", jpeg }, { ".tif", tiff },
                                                                           { ".tiff", tiff }, { ".exr", exr } };
  return formats;
}

} // namespace

PictureFormat
FormatOf(const std::filesystem::path & path)
{
  const std::string extension = itksys::SystemTools::LowerCase(path.extension().string());
  std::string known;
  for (const auto & format : KnownFormats())
  {
    if (extension == format.first)
    {
      return format.second;
    }
    known += (known.empty() ? "" : ", ") + format.first;
  }
  throw Failure(FailureKind::Usage,
                "Cannot write the picture " + path.string() + ": its extension must be one of " + known + ".");
}

} // namespace rhombic
