#ifndef itkFCCCellSurface_h
#define itkFCCCellSurface_h

#include "itkFCCCellMarching.h"
#include "itkFCCEdgeSurface.h"

namespace itk
{

/** \class FCCCellSurface
 * \brief The surface through whole cells of the lattice, layer by layer (see FillCellTriangles()).
 *
 * \ingroup FCCIsosurface
 */
class FCCCellSurface : public FCCEdgeSurface
{
public:
  FCCCellSurface(const FCCSigns & signs, const FCCScalarField & field, FCCCellScheme scheme)
    : FCCEdgeSurface(signs, field, GetEdgeTypes(scheme), false)
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
