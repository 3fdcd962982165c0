#ifndef rhombicSurfaceRequest_h
#define rhombicSurfaceRequest_h

#include "rhombicScene.h"

#include <optional>
#include <string>

namespace rhombic
{

/** \file
 * Surfaces to extract, and how people write them. Thread safety: requests are values, and the functions pure. */

/** A surface to extract, and how to draw it. */
struct SurfaceRequest
{
  /** Which side of the isovalue is inside. */
  enum class Side
  {
    Above, ///< values at or above it
    Below  ///< values below it: lungs and other air
  };

  /** Which connected parts are kept. */
  enum class Parts
  {
    All,

    /** Those in the body, without small ones: the lungs, also where the scan's sides cut them, but not the air around
     * the patient. Around the body is what is below -940 HU, or less than 60 HU above the lowest values if that is
     * between -940 and -860 HU, and reaches a corner of the slices, or a side of the scan where a ball of 8 mm radius
     * has room; all else is in the body. Lungs without emphysema are denser than that. Where no tissue lies between, as
     * at the border of a round field of view or in the nose, the parts in the body end there. At isovalues of 0 and
     * more, which are no thresholds of air in HU, and above isovalues, the corners alone decide. */
    Enclosed
  };

  std::string name;
  std::optional<double> isovalue; ///< in the scan's units; none: Otsu's threshold of the scan
  Side side = Side::Above;
  Parts parts = Parts::All;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0;
};

/** A colour written as `#rrggbb`, `#rgb` or by one of the 148 names of CSS, in upper or lower case. Throws
 * Failure(Usage). */
Colour
ParseColour(const std::string & text);

/** A threshold written as a number, `<number` for what lies below, or `otsu`. Returns whether it is one of these; then
 * the request's isovalue and side are set. */
bool
ParseThreshold(const std::string & text, SurfaceRequest & request);

/** A surface written as name=threshold[,colour[,opacity]], where the threshold is a number or `otsu`. A threshold that
 * begins with `<` takes what lies below it. Surfaces without a colour get the \a number-th of a palette. Throws
 * Failure(Usage). */
SurfaceRequest
ParseSurfaceRequest(const std::string & text, std::size_t number);

} // namespace rhombic

#endif
