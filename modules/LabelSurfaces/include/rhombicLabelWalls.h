#ifndef rhombicLabelWalls_h
#define rhombicLabelWalls_h

#include "rhombicLabelSurfaces.h"
#include "rhombicSurfaceFinish.h"

#include "itkLabelWalls.h"

#include <vector>

namespace rhombic
{

/** Labels and the walls between them. */
struct LabelMesh
{
  itk::LabelWalls::Pointer walls;   ///< of the numbers of labels, from 1; all that is no label here is outside, 0
  std::vector<LabelSurface> labels; ///< in the order of their values
};

/** The walls between labels, and between them and all else, without the steps of the voxels: labels that touch share
 * their wall. Surfaces of the labels are those of the walls (ExtractSurfaces()).
 *
 * The walls are those of itk::LabelsToFCCFilter and itk::FCCLabelSurfaceFilter, smoothed by itk::RelaxWalls(), which
 * moves points by 0.3 voxels at most. They suit thick slices better than LabelsToSurfaces(), and parts that are hardly
 * wider than a voxel less: such parts may come apart. Labels above 1 ml have the volume of their voxels within 1 %.
 * LabelSurface::finerPieces and protectedVoxels are 0; the mode of the settings has no effect.
 *
 * Where a label reaches the scan's border, its surface closes at the outer faces of the voxels there. Slices may be
 * tilted, sheared or unevenly spaced. The result has the same bytes for any number of threads.
 *
 * Throws Failure: those of LabelsToSurfaces(); Unreadable for more than 65,535 labels. */
LabelMesh
LabelsToWalls(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events);

/** Smooths and simplifies the walls as \a finish says, once for both labels of each wall, so that labels that touch
 * still share it (itk::RelaxWalls(), itk::SimplifyWalls()). A limit of triangles is one for all walls together.
 * Removes no parts. Notes give the results.
 * \param spacing of the voxels in mm */
Refinement
RefineWalls(itk::LabelWalls & walls, const SurfaceFinish & finish, double spacing, const Events & events);

/** Sets the closed surface of each label, with normals: the triangles of its walls, in the order of the mesh. Touching
 * surfaces have the same points and, turned over, the same triangles on their common wall. */
void
ExtractSurfaces(LabelMesh & mesh);

} // namespace rhombic

#endif
