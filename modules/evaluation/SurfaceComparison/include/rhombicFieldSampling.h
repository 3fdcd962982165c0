#ifndef rhombicFieldSampling_h
#define rhombicFieldSampling_h

#include "rhombicReferenceField.h"
#include "rhombicForEachBlock.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <cmath>
#include <limits>

namespace rhombic
{

/** An image of \a size samples, \a spacing apart, from \a origin on, that holds scale * field at each sample's
 * position. Integer pixels are rounded, not clamped: choose a scale that fits. Works with itk::Image and itk::FCCImage,
 * on several threads (itk::MultiThreaderBase). */
template <typename TImage>
typename TImage::Pointer
SampleField(const ReferenceField & field,
            const typename TImage::SizeType & size,
            double spacing,
            const Vector3 & origin = {},
            double scale = 1.0)
{
  using PixelType = typename TImage::PixelType;
  const auto image = TImage::New();
  image->SetRegions(size);
  image->SetSpacing(typename TImage::SpacingType(spacing));
  image->SetOrigin(origin.data());
  image->Allocate();
  ForEachBlock(size[2], 1, [&](std::size_t begin, std::size_t end) {
    auto planes = image->GetBufferedRegion();
    planes.SetIndex(2, static_cast<itk::IndexValueType>(begin));
    planes.SetSize(2, end - begin);
    typename TImage::PointType point;
    for (itk::ImageRegionIteratorWithIndex<TImage> it(image, planes); !it.IsAtEnd(); ++it)
    {
      image->TransformIndexToPhysicalPoint(it.GetIndex(), point);
      const double value = scale * field.Evaluate({ point[0], point[1], point[2] });
      it.Set(static_cast<PixelType>(std::numeric_limits<PixelType>::is_integer ? std::round(value) : value));
    }
  });
  return image;
}

/** Samples a field on a Cartesian grid of \a count samples along each axis, \a spacing apart, the first one at the
 * world's origin. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
SampleOnGrid(const ReferenceField & field, itk::SizeValueType count, double spacing, double scale = 1.0)
{
  return SampleField<itk::Image<TPixel, 3>>(field, { { count, count, count } }, spacing, {}, scale);
}

} // namespace rhombic

#endif
