#include "detail/itkFCCMirror.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCLattice.h"
#include "itkRowRing.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

/** A symmetric factor: its weights from the middle on, and its sums (see FCCGaussianTaps). */
struct HalfFactor
{
  std::vector<double> weights;
  double secondMoment = 0.0;      // m
  double alternatingSum = 0.0;    // A
  double alternatingMoment = 0.0; // B
};

/** The sampled Gaussian in which weights fall by \a decay = exp(-1 / 2q) from the middle to the first step. */
HalfFactor
SampleGaussian(double decay, OffsetValueType reach)
{
  HalfFactor factor;
  double sum = 0.0;
  for (OffsetValueType n = 0; n <= reach; ++n)
  {
    const auto square = static_cast<double>(n * n);
    factor.weights.push_back(std::pow(decay, square));
    const double both = (n == 0 ? 1.0 : 2.0) * factor.weights.back();
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    sum += both;
    factor.secondMoment += square * both;
    factor.alternatingSum += sign * both;
    factor.alternatingMoment += sign * square * both;
  }
  for (double * const value : { &factor.secondMoment, &factor.alternatingSum, &factor.alternatingMoment })
  {
    *value /= sum;
  }
  for (double & weight : factor.weights)
  {
    weight /= sum;
  }
  return factor;
}

/** The sampled Gaussian with the given second moment, which grows with the decay. */
HalfFactor
FindGaussian(double secondMoment, OffsetValueType reach)
{
  double low = 0.0;
  double high = 1.0;
  for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high))
  {
    (SampleGaussian(middle, reach).secondMoment < secondMoment ? low : high) = middle;
  }
  return SampleGaussian(low, reach);
}

/** The factors whose product has the given variances on the lattice, by damped fixed-point iteration. Damping is needed
 * because with small variances along one axis alone, moments on the lattice grow with the fourth power of the factor's.
 */
std::array<HalfFactor, 3>
FindFactors(const std::array<double, 3> & variances, const std::array<OffsetValueType, 3> & reach)
{
  constexpr unsigned int mostRounds = 1000;
  constexpr double tolerance = 1e-10;
  constexpr double damping = 0.25;
  std::array<HalfFactor, 3> factors;
  std::array<double, 3> moments = variances;
  double worst = 1.0;
  for (unsigned int round = 0; round < mostRounds && worst > tolerance; ++round)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      factors[axis] = FindGaussian(moments[axis], reach[axis]);
    }
    worst = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double others = factors[(axis + 1) % 3].alternatingSum * factors[(axis + 2) % 3].alternatingSum;
      const double onLattice = (factors[axis].secondMoment + factors[axis].alternatingMoment * others) /
                               (1.0 + factors[axis].alternatingSum * others);
      if (variances[axis] > 0.0)
      {
        worst = std::max(worst, std::abs(onLattice / variances[axis] - 1.0));
        moments[axis] *= std::pow(variances[axis] / onLattice, damping);
      }
    }
  }
  return factors;
}

/** The Gaussian's three passes over the rows of one region.
 *
 * Lattice points are the sites and the points between them. The product of the factors is summed over the sites alone,
 * whose three steps have an even sum; so each pass keeps apart the sums over even and over odd steps. */
class GaussianPasses
{
public:
  GaussianPasses(const FCCGaussianTaps & taps,
                 const ImageRegion<3> & whole,
                 const ImageRegion<3> & region,
                 const LoadRow & load)
    : m_Taps(taps)
    , m_Load(load)
    , m_Whole(whole)
    , m_Region(region)
    , m_Wider(taps.AddReach(region, whole))
    , m_Length(m_Wider.GetSize(0))
    , m_Stride(RowArithmetic::PaddedLength(m_Length))
    , m_Margin(static_cast<SizeValueType>(taps.GetReach(0) / 2 + 1))
    , m_PlaneCount(std::min<SizeValueType>(2 * taps.GetReach(2) + 1, whole.GetSize(2)))
    , m_BlockSize(RowsPerBlock(2 * m_PlaneCount * m_Stride, region.GetSize(1)))
    , m_InputRows(std::min<SizeValueType>(2 * taps.GetReach(1) + 1, whole.GetSize(1)), m_Stride)
    , m_Slabs(m_PlaneCount, 2 * m_BlockSize * m_Stride)
    , m_Values(RowArithmetic::PaddedLength(region.GetSize(0)))
  {
    for (auto & line : m_Lines)
    {
      line.resize(RowArithmetic::PaddedLength(m_Length + 2 * m_Margin));
    }
  }

