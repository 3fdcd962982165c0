#ifndef rhombicCameraMatrices_h
#define rhombicCameraMatrices_h

#include "rhombicVector3.h"

#include <array>

class vtkMatrix4x4;
class vtkRenderer;

namespace rhombic
{

/** \class CameraMatrices
 * \brief How a renderer's camera sees points in a target of some pixels. The depth of a point is its distance behind
 * the camera's focal point, along the direction of view, in the unit of the scene. */
struct CameraMatrices
{
  using Matrix = std::array<double, 16>; ///< row by row

  CameraMatrices(vtkRenderer * renderer, int targetWidth, int targetHeight);

  int width;  ///< pixels
  int height; ///< pixels

  Matrix viewFromWorld;
  Matrix clipFromView;
  Vector3 focalPoint; ///< in the world
  bool isParallel;

  double pixelSize; ///< width of a pixel at depth 0
  double spread;    ///< a pixel at depth d is 1 + spread * d times as wide; 0 in parallel projection

  /** The depth of a point is (ndc - depthOffset) / (depthFactor - ndc * spread), where ndc is its normalised device
   * coordinate, -1 to 1. */
  double depthFactor;
  double depthOffset;
};

/** How the points of an actor are seen. Points are taken relative to the camera's focal point, so that they stay exact
 * in 32 bits. */
struct ActorMatrices
{
  /** \param worldFromActor must be invertible
   * \param origin of the model's coordinates, in those of the actor */
  ActorMatrices(const CameraMatrices & camera, vtkMatrix4x4 * worldFromActor, const Vector3 & origin);

  CameraMatrices::Matrix worldFromModel;
  std::array<float, 3> centre;           ///< the focal point in the model's coordinates
  std::array<float, 16> clipFromCentred; ///< column by column
  std::array<float, 16> viewFromCentred; ///< column by column
  std::array<float, 9> viewFromNormal;   ///< column by column; x right, y up, z towards the viewer
  CameraMatrices::Matrix worldFromCentred;
  double scale;     ///< cube root of the volume that a unit cube has in the world
  bool isMirrored;  ///< in the picture
  float handedness; ///< of the picture: 1, or -1 if the camera's projection mirrors
};

} // namespace rhombic

#endif
