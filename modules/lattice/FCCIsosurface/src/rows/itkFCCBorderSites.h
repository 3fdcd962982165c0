#ifndef itkFCCBorderSites_h
#define itkFCCBorderSites_h

#include "itkFCCSigns.h"

namespace itk
{

/** Writes one bit for each site of a row of the signs: has it a neighbour on the other side of the surface? */
void
FindBorderSites(const FCCSigns & signs, SizeValueType j, SizeValueType k, FCCSigns::WordType * border);

} // namespace itk

#endif
