#ifndef rhombicHiding_h
#define rhombicHiding_h

#include "rhombicScene.h"
#include "rhombicView.h"

#include <cstddef>
#include <vector>

namespace rhombic
{

/** \file
 * Which surfaces hide others, by rays through the triangles. Pictures of a scene's planes do not count. */

/** Where parallel rays, one through the centre of each pixel, meet a surface first: mm along the projection's look
 * from the plane through its centre, in rows from the top; infinity for rays that meet nothing. What \a cuts remove is
 * not met. Time O(triangles + pixels they cover). */
std::vector<float>
FindDepths(const SceneSurface & item, const std::vector<ClipPlane> & cuts, const Projection & rays);

/** Which surfaces of a scene can be seen in a view, in their order: those that are in front in at least three pixels of
 * a picture with 600 pixels along its longer side. Opaque surfaces hide what is behind them, translucent ones hide
 * nothing; of several surfaces in one place the first is seen. What cuts remove is not there. */
std::vector<bool>
FindSeenSurfaces(const Scene & scene, const Projection & projection);

/** The numbers, ascending, of the opaque surfaces that hide another surface from every side: in each of the six
 * standard views, nine of ten rays through that surface meet the first one before. */
std::vector<std::size_t>
FindEnclosing(const Scene & scene);

/** The numbers, ascending, of the surfaces that hide a part of the focus in one of the views, of 0.5 % and more.
 * \param isFocus for each surface of the scene */
std::vector<std::size_t>
FindHiding(const Scene & scene, const std::vector<bool> & isFocus, const std::vector<View> & views);

/** The standard view in which opaque surfaces hide the smallest share of the focus; of views whose shares differ by
 * less than 5 %, the first. Views in which the focus has less than half of the area that it has in another one, hidden
 * or not, do not count, as those along a vessel.
 * \param isFocus for each surface of the scene */
const View &
FindBestView(const Scene & scene, const std::vector<bool> & isFocus);

} // namespace rhombic

#endif
