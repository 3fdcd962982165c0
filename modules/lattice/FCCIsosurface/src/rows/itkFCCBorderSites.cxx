#include "itkFCCBorderSites.h"

#include "itkFCCBitRows.h"
#include "itkFCCStepTarget.h"

namespace itk
{

void
FindBorderSites(const FCCSigns & signs, SizeValueType j, SizeValueType k, FCCSigns::WordType * border)
{
  const FCCSigns::WordType * const row = signs.GetRow(j, k);
  std::fill_n(border, signs.GetNumberOfWords(), 0);
  for (const auto & edge : FCCLattice::OwnedEdges)
  {
    for (const IndexValueType sign : { 1, -1 })
    {
      const FCCStepTarget end(signs, j, k, { sign * edge[0], sign * edge[1], sign * edge[2] });
      if (end.isInBox)
      {
        FCCBits::ForEachShifted(signs.GetRow(end.j, end.k),
                                signs.GetNumberOfWords(),
                                end.shift,
                                [&](SizeValueType word, FCCSigns::WordType bits) { border[word] |= row[word] ^ bits; });
      }
    }
  }
}

} // namespace itk
