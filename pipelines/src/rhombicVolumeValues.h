#ifndef rhombicVolumeValues_h
#define rhombicVolumeValues_h

#include "rhombicColourBy.h"
#include "rhombicScanSource.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Numbers of the points of each surface, and their unit. */
struct VolumeValues
{
  std::vector<itk::BulkVector<float>> values; ///< NaN outside of the volume
  std::string unit;                           ///< "HU", "Bq/ml", "SUV"; empty if unknown
};

ScanSource
SourceOfVolume(const ColourBy & by);

/** The values of a volume at the points of surfaces. Throws Failure as ColourSurfaces() does. */
VolumeValues
SampleVolume(const ColourBy & by,
             const std::string & frameOfReference,
             const std::vector<SceneSurface> & surfaces,
             const Events & events);

/** Throws Failure(Geometry) if the boxes of surfaces and of something else do not meet, with their distance.
 * \param low and \param high in LPS mm */
void
RequireSamePlace(const std::filesystem::path & file,
                 const std::array<double, 3> & low,
                 const std::array<double, 3> & high,
                 const std::vector<SceneSurface> & surfaces);

} // namespace rhombic

#endif
