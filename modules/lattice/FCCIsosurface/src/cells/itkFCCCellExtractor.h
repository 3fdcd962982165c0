#ifndef itkFCCCellExtractor_h
#define itkFCCCellExtractor_h

#include "itkFCCEdgeExtractor.h"

namespace itk
{

/** The ways to fill space with whole cells of the lattice: FCCOctahedraCases and FCCParallelepipedCases. */
enum class FCCCellScheme : unsigned char
{
  Octahedra,
  Parallelepipeds
};

/** \class FCCCellExtractor
 * \brief Extracts the surface through whole cells of the lattice, layer by layer: *layer* k is the cells whose anchors
 * are in plane k.
 *
 * When the surface is closed, sites beyond the box of the signs are outside and every cell that holds a site of the box
 * is marched; the first and last sites of the box along each axis must be outside. When it is open, only cells whose
 * corners are all in the box are.
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
  static std::uint8_t
  GetEdgeTypes(FCCCellScheme scheme);

  FCCCellScheme m_Scheme;
};

} // namespace itk

#endif
