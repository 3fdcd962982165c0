#ifndef rhombicSurfaceFinish_h
#define rhombicSurfaceFinish_h

#include "rhombicEvents.h"

#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "itkTriangleSurfaceSolids.h"
#include "itkTriangleSurfaceUntangling.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace rhombic
{

/** \class SmoothingLimit
 * \brief The largest move of a point by smoothing: a number of spacings of the lattice or a length, whichever is more.
 * By default nothing moves. */
struct SmoothingLimit
{
  SmoothingLimit(double spacings_ = 0.0)
    : spacings(spacings_)
  {}

  bool
  IsNothing() const
  {
    return spacings == 0.0 && millimetres == 0.0;
  }

  /** In mm. \param spacing of the lattice in mm */
  double
  FindLargestMove(double spacing) const
  {
    return std::max(spacings * spacing, millimetres);
  }

  double spacings;          ///< 0 to 1
  double millimetres = 0.0; ///< finite, not negative
};

/** The limit that a text says: "0.3" for spacings of the lattice, "0.8mm" or "0.8 mm" for a length. Throws
 * Failure(Usage) for other texts. */
SmoothingLimit
ParseSmoothingLimit(const std::string & text);

/** ParseSmoothingLimit() of all of the stream, for the command line. */
std::istream &
operator>>(std::istream & stream, SmoothingLimit & limit);

/** \class SurfaceFinish
 * \brief Steps that a surface goes through after its extraction. By default it is untangled only. */
struct SurfaceFinish
{
  double minimumVolume = 0.0;    ///< in ml; smaller solids are removed
  bool keepsLargestPart = false; ///< whether all solids but the largest are removed
  bool fillsCavities = false;    ///< whether shells inside others are removed
  SmoothingLimit smoothing;      ///< largest move of a point

  /** A surface is simplified if any of these three is set: until it has the smaller number of triangles, or fewer would
   * have a larger error. */
  std::optional<double> maximumError; ///< in mm, above 0; default: a spacing of the lattice
  std::size_t maximumTriangles = 0;   ///< 0: no limit
  double share = 1.0;                 ///< share of the surface's triangles to keep, above 0

  /** Whether surfaces are simplified. */
  bool
  Simplifies() const
  {
    return maximumError || maximumTriangles > 0 || share < 1.0;
  }
};

/** A finish with the removals of both finishes and the larger limits of the two. Simplification is that of \a second if
 * it simplifies, else that of \a first. */
SurfaceFinish
CombineFinish(const SurfaceFinish & first, const SurfaceFinish & second);

/** Throws Failure(Usage) for settings out of their ranges. */
void
CheckSurfaceFinish(const SurfaceFinish & finish);

/** \class PartRemoval
 * \brief Shells that RemoveParts() removed. */
struct PartRemoval
{
  itk::RemovedShells filled;  ///< cavities, and the solids inside them
  itk::RemovedShells removed; ///< solids with their cavities
  std::string warning;        ///< a line if keeping the largest solid left out 5 % of the volume or more

  bool
  IsNothing() const
  {
    return filled.solids + filled.cavities + removed.solids + removed.cavities == 0;
  }
};

/** Fills cavities and removes solids of a surface. Notes list the filled cavities and removed solids, with volumes,
 * and give the warning.
 * \param name of the surface, for messages */
PartRemoval
RemoveParts(itk::TriangleSurface & surface,
            const SurfaceFinish & finish,
            const std::string & name,
            const Events & events);

/** \class SmoothingResult
 * \brief Moves of points, and volumes in mm^3. */
struct SmoothingResult
{
  double maximumMove; ///< largest move that was allowed, in mm
  itk::TriangleSurfaceSmoothingReport moves;
  double volumeBefore;
  double volumeAfter;
};

/** \class SimplificationResult
 * \brief Counts of triangles, distances in mm, and volumes in mm^3. */
struct SimplificationResult
{
  double maximumError; ///< largest error that was allowed
  itk::TriangleSurfaceSimplificationReport triangles;
  double meanDistance;    ///< mean distance between the surfaces before and after, from points of up to 30 000
                          ///< triangles of each (itk::ComputeTriangleSurfaceDistances()); the larger of both directions
  double maximumDistance; ///< the largest distance of these points
  double volumeBefore;
  double volumeAfter;
};

/** \class Refinement
 * \brief Results of RefineSurface(); none for a step that was not requested or changed nothing. */
struct Refinement
{
  std::optional<SmoothingResult> smoothing;
  std::optional<itk::TriangleSurfaceUntanglingReport> untangling;
  std::optional<SimplificationResult> simplification;
  itk::SizeValueType shellsTurned = 0; ///< small shells that faced the wrong way
};

/** How surfaces of one kind are smoothed, simplified and measured. */
struct RefinementFunctions
{
  std::function<itk::TriangleSurfaceSmoothingReport(itk::TriangleSurface &,
                                                    const itk::TriangleSurfaceSmoothingSettings &,
                                                    const ProgressFunction &)>
    smooth;
  std::function<itk::TriangleSurfaceSimplificationReport(itk::TriangleSurface &,
                                                         const itk::TriangleSurfaceSimplificationSettings &,
                                                         const ProgressFunction &)>
    simplify;
  std::function<double(const itk::TriangleSurface &)> computeVolume; ///< in mm^3
};

/** Smooths and simplifies a surface, with functions of its kind that add no crossing triangles. See RefineSurface(). */
Refinement
RefineBy(const RefinementFunctions & functions,
         itk::TriangleSurface & surface,
         const SurfaceFinish & finish,
         double spacing,
         const std::string & name,
         const Events & events);

/** Untangles a surface, smooths it, simplifies it, and turns shells that face the wrong way, each where it may be
 * needed. Untangling moves points by one spacing of the lattice at most, where triangles pass through each other.
 * Smoothing and simplification add no such triangles. Notes give the results, and how many triangles pass
 * through others after untangling.
 *
 * \param spacing of the lattice in mm (see MeanSpacingOf())
 * \param name of the surface, for progress and messages
 * \param candidates which triangles may cross; nothing: all may
 *
 * Throws itk::ExceptionObject as itk::UntangleTriangleSurface() and itk::SimplifyTriangleSurface() do. */
Refinement
RefineSurface(itk::TriangleSurface & surface,
              const SurfaceFinish & finish,
              double spacing,
              const std::string & name,
              const Events & events,
              const std::optional<itk::CrossingCandidates> & candidates = std::nullopt);

} // namespace rhombic

#endif
