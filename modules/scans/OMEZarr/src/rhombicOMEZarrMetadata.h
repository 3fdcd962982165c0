#ifndef rhombicOMEZarrMetadata_h
#define rhombicOMEZarrMetadata_h

#include "rhombicOMEZarrImage.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** An axis of space of an OME-Zarr image. */
struct OMEZarrAxis
{
  unsigned int dimension = 0;               ///< of space: 0 for x, 1 for y, 2 for z
  std::optional<double> millimetresPerUnit; ///< nothing: the axis has no unit
  std::optional<double> step;               ///< in that unit; nothing: unknown
  double origin = 0;                        ///< in that unit
};

/** What the metadata of an OME-Zarr image say of a level. */
struct OMEZarrMetadata
{
  std::filesystem::path array;     ///< the folder of the level's array, below the image's
  std::array<OMEZarrAxis, 3> axes; ///< of space, in the order of the array, the last one fastest
  std::size_t numberOfAxes = 3;    ///< also those in front of space
  std::size_t numberOfLevels = 1;
  std::vector<std::string> notes;
};

/** Reads and checks the metadata in a folder. Throws Failure as OMEZarrImage does. */
OMEZarrMetadata
ReadOMEZarrMetadata(const std::filesystem::path & folder, const OMEZarrOptions & options);

} // namespace rhombic

#endif
