#ifndef rhombicComparedSide_h
#define rhombicComparedSide_h

#include "rhombicCompareLabels.h"
#include "rhombicLabelOverlap.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicLabelPairs.h"

#include <map>
#include <optional>
#include <vector>

namespace rhombic
{

/** One of two segmentations: labels, and what their surfaces are made of. */
struct ComparedSide
{
  std::string file;                  ///< for messages
  std::vector<ComparedLabel> labels; ///< those with voxels or triangles, and those that were divided into parts
  bool isSingle = false;             ///< one mask, one surface or one isosurface, whose name does not matter

  std::optional<LabelMap> map;                  ///< of labels and isosurfaces: 1 is inside
  std::map<std::int32_t, LabelMoments> moments; ///< of the map's labels

  std::optional<LabelMesh> mesh; ///< of the map's labels

  /** For isosurfaces, surfaces of files and voxels' surfaces: a surface for each label. */
  std::vector<itk::TriangleSurface::ConstPointer> surfaces;

  /** The surface of a label, from surfaces or mesh. */
  itk::TriangleSurface::ConstPointer
  GetSurface(std::size_t label) const;
};

/** Reads a segmentation. \a second: B, else A. Throws Failure. */
ComparedSide
LoadSide(const CompareLabelsSettings & settings, bool isSecond, const Events & events);

/** Makes the mesh of a label map, or the surfaces of the voxels of some labels, by their numbers in
 * ComparedSide::labels. Does nothing for other segmentations. */
void
ExtractSide(const CompareLabelsSettings & settings,
            const std::vector<std::size_t> & chosen,
            const Events & events,
            ComparedSide & side);

/** The corners of the box around a map, or around all surfaces, in LPS mm; none for an empty side. */
std::vector<itk::Point<double, 3>>
FindCorners(const ComparedSide & side);

} // namespace rhombic

#endif
