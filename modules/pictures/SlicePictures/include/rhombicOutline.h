#ifndef rhombicOutline_h
#define rhombicOutline_h

#include "rhombicProjection.h"

#include "itkTriangleSurface.h"

#include <vector>

namespace rhombic
{

/** \class Outline
 * \brief A curve along which a plane cuts a surface, as positions in the picture. Projection::PointAt() gives the
 * points in LPS mm. */
struct Outline
{
  std::vector<PicturePosition> points; ///< no two successive ones are the same
  bool isClosed = true;                ///< whether the last point is joined to the first, which is not repeated
};

/** The curves along which the plane of a projection cuts a surface.
 *
 * The cut is exact: each curve has its points where edges of the surface cross the plane. Points of the surface in the
 * plane are taken to lie just behind it, as the viewer sees it. So each triangle is cut along one line or not at all,
 * and the outlines of closed surfaces are closed; of a wall in the plane, the border is drawn if the surface reaches
 * from it towards the viewer. Closed curves run clockwise around the inside, as seen in the picture, and
 * counter-clockwise around holes. A surface with borders gives open curves, too, and one that is not consistently
 * oriented gives pieces of curves.
 *
 * Curves are in the order of their first triangles in the surface, open ones first; the result does not depend on the
 * number of threads. Curves without extent, where the plane only touches the surface, are left out. */
std::vector<Outline>
CutSurface(const itk::TriangleSurface & surface, const Projection & plane);

} // namespace rhombic

#endif
