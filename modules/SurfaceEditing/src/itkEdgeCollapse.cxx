#include "itkEdgeCollapse.h"

#include "detail/itkClosestOnTriangle.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr double SmallestCosineOfTurn = 0.2; // of a triangle's normal when an edge shrinks
constexpr double SliverQuality = 0.1;        // below it a triangle's own normal says little, and new ones are unwelcome
constexpr unsigned int MostAround = 64;      // triangles around a point that vanishes: more take too long
constexpr double NearEnough = 0.7;           // of the limit, so that places in between are near, too
constexpr double FurthestPlace = 1.0;        // from an edge's middle, in lengths of the edge

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

PositionType
Mix(const PositionType & a, const PositionType & b, double shareOfB)
{
  return { a[0] + shareOfB * (b[0] - a[0]), a[1] + shareOfB * (b[1] - a[1]), a[2] + shareOfB * (b[2] - a[2]) };
}

TriangleSurface::PointType
ToPoint(const PositionType & position)
{
  return { static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2]) };
}

PositionType
Add(const PositionType & a, const PositionType & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

} // namespace

EdgeCollapse::EdgeCollapse(const TriangleSurface & surface,
                           const Part & part,
                           const std::vector<std::uint8_t> & isHeld,
                           const Original & original)
  : m_Surface(surface)
  , m_Original(original)
  , m_Ids(part.triangles)
  , m_Origin(ToPosition(surface.GetPoints()[m_Ids.GetIds().front()]))
  , m_Triangles(m_Ids.ToLocal(part.triangles))
  , m_IsLeft(m_Triangles.size(), 1)
  , m_IsNew(m_Triangles.size(), 0)
  , m_NumberLeft(m_Triangles.size())
  , m_FirstCorner(m_Ids.GetIds().size(), None)
  , m_NextCorner(3 * m_Triangles.size())
  , m_Quadrics(m_FirstCorner.size())
  , m_Versions(m_FirstCorner.size(), 0)
  , m_IsOnBorder(m_FirstCorner.size(), 0)
  , m_IsGone(m_FirstCorner.size(), 0)
  , m_HasMoved(m_FirstCorner.size(), 0)
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
    m_Positions.push_back(Subtract(ToPosition(surface.GetPoints()[id]), m_Origin));
    if (surface.HasNormals())
    {
      m_Normals.push_back(ToPosition(surface.GetNormals()[id]));
    }
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
  if (m_Original.tree != nullptr)
  {
    this->AddWitnesses(part.witnesses);
  }
}

void
EdgeCollapse::AddWitnesses(const std::vector<Witness> & witnesses)
{
  for (const PointId id : m_Ids.GetIds())
  {
    m_Near.push_back((*m_Original.nearPoints)[id]);
  }
  m_FirstWitness.assign(m_Triangles.size(), None);
  for (const Witness & witness : witnesses)
  {
    const auto & point = m_Original.tree->GetSurface().GetPoints()[witness.point];
    m_WitnessPoints.push_back(witness.point);
    m_Witnesses.push_back(Subtract(ToPosition(point), m_Origin));
    m_NextWitness.push_back(m_FirstWitness[witness.triangle]);
    m_FirstWitness[witness.triangle] = static_cast<WitnessId>(m_Witnesses.size() - 1);
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
    const PositionType & first = m_Positions[triangle[0]];
    const Shape shape(first, m_Positions[triangle[1]], m_Positions[triangle[2]]);
    for (const PointId point : triangle)
    {
      m_Quadrics[point].AddPlane(first, shape.normal);
    }
  }
}

std::vector<EdgeCollapse::Progress>
EdgeCollapse::Run(const Goal & goal)
{
  m_LargestError = goal.error;
  for (const TriangleType & triangle : m_Triangles)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      if (triangle[corner] < triangle[(corner + 1) % 3])
      {
        this->Propose(triangle[corner], triangle[(corner + 1) % 3]);
      }
    }
  }
  std::vector<Progress> progress;
  while (m_NumberLeft > goal.triangles && !m_Candidates.empty())
  {
    const Candidate best = m_Candidates.top();
    m_Candidates.pop();
    if (m_IsGone[best.from] || m_IsGone[best.to] || m_Versions[best.from] + m_Versions[best.to] != best.version ||
        !this->IsTopologyKept(best.from, best.to))
    {
      continue;
    }
    const PositionType place = this->PlaceFor(best.from, best.to);
    if (!this->IsShapeKept(best.from, best.to, place))
    {
      continue;
    }
    if (!this->StaysNear(best.from, best.to, place))
    {
      m_WasHeldBack = true;
      continue;
    }
    this->Collapse(best.from, best.to, place);
    this->ProposeAround(best.to);
    if (progress.empty() || best.error > progress.back().error)
    {
      progress.push_back({ best.error, m_NumberLeft });
    }
    progress.back().triangles = m_NumberLeft;
  }
  return progress;
}

