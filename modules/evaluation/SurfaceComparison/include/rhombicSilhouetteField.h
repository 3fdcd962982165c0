#ifndef rhombicSilhouetteField_h
#define rhombicSilhouetteField_h

#include "rhombicReferenceField.h"

#include "itkTriangleSurface.h"

#include <vector>

namespace rhombic
{

/** \class SilhouetteField
 * \brief The field of Y. Sahillioglu (2017): the smallest value, over pictures of an object from all sides, of the
 * bilinear interpolation at a point's projection, minus 0.5. A picture is 1 where its parallel projection shows the
 * object, 0 elsewhere. Its surface is the object's visual hull, up to a pixel. Values rise from -0.5 to 0.5 within a
 * pixel, so that a grid much coarser than the pixels sees hardly more than inside or outside. */
class SilhouetteField : public ReferenceField
{
public:
  static constexpr unsigned int NumberOfViews = 72; ///< 5 degrees apart, about the z axis

  /** \param object a closed surface
   *  \param rows pixels along the object's height; pixels are square */
  SilhouetteField(const itk::TriangleSurface & object, unsigned int rows);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  void
  Draw(const itk::TriangleSurface & object, unsigned int view);

  /** A point in a picture, in pixels from the centre of the first pixel. */
  std::array<double, 2>
  Project(const Vector3 & point, unsigned int view) const;

  double m_PixelSize;
  double m_Left; ///< position of the first pixel's centre
  double m_Bottom;
  int m_Columns;
  int m_Rows;
  std::vector<Vector3> m_Axes;        ///< the horizontal axis of each view
  std::vector<std::uint8_t> m_Pixels; ///< of all pictures, 0 or 1
};

} // namespace rhombic

#endif
