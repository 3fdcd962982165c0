#include "itkSimplifiedPatch.h"

#include "itkLocalIds.h"
#include "itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>
#include <tuple>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using TriangleId = std::uint32_t;
using CornerId = std::uint32_t; // 3 * triangle + 0, 1 or 2
using PointType = TriangleSurface::PointType;
using TriangleType = TriangleSurface::TriangleType;
using Box = TriangleTree::Box;

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

constexpr double SmallestCosineOfTurn = 0.2; // of a triangle's normal when an edge shrinks
constexpr double SliverQuality = 0.1;        // below it a triangle's own normal says little, and new ones are unwelcome

/** A triangle's normal, as long as twice its area, and how near it is to equilateral: 1 if it is, 0 without area. */
struct Shape
{
  PositionType normal;
  double length;
  double quality;

  Shape(const PositionType & a, const PositionType & b, const PositionType & c)
  {
    const PositionType ab = Subtract(b, a);
    const PositionType ac = Subtract(c, a);
    const PositionType bc = Subtract(c, b);
    normal = Cross(ab, ac);
    length = std::sqrt(Dot(normal, normal));
    const double squares = Dot(ab, ab) + Dot(ac, ac) + Dot(bc, bc);
    quality = squares > 0.0 ? 2.0 * std::sqrt(3.0) * length / squares : 0.0;
  }
};

/** Sum of weighted squared distances from planes, as a function of position. */
class Quadric
{
public:
  /** Adds the plane of a triangle, weighted by its area. */
  void
  AddPlane(const PositionType & position, const Shape & shape)
  {
    if (!(shape.length > 0.0))
    {
      return;
    }
    const PositionType n{ shape.normal[0] / shape.length,
                          shape.normal[1] / shape.length,
                          shape.normal[2] / shape.length };
    const double d = -Dot(n, position);
    const double area = shape.length / 2.0;
    const std::array<double, 11> terms{ n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2],
                                        n[0] * d,    n[1] * d,    n[2] * d,    d * d,       1.0 };
    for (std::size_t i = 0; i < terms.size(); ++i)
    {
      m_Terms[i] += area * terms[i];
    }
  }

  void
  Add(const Quadric & other)
  {
    for (std::size_t i = 0; i < m_Terms.size(); ++i)
    {
      m_Terms[i] += other.m_Terms[i];
    }
  }

  /** Root of the weighted mean of the squared distances. */
  double
  ComputeDistance(const PositionType & p) const
  {
    const auto & t = m_Terms;
    const double sum =
      t[0] * p[0] * p[0] + t[1] * p[1] * p[1] + t[2] * p[2] * p[2] +
      2.0 * (t[3] * p[0] * p[1] + t[4] * p[0] * p[2] + t[5] * p[1] * p[2] + t[6] * p[0] + t[7] * p[1] + t[8] * p[2]) +
      t[9];
    return t[10] > 0.0 ? std::sqrt(std::max(0.0, sum) / t[10]) : 0.0;
  }

private:
  std::array<double, 11> m_Terms{};
};

/** Shrinks the edges of some triangles. Points have local numbers. */
class EdgeCollapse
{
public:
  EdgeCollapse(const SimplifiedPatch::Points & points,
               const std::vector<TriangleType> & triangles,
               const std::vector<std::uint8_t> & isHeld,
               const SimplifiedPatch::Check & isAllowed);

  void
  Run(const SimplifiedPatch::Goal & goal);

  /** The triangles that are left and are, or are not, as they were at first. */
  std::vector<TriangleType>
  GetTriangles(bool isNew) const;

private:
  /** Point \a from is to vanish into point \a to. */
  struct Candidate
  {
    float error;
    PointId from;
    PointId to;
    std::uint32_t version; // of the quadric the error is from

    friend bool
    operator<(const Candidate & a, const Candidate & b) // the least comes first in a queue
    {
      return std::tie(a.error, a.from, a.to) > std::tie(b.error, b.from, b.to);
    }
  };

  template <typename TVisit>
  void
  ForEachTriangle(PointId point, const TVisit & visit) const
  {
    for (CornerId corner = m_FirstCorner[point]; corner != None; corner = m_NextCorner[corner])
    {
      if (m_IsLeft[corner / 3])
      {
        visit(corner / 3, m_Triangles[corner / 3][(corner + 1) % 3], m_Triangles[corner / 3][(corner + 2) % 3]);
      }
    }
  }

