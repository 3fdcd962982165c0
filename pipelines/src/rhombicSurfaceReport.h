#ifndef rhombicSurfaceReport_h
#define rhombicSurfaceReport_h

#include "rhombicMeshedSurface.h"
#include "rhombicScanReport.h"
#include "rhombicSourceLoading.h"

namespace rhombic
{

/** The source of surfaces: files, then those of the label map, if they are hashed; scan, removed objects, denoising and
 * lattice, as far as there are any. */
Report
ReportSource(const LoadedSource & loaded, const ScanSource & source);

/** The request of an isosurface, its size, and the parts left out of it. */
Report
ReportIsosurface(const SurfaceRequest & request, const ExtractedSurface & surface, itk::FCCIsosurfaceMode mode);

/** The surface of a label, compared with the label's voxels. */
Report
ReportLabelSurface(const LabelSurface & surface);

/** The results of all steps that a surface went through. */
Report
ReportMeshedSurface(const MeshedSurface & surface, itk::FCCIsosurfaceMode mode);

} // namespace rhombic

#endif
