#ifndef rhombicSlicePart_h
#define rhombicSlicePart_h

#include "rhombicPictureSteps.h"

#include "itkImageRegion.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** What slices need of a label map. */
struct SlicePart
{
  std::optional<itk::ImageRegion<3>> voxels; ///< that the slices pass; nothing: surfaces are needed as a whole
  std::map<std::string, Vector3> places;     ///< of slices through the middle of the labels or through some of them, by
                                             ///< PlaneRequest::place: found from voxels
};

/** The part of a label map that slices pass, if it is less than half of the map, if no isosurface has a say in where
 * slices lie, and if no parts of surfaces are removed. */
SlicePart
FindSlicePart(const std::vector<PlaneRequest> & slices, const PictureSource & source, const LoadedSource & loaded);

} // namespace rhombic

#endif
