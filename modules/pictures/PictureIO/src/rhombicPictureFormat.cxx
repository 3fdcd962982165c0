#include "rhombicPictureFormat.h"

#include "rhombicFailure.h"

#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <utility>

namespace rhombic
{
namespace
{

const std::vector<std::pair<std::string, PictureFormat>> &
KnownFormats()
{
  using U = PictureUse;
  static const PictureFormat png{ "png", "zip", false, true, false, true, { U::Single } };
  static const PictureFormat jpeg{ "jpeg", "jpeg", false, false, false, false, { U::Single } };
  static const PictureFormat tiff{ "tiff", "zip", false, true, true, true, { U::Single, U::Pages } };
  static const PictureFormat exr{ "openexr", "zip", true, true, false, true, { U::Single } };
  static const PictureFormat gif{ "gif", "none", false, false, false, false, { U::Animation } };
  static const std::vector<std::pair<std::string, PictureFormat>> formats{ { ".png", png },   { ".jpg", jpeg },
                                                                           { ".jpeg", jpeg }, { ".tif", tiff },
                                                                           { ".tiff", tiff }, { ".exr", exr },
                                                                           { ".gif", gif } };
  return formats;
}

} // namespace

PictureFormat
FormatOf(const std::filesystem::path & path, PictureUse use, bool hasAlpha)
{
  const std::string extension = itksys::SystemTools::LowerCase(path.extension().string());
  std::string known;
  for (const auto & [name, format] : KnownFormats())
  {
    if (std::find(format.uses.begin(), format.uses.end(), use) == format.uses.end())
    {
      continue;
    }
    if (extension == name && hasAlpha && !format.hasAlpha)
    {
      throw Failure(FailureKind::Usage,
                    "Cannot write the picture " + path.string() +
                      " with a transparent background: the format has none; use .png, .tif or .exr, or a colour.");
    }
    if (extension == name)
    {
      return format;
    }
    known += (known.empty() ? "" : ", ") + name;
  }
  const std::string what = use == PictureUse::Single ? "picture" : use == PictureUse::Pages ? "pages" : "animation";
  throw Failure(FailureKind::Usage,
                "Cannot write the " + what + " " + path.string() + ": the extension must be one of " + known + ".");
}

} // namespace rhombic
