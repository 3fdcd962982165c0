#ifndef rhombicOutlinedSlice_h
#define rhombicOutlinedSlice_h

#include "rhombicPictureScene.h"
#include "rhombicRenderScan.h"
#include "rhombicSheet.h"

namespace rhombic
{

/** A slice of the scan in greys, black without a scan, and the curves along which it cuts the surfaces, in their
 * colours, fitted into so many pixels. */
SheetPicture
DrawOutlinedSlice(const PictureScene & scene,
                  const PlaneRequest & request,
                  const Vector3 & point,
                  const SliceSettings & settings,
                  int width,
                  int height);

} // namespace rhombic

#endif
