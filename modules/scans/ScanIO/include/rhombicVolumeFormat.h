#ifndef rhombicVolumeFormat_h
#define rhombicVolumeFormat_h

#include <filesystem>
#include <string>

namespace rhombic
{

/** A path's extension in lower case, including the part before ".gz": ".nii", ".nii.gz". */
std::string
VolumeExtension(const std::filesystem::path & path);

/** "NIfTI", "NRRD" or "MetaImage" by the extension, in upper or lower case; empty for others. */
std::string
VolumeFormatOf(const std::filesystem::path & path);

} // namespace rhombic

#endif
