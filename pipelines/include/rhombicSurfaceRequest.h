#ifndef rhombicSurfaceRequest_h
#define rhombicSurfaceRequest_h

#include "rhombicIntensities.h"
#include "rhombicSceneSurface.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicPixelTypes.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** An isosurface to extract, and how to draw it. */
struct SurfaceRequest
{
  /** Which connected parts are kept. */
  enum class Parts
  {
    All,
    Enclosed, ///< parts in the body: see KeepEnclosedParts()
    Outermost ///< the outline of the body, without lungs and bowel gas: see FillBody()
  };

  std::string name;
  std::optional<double> isovalue; ///< in the scan's units; none: a threshold of the scan by Otsu's method
  double Intensities::*otsu = &Intensities::otsu; ///< the threshold that is taken without an isovalue
  bool insideIsBelow = false;
  Parts parts = Parts::All;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0;
  bool hasOwnOpacity = false; ///< the opacity was asked for, so that it does not follow from what the surface hides
  SurfaceFinish finish;       ///< see CombineFinish()

  /** The isovalue has to be set: see ResolveIsovalues(). */
  Threshold
  GetThreshold() const
  {
    return { isovalue.value(), insideIsBelow };
  }
};

/** A colour written as `#rrggbb`, `#rgb` or by one of the 148 names of CSS, in upper or lower case. Throws
 * Failure(Usage). */
Colour
ParseColour(const std::string & text);

/** A threshold written as a number, `otsu`, `otsu-low`, `otsu-lowest` or `otsu-high`, with `<` before it if values
 * below are inside. Sets the request's isovalue, otsu and insideIsBelow. Returns false for other texts. */
bool
ParseThreshold(const std::string & text, SurfaceRequest & request);

/** An opacity above 0 and at most 1; nothing for other texts. */
std::optional<double>
ParseOpacity(const std::string & text);

/** A surface written as name=threshold[,colour[,opacity]]. A surface without a colour gets the \a number-th of a
 * palette. Throws Failure(Usage). */
SurfaceRequest
ParseSurfaceRequest(const std::string & text, std::size_t number);

/** Sets missing isovalues to Otsu's thresholds. Throws Failure(Empty), naming the volume's range, for an isovalue where
 * the volume has no surface. */
std::vector<SurfaceRequest>
ResolveIsovalues(std::vector<SurfaceRequest> requests, const Intensities & intensities);

} // namespace rhombic

#endif
