#ifndef rhombicLabelSurfaces_h
#define rhombicLabelSurfaces_h

#include "rhombicEvents.h"
#include "rhombicLabelMap.h"
#include "rhombicSceneSurface.h"
#include "rhombicSurfaceFinish.h"

#include "itkContinuousIndex.h"
#include "itkFCCLattice.h"
#include "itkImageRegion.h"
#include "itkLabelWalls.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Surfaces of labels. Those of labels that touch share their wall. Copies of a LabelSurface share its surface. */

/** What it takes to make surfaces of labels. */
struct LabelWork
{
  std::uintmax_t bytes = 0; ///< in memory, besides the map; in temporary files where there is a BulkInTemporaryFiles
  double triangles = 0.0;   ///< of the walls
  bool isOfProbabilities = false; ///< which are in memory in any case
};

/** Which labels get a surface, and how it is made. */
struct LabelSurfaceSettings
{
  std::vector<std::string>
    labels; ///< names with wildcards (see MatchesPattern()), or values; empty: all that the label table shows
  double density = itk::FCCLattice::DefaultDensity; ///< lattice sites per voxel
  std::uintmax_t maximumMemory = 0;                 ///< bytes; 0: half of what is free

  /** The voxels in which walls are needed, as those that a slice passes: there the walls are those of the whole map to
   * within some hundredths of a voxel; farther away they are missing. Nothing: all voxels. Without effect on
   * probabilities. */
  std::optional<itk::ImageRegion<3>> part = std::nullopt;

  /** Is called before the work, and throws to refuse it. Empty: Failure(Memory) for more than the maximum. */
  std::function<void(const LabelWork & work)> check = {};
};

/** Estimates the work of LabelsToWalls() and of what follows it, from the faces between voxels of different labels:
 * mostly within 15 % of what is measured. Throws as LabelsToWalls() for \a settings.labels. */
LabelWork
EstimateLabelWork(const LabelMap & map, const LabelSurfaceSettings & settings);

/** Throws Failure(Memory) for work that takes more than the maximum. */
void
RequireMemory(const LabelWork & work, std::uintmax_t maximumMemory);

/** A label and its surface, in the label's name, colour and opacity, and how it compares with the label's voxels. */
struct LabelSurface
{
  SceneSurface scene;
  std::int32_t value = 0;
  std::size_t layer = 0; ///< of LabelMesh::walls
  std::size_t numberOfVoxels = 0;
  double voxelMillilitres = 0.0;
  double surfaceMillilitres = 0.0; ///< before RefineWalls()
  std::size_t pieces = 0;          ///< pieces of the label: voxels connected through faces, edges or corners
  std::size_t surfacePieces = 0;   ///< pieces of the surface: closed shells of positive volume
  bool isTorn = false; ///< more pieces than the label has, even than its voxels connected through faces alone
  bool isPart = false; ///< whether walls are missing (LabelSurfaceSettings::part): nothing of the surface is measured

  /** The relative difference between the volumes of surface and voxels. */
  double
  GetVolumeDifference() const
  {
    return surfaceMillilitres / voxelMillilitres - 1.0;
  }
};

/** Labels and the walls between them. */
struct LabelMesh
{
  /** Of each layer of the map that holds any of the labels: the walls between the numbers of labels, from 1 over all
   * layers; all that is no label of the layer is outside, 0. */
  std::vector<itk::LabelWalls::Pointer> walls;
  std::vector<LabelSurface> labels; ///< in the order of their values
};

/** The voxels of a label. */
struct LabelVoxels
{
  std::string name;
  std::size_t count = 0;
  itk::ImageRegion<3> region;
  itk::ContinuousIndex<double, 3> centroid;
};

/** Where labels lie, in the order of their values. \a labels and what is thrown for them: as LabelsToWalls() */
std::vector<LabelVoxels>
FindLabelVoxels(const LabelMap & map, const std::vector<std::string> & labels);

/** The walls between labels, and between them and all else, without the steps of the voxels: labels that touch share
 * their wall. Labels that overlap are in layers, each of which has its own walls. The surfaces of the labels are set by
 * ExtractSurfaces().
 *
 * The walls are those of itk::LabelsToFCCFilter and itk::FCCLabelSurfaceFilter, smoothed by itk::RelaxLabelWalls().
 * It moves points within an ellipsoid whose half axes are the edges of a voxel: a pixel in plane, a slice along. So
 * what a hand on thick slices leaves behind goes, notches and steps; vessels and sheets stay. Labels above 1 ml have
 * the volume of their voxels within 0.1 %. Pieces of a label that do not touch are not joined. Where the map has
 * probabilities, the walls are those of itk::ProbabilitiesToFCCFilter instead, as they are: labels that are not chosen
 * have walls to the others all the same.
 *
 * Where a label reaches the scan's border, its surface closes at the outer faces of the voxels there. A hollow label
 * has shells inside, too. Slices may be tilted, sheared or unevenly spaced. The result has the same bytes for any
 * number of threads.
 *
 * Throws Failure: Usage for a density that is not above 0 and at most 64, and for labels that the map doesn't hold;
 * Empty when there is none to show; Unreadable for more than 65,535 labels; Memory, before the work, when it needs too
 * much. */
LabelMesh
LabelsToWalls(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events);

/** Smooths and simplifies the walls as \a finish says, once for both labels of each wall, so that labels that touch
 * still share it (itk::RelaxLabelWalls(), itk::SimplifyLabelWalls()). That is beyond what LabelsToWalls() smooths. A
 * limit of triangles is one for all walls together, of which each layer gets a share by its triangles, at least one.
 * Removes no parts. Notes give the results, of which there is one for each layer.
 *
 * \param spacing of the voxels in mm */
std::vector<Refinement>
RefineWalls(LabelMesh & mesh, const SurfaceFinish & finish, double spacing, const Events & events);

/** The closed surface of a label, with normals: the triangles of its walls, in the order of the mesh. Touching surfaces
 * have the same points and, turned over, the same triangles on their common wall.
 *
 * \param label number in LabelMesh::labels */
itk::TriangleSurface::Pointer
ExtractSurface(const LabelMesh & mesh, std::size_t label);

/** Sets the surface of each label (ExtractSurface()). */
void
ExtractSurfaces(LabelMesh & mesh);

} // namespace rhombic

#endif
