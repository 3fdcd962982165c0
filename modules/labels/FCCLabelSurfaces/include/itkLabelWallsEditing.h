#ifndef itkLabelWallsEditing_h
#define itkLabelWallsEditing_h

#include "itkLabelWalls.h"
#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceSmoothing.h"

namespace itk
{

/** Smooths walls, and keeps the volume of each label. Walls pass a low-pass filter (a windowed sinc of degree
 * iterations, after Taubin, Zhang and Golub, ECCV 1996), which keeps waves that are longer than about iterations / 2
 * edges: pits, steps of slices and bumps go, and tubes keep their radius. The curves where walls meet are filtered
 * along themselves. Then walls and their curves move along their normals until each label has its volume again, or the
 * volume that \a volumes gives: within 0.001 %, and within 0.01 % if triangles that met were put back; or it lacks a
 * layer of a thousandth of the largest move in the direction in which that is least. Points where curves meet or walls
 * touch stay.
 *
 * No point moves farther than maximumMove from where it is at the call, or out of the ellipsoid of halfAxes. Where
 * triangles would turn by 155 degrees or more, lose more than 99 hundredths of their area, or meet others elsewhere
 * than at shared corners and sides, points move less, and those around them a little less. The report is of all moves
 * together. So the walls of each label stay a closed, oriented manifold without crossings, if they were. Labels of
 * which all points are as far as they may go can have another volume. Throws ExceptionObject as Verify() of the
 * settings does. The same bytes for any number of threads.
 *
 * \param volumes by label in mm^3, such as LabelsToFCCFilter::GetVoxelVolumes(); labels without a volume, or with 0,
 * keep their own
 * \param report as that of SmoothTriangleSurface() */
TriangleSurfaceSmoothingReport
RelaxLabelWalls(LabelWalls & walls,
                const TriangleSurfaceSmoothingSettings & settings,
                const std::vector<double> & volumes = {},
                const rhombic::ProgressFunction & report = {});

/** Reduces the number of triangles of walls, as SimplifyTriangleSurface() does, once for both labels of each wall:
 * labels still share their walls, without gaps and overlaps.
 *
 * Points on the curves where walls meet collapse along these, and points where curves meet stay, so that the surface of
 * each label keeps its topology. Distances are checked wall by wall: each wall, in both directions, against the same
 * wall before. A tenth of maximumError is kept for RelaxLabelWalls() without iterations at the end, so that labels keep
 * their volumes; if maximumError is infinite, volumes are not restored. Reports and throws as SimplifyTriangleSurface()
 * does. */
TriangleSurfaceSimplificationReport
SimplifyLabelWalls(LabelWalls & walls,
                   const TriangleSurfaceSimplificationSettings & settings,
                   const rhombic::ProgressFunction & report = {});

} // namespace itk

#endif
