#ifndef rhombicLabelScan_h
#define rhombicLabelScan_h

#include "rhombicScan.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

namespace rhombictest
{

using LabelImage = itk::Image<std::uint8_t, 3>;

/** A point in LPS mm. */
inline itk::Point<double, 3>
At(double x, double y, double z)
{
  const double coordinates[] = { x, y, z };
  return itk::Point<double, 3>(coordinates);
}

/** The label at a point in LPS mm; 0 is the background. */
using LabelFunction = std::function<int(const itk::Point<double, 3> &)>;

/** A grid whose middle is at \a middle. */
struct LabelGrid
{
  itk::Size<3> size;
  std::array<double, 3> spacing;
  itk::Point<double, 3> middle{};
  itk::Matrix<double, 3, 3> direction = itk::Matrix<double, 3, 3>::GetIdentity();
};

/** The labels at the centres of the voxels. */
inline rhombic::Scan
MakeLabelScan(const LabelGrid & grid, const LabelFunction & label)
{
  const auto image = LabelImage::New();
  image->SetRegions(grid.size);
  image->SetSpacing(grid.spacing.data());
  image->SetDirection(grid.direction);
  itk::ContinuousIndex<double, 3> middle;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = 0.5 * static_cast<double>(grid.size[axis] - 1);
  }
  const auto offset = image->TransformContinuousIndexToPhysicalPoint<double, double>(middle);
  image->SetOrigin(image->GetOrigin() + (grid.middle - offset));
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<std::uint8_t>(label(image->TransformIndexToPhysicalPoint<double>(it.GetIndex()))));
  }
  rhombic::Scan scan;
  scan.image = image;
  return scan;
}

/** Label 1 within \a radius mm of \a centre. */
inline LabelFunction
Ball(double radius, const itk::Point<double, 3> & centre = {})
{
  return [=](const itk::Point<double, 3> & point) { return point.EuclideanDistanceTo(centre) <= radius ? 1 : 0; };
}

} // namespace rhombictest

#endif