/** Where one point stays, the other one is to vanish. */
void
EdgeCollapse::Propose(PointId a, PointId b)
{
  if (m_Stays[a] && m_Stays[b])
  {
    return;
  }
  const PointId from = m_Stays[a] ? b : a;
  const PointId to = m_Stays[a] ? a : b;
  Quadric quadric = m_Quadrics[from];
  quadric.Add(m_Quadrics[to]);
  const double error = quadric.ComputeDistance(this->PlaceFor(from, to));
  if (error <= m_LargestError)
  {
    m_Candidates.push({ static_cast<float>(error), from, to, m_Versions[from] + m_Versions[to] });
  }
  else
  {
    m_WasHeldBack = true;
  }
}

void
EdgeCollapse::ProposeAround(PointId point)
{
  this->ForEachTriangle(point, [&](TriangleId, PointId next, PointId) { this->Propose(point, next); });
}

/** Where the edge is to shrink to; exactly a point of the surface's precision. */
PositionType
EdgeCollapse::PlaceFor(PointId from, PointId to) const
{
  if (m_Stays[to])
  {
    return m_Positions[to];
  }
  const PositionType middle = Mix(m_Positions[from], m_Positions[to], 0.5);
  Quadric quadric = m_Quadrics[from];
  quadric.Add(m_Quadrics[to]);
  PositionType place = quadric.FindMinimum(middle);
  const PositionType edge = Subtract(m_Positions[to], m_Positions[from]);
  const PositionType way = Subtract(place, middle);
  if (!(Dot(way, way) <= FurthestPlace * FurthestPlace * Dot(edge, edge)))
  {
    place = middle;
  }
  return Subtract(ToPosition(ToPoint(Add(place, m_Origin))), m_Origin);
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
  if (common != 2 || joinsBorder || degree > MostAround)
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

bool
EdgeCollapse::IsShapeKept(PointId from, PointId to, const PositionType & place) const
{
  return this->IsShapeKeptAround(from, to, place) && (m_Stays[to] || this->IsShapeKeptAround(to, from, place));
}

/** No triangle may lose its area, turn round or become a sliver worse than any before. */
bool
EdgeCollapse::IsShapeKeptAround(PointId moved, PointId other, const PositionType & place) const
{
  PositionType fanNormal{};
  double worstBefore = 1.0;
  this->ForEachTriangle(moved, [&](TriangleId, PointId next, PointId last) {
    const Shape shape(m_Positions[moved], m_Positions[next], m_Positions[last]);
    worstBefore = std::min(worstBefore, shape.quality);
    fanNormal = Add(fanNormal, shape.normal);
  });
  bool isKept = true;
  this->ForEachTriangle(moved, [&](TriangleId, PointId next, PointId last) {
    if (!isKept || next == other || last == other)
    {
      return;
    }
    const Shape before(m_Positions[moved], m_Positions[next], m_Positions[last]);
    const Shape after(place, m_Positions[next], m_Positions[last]);
    const auto liesAlong = [&](const PositionType & reference) {
      return Dot(after.normal, reference) > SmallestCosineOfTurn * after.length * std::sqrt(Dot(reference, reference));
    };
    isKept = after.quality > 0.0 && after.quality >= std::min(SliverQuality, worstBefore) &&
             (liesAlong(before.normal) || (before.quality < SliverQuality && liesAlong(fanNormal)));
  });
  return isKept;
}

bool
EdgeCollapse::StaysNear(PointId from, PointId to, const PositionType & place)
{
  if (m_Original.tree == nullptr)
  {
    return true;
  }
  m_Fan.clear();
  const auto add = [&](PointId moved, PointId other) {
    this->ForEachTriangle(moved, [&](TriangleId id, PointId next, PointId last) {
      if (next != other && last != other)
      {
        m_Fan.push_back({ id, next, last });
      }
    });
  };
  add(from, to);
  if (!m_Stays[to])
  {
    add(to, from);
  }
  return this->IsNearOriginal(from, to, place) && this->AreWitnessesNear(from, to, place);
}

/** Looks at the place, at the middles of the edges there and at the centres of the triangles around it. */
bool
EdgeCollapse::IsNearOriginal(PointId from, PointId to, const PositionType & place)
{
  const double squaredLimit = m_Original.limit * m_Original.limit;
  const auto findNear = [&](const PositionType & position, const std::array<TriangleId, 3> & likely) {
    const PositionType absolute = Add(position, m_Origin);
    for (const TriangleId triangle : likely)
    {
      const PositionType way = Subtract(absolute, m_Original.tree->FindClosestPointOfTriangle(absolute, triangle));
      if (Dot(way, way) <= NearEnough * NearEnough * squaredLimit)
      {
        return triangle;
      }
    }
    return m_Original.tree->FindClosestPoint(absolute, squaredLimit).triangle;
  };
  m_NearPlace = findNear(place, { m_Near[from], m_Near[to], m_Near[to] });
  return m_NearPlace != TriangleTree::None && std::all_of(m_Fan.begin(), m_Fan.end(), [&](const Fan & fan) {
           const PositionType & next = m_Positions[fan.next];
           const std::array<TriangleId, 3> likely{ m_NearPlace, m_Near[fan.next], m_Near[fan.last] };
           return findNear(Mix(place, next, 0.5), likely) != TriangleTree::None &&
                  findNear(Mix(place, Mix(next, m_Positions[fan.last], 0.5), 2.0 / 3.0), likely) != TriangleTree::None;
         });
}

/** Finds the nearest new triangle for each witness. */
bool
EdgeCollapse::AreWitnessesNear(PointId from, PointId to, const PositionType & place)
{
  m_Assigned.clear();
  const double squaredLimit = m_Original.limit * m_Original.limit;
  bool areNear = true;
  const auto assign = [&](TriangleId triangle) {
    for (WitnessId id = m_FirstWitness[triangle]; areNear && id != None; id = m_NextWitness[id])
    {
      double least = std::numeric_limits<double>::infinity();
      TriangleId nearest = None;
      for (const Fan & fan : m_Fan)
      {
        const PositionType way = Subtract(
          m_Witnesses[id], ClosestOnTriangle(m_Witnesses[id], { place, m_Positions[fan.next], m_Positions[fan.last] }));
        const double distance = Dot(way, way);
        nearest = distance < least ? fan.triangle : nearest;
        least = std::min(least, distance);
      }
      areNear = least <= squaredLimit;
      m_Assigned.emplace_back(id, nearest);
    }
  };
  this->ForEachTriangle(from, [&](TriangleId id, PointId, PointId) { assign(id); });
  if (!m_Stays[to])
  {
    this->ForEachTriangle(to, [&](TriangleId id, PointId next, PointId last) {
      if (next != from && last != from)
      {
        assign(id);
      }
    });
  }
  return areNear;
}

void
EdgeCollapse::Collapse(PointId from, PointId to, const PositionType & place)
{
  if (!m_Stays[to])
  {
    this->MixNormals(from, to, place);
    m_Positions[to] = place;
    m_HasMoved[to] = 1;
    this->ForEachTriangle(to, [&](TriangleId id, PointId, PointId) { m_IsNew[id] = 1; });
  }
  m_IsGone[from] = 1;
  m_Quadrics[to].Add(m_Quadrics[from]);
  m_Versions[to] += m_Versions[from] + 1;
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
  if (m_Original.tree != nullptr)
  {
    m_Near[to] = m_NearPlace;
    this->MoveWitnesses();
  }
}

void
EdgeCollapse::MoveWitnesses()
{
  for (const Fan & fan : m_Fan)
  {
    m_FirstWitness[fan.triangle] = None;
  }
  for (const auto & [witness, triangle] : m_Assigned)
  {
    m_NextWitness[witness] = m_FirstWitness[triangle];
    m_FirstWitness[triangle] = witness;
  }
}

/** The normal of an edge's place nearest to where it has shrunk to. */
void
EdgeCollapse::MixNormals(PointId from, PointId to, const PositionType & place)
{
  if (m_Normals.empty())
  {
    return;
  }
  const PositionType edge = Subtract(m_Positions[to], m_Positions[from]);
  const double share = Dot(Subtract(place, m_Positions[from]), edge) / Dot(edge, edge);
  const PositionType mixed = Mix(m_Normals[from], m_Normals[to], std::clamp(share, 0.0, 1.0));
  const double length = std::sqrt(Dot(mixed, mixed));
  if (length > 0.0)
  {
    m_Normals[to] = { mixed[0] / length, mixed[1] / length, mixed[2] / length };
  }
}

EdgeCollapse::Part
EdgeCollapse::GetResult() const
{
  Part result;
  const auto & ids = m_Ids.GetIds();
  for (const bool isNew : { false, true })
  {
    for (TriangleId id = 0; id < m_Triangles.size(); ++id)
    {
      if (!m_IsLeft[id] || (m_IsNew[id] != 0) != isNew)
      {
        continue;
      }
      const auto number = static_cast<TriangleId>(result.triangles.size());
      result.triangles.push_back({ ids[m_Triangles[id][0]], ids[m_Triangles[id][1]], ids[m_Triangles[id][2]] });
      for (WitnessId witness = m_FirstWitness.empty() ? None : m_FirstWitness[id]; witness != None;
           witness = m_NextWitness[witness])
      {
        result.witnesses.push_back({ m_WitnessPoints[witness], number });
      }
    }
  }
  return result;
}

std::size_t
EdgeCollapse::CountOldTriangles() const
{
  std::size_t count = 0;
  for (TriangleId id = 0; id < m_Triangles.size(); ++id)
  {
    count += m_IsLeft[id] && !m_IsNew[id] ? 1 : 0;
  }
  return count;
}

std::vector<EdgeCollapse::MovedPoint>
EdgeCollapse::GetMovedPoints() const
{
  std::vector<MovedPoint> moved;
  for (PointId point = 0; point < m_Positions.size(); ++point)
  {
    if (m_HasMoved[point] && !m_IsGone[point])
    {
      moved.push_back({ m_Ids.GetIds()[point],
                        ToPoint(Add(m_Positions[point], m_Origin)),
                        m_Normals.empty() ? TriangleSurface::NormalType{} : ToPoint(m_Normals[point]),
                        m_Near.empty() ? None : m_Near[point] });
    }
  }
  return moved;
}

} // namespace itk
