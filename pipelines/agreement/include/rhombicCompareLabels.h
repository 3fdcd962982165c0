#ifndef rhombicCompareLabels_h
#define rhombicCompareLabels_h

#include "rhombicEvents.h"
#include "rhombicScanSource.h"
#include "rhombicSidecar.h"

#include "itkTriangleSurfaceAgreement.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** The kind of the two segmentations. */
enum class ComparedKind
{
  Labels,     ///< label maps, masks or folders of masks
  Surfaces,   ///< files of closed surfaces
  Isosurfaces ///< scans, of which one isosurface each is compared
};

/** The tolerance of the normalised surface Dice of labels whose names fit a pattern. */
struct LabelTolerance
{
  std::string pattern;
  double millimetres;
};

/** Two segmentations, and how they are compared. */
struct CompareLabelsSettings
{
  ComparedKind kind = ComparedKind::Labels;
  ScanSource first;                 ///< A
  ScanSource second;                ///< B
  std::filesystem::path firstTable; ///< of label names; empty: see LabelMapSource::table
  std::filesystem::path secondTable;
  SurfaceRequest isosurface; ///< for isosurfaces

  std::vector<std::pair<std::string, std::string>> pairs; ///< names or values of a label of A and one of B
  bool pairsByValue = false;                              ///< even if labels have names
  std::vector<std::string> only;                          ///< patterns of names of A or B; empty: all
  std::vector<std::string> hidden;

  std::vector<LabelTolerance> tolerances{ { "*", 1.0 } }; ///< later ones count more
  std::filesystem::path toleranceTable;                   ///< the file of the tolerances, if any, which is no output
  bool takesVoxelSurfaces = false; ///< of label maps: the voxels' faces in place of smooth surfaces

  std::filesystem::path transform;  ///< of ITK in text, affine: maps points of A's space to B's; empty: one space
  bool isTransformInverted = false; ///< the transform maps points of B's space to A's

  std::optional<double> days;     ///< from A to B, above 0: the table has the growth of each label
  std::vector<std::string> parts; ///< patterns of names of labels of maps, whose parts are compared one by one
  bool hasVoxelMetrics = false;   ///< of label maps on one grid: see VoxelMetrics

  std::filesystem::path table; ///< .csv, .tsv or .json; empty: none
  std::filesystem::path page;  ///< for RenderAgreement(), which needs the surfaces: they are kept; empty: none
  Provenance provenance;
};

/** Which of two segmentations has a label. */
enum class AgreementStatus
{
  Compared,
  MissingInFirst,
  MissingInSecond,
  BothEmpty
};

/** What became of the parts of a label that overlap: as "split" if A has one and B has two. */
struct PartChange
{
  std::size_t partsOfFirst = 0;
  std::size_t partsOfSecond = 0;
};

/** What became of parts of a label from A to B: new, gone, kept, split, merged or regrouped. */
std::string
NameChange(const PartChange & change);

/** Measures between the corners of voxels, as DeepMind's program surface-distance defines them. */
struct VoxelMetrics
{
  double meanToSecond = 0.0; ///< mean distance in mm from A to B
  double meanToFirst = 0.0;
  double hausdorff = 0.0; ///< in mm
  double hausdorff95 = 0.0;
  double normalizedDice = 0.0;
};

/** Measures of a label in one of the segmentations. */
struct ComparedVolume
{
  double millilitres = 0.0;               ///< inside the surface
  std::optional<double> voxelMillilitres; ///< of the voxels
};

/** The agreement of two labels. */
struct LabelAgreement
{
  std::string label;
  AgreementStatus status = AgreementStatus::Compared;
  ComparedVolume first;
  ComparedVolume second;
  std::optional<double> dice; ///< on the voxels of A's grid, with the nearest voxel of B; nothing for surface files
  std::optional<double> iou;
  itk::TriangleSurfaceAgreement surfaces; ///< for AgreementStatus::Compared, and its normalised Dice
  double tolerance = 1.0;                 ///< in mm
  std::optional<double> days;             ///< from A to B
  /** Mean distance in mm from A's surface to the surface of its voxels, below which distances mean nothing. */
  std::optional<double> noiseFloor;
  std::optional<double> centroidShift;              ///< in mm
  Colour colour{ 0.8, 0.8, 0.8 };                   ///< of the label in A, or else in B
  itk::TriangleSurface::ConstPointer firstSurface;  ///< for pages, and next; null where the label is missing
  itk::TriangleSurface::ConstPointer secondSurface; ///< in A's space
  std::optional<PartChange> change;                 ///< for parts of a label
  std::optional<VoxelMetrics> voxels;               ///< for AgreementStatus::Compared, if asked for
};

/** The days from one date to another, both written as 2025-01-31. Throws Failure(Usage) for other texts, for dates that
 * do not exist, and unless the second is later. */
double
CountDays(const std::string & first, const std::string & second);

/** Checks the settings, without reading or writing anything. Returns the files that CompareLabels() writes. Throws
 * Failure(Usage). */
std::vector<std::filesystem::path>
CheckCompareLabels(const CompareLabelsSettings & settings);

/** The agreement of all labels, in the order of A's labels, then those of B alone; and the files.
 *
 * Labels are paired by name if both maps have names, and by value if neither has. Two masks of one label each are a
 * pair. A label that is compared in parts has a row for each group of parts of A and B that overlap. Surface files are
 * paired as labels with names; two files of one surface each are a pair. B's points are brought to A's space. Notes
 * give the agreement of each label, and doubts.
 *
 * Throws Failure: Usage for labels that cannot be paired, for patterns that fit nothing, and for maps of which only one
 * has names, for patterns of parts that fit nothing or a label of more than 1000 parts, and for voxel metrics of maps
 * that do not have one grid; Geometry for segmentations that lie apart; Unreadable for a transform that is not affine;
 * and those of LoadVolume(), LabelsToWalls() and ReadSurfaces(). */
std::vector<LabelAgreement>
CompareLabels(const CompareLabelsSettings & settings, const Events & events, std::vector<MadeFile> & made);

/** A table for people: a line for each label, and one of the means. */
std::string
DescribeAgreement(const std::vector<LabelAgreement> & labels);

} // namespace rhombic

#endif
