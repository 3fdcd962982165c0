#ifndef itkFCCStepTarget_h
#define itkFCCStepTarget_h

#include "itkFCCSigns.h"

namespace itk
{

/** \class FCCStepTarget
 * \brief The sites at one step from those of a row: their row, and how far their indices are from those of the row.
 */
struct FCCStepTarget
{
  SizeValueType j;
  SizeValueType k;
  IndexValueType shift;
  bool isInBox; ///< whether the row is one of the signs

  FCCStepTarget(const FCCSigns & signs, SizeValueType fromJ, SizeValueType fromK, const FCCLattice::SiteType & step)
    : j(fromJ + static_cast<SizeValueType>(step[1])) // below 0 wraps around
    , k(fromK + static_cast<SizeValueType>(step[2]))
    , shift(FCCLattice::OffsetOf(step, signs.GetParity(fromJ, fromK))[0])
    , isInBox(j < signs.GetHeight() && k < signs.GetDepth())
  {}
};

} // namespace itk

#endif
