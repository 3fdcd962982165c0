#ifndef rhombicSurfaceReport_h
#define rhombicSurfaceReport_h

#include "rhombicSourceSurfaces.h"
#include "rhombicScanReport.h"
#include "rhombicWallAudit.h"

#include <string>
#include <vector>

namespace rhombic
{

/** The files of a source, then those of its label map, with their hash; null if the source isn't to be hashed. Throws
 * Failure(Unreadable). Reads all of the files. */
Report
ReportInput(const LoadedSource & loaded, const ScanSource & source);

/** The source of surfaces: \a input, which ReportInput() returns, scan, removed objects, denoising and lattice, as far
 * as there are any. */
Report
ReportSource(const LoadedSource & loaded, const ScanSource & source, const Report & input);

/** The measures of a finished surface (see rhombicMeasureTable.h), and the results of all steps that it went through.
 */
Report
ReportMeshedSurface(const MeshedSurface & surface);

/** An audit as JSON; units are in the keys. */
Report
ReportAudit(const itk::TriangleSurfaceAudit & audit);

/** An audit in a line each for shape, defects, self-intersections and quality of triangles. */
std::vector<std::string>
DescribeAudit(const itk::TriangleSurfaceAudit & audit);

/** The defects that keep a surface from being watertight, as "3 boundary edges"; empty when it is. */
std::string
DescribeLeaks(const itk::TriangleSurfaceAudit & audit);

/** An audit of walls as JSON. */
Report
ReportWalls(const WallAudit & audit);

/** An audit of walls in one line. */
std::string
DescribeWalls(const WallAudit & audit);

} // namespace rhombic

#endif
