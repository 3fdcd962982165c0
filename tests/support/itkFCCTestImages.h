#ifndef itkFCCTestImages_h
#define itkFCCTestImages_h

#include "itkFCCImage.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <random>

/** FCC images made from formulas, for tests. */
namespace fcctest
{

using ImageType = itk::FCCImage<float>;
using PointType = ImageType::PointType;

/** An isotropic image of spacing \a s around the world's origin, whose extent is about the cube of half width \a
 * radius, sampled from \a field(point). */
template <typename TField>
ImageType::Pointer
MakeImage(double s, double radius, const TField & field)
{
  auto image = ImageType::New();
  const auto half = static_cast<itk::IndexValueType>(std::ceil(radius / s));
  const auto halfX = (half + 1) / 2;
  image->SetRegions(ImageType::RegionType({ { -halfX, -half, -half } },
                                          { { static_cast<itk::SizeValueType>(2 * halfX + 1),
                                              static_cast<itk::SizeValueType>(2 * half + 1),
                                              static_cast<itk::SizeValueType>(2 * half + 1) } }));
  image->SetSpacing(ImageType::SpacingType(s));
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(field(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  return image;
}

inline double
Sphere(const PointType & p, double radius)
{
  return radius - std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/** A torus about the z axis: positive inside. */
inline double
Torus(const PointType & p, double major, double minor)
{
  const double ring = std::sqrt(p[0] * p[0] + p[1] * p[1]) - major;
  return minor - std::sqrt(ring * ring + p[2] * p[2]);
}

/** Whole numbers from 0 to \a levels - 1, so that isovalues meet samples. */
inline ImageType::Pointer
MakeNoise(const ImageType::RegionType & region, unsigned int seed, int levels)
{
  auto image = ImageType::New();
  image->SetRegions(region);
  image->Allocate();
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> value(0, levels - 1);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<float>(value(random)));
  }
  return image;
}

} // namespace fcctest

#endif
