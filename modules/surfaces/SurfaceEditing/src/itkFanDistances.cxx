#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFanDistances.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFanDistances.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Doubles>;

HWY_INLINE Vector
Broadcast(double value)
{
  return hn::Set(Doubles(), value);
}

/** The squared distance from a side that begins at 0, without the square of the position.
 * \param product of the position and the side \param squared length of the side \param over its reciprocal */
HWY_INLINE Vector
AlongSide(Vector product, double squared, double over)
{
  const Vector share = hn::Min(hn::Max(product * Broadcast(over), hn::Zero(Doubles())), Broadcast(1.0));
  return share * (share * Broadcast(squared) - (product + product));
}

/** The squared distances from a triangle, without the squares of the positions. */
HWY_INLINE Vector
DistanceFrom(const FanDistances::Triangle & triangle, Vector x, Vector y, Vector z)
{
  const auto & [b, c, bb, bc, cc, ss, overBB, overCC, overSS, overArea, area, sheet] = triangle;
  const Vector ofB = Broadcast(b[0]) * x + Broadcast(b[1]) * y + Broadcast(b[2]) * z;
  const Vector ofC = Broadcast(c[0]) * x + Broadcast(c[1]) * y + Broadcast(c[2]) * z;
  const Vector weightOfB = Broadcast(cc) * ofB - Broadcast(bc) * ofC;
  const Vector weightOfC = Broadcast(bb) * ofC - Broadcast(bc) * ofB;
  const Vector over = (weightOfB * ofB + weightOfC * ofC) * Broadcast(-overArea);
  const Vector fromOpposite = Broadcast(bb) - (ofB + ofB) + AlongSide(ofC - ofB - Broadcast(bc - bb), ss, overSS);
  const Vector sides = hn::Min(hn::Min(AlongSide(ofB, bb, overBB), AlongSide(ofC, cc, overCC)), fromOpposite);
  const Vector least = hn::Min(hn::Min(weightOfB, weightOfC), Broadcast(area) - weightOfB - weightOfC);
  return hn::IfThenElse(least < hn::Zero(Doubles()), sides, over);
}

/** \param values x, y, z and sheets of \a stride positions, whole vectors
 *  \param nearest gets for each position the number of the nearest triangle, and then the squared distances */
HWY_ATTR void
FindNearest(const double * HWY_RESTRICT values,
            std::size_t stride,
            const FanDistances::Triangle * triangles,
            std::size_t count,
            double * HWY_RESTRICT nearest)
{
  const Doubles d;
  const Vector infinity = Broadcast(std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < stride; n += hn::Lanes(d))
  {
    const Vector x = hn::LoadU(d, values + n);
    const Vector y = hn::LoadU(d, values + stride + n);
    const Vector z = hn::LoadU(d, values + 2 * stride + n);
    const Vector sheet = hn::LoadU(d, values + 3 * stride + n);
    Vector least = infinity;
    Vector number = hn::Zero(d);
    for (std::size_t k = 0; k < count; ++k)
    {
      const Vector squared = DistanceFrom(triangles[k], x, y, z);
      const auto isNearer = hn::And(squared < least, sheet == Broadcast(triangles[k].sheet));
      least = hn::IfThenElse(isNearer, squared, least);
      number = hn::IfThenElse(isNearer, Broadcast(static_cast<double>(k)), number);
    }
    hn::StoreU(number, d, nearest + n);
    hn::StoreU(x * x + y * y + z * z + least, d, nearest + stride + n);
  }
}

} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace itk
{

HWY_EXPORT(FindNearest);

void
FanDistances::AddTriangle(const PositionType & b, const PositionType & c, std::uint32_t sheet)
{
  constexpr double leastArea = 1e-12; // relative to the sides
  const PositionType side = Subtract(c, b);
  const double bb = Dot(b, b), bc = Dot(b, c), cc = Dot(c, c), ss = Dot(side, side);
  const double area = bb * cc - bc * bc;
  const bool isFlat = !(area > leastArea * bb * cc);
  const auto reciprocal = [](double squared) { return squared > 0.0 ? 1.0 / squared : 0.0; };
  m_Triangles.push_back({ b,
                          c,
                          bb,
                          bc,
                          cc,
                          ss,
                          reciprocal(bb),
                          reciprocal(cc),
                          reciprocal(ss),
                          isFlat ? 0.0 : 1.0 / area,
                          isFlat ? -1.0 : area,
                          static_cast<double>(sheet) });
}

bool
FanDistances::FindNearest(double squaredDistance, std::vector<std::uint16_t> & numbers)
{
  m_Nearest.resize(2 * m_Stride);
  HWY_DYNAMIC_DISPATCH(FindNearest)
  (m_Values.data(), m_Stride, m_Triangles.data(), m_Triangles.size(), m_Nearest.data());
  numbers.resize(m_Size);
  bool areNear = true;
  for (std::size_t n = 0; n < m_Size; ++n)
  {
    numbers[n] = static_cast<std::uint16_t>(m_Nearest[n]);
    areNear = areNear && m_Nearest[m_Stride + n] <= squaredDistance;
  }
  return areNear;
}

} // namespace itk

#endif
