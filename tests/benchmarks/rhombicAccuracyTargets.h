#ifndef rhombicAccuracyTargets_h
#define rhombicAccuracyTargets_h

#include "rhombicAccuracyExperiment.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \class AccuracyTarget
 * \brief A figure, and its upper or lower limit. */
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

/** The targets of a mesh. Modes fine and lean at the default density have limits for the distance and the number of
 * triangles, relative to the reference, and for the quality of triangles. All modes must be manifold without degenerate
 * triangles. Marching cubes has no targets. */
std::vector<AccuracyTarget>
GetAccuracyTargets(const AccuracyCase & experiment, const AccuracyResult & reference, const AccuracyResult & result);

} // namespace rhombic

#endif
