#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCFieldKernels.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "detail/itkFCCBitRows.h"
#include "itkFCCCells.h"
#include "itkFCCFieldPlanes.h"

#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

/** The index of a step in FCCLattice::NearestNeighbors. */
constexpr unsigned int
PlaceOf(IndexValueType x, IndexValueType y, IndexValueType z)
{
  unsigned int place = 0;
  while (!FCCStep::AreEqual(FCCLattice::NearestNeighbors[place], { x, y, z }))
  {
    ++place;
  }
  return place;
}
static_assert(PlaceOf(-1, -1, 0) == PlaceOf(1, 1, 0) + 6 && PlaceOf(1, -1, 0) == PlaceOf(-1, 1, 0) + 6 &&
                PlaceOf(-1, 0, -1) == PlaceOf(1, 0, 1) + 6 && PlaceOf(1, 0, -1) == PlaceOf(-1, 0, 1) + 6 &&
                PlaceOf(0, -1, -1) == PlaceOf(0, 1, 1) + 6 && PlaceOf(0, 1, -1) == PlaceOf(0, -1, 1) + 6,
              "opposite neighbours are 6 places apart");

HWY_ATTR void
QuasiInterpolateRow(const float * values,
                    const float * const * n,
                    SizeValueType count,
                    float * HWY_RESTRICT coefficients)
{
  constexpr float largest = std::numeric_limits<float>::max();
  for (SizeValueType first = 0; first < count; first += FCCFieldKernels::Block)
  {
    for (SizeValueType i = first; i < first + FCCFieldKernels::Block; ++i)
    {
      const float sum = ((n[0][i] + n[6][i]) + (n[1][i] + n[7][i])) + ((n[2][i] + n[8][i]) + (n[3][i] + n[9][i])) +
                        ((n[4][i] + n[10][i]) + (n[5][i] + n[11][i]));
      const float coefficient = 1.5f * values[i] - sum * (1.0f / 24.0f);
      coefficients[i] = coefficient >= -largest && coefficient <= largest ? coefficient : values[i];
    }
  }
}

/** The gradients at all sites of a block. */
HWY_INLINE void
GradientBlock(const float * const * n, std::size_t first, float * HWY_RESTRICT gradients)
{
  const hn::CappedTag<float, FCCFieldKernels::Block> tag;
  const auto eighth = hn::Set(tag, 0.125f);
  for (std::size_t i = first; i < first + FCCFieldKernels::Block; i += hn::Lanes(tag))
  {
    const auto differenceAlong = [&](unsigned int neighbor) HWY_ATTR {
      return hn::Sub(hn::LoadU(tag, n[neighbor] + i), hn::LoadU(tag, n[neighbor + 6] + i));
    };
    const auto a = differenceAlong(PlaceOf(1, 1, 0));
    const auto b = differenceAlong(PlaceOf(-1, 1, 0));
    const auto c = differenceAlong(PlaceOf(1, 0, 1));
    const auto d = differenceAlong(PlaceOf(-1, 0, 1));
    const auto e = differenceAlong(PlaceOf(0, 1, 1));
    const auto f = differenceAlong(PlaceOf(0, -1, 1));
    hn::StoreInterleaved4(hn::Mul(eighth, hn::Add(hn::Sub(a, b), hn::Sub(c, d))),
                          hn::Mul(eighth, hn::Add(hn::Add(a, b), hn::Sub(e, f))),
                          hn::Mul(eighth, hn::Add(hn::Add(c, d), hn::Add(e, f))),
                          hn::Zero(tag),
                          tag,
                          gradients + FCCFieldKernels::GradientStride * (i - first));
  }
}

HWY_ATTR void
GradientsOfRow(const float * const * n, const FCCBits::WordType * sites, SizeValueType words, float * gradients)
{
  constexpr SizeValueType block = FCCFieldKernels::Block;
  constexpr SizeValueType stride = FCCFieldKernels::GradientStride;
  alignas(64) float all[block * stride];
  for (SizeValueType first = 0; first < words * FCCBits::WordBits; first += block)
  {
    const FCCBits::WordType wanted =
      sites[first / FCCBits::WordBits] >> (first % FCCBits::WordBits) & ((FCCBits::WordType{ 1 } << block) - 1);
    if (wanted != 0)
    {
      GradientBlock(n, first, all);
      FCCBits::ForEach(wanted, 0, [&](SizeValueType i) HWY_ATTR {
        std::memcpy(gradients, all + stride * i, stride * sizeof(float));
        gradients += stride;
      });
    }
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{
HWY_EXPORT(QuasiInterpolateRow);
HWY_EXPORT(GradientsOfRow);
} // namespace

void
FCCFieldKernels::QuasiInterpolate(const float * values,
                                  const NeighborRows & neighbors,
                                  SizeValueType count,
                                  float * coefficients)
{
  HWY_DYNAMIC_DISPATCH(QuasiInterpolateRow)(values, neighbors.data(), count, coefficients);
}

void
FCCFieldKernels::Gradient(const NeighborRows & neighbors,
                          const std::uint64_t * sites,
                          SizeValueType words,
                          float * gradients)
{
  HWY_DYNAMIC_DISPATCH(GradientsOfRow)(neighbors.data(), sites, words, gradients);
}

} // namespace itk
#endif
