#ifndef rhombicShaders_h
#define rhombicShaders_h

#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** \file
 * The programs that run for each vertex and each sample or pixel, in GLSL. Lengths are in mm; a depth is that of
 * Camera.
 *
 * Software renderers run these programs on the processor, where a sample's program decides how long a picture takes. */

/** How surfaces are lit. */
enum class SurfaceLight
{
  Own,     ///< a key, a fill, a sky's and a rim's light that go with the camera
  Renderer ///< the lights of the renderer, as VTK lights surfaces
};

/** The lights of a renderer, as vtkOpenGLRenderer gives them to programs. */
struct RendererLights
{
  std::string declarations; ///< of their uniforms
  int complexity = 0;       ///< 0: none; 1: one headlight; 2: directions; 3: positions too
  int count = 0;
};

/** How triangles are drawn. */
struct SurfaceProgram
{
  bool isSmooth = true;       ///< with the normals of points; faceted otherwise
  bool isTranslucent = false; ///< with FragmentLists
  bool isPicture = false;     ///< an unlit picture, with the points' positions in it
  bool hasColours = false;    ///< of points
  SurfaceLight light = SurfaceLight::Own;
  int cuts = 0; ///< number of clip planes
};

std::string
SurfaceVertexShader(const SurfaceProgram & program);

/** The colour of a sample. Opaque: its alpha is the surface's number. Translucent: straight alpha, for FragmentLists.
 */
std::string
SurfaceFragmentShader(const SurfaceProgram & program, const RendererLights & lights);

/** Names of the preprocessor in a program, and their values. */
using ShaderDefines = std::vector<std::pair<std::string, int>>;

/** The whole program of one of the texts below. */
std::string
VertexShader(const std::string & text, const ShaderDefines & defines = {});
std::string
FragmentShader(const std::string & text, const ShaderDefines & defines = {});

/** A fragment program with the lists of FragmentLists. */
std::string
ListShader(const std::string & text, const ShaderDefines & defines = {});

/** A triangle from three vertices without attributes that covers the whole target. */
extern const char * const WholeTargetVertex;

/** Samples without a surface at the depths of pixels, which have SAMPLES along each side. */
extern const char * const NoSurfaceFragment;

/** Where the depths of pixels have changed since they were written, samples without a surface at the depth that is
 * there now. */
extern const char * const ChangedFragment;

/** The depth and the surface's number of one sample of each pixel, which has SAMPLES along each side. */
extern const char * const ReliefFragment;

/** Red: the share of light that the surroundings take from each pixel, if OCCLUSION; green: how much it is part of an
 * outline, if OUTLINES.
 *
 * For light, the share of a ball's volume in front of a plane that surfaces take up, from PAIRS of opposite points, as
 * in B. J. Loos and P.-P. Sloan, "Volumetric Obscurance", I3D 2010. A plane takes up nothing, however it is inclined.
 */
extern const char * const ShadeFragment;

/** The mean of a pixel's samples, with translucent layers, if LAYERS, over opaque surfaces, with shades if RELIEF, over
 * what is behind, or, if CHANGED, over what is there now where depths have changed. If DEPTHS, the depth of the sample
 * of ReliefFragment. Multiplied by alpha, as what is behind, unless STRAIGHT. */
extern const char * const PixelFragment;

} // namespace rhombic

#endif
