#ifndef rhombicSourceSurfaces_h
#define rhombicSourceSurfaces_h

#include "rhombicLabelSurfaces.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanSource.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceMeasures.h"

#include "itkTriangleSurfaceAudit.h"

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
  std::optional<LabelSurface> label;     ///< for labels; its scene is empty

  std::optional<ExtractedSize> extracted;     ///< for surfaces of scans
  std::optional<IsosurfaceVolume> isosurface; ///< for isosurfaces in files: volume of the whole isosurface

  PartRemoval parts;
  Refinement refinement; ///< for files

  std::string identity; ///< this and all below: of the surface as its file holds it
  itk::SizeValueType points = 0;
  itk::SizeValueType triangles = 0;
  SurfaceMeasures measures;
  std::optional<SurfaceDeviation> deviation; ///< for isosurfaces of scans
  std::optional<itk::TriangleSurfaceAudit> audit;

  /** Volume of the parts that were kept, as extracted, in mm^3. For surfaces of scans. */
  double
  GetVolumeOfKeptParts() const
  {
    return extracted.value().volume - parts.filled.volume - parts.removed.volume;
  }
};

/** What surfaces are made for. */
enum class SurfaceUse
{
  Files,   ///< isosurfaces are untangled, smoothed and simplified (RefineSurface()), walls of labels by RefineWalls()
  Pictures ///< surfaces are smoothed, and their normals last; that takes less time
};

/** Makes the surfaces of a source in two steps, between which the source's volumes can be dropped.
 *
 * All arguments of the constructor must outlive the object. */
class SourceSurfaces
{
public:
  /** \param finish of each surface; combined with that of its request */
  SourceSurfaces(const ScanSource & source,
                 const SurfaceSelection & selection,
                 const SurfaceFinish & finish,
                 SurfaceUse use,
                 const Events & events)
    : m_Source(source)
    , m_Selection(selection)
    , m_Finish(finish)
    , m_Use(use)
    , m_Events(events)
  {}

  /** Extracts isosurfaces and labels, in this order. Walls between labels are refined here, once for both sides.
   * Throws Failure.
   *
   * \param computesNormals whether isosurfaces get normals; labels always do */
  std::vector<MeshedSurface>
  Extract(const LoadedSource & loaded, bool computesNormals = true);

  /** Removes parts of a surface, and refines or smooths it. Returns whether anything is left; notes say if not. */
  bool
  Finish(MeshedSurface & surface) const;

  /** Finishes surfaces, and drops surfaces without triangles. Throws Failure(Empty) if no surface is left. */
  void
  Finish(std::vector<MeshedSurface> & surfaces) const;

private:
  void
  AddIsosurfaces(const LoadedSource & loaded, bool computesNormals, std::vector<MeshedSurface> & surfaces);
  void
  AddLabels(const LoadedSource & loaded, std::vector<MeshedSurface> & surfaces) const;
  std::optional<itk::CrossingCandidates>
  FindCandidates(const itk::TriangleSurface & surface) const;

  const ScanSource & m_Source;
  const SurfaceSelection & m_Selection;
  const SurfaceFinish & m_Finish;
  SurfaceUse m_Use;
  const Events & m_Events;
  itk::ImageBase<3>::Pointer m_Lattice; ///< position of the lattice, without values; null without isosurfaces
  itk::ImageBase<3>::Pointer m_Grid;    ///< see LoadedSource
};

} // namespace rhombic

#endif
