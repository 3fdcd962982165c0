#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace itk
{
namespace
{

using PointType = TriangleSurface::PointType;

double
SquaredDistance(const PointType & a, const PointType & b)
{
  double sum = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double difference = static_cast<double>(a[axis]) - b[axis];
    sum += difference * difference;
  }
  return sum;
}

/** Points halved along their longest side again and again, so that those of each box follow each other. The children of
 * box n are boxes 2 n + 1 and 2 n + 2. */
class PointBoxes
{
public:
  explicit PointBoxes(const TriangleSurface & surface)
    : m_Points(surface.GetPoints().begin(), surface.GetPoints().end())
  {
    std::size_t leaves = 1;
    while (leaves * LargestLeaf < m_Points.size())
    {
      leaves *= 2;
    }
    m_Boxes.resize(2 * leaves - 1);
    this->Split(0, 0, m_Points.size());
  }

  double
  FindLargestDistance()
  {
    // A first guess close to the answer spares most of the search.
    const auto farthestFrom = [this](const PointType & from) {
      return *std::max_element(m_Points.begin(), m_Points.end(), [&from](const auto & a, const auto & b) {
        return SquaredDistance(from, a) < SquaredDistance(from, b);
      });
    };
    const PointType end = farthestFrom(m_Points.front());
    m_Largest = SquaredDistance(end, farthestFrom(end));
    this->Search(0, 0);
    return std::sqrt(m_Largest);
  }

private:
  static constexpr std::size_t LargestLeaf = 16;

  struct Box
  {
    PointType low;
    PointType high;
    std::size_t begin;
    std::size_t end;
  };

  void
  Split(std::size_t n, std::size_t begin, std::size_t end)
  {
    Box & box = m_Boxes[n];
    box = { m_Points[begin], m_Points[begin], begin, end };
    for (std::size_t i = begin; i < end; ++i)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        box.low[axis] = std::min(box.low[axis], m_Points[i][axis]);
        box.high[axis] = std::max(box.high[axis], m_Points[i][axis]);
      }
    }
    if (this->IsLeaf(n))
    {
      return;
    }
    unsigned int longest = 0;
    for (unsigned int axis = 1; axis < 3; ++axis)
    {
      longest = box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest] ? axis : longest;
    }
    const std::size_t middle = (begin + end) / 2;
    const auto at = [this](std::size_t i) { return m_Points.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(
      at(begin), at(middle), at(end), [longest](const auto & a, const auto & b) { return a[longest] < b[longest]; });
    this->Split(2 * n + 1, begin, middle);
    this->Split(2 * n + 2, middle, end);
  }

  bool
  IsLeaf(std::size_t n) const
  {
    return 2 * n + 1 >= m_Boxes.size();
  }

  /** Between the farthest corners of two boxes, squared. */
  double
  FarthestOf(std::size_t a, std::size_t b) const
  {
    PointType one;
    PointType other;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool aIsFirst = static_cast<double>(m_Boxes[b].high[axis]) - m_Boxes[a].low[axis] >
                            static_cast<double>(m_Boxes[a].high[axis]) - m_Boxes[b].low[axis];
      one[axis] = aIsFirst ? m_Boxes[a].low[axis] : m_Boxes[b].low[axis];
      other[axis] = aIsFirst ? m_Boxes[b].high[axis] : m_Boxes[a].high[axis];
    }
    return SquaredDistance(one, other);
  }

  /** Looks for a pair of points, one in each box, that is farther apart than the best known. */
  void
  Search(std::size_t a, std::size_t b)
  {
    if (this->FarthestOf(a, b) <= m_Largest)
    {
      return;
    }
    if (this->IsLeaf(a)) // all leaves are on one level, and so are a and b
    {
      for (std::size_t i = m_Boxes[a].begin; i < m_Boxes[a].end; ++i)
      {
        for (std::size_t j = m_Boxes[b].begin; j < m_Boxes[b].end; ++j)
        {
          m_Largest = std::max(m_Largest, SquaredDistance(m_Points[i], m_Points[j]));
        }
      }
      return;
    }
    using Pair = std::pair<double, std::pair<std::size_t, std::size_t>>;
    std::vector<Pair> pairs;
    pairs.reserve(4);
    for (const std::size_t childOfA : { 2 * a + 1, 2 * a + 2 })
    {
      for (const std::size_t childOfB : { 2 * b + 1, 2 * b + 2 })
      {
        if (a != b || childOfA <= childOfB) // each pair once
        {
          pairs.push_back({ this->FarthestOf(childOfA, childOfB), { childOfA, childOfB } });
        }
      }
    }
    std::sort(pairs.begin(), pairs.end(), std::greater<>());
    for (const Pair & pair : pairs)
    {
      this->Search(pair.second.first, pair.second.second);
    }
  }

  std::vector<PointType> m_Points;
  std::vector<Box> m_Boxes;
  double m_Largest = 0.0;
};

} // namespace

double
ComputeLongestDiameter(const TriangleSurface & surface)
{
  return surface.GetPoints().empty() ? 0.0 : PointBoxes(surface).FindLargestDistance();
}

} // namespace itk
