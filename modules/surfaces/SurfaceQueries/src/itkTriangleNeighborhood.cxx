#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkTriangleNeighborhood.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkTriangleNeighborhood.h"

#include <cstring>

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

} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace itk
{

HWY_EXPORT(FindOthersIn);

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

} // namespace itk

#endif
