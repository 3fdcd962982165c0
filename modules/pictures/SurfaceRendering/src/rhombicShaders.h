#ifndef rhombicShaders_h
#define rhombicShaders_h

#include <string>

namespace rhombic
{

/** \file
 * The programs that run for each vertex and each sample or pixel, in GLSL. Lengths are in mm; a depth is that of
 * Camera.
 *
 * Software renderers run these programs on the processor, where a sample's program decides how long a picture takes. */

/** How triangles are drawn. */
struct SurfaceProgram
{
  bool isSmooth = true;       ///< with the normals of points; faceted otherwise
  bool isTranslucent = false; ///< one layer of peeling
  bool isPlane = false;       ///< a ScenePlane; the normals of points are positions in its picture
  int cuts = 0;               ///< number of clip planes
};

std::string
SurfaceVertexShader(const SurfaceProgram & program);

/** The colour of a sample. Opaque: its alpha is the surface's number. Translucent: straight alpha; only samples behind
 * the layer before. */
std::string
SurfaceFragmentShader(const SurfaceProgram & program);

/** A triangle from three vertices without attributes that covers the whole target. */
std::string
WholeTargetVertexShader();

/** A translucent layer without anything, that ends where opaque surfaces are. */
std::string
NoLayerFragmentShader();

/** Adds a translucent layer under those before: multiplied by alpha, to be blended. */
std::string
LayerFragmentShader();

/** Two triangles over each open tile of OpenTiles, from six vertices without attributes. */
std::string
OpenTilesVertexShader();

/** For each tile, the smallest depth of a layer where it is in front of opaque surfaces and the background. */
std::string
OpenTileFragmentShader();

/** The depth and the surface's number of one sample of each pixel. */
std::string
ReliefFragmentShader(int samples);

/** Red: the share of light that the surroundings take from each pixel; green: how much it is part of an outline.
 *
 * For light, the share of a ball's volume in front of a plane that surfaces take up, from pairs of opposite points, as
 * in B. J. Loos and P.-P. Sloan, "Volumetric Obscurance", I3D 2010. A plane takes up nothing, however it is inclined.
 */
std::string
ShadeFragmentShader(bool hasOcclusion, bool hasOutlines, int pairs);

/** The mean of a pixel's samples, with translucent layers over opaque surfaces over the background. */
std::string
PixelFragmentShader(int samples, bool hasRelief, bool hasLayers);

} // namespace rhombic

#endif
