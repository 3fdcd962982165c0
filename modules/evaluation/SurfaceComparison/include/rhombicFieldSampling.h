#ifndef rhombicFieldSampling_h
#define rhombicFieldSampling_h

#include "rhombicReferenceField.h"

#include "itkFCCImage.h"
#include "rhombicForEachBlock.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"

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

/** Samples a field on an FCC lattice that covers the cube from 0 to \a edge along each axis; a site is at the world's
 * origin. \param density sites per unit of volume, above 0 */
template <typename TPixel>
typename itk::FCCImage<TPixel>::Pointer
SampleOnLattice(const ReferenceField & field, double edge, double density, double scale = 1.0)
{
  using ImageType = itk::FCCImage<TPixel>;
  const double spacing = std::cbrt(1.0 / (itk::FCCLattice::CellVolume * density));
  const auto rows = static_cast<itk::SizeValueType>(std::ceil(edge / spacing)) + 1;
  const auto image = ImageType::New();
  image->SetRegions(typename ImageType::SizeType{ { rows / 2 + 1, rows, rows } });
  image->SetSpacing(typename ImageType::SpacingType(spacing));
  SampleField(field, scale, image.GetPointer());
  return image;
}

} // namespace rhombic

#endif