  void
  FindBorder();
  void
  AddQuadrics();
  void
  Propose(PointId from, PointId to);
  void
  ProposeAround(PointId point);
  bool
  IsTopologyKept(PointId from, PointId to);
  bool
  IsShapeKept(PointId from, PointId to) const;
  void
  Collapse(PointId from, PointId to);
  Shape
  ShapeOf(const TriangleType & triangle) const
  {
    return { m_Positions[triangle[0]], m_Positions[triangle[1]], m_Positions[triangle[2]] };
  }

  const SimplifiedPatch::Check & m_IsAllowed;
  const LocalIds m_Ids;
  std::vector<TriangleType> m_Triangles;
  std::vector<std::uint8_t> m_IsLeft; // of triangles, as is the next
  std::vector<std::uint8_t> m_IsNew;
  std::size_t m_NumberLeft;
  std::vector<CornerId> m_FirstCorner; // of each point; its other corners follow by m_NextCorner
  std::vector<CornerId> m_NextCorner;
  std::vector<PositionType> m_Positions; // from here on of points; from the first point, to keep digits
  std::vector<Quadric> m_Quadrics;
  std::vector<std::uint32_t> m_Versions;
  std::vector<std::uint8_t> m_IsOnBorder;
  std::vector<std::uint8_t> m_Stays;
  std::vector<std::uint8_t> m_IsGone;
  std::vector<std::uint32_t> m_Marks;
  std::uint32_t m_Mark = 0;
  double m_LargestError = 0.0;
  std::priority_queue<Candidate> m_Candidates;
};

EdgeCollapse::EdgeCollapse(const SimplifiedPatch::Points & points,
                           const std::vector<TriangleType> & triangles,
                           const std::vector<std::uint8_t> & isHeld,
                           const SimplifiedPatch::Check & isAllowed)
  : m_IsAllowed(isAllowed)
  , m_Ids(triangles)
  , m_Triangles(m_Ids.ToLocal(triangles))
  , m_IsLeft(triangles.size(), 1)
  , m_IsNew(triangles.size(), 0)
  , m_NumberLeft(triangles.size())
  , m_FirstCorner(m_Ids.GetIds().size(), None)
  , m_NextCorner(3 * triangles.size())
  , m_Quadrics(m_FirstCorner.size())
  , m_Versions(m_FirstCorner.size(), 0)
  , m_IsOnBorder(m_FirstCorner.size(), 0)
  , m_IsGone(m_FirstCorner.size(), 0)
  , m_Marks(m_FirstCorner.size(), 0)
{
  for (CornerId corner = 0; corner < m_NextCorner.size(); ++corner)
  {
    const PointId point = m_Triangles[corner / 3][corner % 3];
    m_NextCorner[corner] = m_FirstCorner[point];
    m_FirstCorner[point] = corner;
  }
  for (const PointId id : m_Ids.GetIds())
  {
    m_Positions.push_back(Subtract(ToPosition(points[id]), ToPosition(points[m_Ids.GetIds().front()])));
  }
  this->AddQuadrics();
  this->FindBorder();
  m_Stays = m_IsOnBorder;
  for (std::size_t id = 0; id < isHeld.size(); ++id)
  {
    for (const PointId point : m_Triangles[id])
    {
      m_Stays[point] = m_Stays[point] || isHeld[id] ? 1 : 0;
    }
  }
}

/** Around a point inside, each neighbour follows it in one triangle and precedes it in another one. */
void
EdgeCollapse::FindBorder()
{
  std::vector<int> balance(m_FirstCorner.size(), 0);
  for (PointId point = 0; point < m_FirstCorner.size(); ++point)
  {
    this->ForEachTriangle(point, [&](TriangleId, PointId next, PointId last) {
      ++balance[next];
      --balance[last];
    });
    this->ForEachTriangle(point, [&](TriangleId, PointId next, PointId last) {
      m_IsOnBorder[point] = m_IsOnBorder[point] || balance[next] != 0 || balance[last] != 0 ? 1 : 0;
    });
    this->ForEachTriangle(point, [&](TriangleId, PointId next, PointId last) { balance[next] = balance[last] = 0; });
  }
}

void
EdgeCollapse::AddQuadrics()
{
  for (const TriangleType & triangle : m_Triangles)
  {
    const Shape shape = this->ShapeOf(triangle);
    for (const PointId point : triangle)
    {
      m_Quadrics[point].AddPlane(m_Positions[triangle[0]], shape);
    }
  }
}

