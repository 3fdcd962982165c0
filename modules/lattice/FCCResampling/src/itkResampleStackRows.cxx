#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCLattice.h"
#include "itkRowRing.h"

#include <optional>

namespace itk
{

void
ResampleStackRows(const SliceStackPlanes & planes,
                  const ImageRegion<3> & region,
                  const LoadRow & load,
                  const StoreRow & store)
{
  const auto needed = planes.FindNeededSamples();
  const IndexValueType xFirst = needed.GetIndex(0);
  const SizeValueType xCount = needed.GetSize(0);
  const SeparableTaps & zTaps = planes.GetSliceTaps();
  const SizeValueType zCount = zTaps.GetNumberOfTaps();
  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);

  std::vector<float> sliceRows(zCount * stride);
  std::vector<const float *> sliceTerms(zCount);
  for (SizeValueType tap = 0; tap < zCount; ++tap)
  {
    sliceTerms[tap] = sliceRows.data() + tap * stride;
  }
  const auto blendSlices = [&](SizeValueType k, SizeValueType y, float * blend) {
    const auto zFirst = static_cast<IndexValueType>(zTaps.GetFirst(k));
    for (SizeValueType tap = 0; tap < zCount; ++tap)
    {
      load({ { xFirst, static_cast<IndexValueType>(y), zFirst + static_cast<IndexValueType>(tap) } },
           xCount,
           sliceRows.data() + tap * stride);
    }
    RowArithmetic::Blend(sliceTerms.data(), zTaps.GetWeights(k), zCount, xCount, blend);
  };

  std::vector<float> row(stride);
  std::vector<float> values;
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    const std::vector<double> rows = planes.GetRows(k);
    const SeparableTaps yTaps = planes.MakeRowTaps(rows);
    const SizeValueType yCount = yTaps.GetNumberOfTaps();
    RowRing blendedRows(yCount, stride);
    std::vector<const float *> terms(yCount);
    std::optional<SliceStackPlanes::SiteRow> siteRows[2]; // by parity
    for (SizeValueType j = 0; j < region.GetSize(1); ++j)
    {
      Index<3> index{ { region.GetIndex(0),
                        region.GetIndex(1) + static_cast<IndexValueType>(j),
                        region.GetIndex(2) + static_cast<IndexValueType>(k) } };
      const IndexValueType parity = FCCLattice::Parity(index[1], index[2]);
      auto & sites = siteRows[parity];
      if (!sites || planes.AreRowsShifted())
      {
        sites.emplace(planes.MakeSiteRow(k, rows[j], parity, static_cast<SizeValueType>(xFirst)));
      }
      if (!planes.HasRow(rows[j]) || sites->begin == sites->end)
      {
        store(index, 0, nullptr);
        continue;
      }
      const SizeValueType first = yTaps.GetFirst(j);
      blendedRows.Advance(first, first + yCount, [&](SizeValueType y, float * blended) { blendSlices(k, y, blended); });
      for (SizeValueType tap = 0; tap < yCount; ++tap)
      {
        terms[tap] = blendedRows.GetRow(first + tap);
      }
      RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, row.data());
      values.resize(sites->taps.GetPaddedLength());
      RowArithmetic::Interpolate(row.data(), sites->taps, values.data());
      index[0] += static_cast<IndexValueType>(sites->begin);
      store(index, sites->end - sites->begin, values.data() + sites->begin);
    }
  }
}

} // namespace itk
