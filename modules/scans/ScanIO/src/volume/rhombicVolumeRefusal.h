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

/** \class OtherImage
 * \brief The failure for a file that holds no volume of single numbers, such as a picture, a colour image or several
 * volumes, or a volume in a form that this module does not read. Other readers may read the file. */
class OtherImage : public Failure
{
public:
  using Failure::Failure;
};

/** Throws OtherImage(Unreadable): "Cannot read PATH: WHY." */
[[noreturn]] inline void
RefuseOther(const std::filesystem::path & path, const std::string & why)
{
  throw OtherImage(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** RefuseOther() when a condition is true. */
inline void
RefuseOtherIf(bool isOther, const std::filesystem::path & path, const std::string & why)
{
  if (isOther)
  {
    RefuseOther(path, why);
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
