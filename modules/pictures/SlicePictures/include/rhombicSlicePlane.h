#ifndef rhombicSlicePlane_h
#define rhombicSlicePlane_h

#include "rhombicPicture.h"
#include "rhombicProjection.h"
#include "rhombicScan.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Where slices lie. A slice is a Projection: the plane through its centre, seen along its frame's look. */

/** The planes at right angles to the patient's axes. */
enum class SlicePlane
{
  Axial,   ///< at right angles to the line from foot to head
  Coronal, ///< from front to back
  Sagittal ///< from right to left
};

/** From which side axial and coronal slices are seen. */
enum class SliceConvention
{
  Radiological, ///< from the feet and from the front: the patient's right is on the picture's left
  Neurological  ///< from the head and from behind: the patient's right is on the picture's right
};

/** The number of the LPS axis at right angles to a plane: its coordinate is the same in all of a slice. */
std::size_t
AxisOf(SlicePlane plane);

/** "axial", "coronal" or "sagittal". */
std::string
NameOf(SlicePlane plane);

/** The plane with this name, in upper or lower case. Throws Failure(Usage), listing the names, when there is none. */
SlicePlane
SlicePlaneFromName(const std::string & name);

/** The axes of a slice. Anterior is up in axial slices, the head in the others. Sagittal slices are seen from the left,
 * with anterior on the picture's left, in both conventions. */
ViewFrame
FrameOf(SlicePlane plane, SliceConvention convention = SliceConvention::Radiological);

/** \class SliceBox
 * \brief The box that slices show, around a scan or a part of a scan. The perpendicular sides may have any directions.
 */
struct SliceBox
{
  Vector3 corner;               ///< in LPS mm
  std::array<Vector3, 3> sides; ///< from that corner to the three next to it, in mm
  Vector3 spacing;              ///< distances of samples along each side, in mm
};

/** The smallest box, along the axes of the scan's slices, that holds all voxels to their outer faces. */
SliceBox
BoxOf(const Scan & scan);

/** The box between two corners along the patient's axes, in LPS mm. */
SliceBox
BoxOf(const Vector3 & lowest, const Vector3 & highest, const Vector3 & spacing);

/** A point of the slice at a position on the patient's axis, in mm: z of LPS for axial, y for coronal, x for sagittal
 * slices. The point is below or beside the middle of the box. */
Vector3
PointAtPosition(const SliceBox & box, SlicePlane plane, double position);

/** The middle of a slice of voxels, counted from 0 in the scan's order along that axis of the scan which is nearest to
 * the patient's axis. Throws Failure(Usage) when there is no such slice. */
Vector3
PointAtIndex(const Scan & scan, SlicePlane plane, std::size_t index);

/** Points on the planes of \a count slices that divide a box evenly along the look direction, in the order in which the
 * viewer meets them. The distance of two slices is the box's depth over \a count; the first and the last are half of
 * that from its ends. */
std::vector<Vector3>
SpreadEvenly(const SliceBox & box, const ViewFrame & frame, std::size_t count);

/** The slice through a point that shows the whole width and height of a box, with the box's middle in the middle of the
 * picture. For the organ or label of a surface, the point may be itk::ComputeTriangleSurfaceCentroid().
 *
 * \param frame any: slices may be oblique
 * \param pixelSize in mm; 0: the smallest distance of samples along those two sides that are most nearly in the plane,
 * so that pixels of axial slices of an axial scan are its voxels
 *
 * Throws Failure(Usage) when the plane does not meet the box, and for a pixel size that is negative or makes pictures
 * more than 65536 pixels wide or high. */
Projection
SliceThrough(const Vector3 & point, const SliceBox & box, const ViewFrame & frame, double pixelSize = 0.0);

/** The same for a picture of given size in pixels, with the smallest pixels that show the whole box between margins,
 * which have to leave some of the picture. */
Projection
SliceOfSize(int width,
            int height,
            const Vector3 & point,
            const SliceBox & box,
            const ViewFrame & frame,
            const Margins & margins = {});

} // namespace rhombic

#endif
