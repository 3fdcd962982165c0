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

/** A label that a label map holds, and how much of it. Thread safety: a value. */
struct LabelSummary
{
  Label label;
  std::size_t numberOfVoxels = 0;
  double millilitres = 0;
};

/** Whether a scan's values are labels rather than intensities: whole numbers, none negative, at most 4096 different
 * ones, and at least half of the pairs of neighbours along columns, both not 0, equal. Thread safe. */
bool
LooksLikeLabelMap(const Scan & scan);

/** The labels in a label map, by value, without the background 0. Labels that \a table lacks are named "label N" and
 * coloured by AnatomicalColour(). Volumes are sums of VoxelVolumes().
 *
 * Throws Failure(Unreadable) when values are not whole numbers or there are more than 4096 different ones. Thread safe.
 */
std::vector<LabelSummary>
SummarizeLabels(const Scan & scan, const LabelTable & table);

/** The part of \a inner's box, voxels included, that lies in \a outer's box in world space, from 0 to 1. Measured at
 * 32 x 32 x 32 points; exactly 0 and 1 for boxes that are clearly apart and for a box in itself. Thread safe. */
double
OverlapOfBoxes(const itk::ImageBase<3> & inner, const itk::ImageBase<3> & outer);

/** Checks that a label map lies where its scan does. The two may have different grids: what counts is where they are in
 * the patient, and of the label map the box around all labels. Returns a sentence for the user when less than 99 % of
 * that box is in the scan, else "". Throws Failure(Geometry) when nothing is. Thread safe. */
std::string
RequireOverlap(const Scan & scan,
               const Scan & labels,
               const std::filesystem::path & scanPath,
               const std::filesystem::path & labelsPath);

} // namespace rhombic

#endif
