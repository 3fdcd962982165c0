#ifndef rhombicVolumeRefusal_h
#define rhombicVolumeRefusal_h

#include "rhombicFailure.h"

#include <filesystem>
#include <string>

namespace rhombic
{

/** Throws Failure(Unreadable): "Cannot read PATH: WHY." */
[[noreturn]] inline void
RefuseVolume(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** Throws Failure(Geometry): "Cannot place PATH in the patient: WHY." */
[[noreturn]] inline void
RefuseGeometry(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Geometry, "Cannot place " + path.string() + " in the patient: " + why + ".");
}

} // namespace rhombic

#endif
