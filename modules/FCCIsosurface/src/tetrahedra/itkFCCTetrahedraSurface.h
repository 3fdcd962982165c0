#ifndef itkFCCTetrahedraSurface_h
#define itkFCCTetrahedraSurface_h

#include "itkFCCEdgeSurface.h"

namespace itk
{

/** \class FCCTetrahedraSurface
 * \brief The surface through the lattice's tetrahedra, plane by plane (see FillTriangles()).
 *
 * \ingroup FCCIsosurface
 */
class FCCTetrahedraSurface : public FCCEdgeSurface
{
public:
  FCCTetrahedraSurface(const FCCSigns & signs, const FCCScalarField & field, bool cubic)
    : FCCEdgeSurface(signs, field, FCCCutEdges::AllTypes, cubic)
  {}

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override;

protected:
  SizeValueType
  CountTriangles(SizeValueType k) const override;
};

} // namespace itk

#endif
