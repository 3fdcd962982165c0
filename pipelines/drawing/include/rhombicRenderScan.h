#ifndef rhombicRenderScan_h
#define rhombicRenderScan_h

#include "rhombicEvents.h"
#include "rhombicScanSource.h"
#include "rhombicScene.h"
#include "rhombicSidecar.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** \class RenderScanSettings
 * \brief From a scan to pictures of its surfaces. */
struct RenderScanSettings
{
  ScanSource source;
  SurfaceSelection surfaces;
  RenderSettings render; ///< its view is set from the list below, its memory is the source's
  std::vector<View> views{ View::Anterior };
  std::filesystem::path picture; ///< with more than one view, the view's name is added to the stem
  Provenance provenance;
};

/** Renders a scan, with a sidecar for each picture; returns the pictures' paths. All files appear together at the end,
 * or none does. Throws Failure; for outputs that can't be written or drawn, before the scan is read. */
std::vector<std::filesystem::path>
RenderScan(const RenderScanSettings & settings, const Events & events);

} // namespace rhombic

#endif
