#include "rhombicPatientAxes.h"

#include "rhombicMappedVoxels.h"
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

/** What makes an image of other axes of an image. */
template <typename TImage>
struct AxisFilters
{
  typename itk::PermuteAxesImageFilter<TImage>::Pointer permute; ///< null if none is needed
  typename itk::FlipImageFilter<TImage>::Pointer flip;           ///< behind it; null if none is needed
  typename TImage::Pointer output;                               ///< the image itself, if none is needed

  explicit AxisFilters(TImage & image)
    : output(&image)
  {
    const Order order = FindOrder(image.GetDirection());
    itk::FixedArray<bool, 3> isReversed;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isReversed[axis] = image.GetDirection()[axis][order[axis]] < 0.0;
    }
    if (order[0] != 0 || order[1] != 1)
    {
      permute = itk::PermuteAxesImageFilter<TImage>::New();
      permute->SetOrder(order);
      permute->SetInput(output);
      permute->ReleaseDataFlagOn();
      output = permute->GetOutput();
    }
    if (isReversed[0] || isReversed[1] || isReversed[2])
    {
      flip = itk::FlipImageFilter<TImage>::New();
      flip->SetFlipAxes(isReversed);
      flip->FlipAboutOriginOff();
      flip->SetInput(output);
      output = flip->GetOutput();
    }
    output->UpdateOutputInformation();
  }

  /** How many images there are at a time, besides the input. */
  std::uintmax_t
  CountCopies() const
  {
    return (permute ? 1 : 0) + (flip ? 1 : 0);
  }
};

/** An image without pixels in another one's place. */
template <typename TImage>
typename TImage::Pointer
NewFrameOf(const TImage & image)
{
  const auto frame = TImage::New();
  frame->CopyInformation(&image);
  return frame;
}

/** Makes the output of \a filters in a temporary file, as many slices at a time as fit into \a allowed bytes. */
template <typename TImage>
typename TImage::Pointer
OrderInTemporaryFile(const AxisFilters<TImage> & filters,
                     const ScanImage & input,
                     std::uintmax_t allowed,
                     const std::filesystem::path & folder)
{
  const typename TImage::Pointer ordered = NewFrameOf(*filters.output);
  AllocateInTemporaryFile(ScanImage(ordered),
                          { folder, "Cannot put the axes of the scan in the order of the patient's: its voxels" });
  itk::ImageRegion<3> slab = ordered->GetLargestPossibleRegion();
  const std::size_t depth = slab.GetSize(2);
  const std::size_t pixels = slab.GetNumberOfPixels() / depth; // of a slice
  const std::uintmax_t bytes = filters.CountCopies() * pixels * sizeof(typename TImage::PixelType);
  const std::size_t slices = std::clamp<std::uintmax_t>(allowed / bytes, 1, depth);
  for (std::size_t begin = 0; begin < depth; begin += slices)
  {
    slab.SetIndex(2, static_cast<itk::IndexValueType>(begin) + ordered->GetLargestPossibleRegion().GetIndex(2));
    slab.SetSize(2, std::min(slices, depth - begin));
    filters.output->SetRequestedRegion(slab);
    filters.output->PropagateRequestedRegion();
    filters.output->UpdateOutputData();
    std::copy_n(filters.output->GetBufferPointer() + filters.output->ComputeOffset(slab.GetIndex()),
                slab.GetNumberOfPixels(),
                ordered->GetBufferPointer() + begin * pixels);
    DropPages(input);
    DropPages(ordered);
  }
  return ordered;
}

template <typename TImage>
typename TImage::Pointer
OrderAxes(typename TImage::Pointer image, std::uintmax_t maximumMemory, const std::filesystem::path & folder)
{
  const AxisFilters<TImage> filters(*image);
  const itk::ImageRegion<3> & region = image->GetLargestPossibleRegion();
  const std::uintmax_t bytes = filters.CountCopies() * region.GetNumberOfPixels() * sizeof(typename TImage::PixelType);
  const std::uintmax_t allowed = MemoryAllowance(maximumMemory);
  if (bytes == 0)
  {
    return image;
  }
  if (image->GetBufferedRegion() != region) // it has no voxels
  {
    return NewFrameOf(*filters.output);
  }
  if (bytes > allowed)
  {
    return OrderInTemporaryFile(filters, ScanImage(image), allowed / 2, folder);
  }
  filters.output->Update();
  const typename TImage::Pointer output = filters.output;
  output->DisconnectPipeline();
  return output;
}

/** \class RowwisePermutation
 * \brief itk::PermuteAxesImageFilter for orders that keep the first axis, whose rows are copied. */
template <typename TImage>
class RowwisePermutation : public itk::PermuteAxesImageFilter<TImage>
{
public:
  using Pointer = itk::SmartPointer<RowwisePermutation>;
  itkFactorylessNewMacro(RowwisePermutation);

protected:
  void
  DynamicThreadedGenerateData(const itk::ImageRegion<3> & region) override
  {
    const TImage & input = *this->GetInput();
    TImage & output = *this->GetOutput();
    itk::Index<3> index = region.GetIndex();
    for (; index[2] < region.GetIndex(2) + static_cast<itk::IndexValueType>(region.GetSize(2)); ++index[2])
    {
      for (index[1] = region.GetIndex(1);
           index[1] < region.GetIndex(1) + static_cast<itk::IndexValueType>(region.GetSize(1));
           ++index[1])
      {
        std::copy_n(input.GetBufferPointer() + input.ComputeOffset({ { index[0], index[2], index[1] } }),
                    region.GetSize(0),
                    output.GetBufferPointer() + output.ComputeOffset(index));
      }
    }
  }
};

} // namespace

DeepImage
MakeDeep(const ScanImage & image)
{
  constexpr itk::SizeValueType large = 8'000'000;
  return std::visit(
    [](const auto & flat) -> DeepImage {
      using Image = typename std::decay_t<decltype(*flat)>;
      const itk::Size<3> & size = flat->GetLargestPossibleRegion().GetSize();
      if (size[0] * size[1] <= large || size[1] < 2 * size[2])
      {
        return { flat, nullptr };
      }
      const auto exchange = RowwisePermutation<Image>::New();
      const unsigned int order[] = { 0, 2, 1 };
      exchange->SetOrder(Order(order));
      exchange->SetInput(flat);
      exchange->ReleaseDataFlagOn();
      exchange->UpdateOutputInformation();
      return { ScanImage(exchange->GetOutput()), exchange.GetPointer() };
    },
    image);
}

Scan
OrderAlongPatient(const Scan & scan, std::uintmax_t maximumMemory, const std::filesystem::path & folder)
{
  Scan ordered = scan;
  if (!IsSlanted(scan))
  {
    std::visit([&](auto & image) { image = OrderAxes<std::decay_t<decltype(*image)>>(image, maximumMemory, folder); },
               ordered.image);
  }
  return ordered;
}

} // namespace rhombic
