#ifndef rhombicPlaneRequest_h
#define rhombicPlaneRequest_h

#include "rhombicSlicePlane.h"

#include <string>
#include <vector>

namespace rhombic
{

/** A plane at right angles to an axis of the patient, through a place that is known once there are surfaces. */
struct PlaneRequest
{
  SlicePlane plane = SlicePlane::Axial;
  std::string place; ///< "12.5": mm along the axis in LPS; "#40": a slice of voxels, from 0; empty: the middle of the
                     ///< scene; else the centroid of the surfaces whose names fit this pattern (see FitsPattern())
};

/** A plane, and the side of it that is removed. */
struct CutRequest
{
  PlaneRequest plane;
  bool removesHigher = true; ///< the side of larger coordinates in LPS
};

/** Throws Failure(Usage) for a position in LPS mm that is not in the box. */
void
RequireInside(SlicePlane plane, double position, const SliceBox & box);

/** Throws Failure(Usage) for a slice that a scan does not have and a position outside of it. The scan needs no voxels.
 */
void
CheckPlaces(const std::vector<PlaneRequest> & requests, const Scan & scan);

/** A plane written as axial, coronal=liver, sagittal=-12.5 or axial=#40. Throws Failure(Usage). */
PlaneRequest
ParsePlaneRequest(const std::string & text);

/** A cut written as a plane, or as x>12, y<-30, z>100 in LPS mm for what is removed. Of planes, what lies above
 * (axial), in front (coronal) or to the patient's left (sagittal) is removed. Throws Failure(Usage). */
CutRequest
ParseCutRequest(const std::string & text);

} // namespace rhombic

#endif