void
EdgeCollapse::Run(const SimplifiedPatch::Goal & goal)
{
  m_LargestError = goal.error;
  for (const TriangleType & triangle : m_Triangles)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      this->Propose(triangle[corner], triangle[(corner + 1) % 3]);
    }
  }
  while (m_NumberLeft > goal.triangles && !m_Candidates.empty())
  {
    const Candidate best = m_Candidates.top();
    m_Candidates.pop();
    if (!m_IsGone[best.from] && !m_IsGone[best.to] && m_Versions[best.from] == best.version &&
        this->IsTopologyKept(best.from, best.to) && this->IsShapeKept(best.from, best.to))
    {
      this->Collapse(best.from, best.to);
      this->ProposeAround(best.to);
    }
  }
}

void
EdgeCollapse::Propose(PointId from, PointId to)
{
  if (m_Stays[from])
  {
    return;
  }
  const double error = m_Quadrics[from].ComputeDistance(m_Positions[to]);
  if (error <= m_LargestError)
  {
    m_Candidates.push({ static_cast<float>(error), from, to, m_Versions[from] });
  }
}

void
EdgeCollapse::ProposeAround(PointId point)
{
  this->ForEachTriangle(point, [&](TriangleId, PointId next, PointId) {
    this->Propose(point, next);
    this->Propose(next, point);
  });
}

/** The link condition: the points next to both are those opposite to the edge, and no two triangles come to lie upon
 * each other. Points that vanish are inside the patch, so each point next to them follows them in one triangle. */
bool
EdgeCollapse::IsTopologyKept(PointId from, PointId to)
{
  ++m_Mark;
  this->ForEachTriangle(to, [&](TriangleId, PointId next, PointId last) {
    m_Marks[next] = m_Mark;
    m_Marks[last] = m_Mark;
  });
  unsigned int degree = 0;
  unsigned int common = 0;
  bool joinsBorder = false;
  std::array<PointId, 2> opposite{ None, None };
  this->ForEachTriangle(from, [&](TriangleId, PointId next, PointId) {
    ++degree;
    if (next != to && m_Marks[next] == m_Mark)
    {
      opposite[common % 2] = next;
      ++common;
    }
    joinsBorder = joinsBorder || (next != to && m_Marks[next] != m_Mark && m_IsOnBorder[to] && m_IsOnBorder[next]);
  });
  if (common != 2 || joinsBorder)
  {
    return false;
  }
  bool isDoubled = false;
  if (degree == 3)
  {
    this->ForEachTriangle(to, [&](TriangleId, PointId next, PointId last) {
      isDoubled =
        isDoubled || (next == opposite[0] && last == opposite[1]) || (next == opposite[1] && last == opposite[0]);
    });
  }
  return !isDoubled;
}

/** No triangle may lose its area, turn round or become a sliver worse than any before, or be refused. */
bool
EdgeCollapse::IsShapeKept(PointId from, PointId to) const
{
  PositionType fanNormal{};
  double worstBefore = 1.0;
  this->ForEachTriangle(from, [&](TriangleId id, PointId, PointId) {
    const Shape shape = this->ShapeOf(m_Triangles[id]);
    worstBefore = std::min(worstBefore, shape.quality);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      fanNormal[axis] += shape.normal[axis];
    }
  });
  bool isKept = true;
  const auto forEachMoved = [&](const auto & visit) {
    this->ForEachTriangle(from, [&](TriangleId id, PointId next, PointId last) {
      if (isKept && next != to && last != to)
      {
        visit(id, next, last);
      }
    });
  };
  forEachMoved([&](TriangleId id, PointId next, PointId last) {
    const Shape before = this->ShapeOf(m_Triangles[id]);
    const Shape after(m_Positions[to], m_Positions[next], m_Positions[last]);
    const PositionType & reference = before.quality >= SliverQuality ? before.normal : fanNormal;
    isKept = after.quality > 0.0 && after.quality >= std::min(SliverQuality, worstBefore) &&
             Dot(after.normal, reference) > SmallestCosineOfTurn * after.length * std::sqrt(Dot(reference, reference));
  });
  if (m_IsAllowed)
  {
    forEachMoved([&](TriangleId, PointId next, PointId last) {
      isKept = m_IsAllowed({ m_Ids.GetIds()[to], m_Ids.GetIds()[next], m_Ids.GetIds()[last] });
    });
  }
  return isKept;
}

