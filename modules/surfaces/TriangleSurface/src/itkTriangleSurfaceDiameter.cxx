#include "itkTriangleSurfaceMeasures.h"

#include "detail/itkPositionArithmetic.h"
#include "itkPointBox.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace itk
{
namespace
{

using PointType = TriangleSurface::PointType;

double
SquaredDistanceOfPoints(const PointType & a, const PointType & b)
{
  return SquaredDistance(ToPosition(a), ToPosition(b));
}

/** A binary tree of boxes around points. Each box halves its points across its longest side; the children of box n are
 * boxes 2 n + 1 and 2 n + 2. */
class PointBoxes
{
public:
  explicit PointBoxes(TriangleSurface::PointsContainer points)
    : m_Points(std::move(points))
  {
    std::size_t leaves = 1;
    while (leaves * LargestLeaf < m_Points.size())
    {
      leaves *= 2;
    }
    m_Boxes.resize(2 * leaves - 1);
    this->Split(0, 0, m_Points.size());
  }

  /** The largest squared distance between two points, or \a known if that is larger. */
  double
  FindLargest(double known)
  {
    m_Largest = known;
    this->Search(0, 0);
    return m_Largest;
  }

private:
  static constexpr std::size_t LargestLeaf = 16;

  /** The points [begin, end) and the box around them. */
  struct Box
  {
    PointBox bounds;
    std::size_t begin;
    std::size_t end;
  };

  void
  Split(std::size_t n, std::size_t begin, std::size_t end)
  {
    Box & box = m_Boxes[n];
    box = { { m_Points[begin], m_Points[begin] }, begin, end };
    for (std::size_t point = begin; point < end; ++point)
    {
      box.bounds.Add(m_Points[point]);
    }
    if (this->IsLeaf(n))
    {
      return;
    }
    const unsigned int longest = box.bounds.FindLongestAxis();
    const std::size_t middle = (begin + end) / 2;
    const auto at = [this](std::size_t point) { return m_Points.begin() + static_cast<std::ptrdiff_t>(point); };
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

  /** Squared distance between the farthest corners of two boxes. */
  double
  BoundOf(std::size_t a, std::size_t b) const
  {
    const PointBox & boxOfA = m_Boxes[a].bounds;
    const PointBox & boxOfB = m_Boxes[b].bounds;
    PointType cornerOfA;
    PointType cornerOfB;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool isALower =
        double(boxOfB.highest[axis]) - boxOfA.lowest[axis] > double(boxOfA.highest[axis]) - boxOfB.lowest[axis];
      cornerOfA[axis] = isALower ? boxOfA.lowest[axis] : boxOfA.highest[axis];
      cornerOfB[axis] = isALower ? boxOfB.highest[axis] : boxOfB.lowest[axis];
    }
    return SquaredDistanceOfPoints(cornerOfA, cornerOfB);
  }

  /** Looks for two points, one in each box, that are farther apart than the best pair so far. */
  void
  Search(std::size_t a, std::size_t b)
  {
    if (this->BoundOf(a, b) <= m_Largest)
    {
      return;
    }
    if (this->IsLeaf(a)) // then b is a leaf, too: both have the same depth, and so do all leaves
    {
      this->ComparePoints(m_Boxes[a], m_Boxes[b]);
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
          pairs.push_back({ this->BoundOf(childOfA, childOfB), { childOfA, childOfB } });
        }
      }
    }
    std::sort(pairs.begin(), pairs.end(), std::greater<>());
    for (const Pair & pair : pairs)
    {
      this->Search(pair.second.first, pair.second.second);
    }
  }

  void
  ComparePoints(const Box & a, const Box & b)
  {
    for (std::size_t first = a.begin; first < a.end; ++first)
    {
      for (std::size_t second = b.begin; second < b.end; ++second)
      {
        m_Largest = std::max(m_Largest, SquaredDistanceOfPoints(m_Points[first], m_Points[second]));
      }
    }
  }

  TriangleSurface::PointsContainer m_Points;
  BulkVector<Box> m_Boxes;
  double m_Largest = 0.0; ///< squared distance of the best pair so far
};

PointType
FindFarthest(const TriangleSurface::PointsContainer & points, const PointType & from)
{
  return *std::max_element(points.begin(), points.end(), [&from](const auto & a, const auto & b) {
    return SquaredDistanceOfPoints(from, a) < SquaredDistanceOfPoints(from, b);
  });
}

/** The points that may be ends of a distance of more than \a length: the others are nearer than that to all corners of
 * the box around the points. */
TriangleSurface::PointsContainer
FindEnds(const TriangleSurface::PointsContainer & points, double length)
{
  PointBox box{ points.front(), points.front() };
  std::for_each(points.begin(), points.end(), [&box](const PointType & point) { box.Add(point); });
  constexpr double rounding = 1e-9; // generous
  const double least = length * length * (1.0 - rounding);
  TriangleSurface::PointsContainer ends;
  std::copy_if(points.begin(), points.end(), std::back_inserter(ends), [&](const PointType & point) {
    double farthest = 0.0; // squared
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double reach = std::max(double(point[axis]) - box.lowest[axis], double(box.highest[axis]) - point[axis]);
      farthest += reach * reach;
    }
    return !(farthest < least);
  });
  return ends;
}

} // namespace

double
ComputeTriangleSurfaceLongestDiameter(const TriangleSurface & surface)
{
  const auto & points = surface.GetPoints();
  if (points.empty())
  {
    return 0.0;
  }
  // A good first guess spares most of the search.
  const PointType first = FindFarthest(points, points.front());
  const PointType second = FindFarthest(points, first);
  const double guess = SquaredDistanceOfPoints(first, second);
  return std::sqrt(PointBoxes(FindEnds(points, std::sqrt(guess))).FindLargest(guess));
}

} // namespace itk
