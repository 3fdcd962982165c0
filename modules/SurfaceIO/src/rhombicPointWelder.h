#ifndef rhombicPointWelder_h
#define rhombicPointWelder_h

#include "itkTriangleSurface.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace rhombic
{

/** \class PointWelder
 * \brief Numbers points by position: the same number for the same three floats, 0 and -0 taken for one.
 *
 * A hash table with open addressing, 4 bytes a place, two to four places a point. */
class PointWelder
{
public:
  using PointType = itk::TriangleSurface::PointType;
  using PointsContainer = itk::TriangleSurface::PointsContainer;

  /** New points are added at the end of \a points, which nobody else changes meanwhile. */
  explicit PointWelder(PointsContainer & points)
    : m_Points(points)
    , m_Places(1024, Empty)
  {}

  std::uint32_t
  Add(const PointType & point)
  {
    std::uint32_t & place = this->Find(point);
    if (place != Empty)
    {
      return place;
    }
    const auto number = static_cast<std::uint32_t>(m_Points.size());
    place = number;
    m_Points.push_back(point);
    if (2 * m_Points.size() > m_Places.size())
    {
      this->Grow();
    }
    return number;
  }

private:
  static constexpr std::uint32_t Empty = std::numeric_limits<std::uint32_t>::max();

  using Bits = std::array<std::uint32_t, 3>;

  static Bits
  BitsOf(const PointType & point)
  {
    const PointType positive{ point[0] + 0.0f, point[1] + 0.0f, point[2] + 0.0f }; // -0 becomes 0
    Bits bits;
    std::memcpy(bits.data(), positive.data(), sizeof(bits));
    return bits;
  }

  /** The place of the point, or where it belongs. */
  std::uint32_t &
  Find(const PointType & point)
  {
    const Bits bits = BitsOf(point);
    std::uint64_t hash = (std::uint64_t{ bits[0] } << 32 | bits[1]) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 32 ^ bits[2]) * 0xd6e8feb86659fd93u;
    std::size_t place = (hash ^ hash >> 32) & (m_Places.size() - 1);
    while (m_Places[place] != Empty && BitsOf(m_Points[m_Places[place]]) != bits)
    {
      place = (place + 1) & (m_Places.size() - 1);
    }
    return m_Places[place];
  }

  void
  Grow()
  {
    m_Places.assign(2 * m_Places.size(), Empty);
    for (std::size_t number = 0; number < m_Points.size(); ++number)
    {
      this->Find(m_Points[number]) = static_cast<std::uint32_t>(number);
    }
  }

  PointsContainer & m_Points;
  std::vector<std::uint32_t> m_Places; ///< a power of two
};

} // namespace rhombic

#endif
