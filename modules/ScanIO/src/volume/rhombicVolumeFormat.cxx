#include "rhombicVolumeFormat.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{

std::string
VolumeExtension(const fs::path & path)
{
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  const fs::path lower(name);
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

} // namespace rhombic
