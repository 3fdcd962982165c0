#ifndef rhombicScene_h
#define rhombicScene_h

#include "rhombicPicture.h"
#include "rhombicProjection.h"
#include "rhombicSceneSurface.h"
#include "rhombicView.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class ClipPlane
 * \brief Removes the part of a scene on one side of a plane. */
struct ClipPlane
{
  Vector3 point;                     ///< in the plane, LPS mm
  Vector3 normal;                    ///< points to the side that is removed; any length
  std::vector<std::string> surfaces; ///< names of the surfaces that are cut; empty: all surfaces
};

/** Whether a plane cuts a surface, if it meets it. */
bool
IsCut(const SceneSurface & item, const ClipPlane & cut);

/** \class ScenePlane
 * \brief A picture that stands in the scene, as a slice or the cap of a cut. It is not lit, seen from both sides, and
 * not cut. Where it has alpha, it lets light pass. */
struct ScenePlane
{
  Picture picture;
  Projection projection; ///< the place of the picture; its width and height are those of the picture
};

/** \class Scene
 * \brief Surfaces, cuts and pictures that are drawn together. */
struct Scene
{
  std::vector<SceneSurface> surfaces; ///< of several surfaces in one place, the first is seen
  std::vector<ClipPlane> cuts;        ///< at most 6
  std::vector<ScenePlane> planes;
};

/** A box whose sides are along the axes, LPS mm. */
struct LPSBox
{
  Vector3 lowest;
  Vector3 highest;
};

/** The box around the points of surfaces; surfaces without triangles do not count. Throws Failure(Empty) when no
 * surface has a triangle.
 *
 * As RenderSettings::extent, together with sameScale, it keeps the scene in place in the frames of a turntable. */
LPSBox
BoxAround(const std::vector<SceneSurface> & surfaces);

/** Background and light. */
enum class PictureStyle
{
  Clinic,     ///< black background, strong light from one side
  Paper,      ///< white background, soft light, dark outlines
  Transparent ///< the light of Paper; a picture with alpha
};

/** \class RenderSettings
 * \brief Size, camera and effects of pictures. Each side has at most 16384 samples: 8192 pixels with two samples each.
 *
 * SurfaceRenderer::CheckSettings() throws for values out of range. */
struct RenderSettings
{
  int width = 1200;               ///< pixels; 0: as wide as the extent needs
  int height = 1200;              ///< pixels; 0: as high as the extent needs; both 0: the longer side is 1200
  std::optional<Margins> margins; ///< pixels that the scene leaves free; by default 0.02 of the picture's shorter side

  bool perspective = false;        ///< parallel projection otherwise, in which sizes can be compared
  std::optional<LPSBox> extent;    ///< the box that fits between the margins; by default all surfaces and planes
  std::optional<Vector3> centre;   ///< the LPS point between the margins; by default the middle of the extent
  double zoom = 1.0;               ///< above 1 enlarges
  std::optional<double> pixelSize; ///< in mm, instead of the size that fits; for parallel projection
  bool sameScale = false;          ///< all views have the pixel size of the view that needs the largest

  PictureStyle style = PictureStyle::Clinic;
  std::optional<Colour> background; ///< instead of the style's
  int samples = 2;                  ///< along each side of a pixel, 1 to 4; 2 gives four samples per pixel
  bool ambientOcclusion = true;     ///< darkens cavities of opaque surfaces
  bool silhouettes = true;          ///< dark lines at the outlines of opaque surfaces
  std::uintmax_t maximumMemory = 0; ///< for drawing, in bytes; 0: half of the free memory
};

/** The colour behind the scene: the settings' or the style's. With PictureStyle::Transparent nothing shows it. */
Colour
BackgroundOf(const RenderSettings & settings);

/** \class RenderedView
 * \brief A picture, and how it lies in the patient. */
struct RenderedView
{
  Picture picture;                      ///< with alpha in PictureStyle::Transparent
  std::optional<Projection> projection; ///< exact; none in perspective
};

} // namespace rhombic

#endif
