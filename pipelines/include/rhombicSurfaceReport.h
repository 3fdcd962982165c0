#ifndef rhombicSurfaceReport_h
#define rhombicSurfaceReport_h

#include "rhombicSourceSurfaces.h"
#include "rhombicScanReport.h"

namespace rhombic
{

/** The source of surfaces: files, then those of the label map, if they are hashed; scan, removed objects, denoising and
 * lattice, as far as there are any. */
Report
ReportSource(const LoadedSource & loaded, const ScanSource & source);

/** The measures of a finished surface (see rhombicMeasureTable.h), and the results of all steps that it went through.
 */
Report
ReportMeshedSurface(const MeshedSurface & surface);

} // namespace rhombic

#endif