void
EdgeCollapse::Collapse(PointId from, PointId to)
{
  m_IsGone[from] = 1;
  m_Quadrics[to].Add(m_Quadrics[from]);
  ++m_Versions[to];
  for (CornerId corner = m_FirstCorner[from], next = None; corner != None; corner = next)
  {
    next = m_NextCorner[corner];
    TriangleType & triangle = m_Triangles[corner / 3];
    if (!m_IsLeft[corner / 3])
    {
      continue;
    }
    if (std::find(triangle.begin(), triangle.end(), to) != triangle.end())
    {
      m_IsLeft[corner / 3] = 0;
      --m_NumberLeft;
      continue;
    }
    triangle[corner % 3] = to;
    m_IsNew[corner / 3] = 1;
    m_NextCorner[corner] = m_FirstCorner[to];
    m_FirstCorner[to] = corner;
  }
}

std::vector<TriangleType>
EdgeCollapse::GetTriangles(bool isNew) const
{
  std::vector<TriangleType> triangles;
  const auto & ids = m_Ids.GetIds();
  for (TriangleId id = 0; id < m_Triangles.size(); ++id)
  {
    if (m_IsLeft[id] && (m_IsNew[id] != 0) == isNew)
    {
      triangles.push_back({ ids[m_Triangles[id][0]], ids[m_Triangles[id][1]], ids[m_Triangles[id][2]] });
    }
  }
  return triangles;
}

} // namespace

Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleType & triangle)
{
  Box box{ points[triangle[0]], points[triangle[0]] };
  for (const PointId point : triangle)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lowest[axis] = std::min(box.lowest[axis], points[point][axis]);
      box.highest[axis] = std::max(box.highest[axis], points[point][axis]);
    }
  }
  return box;
}

SimplifiedPatch::SimplifiedPatch(const Points & points, const TriangleType * begin, const TriangleType * end)
  : m_Points(&points)
  , m_Begin(begin)
  , m_End(end)
  , m_Bounds(BoxOf(points, *begin))
  , m_IsHeld(static_cast<std::size_t>(end - begin), 0)
{
  std::for_each(begin, end, [this](const TriangleType & triangle) {
    const Box box = BoxOf(*m_Points, triangle);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Bounds.lowest[axis] = std::min(m_Bounds.lowest[axis], box.lowest[axis]);
      m_Bounds.highest[axis] = std::max(m_Bounds.highest[axis], box.highest[axis]);
    }
  });
}

void
SimplifiedPatch::Simplify(const Goal & goal, const Check & isAllowed)
{
  EdgeCollapse collapse(*m_Points, std::vector<TriangleType>(m_Begin, m_End), m_IsHeld, isAllowed);
  collapse.Run(goal);
  const std::vector<TriangleType> oldTriangles = collapse.GetTriangles(false);
  const std::vector<TriangleType> newTriangles = collapse.GetTriangles(true);
  std::vector<TriangleType> previous(m_Result.begin() + static_cast<std::ptrdiff_t>(m_NumberOfOldTriangles),
                                     m_Result.end());
  std::sort(previous.begin(), previous.end());
  m_Fresh.clear();
  for (std::size_t id = 0; id < newTriangles.size(); ++id)
  {
    if (!std::binary_search(previous.begin(), previous.end(), newTriangles[id]))
    {
      m_Fresh.push_back(static_cast<std::uint32_t>(oldTriangles.size() + id));
    }
  }
  std::vector<TriangleType> current = newTriangles;
  std::sort(current.begin(), current.end());
  m_Dropped.clear();
  std::set_difference(previous.begin(), previous.end(), current.begin(), current.end(), std::back_inserter(m_Dropped));

  m_NumberOfOldTriangles = oldTriangles.size();
  m_Result = oldTriangles;
  m_Result.insert(m_Result.end(), newTriangles.begin(), newTriangles.end());
}

bool
SimplifiedPatch::Hold(const std::vector<Box> & places)
{
  bool isAnyNew = false;
  for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
  {
    const Box own = BoxOf(*m_Points, m_Begin[id]);
    if (!m_IsHeld[id] &&
        std::any_of(places.begin(), places.end(), [&own](const Box & place) { return place.Overlaps(own); }))
    {
      m_IsHeld[id] = 1;
      isAnyNew = true;
    }
  }
  return isAnyNew;
}

void
SimplifiedPatch::HoldAll()
{
  std::fill(m_IsHeld.begin(), m_IsHeld.end(), std::uint8_t{ 1 });
}

void
SimplifiedPatch::Restart()
{
  std::fill(m_IsHeld.begin(), m_IsHeld.end(), std::uint8_t{ 0 });
  m_Result.clear();
  m_NumberOfOldTriangles = 0;
}

} // namespace itk
