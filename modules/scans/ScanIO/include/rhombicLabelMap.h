#ifndef rhombicLabelMap_h
#define rhombicLabelMap_h

#include "rhombicLabelTable.h"
#include "rhombicScan.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** A label of a label map and its volume. */
struct LabelSummary
{
  Label label;
  std::size_t numberOfVoxels = 0;
  double millilitres = 0;
};

/** Whether a scan's values are labels rather than intensities: at most 4096 different values, all whole numbers of at
 * least 0; and at least half of all adjacent voxels along x that are both not 0 have equal values. */
bool
LooksLikeLabelMap(const Scan & scan);

/** The labels in all layers of a label map, sorted by value, without the background 0. Labels that \a table lacks are
 * named "label N" and get a colour by their value. Volumes are sums of VoxelVolumes().
 *
 * Throws Failure(Unreadable) when values are not whole numbers or there are more than 4096 different ones. */
std::vector<LabelSummary>
SummarizeLabels(const Scan & scan, const LabelTable & table);

/** Whether these are the labels of a mask: a single one, of value 1 or 255. */
bool
IsMask(const std::vector<LabelSummary> & labels);

/** The smallest region that holds all voxels that are not 0 in any of the layers; the whole image if all are 0. */
itk::ImageRegion<3>
RegionOfLabels(const std::vector<ScanImage> & layers);

/** Checks that the box around all labels of a label map is in its scan, in world space; the two may have different
 * grids. Returns a sentence for the user when less than 99 % of the box is in the scan, else "". Throws
 * Failure(Geometry) when no part of it is. */
std::string
RequireOverlap(const Scan & scan,
               const Scan & labels,
               const std::filesystem::path & scanPath,
               const std::filesystem::path & labelsPath);

} // namespace rhombic

#endif
