#ifndef itkFCCLinearField_h
#define itkFCCLinearField_h

#include "itkFCCImage.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <cmath>

/** A field that every interpolation must reproduce, and an image in general position to sample it with. */
namespace fcctest
{

inline double
LinearField(const itk::Point<double, 3> & p)
{
  return 40.0 + 0.7 * p[0] - 1.1 * p[1] + 0.4 * p[2];
}

/** Sets all samples of an image, on a lattice or a grid, to the field at their points. */
template <typename TImage, typename TField>
void
Sample(TImage * image, const TField & field)
{
  for (itk::ImageRegionIteratorWithIndex<TImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<typename TImage::PixelType>(
      field(image->template TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
}

inline itk::Matrix<double, 3, 3>
Turn(double aboutZ, double aboutX)
{
  itk::Matrix<double, 3, 3> z, x;
  z.SetIdentity();
  x.SetIdentity();
  z[0][0] = z[1][1] = std::cos(aboutZ);
  z[1][0] = std::sin(aboutZ);
  z[0][1] = -z[1][0];
  x[1][1] = x[2][2] = std::cos(aboutX);
  x[2][1] = std::sin(aboutX);
  x[1][2] = -x[2][1];
  return z * x;
}

/** LinearField() on 12 x 23 x 21 samples of an anisotropic, turned lattice, the first of them in a row of parity 1. */
inline itk::FCCImage<float>::Pointer
MakeTurnedLinearField()
{
  auto image = itk::FCCImage<float>::New();
  image->SetRegions(itk::ImageRegion<3>({ { -3, 4, -7 } }, { { 12, 23, 21 } }));
  const double spacing[3] = { 0.8, 1.0, 1.3 };
  const double origin[3] = { -20.0, 35.0, 11.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(Turn(0.4, -0.3));
  image->Allocate();
  Sample(image.GetPointer(), LinearField);
  return image;
}

} // namespace fcctest

#endif
