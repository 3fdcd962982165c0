#include "itkTriangleSurfaceMeasures.h"

#include "detail/itkPositionArithmetic.h"
#include "itkPointBox.h"

#include <algorithm>
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

/** A binary tree of boxes around points. A box is divided in the middle of its longest side when a search first needs
 * its halves: most are told by their corners alone. */
class PointBoxes
{
public:
  explicit PointBoxes(TriangleSurface::PointsContainer points)
    : m_Points(std::move(points))
  {
    this->AddBox(0, m_Points.size());
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
    std::size_t halves = 0; ///< the first of two boxes, one after the other; 0 before the box is divided
  };

  void
  AddBox(std::size_t begin, std::size_t end)
  {
    Box box{ { m_Points[begin], m_Points[begin] }, begin, end };
    for (std::size_t point = begin; point < end; ++point)
    {
      box.bounds.Add(m_Points[point]);
    }
    const bool isOnePoint = box.bounds.lowest == box.bounds.highest;
    box.end = isOnePoint ? begin + 1 : end;
    m_Boxes.push_back(box);
  }

  bool
  IsLeaf(std::size_t n) const
  {
    return m_Boxes[n].end - m_Boxes[n].begin <= LargestLeaf;
  }

  /** The first of the two halves of a box, which is no leaf. */
  std::size_t
  Divide(std::size_t n)
  {
    if (m_Boxes[n].halves == 0)
    {
      const Box box = m_Boxes[n];
      const unsigned int axis = box.bounds.FindLongestAxis();
      const double middle = 0.5 * (double(box.bounds.lowest[axis]) + box.bounds.highest[axis]);
      const auto first = m_Points.begin();
      const auto second = std::partition(first + static_cast<std::ptrdiff_t>(box.begin),
                                         first + static_cast<std::ptrdiff_t>(box.end),
                                         [=](const PointType & point) { return point[axis] < middle; });
      m_Boxes[n].halves = m_Boxes.size();
      this->AddBox(box.begin, static_cast<std::size_t>(second - first));
      this->AddBox(static_cast<std::size_t>(second - first), box.end);
    }
    return m_Boxes[n].halves;
  }

  /** Squared length of a box's diagonal. */
  double
  SizeOf(std::size_t n) const
  {
    return SquaredDistanceOfPoints(m_Boxes[n].bounds.lowest, m_Boxes[n].bounds.highest);
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
    if (this->IsLeaf(a) && this->IsLeaf(b))
    {
      this->ComparePoints(m_Boxes[a], m_Boxes[b]);
    }
    else if (a == b)
    {
      const std::size_t half = this->Divide(a);
      this->Search(half, half + 1); // first, as the best pair is likely there
      this->Search(half, half);
      this->Search(half + 1, half + 1);
    }
    else
    {
      if (this->IsLeaf(b) || (!this->IsLeaf(a) && this->SizeOf(a) > this->SizeOf(b)))
      {
        std::swap(a, b);
      }
      const std::size_t half = this->Divide(b);
      const bool isFirstFarther = this->BoundOf(a, half) > this->BoundOf(a, half + 1);
      this->Search(a, isFirstFarther ? half : half + 1);
      this->Search(a, isFirstFarther ? half + 1 : half);
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
FindMiddle(const TriangleSurface::PointsContainer & points)
{
  PointBox box{ points.front(), points.front() };
  std::for_each(points.begin(), points.end(), [&box](const PointType & point) { box.Add(point); });
  PointType middle;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = 0.5f * box.lowest[axis] + 0.5f * box.highest[axis];
  }
  return middle;
}

PointType
FindFarthest(const TriangleSurface::PointsContainer & points, const PointType & from)
{
  return *std::max_element(points.begin(), points.end(), [&from](const auto & a, const auto & b) {
    return SquaredDistanceOfPoints(from, a) < SquaredDistanceOfPoints(from, b);
  });
}

} // namespace

double
ComputeTriangleSurfaceLongestDiameter(const TriangleSurface & surface)
{
  TriangleSurface::PointsContainer points;
  std::copy_if(surface.GetPoints().begin(), surface.GetPoints().end(), std::back_inserter(points), IsFinite);
  if (points.empty())
  {
    return 0.0;
  }
  // A good first guess spares most of the search, also of a ball, most of whose points are as far apart as any others.
  const PointType middle = FindMiddle(points);
  const PointType first = FindFarthest(points, middle);
  const double known = SquaredDistanceOfPoints(first, FindFarthest(points, first));
  // No point is farther from the middle m than the first one, f. So if |ab| > known, then |am| >= |ab| - |bm| > known -
  // |fm|. Points nearer to the middle are left out.
  constexpr double rounding = 1e-9;
  const double least = std::sqrt(known) * (1.0 - rounding) - std::sqrt(SquaredDistanceOfPoints(middle, first));
  const auto isWithin = [&](const PointType & point) {
    return least > 0.0 && SquaredDistanceOfPoints(middle, point) < least * least;
  };
  points.erase(std::remove_if(points.begin(), points.end(), isWithin), points.end());
  return std::sqrt(PointBoxes(std::move(points)).FindLargest(known));
}

} // namespace itk
