#ifndef rhombicAuditReport_h
#define rhombicAuditReport_h

#include "rhombicScanReport.h"

#include "itkTriangleSurfaceAudit.h"

#include <string>
#include <vector>

namespace rhombic
{

/** An audit as JSON; units are in the keys. */
Report
ReportAudit(const itk::TriangleSurfaceAudit & audit);

/** An audit in a line each for shape, defects, self-intersections and quality of triangles. */
std::vector<std::string>
DescribeAudit(const itk::TriangleSurfaceAudit & audit);

/** The defects that keep a surface from being watertight, as "3 boundary edges"; empty when it is. */
std::string
DescribeLeaks(const itk::TriangleSurfaceAudit & audit);

} // namespace rhombic

#endif
