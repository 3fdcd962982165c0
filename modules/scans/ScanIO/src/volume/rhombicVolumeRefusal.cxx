#include "rhombicVolumeRefusal.h"

#include "rhombicFailure.h"

namespace rhombic
{

void
RefuseVolume(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

void
RefuseGeometry(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Geometry, "Cannot place " + path.string() + " in the patient: " + why + ".");
}

} // namespace rhombic
