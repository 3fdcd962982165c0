#ifndef itkFCCCellExtractor_h
#define itkFCCCellExtractor_h

#include "itkFCCCellMarching.h"
#include "itkFCCEdgeExtractor.h"

namespace itk
{

/** \class FCCCellExtractor
 * \brief Extracts the surface through whole cells of the lattice, layer by layer (see FillCellTriangles()).
 *
 * \ingroup FCCIsosurface
 */
class FCCCellExtractor : public FCCEdgeExtractor
{
public:
  FCCCellExtractor(const FCCSigns & signs, const FCCScalarField & field, FCCCellScheme scheme)
    : FCCEdgeExtractor(signs, field, GetEdgeTypes(scheme), false)
    , m_Scheme(scheme)
  {}

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override;

protected:
  SizeValueType
  CountTriangles(SizeValueType k) const override;

private:
  FCCCellScheme m_Scheme;
};

} // namespace itk

#endif
