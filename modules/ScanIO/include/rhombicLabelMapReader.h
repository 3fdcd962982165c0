#ifndef rhombicLabelMapReader_h
#define rhombicLabelMapReader_h

#include "rhombicLabelMap.h"
#include "rhombicScanReader.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Reads label maps for scans. Copies of a map share its image (see Scan). */

/** A label map, and the names and colours of its labels. */
struct LabelMap
{
  Scan scan;
  std::vector<LabelSummary> labels;
};

/** Where a label map is, and what its labels mean. */
struct LabelMapSource
{
  std::filesystem::path path;
  std::filesystem::path table; ///< empty: the table in the file, or the one beside it (see FindLabelTable())
};

/** Whether a scan is a label map: it has labels, or its values look like labels (see LooksLikeLabelMap()). */
bool
IsLabelMap(const Scan & scan);

/** The labels of a scan that is a label map. Throws Failure(Unreadable) for others. */
std::vector<LabelSummary>
FindLabels(const Scan & scan, const LabelMapSource & source);

/** Reads the label map of a scan, which may have another grid. The options are those of the scan; series and frame are
 * ignored. Throws Failure, also when the two do not overlap (see RequireOverlap()); labels partly outside the scan are
 * noted in the map's scan. */
LabelMap
ReadLabelMap(const LabelMapSource & source,
             const ScanReadOptions & options,
             const Scan & scan,
             const std::filesystem::path & scanPath);

} // namespace rhombic

#endif
