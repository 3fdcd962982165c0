#ifndef rhombicSliceTestScans_h
#define rhombicSliceTestScans_h

#include "rhombicProjection.h"
#include "rhombicScan.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <array>
#include <cmath>
#include <random>

/** Scans made from formulas, and planes. */
namespace slicetest
{

template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeImage(const std::array<std::size_t, 3> & size)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(typename itk::Image<TPixel, 3>::SizeType{ { size[0], size[1], size[2] } });
  image->Allocate();
  return image;
}

/** Each voxel becomes valueOf(its index, its position). */
template <typename TImage, typename TValue>
void
Fill(TImage & image, const std::vector<itk::Point<double, 3>> & sliceOrigins, TValue valueOf)
{
  for (itk::ImageRegionIteratorWithIndex<TImage> it(&image, image.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto index = it.GetIndex();
    auto point = image.template TransformIndexToPhysicalPoint<double>(index);
    if (!sliceOrigins.empty())
    {
      point += sliceOrigins[static_cast<std::size_t>(index[2])] -
               image.template TransformIndexToPhysicalPoint<double>({ { 0, 0, index[2] } });
    }
    it.Set(static_cast<typename TImage::PixelType>(valueOf(index, point)));
  }
}

/** The frame that looks along a vector, with up nearly along \a side. */
inline rhombic::ViewFrame
FrameAlong(const rhombic::Vector3 & look, const rhombic::Vector3 & side)
{
  const auto unit = [](const rhombic::Vector3 & v) {
    const double length = std::sqrt(rhombic::Dot(v, v));
    return rhombic::Vector3{ v[0] / length, v[1] / length, v[2] / length };
  };
  const rhombic::Vector3 right = unit(rhombic::Cross(look, side));
  return { unit(look), rhombic::Cross(right, unit(look)), right };
}

inline rhombic::ViewFrame
RandomFrame(std::mt19937 & random)
{
  std::normal_distribution<double> normal;
  const rhombic::Vector3 look{ normal(random), normal(random), normal(random) };
  return FrameAlong(look, { normal(random), normal(random), normal(random) });
}

} // namespace slicetest

#endif
