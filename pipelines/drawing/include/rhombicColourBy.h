#ifndef rhombicColourBy_h
#define rhombicColourBy_h

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace rhombic
{

/** What the points of surfaces are coloured by. */
struct ColourBy
{
  /** Where the numbers come from. */
  enum class Kind
  {
    Volume,  ///< the value of a volume at the point, linear between its voxels
    Distance ///< the signed distance to another surface in mm: above 0 outside of it
  };

  Kind kind = Kind::Volume;
  std::filesystem::path
    file; ///< a volume; for distances surface files, or a label map whose labels have the same names
  std::optional<std::pair<double, double>> range; ///< of the colours; nothing: what 96 % of the points have, of
                                                  ///< distances 95 %, and the same on both sides of 0
  std::string map;                                ///< of GetColourMaps(); empty: diverging for distances, else viridis
};

/** What is written as pet.nii.gz, pet.nii.gz,0,7,inferno, distance:other.stl or distance:labels.nii.gz,-2,2. Throws
 * Failure(Usage). */
ColourBy
ParseColourBy(const std::string & text);

} // namespace rhombic

#endif
