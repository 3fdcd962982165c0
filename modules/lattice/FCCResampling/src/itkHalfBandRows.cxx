#include "detail/itkFCCMirror.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCLattice.h"
#include "itkRowRing.h"

#include <cstdlib>

namespace itk
{
namespace
{

/** The half-band filter 1/2 + 3/4 A - 1/4 A^3 as a sum of samples, with A the mean of a sample's six face neighbours.
 */
struct HalfBandTerms
{
  std::vector<FCCLattice::SiteType> offsets;
  std::vector<float> weights;

  void
  Add(const FCCLattice::SiteType & offset, double weight)
  {
    offsets.push_back(offset);
    weights.push_back(static_cast<float>(weight));
  }
};

/** A^3 is the mean over all walks of three steps: n! / (|x|! |y|! |z|!) of the 216 end n = 3 steps away at (x, y, z),
 * and 15 at each face neighbour. */
HalfBandTerms
MakeHalfBandTerms()
{
  constexpr double factorials[] = { 1.0, 1.0, 2.0, 6.0 };
  HalfBandTerms terms;
  terms.Add({ 0, 0, 0 }, 0.5);
  for (IndexValueType z = -HalfBandReach; z <= HalfBandReach; ++z)
  {
    for (IndexValueType y = -HalfBandReach; y <= HalfBandReach; ++y)
    {
      for (IndexValueType x = -HalfBandReach; x <= HalfBandReach; ++x)
      {
        const IndexValueType steps = std::abs(x) + std::abs(y) + std::abs(z);
        if (steps == 1)
        {
          terms.Add({ x, y, z }, 0.75 / 6.0 - 0.25 * 15.0 / 216.0);
        }
        else if (steps == 3)
        {
          const double walks = 6.0 / (factorials[std::abs(x)] * factorials[std::abs(y)] * factorials[std::abs(z)]);
          terms.Add({ x, y, z }, -0.25 * walks / 216.0);
        }
      }
    }
  }
  return terms;
}

/** Loads input rows as two rows, their samples of even and of odd x, so that each term of the filter is a run of
 * consecutive samples. Sample n of the even row is at x = 2 (begin + n - Margin), of the odd row at the next x. */
class SplitRowLoader
{
public:
  static constexpr IndexValueType Margin = 2;

  SplitRowLoader(const Size<3> & size, const ImageRegion<3> & region, const LoadRow & load)
    : m_Size(size)
    , m_Load(load)
    , m_Sources(2 * (region.GetSize(0) + 2 * Margin))
  {
    const IndexValueType begin = 2 * region.GetIndex(0);
    const IndexValueType end = begin + 2 * static_cast<IndexValueType>(region.GetSize(0));
    for (std::size_t n = 0; n < m_Sources.size(); ++n)
    {
      const IndexValueType x = begin - 2 * Margin + static_cast<IndexValueType>(n);
      const IndexValueType needed = std::clamp(x, begin - HalfBandReach, end + HalfBandReach - 1);
      m_Sources[n] = MirrorIntoRange(needed, 0, static_cast<IndexValueType>(size[0]) - 1);
    }
    const auto [lowest, highest] = std::minmax_element(m_Sources.begin(), m_Sources.end());
    m_First = *lowest;
    m_Row.resize(static_cast<std::size_t>(*highest - *lowest + 1));
  }

  /** Samples to allocate for each of the two rows. */
  SizeValueType
  GetStride() const
  {
    return RowArithmetic::PaddedLength(m_Sources.size() / 2);
  }

  /** Loads row (y, z), or its mirror image in the input. The odd samples begin GetStride() behind the even samples. */
  void
  Load(IndexValueType y, IndexValueType z, float * even)
  {
    m_Load({ { m_First,
               MirrorIntoRange(y, 0, static_cast<IndexValueType>(m_Size[1]) - 1),
               MirrorIntoRange(z, 0, static_cast<IndexValueType>(m_Size[2]) - 1) } },
           m_Row.size(),
           m_Row.data());
    float * const odd = even + this->GetStride();
    for (std::size_t n = 0; n < m_Sources.size() / 2; ++n)
    {
      even[n] = m_Row[static_cast<std::size_t>(m_Sources[2 * n] - m_First)];
      odd[n] = m_Row[static_cast<std::size_t>(m_Sources[2 * n + 1] - m_First)];
    }
  }

private:
  Size<3> m_Size;
  const LoadRow & m_Load;
  std::vector<IndexValueType> m_Sources; // where even and odd samples in turn come from
  IndexValueType m_First;
  std::vector<float> m_Row;
};

} // namespace

void
FilterHalfBandRows(const Size<3> & size, const ImageRegion<3> & region, const LoadRow & load, const StoreRow & store)
{
  constexpr IndexValueType reach = HalfBandReach;
  constexpr IndexValueType window = 2 * reach + 1;
  const auto begin = region.GetIndex();
  const auto end = begin + region.GetSize();
  const HalfBandTerms terms = MakeHalfBandTerms();
  SplitRowLoader loader(size, region, load);
  const SizeValueType stride = loader.GetStride();

  // A slab is a plane of the input: the rows that one block of output rows needs.
  const auto blockSize = static_cast<IndexValueType>(RowsPerBlock(window * 2 * stride, region.GetSize(1)));
  RowRing slabs(window, static_cast<SizeValueType>(blockSize + 2 * reach) * 2 * stride);
  std::vector<const float *> rows(terms.offsets.size());
  std::vector<float> values(RowArithmetic::PaddedLength(region.GetSize(0)));
  for (IndexValueType blockBegin = begin[1]; blockBegin < end[1]; blockBegin += blockSize)
  {
    const IndexValueType blockEnd = std::min(blockBegin + blockSize, end[1]);
    const auto numberOf = [&](IndexValueType z) { return static_cast<SizeValueType>(z - begin[2] + reach); };
    const auto offsetOf = [&](IndexValueType y) {
      return static_cast<SizeValueType>(y - blockBegin + reach) * 2 * stride;
    };
    const auto loadSlab = [&](SizeValueType number, float * slab) {
      for (IndexValueType y = blockBegin - reach; y < blockEnd + reach; ++y)
      {
        loader.Load(y, begin[2] - reach + static_cast<IndexValueType>(number), slab + offsetOf(y));
      }
    };

    slabs.Restart();
    auto index = begin;
    for (index[2] = begin[2]; index[2] < end[2]; ++index[2])
    {
      slabs.Advance(numberOf(index[2] - reach), numberOf(index[2] + reach) + 1, loadSlab);
      for (index[1] = blockBegin; index[1] < blockEnd; ++index[1])
      {
        for (std::size_t n = 0; n < rows.size(); ++n)
        {
          const auto & offset = terms.offsets[n];
          const IndexValueType x = FCCLattice::Parity(index[1], index[2]) + offset[0] + 2 * SplitRowLoader::Margin;
          rows[n] = slabs.GetRow(numberOf(index[2] + offset[2])) + offsetOf(index[1] + offset[1]) +
                    static_cast<SizeValueType>(x & 1) * stride + static_cast<SizeValueType>(x / 2);
        }
        RowArithmetic::Blend(rows.data(), terms.weights.data(), rows.size(), region.GetSize(0), values.data());
        store(index, region.GetSize(0), values.data());
      }
    }
  }
}

} // namespace itk
