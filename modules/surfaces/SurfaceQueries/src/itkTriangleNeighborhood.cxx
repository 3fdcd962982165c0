#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkTriangleNeighborhood.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkTriangleNeighborhood.h"

#include <algorithm>
#include <cstring>

#ifndef itkTriangleNeighborhood_once
#define itkTriangleNeighborhood_once
namespace itk
{

/** Some pairs of triangles: the coordinates and numbers of their corners, row by row. */
struct TrianglePairs
{
  static constexpr std::size_t Capacity = 16;

  float corners[2][3][3][Capacity]; ///< of both triangles, three each, three coordinates
  std::uint32_t ids[2][3][Capacity];
};

} // namespace itk
#endif

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

/** Finds the boxes behind number n of \a size that overlap it and whose corners are none of \a own.
 * \param sides, corners rows of TriangleNeighborhood
 * \param others gets the numbers of what is found; returns how many */
HWY_ATTR std::size_t
FindOthersIn(const std::int16_t * const * sides,
             const std::uint32_t * const * corners,
             const std::uint32_t * own,
             std::size_t n,
             std::size_t size,
             std::uint32_t * HWY_RESTRICT others)
{
  const hn::ScalableTag<std::int16_t> steps;
  const hn::Repartition<std::uint32_t, decltype(steps)> ids;
  const std::size_t lanes = hn::Lanes(steps);
  const auto lowX = hn::Set(steps, sides[0][n]), lowY = hn::Set(steps, sides[1][n]), lowZ = hn::Set(steps, sides[2][n]);
  const auto highX = hn::Set(steps, sides[3][n]), highY = hn::Set(steps, sides[4][n]),
             highZ = hn::Set(steps, sides[5][n]);
  const auto a = hn::Set(ids, own[0]), b = hn::Set(ids, own[1]), c = hn::Set(ids, own[2]);
  std::size_t count = 0;
  for (std::size_t begin = n + 1; begin < size; begin += lanes)
  {
    const auto side = [=](int which) HWY_ATTR { return hn::LoadU(steps, sides[which] + begin); };
    const auto isApart =
      hn::Or(hn::Or(hn::Or(side(0) > highX, lowX > side(3)), hn::Or(side(1) > highY, lowY > side(4))),
             hn::Or(side(2) > highZ, lowZ > side(5)));
    std::uint64_t bits = 0;
    std::uint8_t bytes[8]{};
    hn::StoreMaskBits(steps, hn::Not(isApart), bytes);
    std::memcpy(&bits, bytes, sizeof(bits));
    const std::size_t left = size - begin;
    bits &= left < lanes ? (std::uint64_t{ 1 } << left) - 1 : ~std::uint64_t{ 0 };
    for (std::size_t part = 0; part < lanes && bits != 0; part += hn::Lanes(ids))
    {
      const auto isOwn = [=](int which) HWY_ATTR {
        const auto corner = hn::LoadU(ids, corners[which] + begin + part);
        return hn::Or(hn::Or(corner == a, corner == b), corner == c);
      };
      std::uint64_t shared = 0;
      std::uint8_t sharedBytes[8]{};
      hn::StoreMaskBits(ids, hn::Or(hn::Or(isOwn(0), isOwn(1)), isOwn(2)), sharedBytes);
      std::memcpy(&shared, sharedBytes, sizeof(shared));
      bits &= ~(shared << part);
    }
    for (; bits != 0; bits &= bits - 1)
    {
      others[count++] = static_cast<std::uint32_t>(begin + static_cast<std::size_t>(__builtin_ctzll(bits)));
    }
  }
  return count;
}

/** One bit for each pair: are all corners of triangle \a other that the other of the pair lacks certain to lie on one
 * side of its plane? Differences of coordinates are rounded once, so that the bound of rounding is that of products of
 * three of them. */
