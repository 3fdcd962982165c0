#ifndef rhombicPointWelder_h
#define rhombicPointWelder_h

#include "itkTriangleSurface.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace rhombic
{

/** \class PointWelder
 * \brief Gives equal points the same index; 0 and -0 are equal.
 *
 * A hash table with open addressing: 4 bytes per slot, two to four slots per point, or per expected point. */
class PointWelder
{
public:
  using PointType = itk::TriangleSurface::PointType;
  using PointsContainer = itk::TriangleSurface::PointsContainer;

  /** Appends new points to \a points, which must not be changed otherwise. The table need not grow up to so many
   * \a expected points. */
  explicit PointWelder(PointsContainer & points, std::size_t expected = 0)
    : m_Points(points)
    , m_Slots(FindNumberOfSlots(expected), Empty)
  {}

  /** The index of the point, which is appended if it is new. */
  std::uint32_t
  Add(const PointType & point)
  {
    std::uint32_t & slot = this->Find(point);
    if (slot != Empty)
    {
      return slot;
    }
    const auto index = static_cast<std::uint32_t>(m_Points.size());
    slot = index;
    m_Points.push_back(point);
    if (2 * m_Points.size() > m_Slots.size())
    {
      this->Grow();
    }
    return index;
  }

private:
  static constexpr std::uint32_t Empty = std::numeric_limits<std::uint32_t>::max();

  static std::size_t
  FindNumberOfSlots(std::size_t points)
  {
    std::size_t slots = 1024;
    while (slots < 2 * points)
    {
      slots *= 2;
    }
    return slots;
  }

  using Bits = std::array<std::uint32_t, 3>;

  static Bits
  BitsOf(const PointType & point)
  {
    const PointType positive{ point[0] + 0.0f, point[1] + 0.0f, point[2] + 0.0f }; // -0 becomes 0
    Bits bits;
    std::memcpy(bits.data(), positive.data(), sizeof(bits));
    return bits;
  }

  /** The slot of the point, or the empty slot for it. */
  std::uint32_t &
  Find(const PointType & point)
  {
    const Bits bits = BitsOf(point);
    std::uint64_t hash = (std::uint64_t{ bits[0] } << 32 | bits[1]) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 32 ^ bits[2]) * 0xd6e8feb86659fd93u;
    std::size_t slot = (hash ^ hash >> 32) & (m_Slots.size() - 1);
    while (m_Slots[slot] != Empty && BitsOf(m_Points[m_Slots[slot]]) != bits)
    {
      slot = (slot + 1) & (m_Slots.size() - 1);
    }
    return m_Slots[slot];
  }

  void
  Grow()
  {
    m_Slots.assign(2 * m_Slots.size(), Empty);
    for (std::size_t index = 0; index < m_Points.size(); ++index)
    {
      this->Find(m_Points[index]) = static_cast<std::uint32_t>(index);
    }
  }

  PointsContainer & m_Points;
  itk::BulkVector<std::uint32_t> m_Slots; ///< indices of points; the size is a power of two
};

} // namespace rhombic

#endif
