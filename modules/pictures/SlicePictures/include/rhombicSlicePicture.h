#ifndef rhombicSlicePicture_h
#define rhombicSlicePicture_h

#include "rhombicGreyWindow.h"
#include "rhombicPicture.h"
#include "rhombicProjection.h"
#include "rhombicScan.h"
#include "rhombicSceneSurface.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class Outline
 * \brief A curve along which a plane cuts a surface, as positions in the picture. Projection::PointAt() gives the
 * points in LPS mm. */
struct Outline
{
  std::vector<PicturePosition> points; ///< no two successive points are the same
  bool isClosed = true;                ///< whether the last point is joined to the first, which is not repeated
};

/** The curves along which the plane of a projection cuts a surface.
 *
 * The cut is exact: each curve has its points where edges of the surface cross the plane. Points of the surface in the
 * plane are taken to lie just behind it, as the viewer sees it. So each triangle is cut along one line or not at all,
 * and the outlines of closed surfaces are closed; of a wall in the plane, the border is drawn if the surface reaches
 * from it towards the viewer. Closed curves run clockwise around the inside, as seen in the picture, and
 * counter-clockwise around holes. A surface with borders gives open curves, too, and a surface that is not consistently
 * oriented gives pieces of curves.
 *
 * Curves are in the order of their first triangles in the surface, open curves first; the result does not depend on the
 * number of threads. Curves without extent, where the plane only touches the surface, are left out. */
std::vector<Outline>
CutSurface(const itk::TriangleSurface & surface, const Projection & plane);

/** Red, green, blue and alpha of pixels outside the scan. */
using SliceBackground = std::array<std::uint8_t, 4>;

/** The greys of a scan in the plane of a projection: the values at the pixels' centres, in a window.
 *
 * Values between samples are interpolated by cubic curves, in slices and between them, and limited to the range of the
 * samples about them. Tilted, sheared and unevenly spaced
 * slices (Scan::sliceOrigins) are used at their true positions. The outer half of the outermost voxels has the value at
 * their centres. Pixels outside all voxels, and values that are not a number, get the background.
 *
 * The picture has alpha if the background is not opaque. It has the same bytes for any number of threads. */
Picture
DrawSlice(const Scan & scan,
          const Projection & plane,
          const GreyWindow & window,
          const SliceBackground & background = { 0, 0, 0, 255 });

/** The values that DrawSlice() turns into greys, in its order; not a number outside all voxels. */
std::vector<float>
SliceValues(const Scan & scan, const Projection & plane);

/** \class CapSurface
 * \brief A surface that a plane cuts open. */
struct CapSurface
{
  std::vector<Outline> outlines; ///< from CutSurface(); open outlines have no inside
  Colour colour{ 1.0, 1.0, 1.0 };
  double tint = 0.0; ///< share of the colour in the cut's pixels, from 0 to 1; the rest is the slice's
};

/** The cut faces of surfaces: the pixels of a slice where it lies inside any of the surfaces; transparent elsewhere.
 * Alpha is the share of the pixel's area that is inside, so that edges are smooth, and the walls that two surfaces have
 * in common leave no gap. Where surfaces overlap, the tint of the later surface is seen.
 * \param slice from DrawSlice() with the plane of the outlines; alpha is ignored */
Picture
DrawCap(const Picture & slice, const std::vector<CapSurface> & surfaces);

} // namespace rhombic

#endif
