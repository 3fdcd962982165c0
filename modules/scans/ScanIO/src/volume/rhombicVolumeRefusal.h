#ifndef rhombicVolumeRefusal_h
#define rhombicVolumeRefusal_h

#include <filesystem>
#include <string>

namespace rhombic
{

/** Throws Failure(Unreadable): "Cannot read PATH: WHY." */
[[noreturn]] void
RefuseVolume(const std::filesystem::path & path, const std::string & why);

/** Throws Failure(Geometry): "Cannot place PATH in the patient: WHY." */
[[noreturn]] void
RefuseGeometry(const std::filesystem::path & path, const std::string & why);

} // namespace rhombic

#endif
