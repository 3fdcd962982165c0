#ifndef rhombicProjection_h
#define rhombicProjection_h

#include "rhombicVector3.h"

#include <string>

namespace rhombic
{

/** \file
 * How a picture lies in the patient: used by views of surfaces, slices, and what is drawn over both. */

/** The axes of a picture, as LPS unit vectors at right angles: right = look x up. */
struct ViewFrame
{
  Vector3 look{};  ///< from the viewer into the picture
  Vector3 up{};    ///< towards the picture's top edge
  Vector3 right{}; ///< towards the picture's right edge
};

/** The anatomical direction at each edge of a picture: L, R (left, right), A, P (anterior, posterior), H or F (head,
 * foot). In oblique pictures two or three letters, the largest component first. */
struct EdgeLetters
{
  std::string left;
  std::string right;
  std::string top;
  std::string bottom;
};

/** The letters of a direction: those of its components of at least \a smallest times its length, the largest first. */
std::string
LettersOf(const Vector3 & direction, double smallest = 0.25);

/** The letters at the edges of a picture. */
EdgeLetters
EdgeLettersOf(const ViewFrame & frame);

/** A position in a picture, in pixels from the outer corner of the top left pixel, whose centre is at (0.5, 0.5). */
struct PicturePosition
{
  double x; ///< to the right
  double y; ///< downwards
};

/** \class Projection
 * \brief The parallel projection of the patient onto a picture. */
struct Projection
{
  ViewFrame frame;
  Vector3 centre{};       ///< the LPS point in mm in the middle of the picture
  double pixelSize = 1.0; ///< width and height of a pixel in mm
  int width = 0;          ///< pixels
  int height = 0;         ///< pixels

  /** Where a point is seen. */
  PicturePosition
  PositionOf(const Vector3 & point) const;

  /** The point that is seen at a position, in the plane through the centre. */
  Vector3
  PointAt(const PicturePosition & position) const;
};

} // namespace rhombic

#endif
