#ifndef rhombicAuditReport_h
#define rhombicAuditReport_h

#include "rhombicScanReport.h"

#include "itkTriangleSurfaceAudit.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * What an audit found, for machines and for people; units are in the keys. Thread safety: the functions are pure. */

/** All that an audit found, and the verdict. */
Report
ReportAudit(const itk::TriangleSurfaceAudit & audit);

/** The same for reading: a line each for shape, defects, self-intersections and triangles. */
std::vector<std::string>
DescribeAudit(const itk::TriangleSurfaceAudit & audit);

/** What keeps a surface from being watertight, as part of a sentence: "3 boundary edges"; empty when it is. */
std::string
DescribeLeaks(const itk::TriangleSurfaceAudit & audit);

} // namespace rhombic

#endif
