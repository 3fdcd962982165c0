#include "rhombicPatientAxes.h"

#include "rhombicMemoryBudget.h"

#include "itkFlipImageFilter.h"
#include "itkPermuteAxesImageFilter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhombic
{
namespace
{

using Direction = itk::ImageBase<3>::DirectionType;
using Order = itk::FixedArray<unsigned int, 3>;

/** For each axis of the patient the scan's axis nearest to it: the order with the largest sum of cosines. */
Order
FindOrder(const Direction & direction)
{
  std::array<unsigned int, 3> order{ 0, 1, 2 };
  std::array<unsigned int, 3> best = order;
  double largest = 0.0;
  do
  {
    double sum = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sum += std::abs(direction[axis][order[axis]]);
    }
    if (sum > largest + 1e-6) // of equal sums, the order nearest to the file's
    {
      largest = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return Order(best.data());
}

template <typename TFilter, typename TImage>
typename TImage::Pointer
Apply(TFilter & filter, const TImage & image)
{
  filter.SetInput(&image);
  filter.Update();
  typename TImage::Pointer output = filter.GetOutput();
  output->DisconnectPipeline();
  return output;
}

template <typename TImage>
typename TImage::Pointer
OrderAxes(typename TImage::Pointer image, std::uintmax_t maximumMemory)
{
  const Order order = FindOrder(image->GetDirection());
  itk::FixedArray<bool, 3> isReversed;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    isReversed[axis] = image->GetDirection()[axis][order[axis]] < 0.0;
  }
  const bool isPermuted = order[0] != 0 || order[1] != 1;
  const bool isFlipped = isReversed[0] || isReversed[1] || isReversed[2];
  const std::uintmax_t copies = (isPermuted ? 1 : 0) + (isFlipped ? 1 : 0);
  RequireMemory(copies * image->GetBufferedRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType),
                maximumMemory,
                "Ordering the scan's axes along the patient's",
                "crop the scan");
  if (isPermuted)
  {
    const auto permute = itk::PermuteAxesImageFilter<TImage>::New();
    permute->SetOrder(order);
    image = Apply(*permute, *image);
  }
  if (isFlipped)
  {
    const auto flip = itk::FlipImageFilter<TImage>::New();
    flip->SetFlipAxes(isReversed);
    flip->FlipAboutOriginOff();
    image = Apply(*flip, *image);
  }
  return image;
}

} // namespace

Scan
OrderAlongPatient(const Scan & scan, std::uintmax_t maximumMemory)
{
  Scan ordered = scan;
  if (!IsSlanted(scan))
  {
    std::visit(
      [maximumMemory](auto & image) { image = OrderAxes<std::decay_t<decltype(*image)>>(image, maximumMemory); },
      ordered.image);
  }
  return ordered;
}

} // namespace rhombic
