#include "itkFCCIsosurfaceFilter.h"

#include "itkFCCExtractors.h"

#include <utility>

namespace itk
{

RHOMBIC_INSTANTIATE(template class FCCIsosurfaceFilter, FCCImage);

SizeValueType
FCCSurfaceExtractor::GetMargin(FCCIsosurfaceMode mode, bool closed)
{
  return closed || mode == FCCIsosurfaceMode::Lean ? 1 : 0;
}

std::unique_ptr<FCCSurfaceExtractor>
FCCSurfaceExtractor::Make(FCCIsosurfaceMode mode, const FCCSigns & signs, const FCCScalarField & field)
{
  switch (mode)
  {
    case FCCIsosurfaceMode::Tetrahedra:
      return MakeFCCTetrahedraExtractor(signs, field, false);
    case FCCIsosurfaceMode::Fine:
      return MakeFCCTetrahedraExtractor(signs, field, true);
    case FCCIsosurfaceMode::Octahedra:
      return MakeFCCCellExtractor(signs, field, FCCCellScheme::Octahedra);
    case FCCIsosurfaceMode::Parallelepipeds:
      return MakeFCCCellExtractor(signs, field, FCCCellScheme::Parallelepipeds);
    default:
      return MakeFCCLeanExtractor(signs, field);
  }
}

void
FCCSurfaceExtractor::SumUp()
{
  for (std::vector<SizeValueType> * const counts : { &m_FirstPoint, &m_FirstTriangle })
  {
    SizeValueType sum = 0;
    for (SizeValueType & count : *counts)
    {
      sum += std::exchange(count, sum);
    }
  }
}

} // namespace itk
