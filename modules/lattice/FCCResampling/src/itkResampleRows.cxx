#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCLattice.h"
#include "itkRowRing.h"

namespace itk
{

void
ResampleRows(const SeparableTaps (&xTaps)[2],
             const SeparableTaps & yTaps,
             const SeparableTaps & zTaps,
             const ImageRegion<3> & region,
             const LoadRow & load,
             const StoreRow & store)
{
  const SizeValueType width = region.GetSize(0);
  const SizeValueType xFirst = xTaps[0].GetFirst(0);
  const SizeValueType xCount = xTaps[1].GetFirst(width - 1) + xTaps[1].GetNumberOfTaps() - xFirst;
  const SizeValueType yCount = yTaps.GetNumberOfTaps();
  const SizeValueType zCount = zTaps.GetNumberOfTaps();
  const RowArithmetic::RowTaps rowTaps[2] = { { xTaps[0], width, xFirst }, { xTaps[1], width, xFirst } };

  // A slab is a plane of the input, blended along y at the rows of one block.
  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);
  const SizeValueType blockSize = RowsPerBlock(zCount * stride, region.GetSize(1));
  RowRing inputRows(yCount, stride);
  RowRing slabs(zCount, blockSize * stride);
  std::vector<float> row(stride);
  std::vector<float> values(rowTaps[0].GetPaddedLength());
  std::vector<const float *> terms(std::max(yCount, zCount));

  for (SizeValueType blockBegin = 0; blockBegin < region.GetSize(1); blockBegin += blockSize)
  {
    const SizeValueType blockEnd = std::min(blockBegin + blockSize, region.GetSize(1));
    const auto makeSlab = [&](SizeValueType z, float * slab) {
      const auto loadRow = [&](SizeValueType y, float * inputRow) {
        load(
          { { static_cast<IndexValueType>(xFirst), static_cast<IndexValueType>(y), static_cast<IndexValueType>(z) } },
          xCount,
          inputRow);
      };
      inputRows.Restart();
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        const SizeValueType first = yTaps.GetFirst(j);
        inputRows.Advance(first, first + yCount, loadRow);
        for (SizeValueType tap = 0; tap < yCount; ++tap)
        {
          terms[tap] = inputRows.GetRow(first + tap);
        }
        RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, slab + (j - blockBegin) * stride);
      }
    };

    slabs.Restart();
    for (SizeValueType k = 0; k < region.GetSize(2); ++k)
    {
      const SizeValueType first = zTaps.GetFirst(k);
      slabs.Advance(first, first + zCount, makeSlab);
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        for (SizeValueType tap = 0; tap < zCount; ++tap)
        {
          terms[tap] = slabs.GetRow(first + tap) + (j - blockBegin) * stride;
        }
        RowArithmetic::Blend(terms.data(), zTaps.GetWeights(k), zCount, xCount, row.data());

        const Index<3> index{ { region.GetIndex(0),
                                region.GetIndex(1) + static_cast<IndexValueType>(j),
                                region.GetIndex(2) + static_cast<IndexValueType>(k) } };
        RowArithmetic::Interpolate(row.data(), rowTaps[FCCLattice::Parity(index[1], index[2])], values.data());
        store(index, width, values.data());
      }
    }
  }
}

} // namespace itk
