#ifndef rhombicMeshedSurface_h
#define rhombicMeshedSurface_h

#include "rhombicLabelSurfaces.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceMeasures.h"

#include "itkTriangleSurfaceAudit.h"

#include <optional>
#include <string>

namespace rhombic
{

/** Measures of a surface as it was extracted, before it was finished. */
struct ExtractedSize
{
  double volume = 0.0; ///< mm^3
  double area = 0.0;   ///< mm^2
  itk::SizeValueType triangles = 0;
};

/** \class MeshedSurface
 * \brief A surface on its way from a scan to a file, and the results of each step. */
struct MeshedSurface
{
  SceneSurface scene;

  std::optional<SurfaceRequest> request; ///< for isosurfaces
  itk::FCCIsosurfaceMode mode{};         ///< for isosurfaces
  std::optional<EnclosedParts> enclosed; ///< for isosurfaces of enclosed parts
  std::optional<LabelSurface> label;     ///< for labels; its scene is empty

  std::optional<ExtractedSize> extracted;     ///< for surfaces of scans
  std::optional<IsosurfaceVolume> isosurface; ///< for isosurfaces: volume of the whole isosurface

  PartRemoval parts;
  Refinement refinement;

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

/** Change in %. */
inline double
PercentChange(double before, double after)
{
  return 100.0 * (after - before) / before;
}

} // namespace rhombic

#endif
