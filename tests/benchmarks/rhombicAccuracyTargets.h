#ifndef rhombicAccuracyTargets_h
#define rhombicAccuracyTargets_h

#include "rhombicAccuracyExperiment.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \class AccuracyTarget
 * \brief A figure, and what it must not exceed or fall below. */
struct AccuracyTarget
{
  std::string what; ///< "distance", "triangles", "quality", "poor %", "no manifold"
  double value = 0.0;
  double limit = 0.0;
  bool isUpperLimit = true;

  bool
  IsReached() const
  {
    return isUpperLimit ? value <= limit : value >= limit;
  }
};

/** What applies to a mesh: for modes fine and lean at the default density, distances and triangles relative to the
 * reference and the quality of triangles; for all modes, that they are manifold without degenerate triangles. Empty for
 * marching cubes. */
std::vector<AccuracyTarget>
GetAccuracyTargets(const AccuracyCase & experiment, const AccuracyResult & reference, const AccuracyResult & result);

} // namespace rhombic

#endif
