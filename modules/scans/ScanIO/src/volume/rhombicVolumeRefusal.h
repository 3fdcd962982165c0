#ifndef rhombicVolumeRefusal_h
#define rhombicVolumeRefusal_h

#include "rhombicFailure.h"

#include <filesystem>
#include <string>

namespace rhombic
{

/** Throws Failure when a condition is true. */
inline void
FailIf(bool isFailure, FailureKind kind, const std::string & message)
{
  if (isFailure)
  {
    throw Failure(kind, message);
  }
}

/** Throws Failure(Unreadable): "Cannot read PATH: WHY." */
[[noreturn]] inline void
RefuseVolume(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** RefuseVolume() when a condition is true. */
inline void
RefuseVolumeIf(bool isRefused, const std::filesystem::path & path, const std::string & why)
{
  if (isRefused)
  {
    RefuseVolume(path, why);
  }
}

/** Throws Failure(Geometry): "Cannot place PATH in the patient: WHY." */
[[noreturn]] inline void
RefuseGeometry(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Geometry, "Cannot place " + path.string() + " in the patient: " + why + ".");
}

/** RefuseGeometry() when a condition is true. */
inline void
RefuseGeometryIf(bool isRefused, const std::filesystem::path & path, const std::string & why)
{
  if (isRefused)
  {
    RefuseGeometry(path, why);
  }
}

} // namespace rhombic

#endif
