#include "rhombicVolumeFormat.h"

#include "rhombicWording.h"

#include <map>

namespace fs = std::filesystem;

namespace rhombic
{

std::string
VolumeExtension(const fs::path & path)
{
  const fs::path lower(LowerCase(path.filename().string()));
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