HWY_ATTR std::uint32_t
FindBesidePlanes(const TrianglePairs & pairs, unsigned int other)
{
  constexpr float roundingOfProduct = 5e-6f; // over the product of the vectors' lengths; generous
  constexpr float leastProduct = 1e-36f;     // what is lost of smaller ones is less
  const hn::CappedTag<float, TrianglePairs::Capacity> numbers;
  const hn::RebindToUnsigned<decltype(numbers)> ids;
  using Numbers = hn::Vec<decltype(numbers)>;
  const auto & plane = pairs.corners[1 - other];
  const auto zero = hn::Zero(numbers);
  const auto least = hn::Set(numbers, leastProduct);
  std::uint32_t found = 0;
  for (std::size_t first = 0; first < TrianglePairs::Capacity; first += hn::Lanes(numbers))
  {
    const auto offset = [&](const float(&corner)[3][TrianglePairs::Capacity], unsigned int axis) HWY_ATTR {
      return hn::Sub(hn::Load(numbers, corner[axis] + first), hn::Load(numbers, plane[0][axis] + first));
    };
    const auto sumOf = [](Numbers x, Numbers y, Numbers z)
                         HWY_ATTR { return hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)); };
    const auto ux = offset(plane[1], 0), uy = offset(plane[1], 1), uz = offset(plane[1], 2);
    const auto vx = offset(plane[2], 0), vy = offset(plane[2], 1), vz = offset(plane[2], 2);
    const auto nx = hn::Sub(hn::Mul(uy, vz), hn::Mul(uz, vy));
    const auto ny = hn::Sub(hn::Mul(uz, vx), hn::Mul(ux, vz));
    const auto nz = hn::Sub(hn::Mul(ux, vy), hn::Mul(uy, vx));
    const auto rounding =
      hn::Add(hn::Mul(hn::Set(numbers, roundingOfProduct), hn::Mul(sumOf(ux, uy, uz), sumOf(vx, vy, vz))), least);
    auto areAbove = hn::Eq(zero, zero);
    auto areBelow = areAbove;
    for (unsigned int n = 0; n < 3; ++n)
    {
      const auto id = hn::Load(ids, pairs.ids[other][n] + first);
      const auto isCorner = [&](unsigned int corner)
                              HWY_ATTR { return hn::Eq(id, hn::Load(ids, pairs.ids[1 - other][corner] + first)); };
      const auto isShared = hn::RebindMask(numbers, hn::Or(hn::Or(isCorner(0), isCorner(1)), isCorner(2)));
      const auto & corner = pairs.corners[other][n];
      const auto x = offset(corner, 0), y = offset(corner, 1), z = offset(corner, 2);
      const auto height = hn::Add(hn::Add(hn::Mul(nx, x), hn::Mul(ny, y)), hn::Mul(nz, z));
      const auto bound = hn::Add(hn::Mul(rounding, sumOf(x, y, z)), least);
      areAbove = hn::And(areAbove, hn::Or(isShared, hn::Gt(height, bound))); // neither where one is no number
      areBelow = hn::And(areBelow, hn::Or(isShared, hn::Lt(height, hn::Neg(bound))));
    }
    std::uint32_t bits = 0;
    std::uint8_t bytes[8]{};
    hn::StoreMaskBits(numbers, hn::Xor(areAbove, areBelow), bytes); // both where all corners are shared
    std::memcpy(&bits, bytes, sizeof(bits));
    found |= bits << first;
  }
  return found;
}

} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace itk
{

HWY_EXPORT(FindOthersIn);
HWY_EXPORT(FindBesidePlanes);

void
TriangleNeighborhood::Add(std::uint32_t triangle, const StepBox & box, const TriangleType & unfolded)
{
  constexpr std::size_t mostLanes = 64; // read behind the last triangle
  if (m_Size + mostLanes > m_Ids.size())
  {
    const std::size_t room = 2 * m_Ids.size() + 4 * mostLanes;
    m_Ids.resize(room);
    for (auto & row : m_Sides)
    {
      row.resize(room);
    }
    for (auto & row : m_Corners)
    {
      row.resize(room);
    }
  }
  m_Ids[m_Size] = triangle;
  for (std::size_t side = 0; side < box.size(); ++side)
  {
    m_Sides[side][m_Size] = box[side];
  }
  for (std::size_t n = 0; n < unfolded.size(); ++n)
  {
    m_Corners[n][m_Size] = unfolded[n];
  }
  ++m_Size;
}

std::size_t
TriangleNeighborhood::FindOthers(std::size_t n)
{
  const std::array<const std::int16_t *, 6> sides{ m_Sides[0].data(), m_Sides[1].data(), m_Sides[2].data(),
                                                   m_Sides[3].data(), m_Sides[4].data(), m_Sides[5].data() };
  const std::array<const std::uint32_t *, 3> corners{ m_Corners[0].data(), m_Corners[1].data(), m_Corners[2].data() };
  return HWY_DYNAMIC_DISPATCH(FindOthersIn)(
    sides.data(), corners.data(), m_Triangles[m_Ids[n]].data(), n, m_Size, m_Others.data());
}

void
TriangleNeighborhood::KeepMeetingPairs()
{
  alignas(64) TrianglePairs pairs{};
  std::size_t kept = 0;
  for (std::size_t first = 0; first < m_Pairs.size(); first += TrianglePairs::Capacity)
  {
    const std::size_t count = std::min(TrianglePairs::Capacity, m_Pairs.size() - first);
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::uint32_t both[] = { m_Pairs[first + n].first, m_Pairs[first + n].second };
      for (unsigned int which = 0; which < 2; ++which)
      {
        for (unsigned int corner = 0; corner < 3; ++corner)
        {
          const std::uint32_t point = m_Triangles[both[which]][corner];
          pairs.ids[which][corner][n] = point;
          for (unsigned int axis = 0; axis < 3; ++axis)
          {
            pairs.corners[which][corner][axis][n] = m_Points[point][axis];
          }
        }
      }
    }
    const std::uint32_t areParted =
      HWY_DYNAMIC_DISPATCH(FindBesidePlanes)(pairs, 0) | HWY_DYNAMIC_DISPATCH(FindBesidePlanes)(pairs, 1);
    for (std::size_t n = 0; n < count; ++n)
    {
      m_Pairs[kept] = m_Pairs[first + n];
      kept += areParted >> n & 1 ? 0 : 1;
    }
  }
  m_Pairs.resize(kept);
}

} // namespace itk

#endif
