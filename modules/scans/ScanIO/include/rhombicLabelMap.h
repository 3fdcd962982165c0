#ifndef rhombicLabelMap_h
#define rhombicLabelMap_h

#include "rhombicLabelTable.h"
#include "rhombicScan.h"
#include "rhombicScanReader.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Label maps, alone and of scans. Copies of a map share its image (see Scan). */

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

/** A label map, and the names and colours of its labels. */
struct LabelMap
{
  Scan scan;
  std::vector<LabelSummary> labels;

  /** The probabilities of labels 1, 2, ..., from 0 to 1, if the scan's labels are the most probable ones; else empty.
   */
  std::vector<itk::Image<float, 3>::Pointer> probabilities = {};
};

/** Where a label map is, and what its labels mean. */
struct LabelMapSource
{
  /** A label map, or several files and folders of masks and label maps of one grid, which become one (see OpenScan()).
   */
  std::vector<std::filesystem::path> paths;

  /** Empty: the table in the file, or the one beside it (see FindLabelTable(), FindDatasetTable()); and a mask that
   * has neither is called as its file (see namesMask). */
  std::filesystem::path table = {};

  /** Whether the label of a mask in a file of its own is called as the file, whose name may be the patient's. */
  bool namesMask = true;

  /** Volumes of probabilities from 0 to 1, 100 or 255, in place of a map: a file for each label, or one that holds
   * several volumes. They are numbered from 1, and have no names if there is no table. */
  std::vector<std::filesystem::path> probabilities = {};

  /** No file: the scan itself is the label map. */
  bool
  IsEmpty() const
  {
    return paths.empty() && probabilities.empty();
  }

  /** The first of the paths, of probabilities if there are any. */
  const std::filesystem::path &
  GetFirstPath() const
  {
    return probabilities.empty() ? paths.front() : probabilities.front();
  }
};

/** Whether a scan is a label map: it has labels, or its values look like labels (see LooksLikeLabelMap()). */
bool
IsLabelMap(const Scan & scan);

/** The labels of a scan that is a label map. Throws Failure(Unreadable) for others. */
std::vector<LabelSummary>
FindLabels(const Scan & scan, const LabelMapSource & source);

/** Reads the label map of a scan, which may have another grid. The options are those of the scan; series and frame are
 * ignored. Throws Failure, also when the two do not overlap (see RequireOverlap()); labels partly outside the scan are
 * noted in the map's scan. For volumes of probabilities, Failure is Geometry when they have different voxels or
 * unevenly spaced slices, Unreadable when values are no probabilities, and Usage for more than 4096 volumes. */
LabelMap
ReadLabelMap(const LabelMapSource & source,
             const ScanReadOptions & options,
             const Scan & scan,
             const std::filesystem::path & scanPath);

} // namespace rhombic

#endif
