#ifndef itkDisjointSets_h
#define itkDisjointSets_h

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace itk
{

/** \class DisjointSets
 * \brief Items from 0 on, each in a set of its own at first, whose sets are joined one by one. */
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : m_Parent(size)
  {
    std::iota(m_Parent.begin(), m_Parent.end(), 0u);
  }

  /** The smallest item of the set. */
  std::uint32_t
  Find(std::uint32_t item)
  {
    while (m_Parent[item] != item)
    {
      m_Parent[item] = m_Parent[m_Parent[item]];
      item = m_Parent[item];
    }
    return item;
  }

  void
  Join(std::uint32_t a, std::uint32_t b)
  {
    const std::uint32_t firstOfA = Find(a);
    const std::uint32_t firstOfB = Find(b);
    m_Parent[std::max(firstOfA, firstOfB)] = std::min(firstOfA, firstOfB);
  }

private:
  std::vector<std::uint32_t> m_Parent;
};

} // namespace itk

#endif
