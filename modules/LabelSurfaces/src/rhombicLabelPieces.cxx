#include "rhombicLabelPieces.h"

#include "itkConnectedComponentImageFilter.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIterator.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <algorithm>

namespace rhombic
{
namespace
{

/** Extends a box to hold a run of voxels along x. */
void
Enclose(itk::ImageRegion<3> & box, const itk::Index<3> & first, itk::SizeValueType length)
{
  const itk::ImageRegion<3> run(first, { { length, 1, 1 } });
  if (box.GetNumberOfPixels() == 0)
  {
    box = run;
    return;
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto begin = std::min(box.GetIndex(axis), run.GetIndex(axis));
    const auto end = std::max(box.GetUpperIndex()[axis], run.GetUpperIndex()[axis]);
    box.SetIndex(axis, begin);
    box.SetSize(axis, static_cast<itk::SizeValueType>(end - begin + 1));
  }
}

/** Calls function(value, first index, length) for each run of equal values along x that are not 0. */
template <typename TImage, typename TFunction>
void
ForEachRun(const TImage & image, const TFunction & function)
{
  const auto & region = image.GetBufferedRegion();
  const auto width = static_cast<std::ptrdiff_t>(region.GetSize(0));
  const auto * row = image.GetBufferPointer();
  auto index = region.GetIndex();
  for (index[2] = region.GetIndex(2); index[2] <= region.GetUpperIndex()[2]; ++index[2])
  {
    for (index[1] = region.GetIndex(1); index[1] <= region.GetUpperIndex()[1]; ++index[1], row += width)
    {
      for (const auto * begin = row; begin != row + width;)
      {
        const auto value = *begin;
        const auto * const end = std::find_if(begin, row + width, [value](auto other) { return other != value; });
        if (value != 0)
        {
          index[0] = region.GetIndex(0) + (begin - row);
          function(value, index, static_cast<itk::SizeValueType>(end - begin));
        }
        begin = end;
      }
    }
  }
}

/** The mask of a label in a box. */
MaskImage::Pointer
CutMask(const ScanImage & image, std::int32_t value, const itk::ImageRegion<3> & box)
{
  const auto mask = MaskImage::New();
  mask->CopyInformation(&GeometryOf(image));
  mask->SetRegions(box);
  mask->Allocate();
  const auto cut = [&](const auto & voxels) {
    using ImageType = std::decay_t<decltype(*voxels)>;
    itk::ImageRegionConstIterator<ImageType> from(voxels, box);
    for (itk::ImageRegionIterator<MaskImage> to(mask, box); !to.IsAtEnd(); ++to, ++from)
    {
      to.Set(from.Get() == static_cast<typename ImageType::PixelType>(value) ? 1 : 0);
    }
  };
  std::visit(cut, image);
  return mask;
}

} // namespace

std::map<std::int32_t, itk::ImageRegion<3>>
FindLabelBoxes(const ScanImage & image)
{
  std::map<std::int32_t, itk::ImageRegion<3>> boxes;
  const auto find = [&boxes](const auto & voxels) {
    ForEachRun(*voxels, [&boxes](auto value, const itk::Index<3> & first, itk::SizeValueType length) {
      Enclose(boxes[static_cast<std::int32_t>(value)], first, length);
    });
  };
  std::visit(find, image);
  return boxes;
}

LabelPieces::LabelPieces(const ScanImage & image, std::int32_t value, const itk::ImageRegion<3> & box)
  : m_ScanRegion(GeometryOf(image).GetLargestPossibleRegion())
{
  const auto filter = itk::ConnectedComponentImageFilter<MaskImage, PieceImage>::New();
  filter->SetInput(CutMask(image, value, box));
  filter->SetFullyConnected(true);
  filter->Update();
  m_Pieces = filter->GetOutput();
  m_Pieces->DisconnectPipeline();
  m_Boxes.resize(filter->GetObjectCount());
  ForEachRun(*m_Pieces, [this](std::uint32_t piece, const itk::Index<3> & first, itk::SizeValueType length) {
    Enclose(m_Boxes[piece - 1], first, length);
  });
}

std::size_t
LabelPieces::CountFaceConnectedPieces() const
{
  const auto filter = itk::ConnectedComponentImageFilter<PieceImage, PieceImage>::New();
  filter->SetInput(m_Pieces);
  filter->Update();
  return filter->GetObjectCount();
}

std::vector<std::size_t>
LabelPieces::CountVoxels(std::size_t piece) const
{
  const itk::ImageRegion<3> & box = m_Boxes[piece];
  std::vector<std::size_t> counts(box.GetSize(2));
  for (itk::ImageRegionConstIteratorWithIndex<PieceImage> it(m_Pieces, box); !it.IsAtEnd(); ++it)
  {
    counts[static_cast<std::size_t>(it.GetIndex()[2] - box.GetIndex(2))] += it.Get() == piece + 1 ? 1 : 0;
  }
  return counts;
}

MaskImage::Pointer
LabelPieces::MakeMask(std::size_t piece, itk::SizeValueType margin) const
{
  const itk::ImageRegion<3> & box = m_Boxes[piece];
  itk::ImageRegion<3> region = box;
  region.PadByRadius(margin);
  const auto mask = MaskImage::New();
  mask->CopyInformation(m_Pieces);
  mask->SetRegions(region);
  mask->Allocate();
  for (itk::ImageRegionIteratorWithIndex<MaskImage> it(mask, region); !it.IsAtEnd(); ++it)
  {
    auto index = it.GetIndex();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = std::clamp(index[axis], m_ScanRegion.GetIndex(axis), m_ScanRegion.GetUpperIndex()[axis]);
    }
    it.Set(box.IsInside(index) && m_Pieces->GetPixel(index) == piece + 1 ? 1 : 0);
  }
  return mask;
}

} // namespace rhombic
