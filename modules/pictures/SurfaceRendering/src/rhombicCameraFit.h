#ifndef rhombicCameraFit_h
#define rhombicCameraFit_h

#include "rhombicScene.h"

#include <vector>

namespace rhombic
{

/** \class Camera
 * \brief How the points of a scene are seen in a picture. The depth of a point is its distance in mm behind the centre,
 * along frame.look. */
struct Camera
{
  ViewFrame frame;
  int width = 0;  ///< pixels
  int height = 0; ///< pixels

  Vector3 centre;         ///< the LPS point in the middle between the margins
  double rightward = 0.0; ///< pixels from the picture's middle to the centre
  double upward = 0.0;    ///< pixels

  double pixelSize = 1.0; ///< width of a pixel in mm at depth 0
  double spread = 0.0;    ///< a pixel at depth d is 1 + spread * d times as wide; 0 in parallel projection

  double nearest = -1.0; ///< depths between which everything lies
  double farthest = 1.0;

  /** For parallel projection. */
  Projection
  ToProjection() const;
};

/** One camera for each view. Throws Failure(Usage) when the margins leave no room. */
std::vector<Camera>
FitCameras(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views);

} // namespace rhombic

#endif
