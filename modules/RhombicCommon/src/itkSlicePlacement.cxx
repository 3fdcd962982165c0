#include "itkSlicePlacement.h"

#include "itkMetaDataObject.h"

#include <cmath>

namespace itk
{
namespace
{

constexpr const char * Key = "SlicePlacement";

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

} // namespace itk