  /** Smooths all rows, in blocks along y. */
  void
  Smooth(const StoreRow & store)
  {
    const auto end = m_Region.GetIndex() + m_Region.GetSize();
    const auto blockSize = static_cast<IndexValueType>(m_BlockSize);
    for (m_BlockBegin = m_Region.GetIndex(1); m_BlockBegin < end[1]; m_BlockBegin += blockSize)
    {
      m_BlockEnd = std::min(m_BlockBegin + blockSize, end[1]);
      m_Slabs.Restart();
      for (IndexValueType k = m_Region.GetIndex(2); k < end[2]; ++k)
      {
        this->AdvanceTo(2, k, m_Slabs, [this](IndexValueType plane, float *) { this->BlendAlongY(plane); });
        for (IndexValueType j = m_BlockBegin; j < m_BlockEnd; ++j)
        {
          const auto parity = static_cast<unsigned int>(FCCLattice::Parity(j, k));
          for (unsigned int between = 0; between < 2; ++between)
          {
            this->BlendAlongZ(j, k, between);
            this->MirrorEnds(parity, between);
          }
          this->BlendAlongX(parity);
          store({ { m_Region.GetIndex(0), j, k } }, m_Region.GetSize(0), m_Values.data());
        }
      }
    }
  }

private:
  /** Fills a ring along an axis with all rows or planes within reach of an index of the region. */
  template <typename TMake>
  void
  AdvanceTo(unsigned int axis, IndexValueType index, RowRing & ring, const TMake & make)
  {
    const IndexValueType reach = m_Taps.GetReach(axis);
    const IndexValueType begin = m_Wider.GetIndex(axis);
    const IndexValueType end = begin + static_cast<IndexValueType>(m_Wider.GetSize(axis));
    ring.Advance(this->NumberOf(axis, std::max(begin, index - reach)),
                 this->NumberOf(axis, std::min(index + reach + 1, end)),
                 [&](SizeValueType number, float * row) {
                   make(m_Whole.GetIndex(axis) + static_cast<IndexValueType>(number), row);
                 });
  }

  /** Rows and planes are numbered from the image's first row or plane. */
  SizeValueType
  NumberOf(unsigned int axis, IndexValueType index) const
  {
    return static_cast<SizeValueType>(index - m_Whole.GetIndex(axis));
  }

  /** The row or plane that stands for a row or plane beyond the image's ends. */
  SizeValueType
  MirroredNumberOf(unsigned int axis, IndexValueType index) const
  {
    return this->NumberOf(axis, MirrorIntoRange(index, m_Whole.GetIndex(axis), m_Whole.GetUpperIndex()[axis]));
  }

  /** Blends of row j of a plane along y: over the even steps (0) or over the odd steps (1). */
  float *
  GetSlabRow(unsigned int oddSteps, IndexValueType j, SizeValueType plane)
  {
    return m_Slabs.GetRow(plane) + (oddSteps * m_BlockSize + static_cast<SizeValueType>(j - m_BlockBegin)) * m_Stride;
  }

  template <typename TRowAt>
  void
  AddTerms(const FCCGaussianTaps::Factor & factor, const TRowAt & rowAt)
  {
    for (std::size_t n = 0; n < factor.steps.size(); ++n)
    {
      m_Terms.push_back(rowAt(factor.steps[n]));
      m_Weights.push_back(factor.weights[n]);
    }
  }

  void
  BlendTerms(SizeValueType length, float * blend)
  {
    RowArithmetic::Blend(m_Terms.data(), m_Weights.data(), m_Terms.size(), length, blend);
    m_Terms.clear();
    m_Weights.clear();
  }

  /** Makes the slab of plane \a k: its rows in the block, blended along y. */
  void
  BlendAlongY(IndexValueType k)
  {
    m_InputRows.Restart();
    for (IndexValueType j = m_BlockBegin; j < m_BlockEnd; ++j)
    {
      this->AdvanceTo(1, j, m_InputRows, [&](IndexValueType inputRow, float * row) {
        m_Load({ { m_Wider.GetIndex(0), inputRow, k } }, m_Length, row);
      });
      for (unsigned int oddSteps = 0; oddSteps < 2; ++oddSteps)
      {
        this->AddTerms(m_Taps.GetFactor(1, oddSteps),
                       [&](OffsetValueType step) { return m_InputRows.GetRow(this->MirroredNumberOf(1, j + step)); });
        this->BlendTerms(m_Length, this->GetSlabRow(oddSteps, j, this->NumberOf(2, k)));
      }
    }
  }

  /** Makes the line of row (j, k) from the slabs: at its sites (0), or at the points between them (1). */
  void
  BlendAlongZ(IndexValueType j, IndexValueType k, unsigned int between)
  {
    for (unsigned int oddSteps = 0; oddSteps < 2; ++oddSteps)
    {
      this->AddTerms(m_Taps.GetFactor(2, oddSteps), [&](OffsetValueType step) {
        return this->GetSlabRow(oddSteps ^ between, j, this->MirroredNumberOf(2, k + step));
      });
    }
    this->BlendTerms(m_Length, m_Lines[between].data() + m_Margin);
  }

