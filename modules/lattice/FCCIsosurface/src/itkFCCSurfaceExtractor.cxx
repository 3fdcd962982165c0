#include "itkFCCSurfaceExtractor.h"

#include "itkFCCCellExtractor.h"
#include "itkFCCLeanExtractor.h"
#include "itkFCCTetrahedraExtractor.h"

namespace itk
{

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
      return std::make_unique<FCCTetrahedraExtractor>(signs, field, false);
    case FCCIsosurfaceMode::Fine:
      return std::make_unique<FCCTetrahedraExtractor>(signs, field, true);
    case FCCIsosurfaceMode::Octahedra:
      return std::make_unique<FCCCellExtractor>(signs, field, FCCCellScheme::Octahedra);
    case FCCIsosurfaceMode::Parallelepipeds:
      return std::make_unique<FCCCellExtractor>(signs, field, FCCCellScheme::Parallelepipeds);
    default:
      return std::make_unique<FCCLeanExtractor>(signs, field);
  }
}

} // namespace itk
