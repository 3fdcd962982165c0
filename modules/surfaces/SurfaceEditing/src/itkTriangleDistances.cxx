#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkTriangleDistances.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkTriangleDistances.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, FanDistances::MostLanes>;
using Vector = hn::Vec<Doubles>;

HWY_INLINE Vector
Broadcast(double value)
{
  return hn::Set(Doubles(), value);
}

/** The squared distance from a side that begins at 0, without the square of the position.
 * \param product of the position and the side \param squared length of the side \param over its reciprocal */
HWY_INLINE Vector
AlongSide(Vector product, Vector squared, Vector over)
{
  const Vector share = hn::Min(hn::Max(product * over, hn::Zero(Doubles())), Broadcast(1.0));
  return share * (share * squared - (product + product));
}

/** The squared distances from triangles, without the squares of the positions, which are relative to the corner a.
 * \param term (n) the triangles' term n */
template <typename TTerms>
HWY_INLINE Vector
DistanceFrom(const TTerms & term, Vector x, Vector y, Vector z)
{
  using T = TriangleTerms;
  const Vector bb = term(T::BB), bc = term(T::BC), cc = term(T::CC);
  const Vector ofB = term(T::B) * x + term(T::B + 1) * y + term(T::B + 2) * z;
  const Vector ofC = term(T::C) * x + term(T::C + 1) * y + term(T::C + 2) * z;
  const Vector weightOfB = cc * ofB - bc * ofC;
  const Vector weightOfC = bb * ofC - bc * ofB;
  const Vector over = hn::Zero(Doubles()) - (weightOfB * ofB + weightOfC * ofC) * term(T::OverArea);
  const Vector fromOpposite = bb - (ofB + ofB) + AlongSide(ofC - ofB - (bc - bb), term(T::SS), term(T::OverSS));
  const Vector sides =
    hn::Min(hn::Min(AlongSide(ofB, bb, term(T::OverBB)), AlongSide(ofC, cc, term(T::OverCC))), fromOpposite);
  const Vector least = hn::Min(hn::Min(weightOfB, weightOfC), term(T::Area) - weightOfB - weightOfC);
  return hn::IfThenElse(least < hn::Zero(Doubles()), sides, over);
}

/** \param values x, y, z and sheets of \a stride positions, whole vectors
 *  \param nearest gets for each position the number of the nearest triangle, and then the squared distances */
HWY_ATTR void
NearestOfFan(const double * HWY_RESTRICT values,
             std::size_t stride,
             const TriangleTerms * triangles,
             const double * sheets,
             std::size_t count,
             double * HWY_RESTRICT nearest)
{
  const Doubles d;
  for (std::size_t n = 0; n < stride; n += hn::Lanes(d))
  {
    const Vector x = hn::LoadU(d, values + n);
    const Vector y = hn::LoadU(d, values + stride + n);
    const Vector z = hn::LoadU(d, values + 2 * stride + n);
    const Vector sheet = hn::LoadU(d, values + 3 * stride + n);
    Vector least = Broadcast(std::numeric_limits<double>::infinity());
    Vector number = hn::Zero(d);
    for (std::size_t k = 0; k < count; ++k)
    {
      const double * const terms = triangles[k].values.data();
      const auto term = [terms](int which) HWY_ATTR { return Broadcast(terms[which]); };
      const Vector squared = DistanceFrom(term, x, y, z);
      const auto isNearer = hn::And(squared < least, sheet == Broadcast(sheets[k]));
      least = hn::IfThenElse(isNearer, squared, least);
      number = hn::IfThenElse(isNearer, Broadcast(static_cast<double>(k)), number);
    }
    hn::StoreU(number, d, nearest + n);
    hn::StoreU(x * x + y * y + z * z + least, d, nearest + stride + n);
  }
}

/** \param samples x, y and z of whole vectors
 *  \param nearest gets for each sample the number of the nearest point, and then the squared distances */
HWY_ATTR void
NearestOfPoints(const std::array<const double *, 3> & samples,
                std::size_t size,
                const PositionType * points,
                std::size_t count,
                double * HWY_RESTRICT nearest)
{
  const Doubles d;
  for (std::size_t n = 0; n < size; n += hn::Lanes(d))
  {
    const Vector x = hn::LoadU(d, samples[0] + n), y = hn::LoadU(d, samples[1] + n), z = hn::LoadU(d, samples[2] + n);
    Vector least = Broadcast(std::numeric_limits<double>::infinity());
    Vector number = hn::Zero(d);
    for (std::size_t k = 0; k < count; ++k)
    {
      const Vector u = Broadcast(points[k][0]) - x, v = Broadcast(points[k][1]) - y, w = Broadcast(points[k][2]) - z;
      const Vector squared = u * u + v * v + w * w;
      const auto isNearer = squared < least;
      least = hn::IfThenElse(isNearer, squared, least);
      number = hn::IfThenElse(isNearer, Broadcast(static_cast<double>(k)), number);
    }
    hn::StoreU(number, d, nearest + n);
    hn::StoreU(least, d, nearest + size + n);
  }
}

/** The squared distances of a position from the triangles n and behind. \param rows of triangles, whole vectors */
HWY_INLINE Vector
DistancesAt(const double * HWY_RESTRICT rows, std::size_t stride, std::size_t n, const double * position)
{
  const Doubles d;
  const auto row = [=](int which) HWY_ATTR { return hn::LoadU(d, rows + which * stride + n); };
  const auto term = [=](int which) HWY_ATTR { return hn::LoadU(d, rows + (3 + which) * stride + n); };
  const Vector x = Broadcast(position[0]) - row(0);
  const Vector y = Broadcast(position[1]) - row(1);
  const Vector z = Broadcast(position[2]) - row(2);
  return x * x + y * y + z * z + DistanceFrom(term, x, y, z);
}

