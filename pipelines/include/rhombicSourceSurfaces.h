#ifndef rhombicSourceSurfaces_h
#define rhombicSourceSurfaces_h

#include "rhombicLabelSurfaces.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanSource.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceMeasures.h"

#include "itkTriangleSurfaceAudit.h"
#include "itkTriangleSurfaceThickness.h"

#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Measures of a surface as it was extracted, before it was finished. */
struct ExtractedSize
{
  double volume = 0.0; ///< mm^3
  double area = 0.0;   ///< mm^2
  itk::SizeValueType triangles = 0;
};

/** A surface on its way from a scan to a file or picture, and the results of each step. */
struct MeshedSurface
{
  SceneSurface scene;

  std::optional<SurfaceRequest> request; ///< for isosurfaces
  itk::FCCIsosurfaceMode mode{};         ///< for isosurfaces
  std::optional<EnclosedParts> enclosed; ///< for isosurfaces of enclosed parts
  itk::ImageBase<3>::Pointer lattice;    ///< for isosurfaces: position of the lattice, without values
  itk::ImageBase<3>::Pointer grid;       ///< for isosurfaces: see LoadedSource
  std::optional<LabelSurface> label;     ///< for labels; its scene is empty

  std::optional<WholeSurface> whole;          ///< for large isosurfaces in pictures: see ExtractedSurface
  std::optional<ExtractedSize> extracted;     ///< for surfaces of scans
  std::optional<IsosurfaceVolume> isosurface; ///< for isosurfaces in files: volume of the whole isosurface

  PartRemoval parts;
  Refinement refinement;                         ///< for files
  itk::TriangleSurface::ConstPointer forDrawing; ///< for labels in pictures: all their parts in fewer triangles

  std::string identity; ///< this and all below: of the surface as its file holds it
  itk::SizeValueType points = 0;
  itk::SizeValueType triangles = 0;
  SurfaceMeasures measures;
  std::optional<SurfaceDeviation> deviation; ///< for isosurfaces of scans
  std::optional<itk::TriangleSurfaceAudit> audit;
  std::optional<itk::ThinParts> thin; ///< for files, if it was asked for

  /** Volume of the parts that were kept, as extracted, in mm^3. For surfaces of scans. */
  double
  GetVolumeOfKeptParts() const
  {
    return extracted.value().volume - parts.filled.volume - parts.removed.volume;
  }
};

/** The purpose of surfaces. */
enum class SurfaceUse
{
  Files,   ///< isosurfaces are untangled, smoothed and simplified (RefineSurface()), walls of labels by RefineWalls()
  Pictures ///< surfaces are smoothed, and their normals last; that takes less time
};

/** How the surfaces of a source are made. All references must outlive the object. */
struct SurfaceMaking
{
  const ScanSource & source;
  const SurfaceSelection & selection;
  const SurfaceFinish & finish; ///< of each surface; combined with that of its request
  SurfaceUse use;
  const Events & events;
  std::optional<itk::ImageRegion<3>> part = std::nullopt;       ///< of the label map: see LabelSurfaceSettings::part
  const SurfaceViewing * viewing = nullptr;                     ///< for isosurfaces that are only looked at
  std::function<void(const LabelWork & work)> checkLabels = {}; ///< see LabelSurfaceSettings::check
};

/** Extracts isosurfaces and labels, in this order. Walls between labels are refined here, once for both sides. The
 * source's volumes can be dropped afterwards. Throws Failure.
 *
 * \param computesNormals whether isosurfaces get normals; labels always do */
std::vector<MeshedSurface>
ExtractSource(const SurfaceMaking & making, const LoadedSource & loaded, bool computesNormals = true);

/** Removes parts of a surface, and refines or smooths it. Returns whether anything is left; notes say if not. A label
 * near a part of its map stays as it is. */
bool
FinishSurface(const SurfaceMaking & making, MeshedSurface & surface);

/** Finishes surfaces, and drops surfaces without triangles. Throws Failure(Empty) if no surface is left. */
void
FinishSurfaces(const SurfaceMaking & making, std::vector<MeshedSurface> & surfaces);

} // namespace rhombic

#endif
