#ifndef rhombicVolumeFormat_h
#define rhombicVolumeFormat_h

#include <filesystem>
#include <string>

namespace rhombic
{

/** A path's extension in lower case, with what is before ".gz": ".nii", ".nii.gz". */
std::string
VolumeExtension(const std::filesystem::path & path);

/** "NIfTI", "NRRD" or "MetaImage" as the extension has it, in whatever case, or empty. */
std::string
VolumeFormatOf(const std::filesystem::path & path);

} // namespace rhombic

#endif
