#ifndef rhombicSurfaceFinish_h
#define rhombicSurfaceFinish_h

#include "rhombicEvents.h"
#include "rhombicScanReport.h"

#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceSolids.h"

#include <cstddef>
#include <optional>
#include <string>

namespace rhombic
{

/** \class SurfaceFinish
 * \brief What is done to surfaces after extraction. By default they are untangled, no more.
 *
 * Thread safety: a value. */
struct SurfaceFinish
{
  double minimumVolume = 0.0;    ///< connected parts of less than this, in ml, are removed
  bool keepsLargestPart = false; ///< and all others are
  bool fillsCavities = false;    ///< shells inside others are removed
  double smoothing = 0.0;        ///< how far points may move, in spacings of the lattice; 0 to 1

  /** Each surface is simplified until it has so few triangles or would be further away from the original than the
   * error; not at all when there are none of these. */
  std::optional<double> maximumError; ///< in mm, above 0; by default a spacing of the lattice
  std::size_t maximumTriangles = 0;   ///< 0: no limit
  double share = 1.0;                 ///< of its triangles that each surface may keep, above 0
};

/** Whether surfaces are simplified. Thread safe. */
bool
IsSimplified(const SurfaceFinish & finish);

/** Throws Failure(Usage) for settings out of their ranges. */
void
CheckSurfaceFinish(const SurfaceFinish & finish);

/** What RemoveParts() changed. Thread safety: a value. */
struct PartRemoval
{
  itk::RemovedShells filled;  ///< cavities, and the solids inside them
  itk::RemovedShells removed; ///< solids with their cavities

  /** Whether the surface is as it was. */
  bool
  IsNothing() const
  {
    return filled.solids + filled.cavities + removed.solids + removed.cavities == 0;
  }
};

/** Fills cavities and removes solids of a surface, as the settings say. Notes say what was filled and removed, with its
 * volume. Thread safe for different surfaces.
 * \param name of the surface, for messages */
PartRemoval
RemoveParts(itk::TriangleSurface & surface,
            const SurfaceFinish & finish,
            const std::string & name,
            const Events & events);

/** Numbers of shells, and volumes in ml. */
Report
ReportPartRemoval(const PartRemoval & removal);

/** Smooths a surface, moves points by a spacing of the lattice at most where triangles pass through each other
 * (itk::UntangleSurface()), simplifies it, which makes no triangles pass through each other, and turns specks that are
 * inside out. The report says how far points moved and how many triangles are left; what can't be untangled is noted.
 * \param spacing of the lattice in mm (see MeanSpacingOf()) \param name of the surface, for progress and messages.
 * Throws itk::ExceptionObject as itk::UntangleSurface() and itk::SimplifySurface() do. Thread safe for different
 * surfaces. */
Report
RefineSurface(itk::TriangleSurface & surface,
              const SurfaceFinish & finish,
              double spacing,
              const std::string & name,
              const Events & events);

} // namespace rhombic

#endif