/** \param rows of triangles, whole vectors \param squared gets the squared distances of a position from them */
HWY_ATTR void
DistancesFromAll(const double * HWY_RESTRICT rows,
                 std::size_t stride,
                 std::size_t count,
                 const double * position,
                 double * HWY_RESTRICT squared)
{
  const Doubles d;
  for (std::size_t n = 0; n < count; n += hn::Lanes(d))
  {
    hn::StoreU(DistancesAt(rows, stride, n, position), d, squared + n);
  }
}

/** As DistancesFromAll(). \param bits gets bit n if triangle n is within a squared distance, for whole vectors */
HWY_ATTR void
WithinOfAll(const double * HWY_RESTRICT rows,
            std::size_t stride,
            std::size_t count,
            const double * position,
            double squaredDistance,
            std::uint64_t * HWY_RESTRICT bits)
{
  const Doubles d;
  for (std::size_t n = 0; n < count; n += hn::Lanes(d))
  {
    const auto isWithin = DistancesAt(rows, stride, n, position) <= Broadcast(squaredDistance);
    std::uint8_t bytes[8]{};
    hn::StoreMaskBits(d, isWithin, bytes);
    bits[n / 64] |= std::uint64_t{ bytes[0] } << n % 64;
  }
}

} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace itk
{

HWY_EXPORT(NearestOfFan);
HWY_EXPORT(NearestOfPoints);
HWY_EXPORT(DistancesFromAll);
HWY_EXPORT(WithinOfAll);

TriangleTerms::TriangleTerms(const PositionType & b, const PositionType & c)
{
  constexpr double leastArea = 1e-12; // relative to the sides
  const PositionType side = Subtract(c, b);
  const double bb = Dot(b, b), bc = Dot(b, c), cc = Dot(c, c), ss = Dot(side, side);
  const double area = bb * cc - bc * bc;
  const bool isFlat = !(area > leastArea * bb * cc);
  const auto reciprocal = [](double squared) { return squared > 0.0 ? 1.0 / squared : 0.0; };
  values = { b[0],
             b[1],
             b[2],
             c[0],
             c[1],
             c[2],
             bb,
             bc,
             cc,
             ss,
             reciprocal(bb),
             reciprocal(cc),
             reciprocal(ss),
             isFlat ? 0.0 : 1.0 / area,
             isFlat ? -1.0 : area };
}

bool
FanDistances::FindNearest(double squaredDistance, std::vector<std::uint16_t> & numbers)
{
  if (m_Triangles.size() > MostTriangles)
  {
    return false;
  }
  m_Nearest.resize(2 * m_Stride);
  HWY_DYNAMIC_DISPATCH(NearestOfFan)
  (m_Values.data(), m_Stride, m_Triangles.data(), m_Sheets.data(), m_Triangles.size(), m_Nearest.data());
  numbers.resize(m_Size);
  bool areNear = true;
  for (std::size_t n = 0; n < m_Size; ++n)
  {
    numbers[n] = static_cast<std::uint16_t>(m_Nearest[n]);
    areNear = areNear && m_Nearest[m_Stride + n] <= squaredDistance;
  }
  return areNear;
}

void
NearestPoints::Find()
{
  constexpr std::size_t lanes = FanDistances::MostLanes;
  const std::size_t size = (m_Samples[0].size() + lanes - 1) / lanes * lanes;
  for (auto & row : m_Samples)
  {
    row.resize(size);
  }
  m_Nearest.resize(2 * size);
  HWY_DYNAMIC_DISPATCH(NearestOfPoints)
  ({ m_Samples[0].data(), m_Samples[1].data(), m_Samples[2].data() },
   size,
   m_Points.data(),
   m_Points.size(),
   m_Nearest.data());
}

bool
NearbyTriangles::Add(std::uint32_t triangle, const CornersType & corners)
{
  if (m_Size == Capacity)
  {
    return false;
  }
  const auto & [a, b, c] = corners;
  const TriangleTerms terms(Subtract(b, a), Subtract(c, a));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Rows[axis * Capacity + m_Size] = a[axis];
  }
  for (std::size_t term = 0; term < terms.values.size(); ++term)
  {
    m_Rows[(3 + term) * Capacity + m_Size] = terms.values[term];
  }
  m_Triangles[m_Size++] = triangle;
  return true;
}

NearbyTriangles::Nearest
NearbyTriangles::FindNearest(const PositionType & position) const
{
  std::array<double, Capacity> squared;
  HWY_DYNAMIC_DISPATCH(DistancesFromAll)(m_Rows.data(), Capacity, m_Size, position.data(), squared.data());
  const double * const least = std::min_element(squared.data(), squared.data() + m_Size);
  return { m_Triangles[least - squared.data()], *least };
}

NearbyTriangles::Some
NearbyTriangles::FindWithin(double squaredDistance, const PositionType & position) const
{
  std::array<std::uint64_t, 2> bits{};
  HWY_DYNAMIC_DISPATCH(WithinOfAll)
  (m_Rows.data(), Capacity, m_Size, position.data(), squaredDistance, bits.data());
  const std::size_t last = (m_Size + 63) / 64 - 1; // behind the last triangle there is anything
  bits[last] &= ~std::uint64_t{ 0 } >> (64 * (last + 1) - m_Size);
  return Some(bits[0]) | Some(bits[1]) << 64;
}

} // namespace itk

#endif