  /** Continues a line beyond the ends of the image by its mirror image. \a parity is that of the row's sites. */
  void
  MirrorEnds(unsigned int parity, unsigned int between)
  {
    std::vector<float> & points = m_Lines[between];
    const IndexValueType pointParity = parity ^ between;
    const IndexValueType first = m_Wider.GetIndex(0);
    const IndexValueType end = first + static_cast<IndexValueType>(m_Length);
    const IndexValueType wholeFirst = m_Whole.GetIndex(0);
    const IndexValueType wholeLast = m_Whole.GetUpperIndex()[0];
    const auto mirror = [&](IndexValueType i) {
      const IndexValueType x = MirrorIntoRange(2 * i + pointParity, 2 * wholeFirst, 2 * wholeLast + 1);
      return static_cast<SizeValueType>((x - pointParity) / 2 - first) + m_Margin;
    };
    for (SizeValueType n = 0; n < m_Margin; ++n)
    {
      const auto step = static_cast<IndexValueType>(n);
      if (first == wholeFirst)
      {
        points[m_Margin - 1 - n] = points[mirror(first - 1 - step)];
      }
      if (end == wholeLast + 1)
      {
        points[m_Margin + m_Length + n] = points[mirror(end + step)];
      }
    }
  }

  /** Makes the values of a row from its two lines. */
  void
  BlendAlongX(unsigned int parity)
  {
    for (unsigned int between = 0; between < 2; ++between)
    {
      const OffsetValueType shift =
        static_cast<OffsetValueType>(parity) - static_cast<OffsetValueType>(parity ^ between);
      const float * const points = m_Lines[between].data() + m_Margin + (m_Region.GetIndex(0) - m_Wider.GetIndex(0));
      this->AddTerms(m_Taps.GetFactor(0, between), [&](OffsetValueType step) { return points + (step + shift) / 2; });
    }
    this->BlendTerms(m_Region.GetSize(0), m_Values.data());
  }

  const FCCGaussianTaps & m_Taps;
  const LoadRow & m_Load;
  ImageRegion<3> m_Whole;
  ImageRegion<3> m_Region;
  ImageRegion<3> m_Wider;     // the region and all within reach of it, in the image
  SizeValueType m_Length;     // length of its rows
  SizeValueType m_Stride;     // between rows, in floats
  SizeValueType m_Margin;     // points of a line beyond each end of its row
  SizeValueType m_PlaneCount; // within reach
  SizeValueType m_BlockSize;  // rows of a block
  IndexValueType m_BlockBegin = 0;
  IndexValueType m_BlockEnd = 0;
  RowRing m_InputRows;
  RowRing m_Slabs;
  std::vector<float> m_Lines[2];
  std::vector<float> m_Values;
  std::vector<const float *> m_Terms;
  std::vector<float> m_Weights;
};

} // namespace

FCCGaussianTaps::FCCGaussianTaps(const std::array<double, 3> & variances)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // A step along one axis alone is of two units.
    const auto reach = static_cast<OffsetValueType>(std::ceil(4.0 * std::sqrt(variances[axis])));
    m_Reach[axis] = variances[axis] > 0.0 ? std::max<OffsetValueType>(2, reach) : 1;
  }
  const auto factors = FindFactors(variances, m_Reach);
  const double sum = 0.5 * (1.0 + factors[0].alternatingSum * factors[1].alternatingSum * factors[2].alternatingSum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double scale = axis == 0 ? 1.0 / sum : 1.0;
    for (OffsetValueType step = -m_Reach[axis]; step <= m_Reach[axis]; ++step)
    {
      const auto distance = static_cast<std::size_t>(std::abs(step));
      Factor & factor = m_Factors[axis][distance % 2];
      factor.steps.push_back(step);
      factor.weights.push_back(static_cast<float>(scale * factors[axis].weights[distance]));
    }
  }
}

ImageRegion<3>
FCCGaussianTaps::AddReach(const ImageRegion<3> & region, const ImageRegion<3> & whole) const
{
  ImageRegion<3> wider = region;
  wider.PadByRadius({ { static_cast<SizeValueType>(m_Reach[0] / 2 + 1),
                        static_cast<SizeValueType>(m_Reach[1]),
                        static_cast<SizeValueType>(m_Reach[2]) } });
  wider.Crop(whole);
  return wider;
}

void
SmoothRows(const FCCGaussianTaps & taps,
           const ImageRegion<3> & whole,
           const ImageRegion<3> & region,
           const LoadRow & load,
           const StoreRow & store)
{
  GaussianPasses(taps, whole, region, load).Smooth(store);
}

} // namespace itk
