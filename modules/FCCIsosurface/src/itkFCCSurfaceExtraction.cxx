#include "itkFCCSurfaceExtraction.h"

#include "itkFCCCellSurface.h"
#include "itkFCCLeanSurface.h"
#include "itkFCCTetrahedraSurface.h"

namespace itk
{

SizeValueType
FCCSurfaceExtraction::GetMargin(FCCIsosurfaceMode mode, bool closed)
{
  return closed || mode == FCCIsosurfaceMode::Lean ? 1 : 0;
}

std::unique_ptr<FCCSurfaceExtraction>
FCCSurfaceExtraction::Make(FCCIsosurfaceMode mode, const FCCSigns & signs, const FCCScalarField & field)
{
  switch (mode)
  {
    case FCCIsosurfaceMode::Tetrahedra:
      return std::make_unique<FCCTetrahedraSurface>(signs, field, false);
    case FCCIsosurfaceMode::Fine:
      return std::make_unique<FCCTetrahedraSurface>(signs, field, true);
    case FCCIsosurfaceMode::Octahedra:
      return std::make_unique<FCCCellSurface>(signs, field, FCCCellScheme::Octahedra);
    case FCCIsosurfaceMode::Parallelepipeds:
      return std::make_unique<FCCCellSurface>(signs, field, FCCCellScheme::Parallelepipeds);
    default:
      return std::make_unique<FCCLeanSurface>(signs, field);
  }
}

} // namespace itk
