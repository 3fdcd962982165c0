#ifndef rhombicFieldSampling_h
#define rhombicFieldSampling_h

#include "rhombicReferenceField.h"
#include "rhombicForEachBlock.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkBSplineInterpolateImageFunction.h"

#include <cmath>
#include <limits>

namespace rhombic
{

/** Allocates an image, whose region and geometry are set, and fills it with scale * field at each sample's position.
 * Integer pixels are rounded, not clamped: choose a scale that fits. Works with itk::Image and itk::FCCImage, on
 * several threads (itk::MultiThreaderBase). */
template <typename TImage>
void
SampleField(const ReferenceField & field, double scale, TImage * image)
{
  using PixelType = typename TImage::PixelType;
  image->Allocate();
  const auto & region = image->GetBufferedRegion();
  ForEachBlock(region.GetSize(2), 1, [&](std::size_t begin, std::size_t end) {
    auto planes = region;
    planes.SetIndex(2, region.GetIndex(2) + static_cast<itk::IndexValueType>(begin));
    planes.SetSize(2, end - begin);
    typename TImage::PointType point;
    for (itk::ImageRegionIteratorWithIndex<TImage> it(image, planes); !it.IsAtEnd(); ++it)
    {
      image->TransformIndexToPhysicalPoint(it.GetIndex(), point);
      const double value = scale * field.Evaluate({ point[0], point[1], point[2] });
      it.Set(static_cast<PixelType>(std::numeric_limits<PixelType>::is_integer ? std::round(value) : value));
    }
  });
}

/** Samples a field on a Cartesian grid of \a count samples along each axis, \a spacing apart, the first one at the
 * world's origin. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
SampleOnGrid(const ReferenceField & field, itk::SizeValueType count, double spacing, double scale = 1.0)
{
  using ImageType = itk::Image<TPixel, 3>;
  const auto image = ImageType::New();
  image->SetRegions(typename ImageType::SizeType{ { count, count, count } });
  image->SetSpacing(typename ImageType::SpacingType(spacing));
  SampleField(field, scale, image.GetPointer());
  return image;
}

/** \class InterpolatedField
 * \brief The cubic B-spline through the samples of a volume, mirrored at its border. */
class InterpolatedField : public ReferenceField
{
public:
  explicit InterpolatedField(const itk::Image<float, 3> * volume)
    : m_Spline(SplineType::New())
  {
    m_Spline->SetSplineOrder(3);
    m_Spline->SetInputImage(volume);
  }

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override
  {
    SplineType::OutputType value;
    SplineType::CovariantVectorType derivative;
    const double coordinates[3]{ point[0], point[1], point[2] };
    m_Spline->EvaluateValueAndDerivative(itk::Point<double, 3>(coordinates), value, derivative);
    gradient = { derivative[0], derivative[1], derivative[2] };
    return value;
  }

private:
  using SplineType = itk::BSplineInterpolateImageFunction<itk::Image<float, 3>, double, double>;
  SplineType::Pointer m_Spline;
};

} // namespace rhombic

#endif
