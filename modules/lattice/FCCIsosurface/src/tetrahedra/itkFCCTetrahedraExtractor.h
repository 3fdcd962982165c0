#ifndef itkFCCTetrahedraExtractor_h
#define itkFCCTetrahedraExtractor_h

#include "itkFCCEdgeExtractor.h"

namespace itk
{

/** \class FCCTetrahedraExtractor
 * \brief Extracts the surface through the lattice's tetrahedra, column by column (see FCCMarchingCases).
 */
class FCCTetrahedraExtractor : public FCCEdgeExtractor
{
public:
  FCCTetrahedraExtractor(const FCCSigns & signs, const FCCScalarField & field, bool cubic)
    : FCCEdgeExtractor(signs, field, FCCStoredEdges::AllTypes, cubic)
  {}

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override;

protected:
  SizeValueType
  CountTriangles(SizeValueType k) const override;
};

} // namespace itk

#endif
