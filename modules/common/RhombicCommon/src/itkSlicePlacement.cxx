#include "itkSlicePlacement.h"

#include "itkInputDataObjectConstIterator.h"
#include "itkMetaDataObject.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr const char * Key = "SlicePlacement";

/** The slice of a scan's grid, a real number from 0, in which a sample of an image lies. */
double
SliceOf(const ImageBase<3> & image, const Index<3> & index, const ImageBase<3> & grid)
{
  const auto point = image.TransformIndexToPhysicalPoint<double>(index);
  return grid.TransformPhysicalPointToContinuousIndex<double>(point)[2] -
         static_cast<double>(grid.GetLargestPossibleRegion().GetIndex(2));
}

/** FindSliceOrigins() for a scan with slice origins. */
std::vector<Point<double, 3>>
PlaceSlices(const ImageBase<3> & image, const SlicePlacement & scan)
{
  constexpr double tolerance = 1e-3; // in slices
  const auto & region = image.GetLargestPossibleRegion();
  std::vector<Point<double, 3>> origins;
  long before = 0; // the scan's slice that the image's slice before is
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    Index<3> first = region.GetIndex();
    first[2] += static_cast<IndexValueType>(k);
    const double place = SliceOf(image, first, *scan.grid);
    const long slice = std::lround(std::clamp(place, -1.0, static_cast<double>(scan.origins.size())));
    bool isSlice = slice >= 0 && slice < static_cast<long>(scan.origins.size()) &&
                   (k == 0 || std::abs(slice - before) == 1) &&
                   std::abs(place - static_cast<double>(slice)) <= tolerance;
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      Index<3> last = first;
      last[axis] = region.GetUpperIndex()[axis];
      isSlice = isSlice && std::abs(SliceOf(image, last, *scan.grid) - place) <= tolerance;
    }
    if (!isSlice)
    {
      itkGenericExceptionMacro("Slice " << k
                                        << " of the input is not the next slice of the scan, whose slices are unevenly "
                                           "spaced; filters before this one may crop the scan, but not shrink, pad or "
                                           "resample it across its slices, and SetScan() needs the scan of the input.");
    }
    Index<3> gridFirst = scan.grid->GetLargestPossibleRegion().GetIndex();
    gridFirst[2] += slice;
    origins.push_back(scan.origins[static_cast<std::size_t>(slice)] +
                      (image.TransformIndexToPhysicalPoint<double>(first) -
                       scan.grid->TransformIndexToPhysicalPoint<double>(gridFirst)));
    before = slice;
  }
  return origins;
}

} // namespace

bool
AreAxesPerpendicular(const Matrix<double, 3, 3> & direction)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto column = direction.GetVnlMatrix().get_column(axis);
    const auto next = direction.GetVnlMatrix().get_column((axis + 1) % 3);
    if (std::abs(dot_product(column, next)) > AxesTolerance * column.magnitude() * next.magnitude())
    {
      return false;
    }
  }
  return true;
}

void
SetSlicePlacement(DataObject & image, const SlicePlacement & placement)
{
  EncapsulateMetaData(image.GetMetaDataDictionary(), Key, placement);
}

SlicePlacement
GetSlicePlacement(const DataObject & image)
{
  SlicePlacement placement;
  ExposeMetaData(image.GetMetaDataDictionary(), Key, placement);
  return placement;
}

bool
IsFromUnevenSlices(const DataObject & image)
{
  if (!GetSlicePlacement(image).origins.empty())
  {
    return true;
  }
  const auto source = image.GetSource();
  if (source.IsNull() || dynamic_cast<const SlicePlacingFilter *>(source.GetPointer()) != nullptr)
  {
    return false;
  }
  for (InputDataObjectConstIterator input(source); !input.IsAtEnd(); ++input)
  {
    if (input.GetName() != "ReferenceImage" && input.GetInput() != nullptr && IsFromUnevenSlices(*input.GetInput()))
    {
      return true;
    }
  }
  return false;
}

std::vector<Point<double, 3>>
FindSliceOrigins(const ImageBase<3> & image, const SlicePlacement & scan)
{
  const SlicePlacement own = GetSlicePlacement(image);
  const SlicePlacement & placement = own.origins.empty() ? scan : own;
  if (!placement.origins.empty())
  {
    return PlaceSlices(image, placement);
  }
  if (IsFromUnevenSlices(image))
  {
    itkGenericExceptionMacro("The input is made from a scan with unevenly spaced slices, whose places a filter in "
                             "between has left out; call SetScan(reader->GetScan()), or DisconnectPipeline() of an "
                             "image whose samples lie where its geometry says.");
  }
  return {};
}

void
PrintSliceOrigins(std::ostream & os, const std::vector<Point<double, 3>> & origins)
{
  os << origins.size();
  if (!origins.empty())
  {
    os << ", from " << origins.front() << " to " << origins.back();
  }
}

} // namespace itk
