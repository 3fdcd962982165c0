#ifndef rhombicColourBy_h
#define rhombicColourBy_h

#include "rhombicColourScale.h"
#include "rhombicEvents.h"
#include "rhombicSceneSurface.h"
#include "rhombicSidecar.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** What the points of surfaces are coloured by. */
struct ColourBy
{
  /** Where the numbers come from. */
  enum class Kind
  {
    Volume,    ///< the values of a volume, linear between its voxels
    Distance,  ///< the signed distance to another surface in mm: above 0 outside of it
    Curvature, ///< mean curvature in 1/mm: see ComputeTriangleSurfaceMeanCurvature()
    Thickness  ///< diameter of the largest inscribed ball in mm: see ComputeTriangleSurfaceThickness()
  };

  /** Which of a volume's values a point has. */
  enum class Summary
  {
    AtSurface, ///< the value at the point
    Mean,      ///< of the values along the inward normal, as far as the depth, but not out of the body again
    Maximum    ///< the highest of these
  };

  Kind kind = Kind::Volume;
  std::filesystem::path
    file; ///< a volume; for distances surface files, or a label map whose labels have the same names
  std::optional<std::pair<double, double>> range; ///< of the colours; nothing: what 96 % of the points have, of
                                                  ///< distances and curvatures 95 %, and the same on both sides of 0
  std::string map; ///< of GetColourMaps(); empty: diverging for distances and curvatures, else viridis
  Summary summary = Summary::AtSurface; ///< of volumes
  double depth = 0.0;                   ///< mm; of Mean and Maximum
  double radius = 2.0;                  ///< mm; of the places around a point that its curvature is taken from

  /** Of a volume's voxels: as ScanReadOptions has them. */
  std::uintmax_t maximumMemory = 0;
  std::filesystem::path temporaryFolder{};
};

/** What is written as pet.nii.gz, pet.nii.gz,0,7,inferno, pet.nii.gz,max:5mm, distance:other.stl,
 * distance:labels.nii.gz,-2,2, thickness,0,10, curvature or curvature:3mm. Throws Failure(Usage). */
ColourBy
ParseColourBy(const std::string & text);

/** The files that numbers come from, if any do. Throws Failure(NotFound) where one is missing. */
std::vector<std::filesystem::path>
InputsOf(const std::optional<ColourBy> & by);

/** What colouring takes, in bytes, beside the surfaces that are coloured. */
struct ColourBytes
{
  std::uintmax_t voxels = 0; ///< in memory, of a volume
  std::uintmax_t others = 0; ///< of other surfaces, about; they are where surfaces are
};

/** From headers and sizes of files. Throws Failure(Memory) where a volume is too large. */
ColourBytes
CountColourBytes(const ColourBy & by);

/** The colours that surfaces have, and what they mean. */
struct SurfaceColours
{
  ColourScale scale;
  Report report; ///< for a sidecar
};

/** Sets SceneSurface::pointValues and SceneSurface::pointColours of surfaces; those without a surface to measure the
 * distance to have no values, and are grey. Notes give the range and what has no value. A PET has SUV if its headers
 * say all that it needs (FindStandardUptake()), else its own unit, and a note says why.
 *
 * Throws Failure: Geometry for a volume or surface whose box lies apart from the surfaces'; Usage for a volume with
 * unevenly spaced slices or several values a voxel; and those of the files.
 *
 * \param frameOfReference of the surfaces' scan: see DicomExamination; a note warns of a volume of another one */
SurfaceColours
ColourSurfaces(const ColourBy & by,
               const std::string & frameOfReference,
               std::vector<SceneSurface> & surfaces,
               const Events & events);

/** The same for signed distances to surfaces that are known already.
 * \param others for each surface the one that its distances are measured to, or null
 * \param range of the colours; nothing: see ColourBy::range */
SurfaceColours
ColourSurfacesByDistance(const std::vector<itk::TriangleSurface::ConstPointer> & others,
                         const std::optional<std::pair<double, double>> & range,
                         std::vector<SceneSurface> & surfaces,
                         const Events & events);

} // namespace rhombic

#endif
