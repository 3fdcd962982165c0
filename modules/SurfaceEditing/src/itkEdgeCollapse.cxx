#include "itkEdgeCollapse.h"

#include "detail/itkClosestOnTriangle.h"
#include "itkQuadric.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using TriangleId = std::uint32_t;
using CornerId = std::uint32_t; ///< 3 * triangle + 0, 1 or 2
using WitnessId = std::uint32_t;
using PointType = TriangleSurface::PointType;
using TriangleType = TriangleSurface::TriangleType;

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

constexpr double SmallestCosineOfCollapse = 0.2; // cosine of the largest turn of a normal when an edge collapses
constexpr double SliverQuality = 0.1;    // the normal of a worse triangle is unreliable, and no new one may be worse
constexpr unsigned int MostAround = 64;  // triangles around a point that vanishes; more would take too long
constexpr double NearEnough = 0.7;       // relative to the limit, so that positions in between are near, too
constexpr double FarthestPosition = 1.0; // distance of the new position from the edge's middle, in lengths of the edge

/** A triangle's normal, twice as long as its area, and its quality: 1 if equilateral, 0 without area. */
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
    length = Length(normal);
    const double squares = Dot(ab, ab) + Dot(ac, ac) + Dot(bc, bc);
    quality = squares > 0.0 ? 2.0 * std::sqrt(3.0) * length / squares : 0.0;
  }
};

PositionType
Mix(const PositionType & a, const PositionType & b, double shareOfB)
{
  return { a[0] + shareOfB * (b[0] - a[0]), a[1] + shareOfB * (b[1] - a[1]), a[2] + shareOfB * (b[2] - a[2]) };
}

PointType
ToPoint(const PositionType & position)
{
  return { static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2]) };
}

/** The distinct points of some triangles, ascending. */
std::vector<PointId>
FindPoints(const std::vector<TriangleType> & triangles)
{
  std::vector<PointId> ids;
  ids.reserve(3 * triangles.size());
  for (const TriangleType & triangle : triangles)
  {
    ids.insert(ids.end(), triangle.begin(), triangle.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/** The triangles with indices into \a ids in place of these ids. */
std::vector<TriangleType>
ToLocal(std::vector<TriangleType> triangles, const std::vector<PointId> & ids)
{
  for (TriangleType & triangle : triangles)
  {
    for (PointId & point : triangle)
    {
      point = static_cast<PointId>(std::lower_bound(ids.begin(), ids.end(), point) - ids.begin());
    }
  }
  return triangles;
}

/** The state of the triangles while edges collapse. Points have local ids. */
class EdgeCollapse
{
public:
  EdgeCollapse(const TriangleSurface & surface,
               const SurfacePart & part,
               const std::vector<std::uint8_t> & isHeld,
               const OriginalSurface & original);

  std::vector<CollapseProgress>
  Run(const CollapseGoal & goal);

  CollapsedPart
  GetResult() const;

private:
  /** A triangle {point, next, last} around a point. */
  struct FanTriangle
  {
    TriangleId id;
    PointId next;
    PointId last;
  };

  /** An edge that may collapse; point \a from vanishes. */
  struct Candidate
  {
    float error;
    PointId from;
    PointId to;
    std::uint32_t version; ///< sum of the points' versions for which the error was computed

    friend bool
    operator<(const Candidate & a, const Candidate & b) // the least error is on top of a priority queue
    {
      return std::tie(a.error, a.from, a.to) > std::tie(b.error, b.from, b.to);
    }
  };

  /** Calls \a visit(triangle, next, last) for each triangle {point, next, last}. */
  template <typename TVisitor>
  void
  ForEachTriangle(PointId point, const TVisitor & visit) const
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
  AddWitnesses(const std::vector<Witness> & witnesses);
  void
  FindBorder();
  void
  AddQuadrics();
  void
  Propose(PointId a, PointId b);
  void
  ProposeAround(PointId point);
  PositionType
  FindPosition(PointId from, PointId to) const;
  bool
  TryCandidate(const Candidate & candidate);
  bool
  KeepsTopology(PointId from, PointId to);
  bool
  KeepsShape(PointId from, PointId to, const PositionType & position) const;
  bool
  KeepsShapeAround(PointId moved, PointId other, const PositionType & position) const;
  bool
  StaysNear(PointId from, PointId to, const PositionType & position);
  void
  CollectFan(PointId from, PointId to);
  bool
  IsNearOriginal(PointId from, PointId to, const PositionType & position);
  bool
  AreWitnessesNear(PointId from, PointId to, const PositionType & position);
  bool
  AssignWitnesses(TriangleId triangle, const PositionType & position);
  void
  Collapse(PointId from, PointId to, const PositionType & position);
  void
  MoveWitnesses();
  void
  MixNormals(PointId from, PointId to, const PositionType & position);

  const OriginalSurface m_Original;
  const std::vector<PointId> m_Ids; ///< the surface's id of each point
  const PositionType m_Origin;      ///< subtracted from positions, to keep digits
  bool m_WasHeldBack = false;
  double m_LargestError = 0.0;
  std::priority_queue<Candidate> m_Candidates;

  // By triangle.
  std::vector<TriangleType> m_Triangles;
  std::vector<std::uint8_t> m_IsLeft;
  std::vector<std::uint8_t> m_IsNew;
  std::size_t m_NumberLeft;

  // By point, except m_NextCorner.
  std::vector<CornerId> m_FirstCorner; ///< one corner at the point; the others follow by m_NextCorner
  std::vector<CornerId> m_NextCorner;  ///< by corner: the next one at the same point
  std::vector<PositionType> m_Positions;
  std::vector<PositionType> m_Normals; ///< empty if the surface has none
  std::vector<Quadric> m_Quadrics;
  std::vector<std::uint32_t> m_Versions; ///< grow when the point takes over another one
  std::vector<std::uint8_t> m_IsOnBorder;
  std::vector<std::uint8_t> m_Stays;
  std::vector<std::uint8_t> m_IsGone;
  std::vector<std::uint8_t> m_HasMoved;
  std::vector<std::uint32_t> m_Marks; ///< equal to m_Mark for the points that are marked
  std::uint32_t m_Mark = 0;

  // Empty unless the distance from the original is limited.
  std::vector<TriangleId> m_Near; ///< by point: a triangle of the original nearby
  std::vector<PointId> m_WitnessPoints;
  std::vector<PositionType> m_WitnessPositions;
  std::vector<WitnessId> m_FirstWitness; ///< by triangle; its other witnesses follow by m_NextWitness
  std::vector<WitnessId> m_NextWitness;

  // The candidate that is tried.
  TriangleId m_NearPosition = 0;                            ///< a triangle of the original near its position
  std::vector<FanTriangle> m_Fan;                           ///< the triangles around its position
  std::vector<std::pair<WitnessId, TriangleId>> m_Assigned; ///< its witnesses and the triangles nearest to them
};

EdgeCollapse::EdgeCollapse(const TriangleSurface & surface,
                           const SurfacePart & part,
                           const std::vector<std::uint8_t> & isHeld,
                           const OriginalSurface & original)
  : m_Original(original)
  , m_Ids(FindPoints(part.triangles))
  , m_Origin(ToPosition(surface.GetPoints()[m_Ids.front()]))
  , m_Triangles(ToLocal(part.triangles, m_Ids))
  , m_IsLeft(m_Triangles.size(), 1)
  , m_IsNew(m_Triangles.size(), 0)
  , m_NumberLeft(m_Triangles.size())
  , m_FirstCorner(m_Ids.size(), None)
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
  for (const PointId id : m_Ids)
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
  for (const PointId id : m_Ids)
  {
    m_Near.push_back((*m_Original.nearPoints)[id]);
  }
  m_FirstWitness.assign(m_Triangles.size(), None);
  for (const Witness & witness : witnesses)
  {
    const auto & point = m_Original.tree->GetSurface().GetPoints()[witness.point];
    m_WitnessPoints.push_back(witness.point);
    m_WitnessPositions.push_back(Subtract(ToPosition(point), m_Origin));
    m_NextWitness.push_back(m_FirstWitness[witness.triangle]);
    m_FirstWitness[witness.triangle] = static_cast<WitnessId>(m_WitnessPositions.size() - 1);
  }
}

/** A point is on the border unless each neighbour follows it in one triangle and precedes it in another. */
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

std::vector<CollapseProgress>
EdgeCollapse::Run(const CollapseGoal & goal)
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
  std::vector<CollapseProgress> progress;
  while (m_NumberLeft > goal.triangles && !m_Candidates.empty())
  {
    const Candidate best = m_Candidates.top();
    m_Candidates.pop();
    if (!this->TryCandidate(best))
    {
      continue;
    }
    this->ProposeAround(best.to);
    if (progress.empty() || best.error > progress.back().error)
    {
      progress.push_back({ best.error, m_NumberLeft });
    }
    progress.back().triangles = m_NumberLeft;
  }
  return progress;
}

/** Collapses an edge if it may collapse; returns whether it did. */
bool
EdgeCollapse::TryCandidate(const Candidate & candidate)
{
  const auto & [error, from, to, version] = candidate;
  if (m_IsGone[from] || m_IsGone[to] || m_Versions[from] + m_Versions[to] != version || !this->KeepsTopology(from, to))
  {
    return false;
  }
  const PositionType position = this->FindPosition(from, to);
  if (!this->KeepsShape(from, to, position))
  {
    return false;
  }
  if (!this->StaysNear(from, to, position))
  {
    m_WasHeldBack = true;
    return false;
  }
  this->Collapse(from, to, position);
  return true;
}

/** Makes an edge a candidate. If one of its points stays, the other one vanishes. */
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
  const double error = quadric.ComputeDistance(this->FindPosition(from, to));
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

/** The position to which an edge collapses, rounded to the surface's precision. */
PositionType
EdgeCollapse::FindPosition(PointId from, PointId to) const
{
  if (m_Stays[to])
  {
    return m_Positions[to];
  }
  const PositionType middle = Mix(m_Positions[from], m_Positions[to], 0.5);
  Quadric quadric = m_Quadrics[from];
  quadric.Add(m_Quadrics[to]);
  PositionType position = quadric.FindMinimum(middle);
  const double squaredEdge = SquaredDistance(m_Positions[to], m_Positions[from]);
  if (!(SquaredDistance(position, middle) <= FarthestPosition * FarthestPosition * squaredEdge))
  {
    position = middle;
  }
  return Subtract(ToPosition(ToPoint(Add(position, m_Origin))), m_Origin);
}

/** The link condition: the common neighbours of the two points are the two points opposite to the edge, and no two
 * triangles become duplicates. The point that vanishes is inside the part, so each of its neighbours follows it in one
 * triangle. */
bool
EdgeCollapse::KeepsTopology(PointId from, PointId to)
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
EdgeCollapse::KeepsShape(PointId from, PointId to, const PositionType & position) const
{
  return this->KeepsShapeAround(from, to, position) && (m_Stays[to] || this->KeepsShapeAround(to, from, position));
}

/** Whether no triangle around a point loses its area, turns by much or becomes a worse sliver than there was before. */
bool
EdgeCollapse::KeepsShapeAround(PointId moved, PointId other, const PositionType & position) const
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
    const Shape after(position, m_Positions[next], m_Positions[last]);
    const auto liesAlong = [&](const PositionType & reference) {
      return Dot(after.normal, reference) > SmallestCosineOfCollapse * after.length * Length(reference);
    };
    isKept = after.quality > 0.0 && after.quality >= std::min(SliverQuality, worstBefore) &&
             (liesAlong(before.normal) || (before.quality < SliverQuality && liesAlong(fanNormal)));
  });
  return isKept;
}

bool
EdgeCollapse::StaysNear(PointId from, PointId to, const PositionType & position)
{
  if (m_Original.tree == nullptr)
  {
    return true;
  }
  this->CollectFan(from, to);
  return this->IsNearOriginal(from, to, position) && this->AreWitnessesNear(from, to, position);
}

/** Collects the triangles that change when an edge collapses. */
void
EdgeCollapse::CollectFan(PointId from, PointId to)
{
  m_Fan.clear();
  const auto collect = [&](PointId moved, PointId other) {
    this->ForEachTriangle(moved, [&](TriangleId id, PointId next, PointId last) {
      if (next != other && last != other)
      {
        m_Fan.push_back({ id, next, last });
      }
    });
  };
  collect(from, to);
  if (!m_Stays[to])
  {
    collect(to, from);
  }
}

/** Checks the position, the middles of the edges there and the centres of the triangles around it. */
bool
EdgeCollapse::IsNearOriginal(PointId from, PointId to, const PositionType & position)
{
  const double squaredLimit = m_Original.limit * m_Original.limit;
  const double squaredEnough = NearEnough * NearEnough * squaredLimit;
  const auto findNear = [&](const PositionType & sample, const std::array<TriangleId, 3> & likely) {
    const PositionType absolute = Add(sample, m_Origin);
    for (const TriangleId triangle : likely)
    {
      const PositionType closest = m_Original.tree->FindClosestPointOfTriangle(absolute, triangle);
      if (SquaredDistance(absolute, closest) <= squaredEnough)
      {
        return triangle;
      }
    }
    return m_Original.tree->FindClosestPoint(absolute, squaredLimit, squaredEnough).triangle;
  };
  m_NearPosition = findNear(position, { m_Near[from], m_Near[to], m_Near[to] });
  return m_NearPosition != TriangleTree::None && std::all_of(m_Fan.begin(), m_Fan.end(), [&](const FanTriangle & fan) {
           const PositionType & next = m_Positions[fan.next];
           const PositionType oppositeMiddle = Mix(next, m_Positions[fan.last], 0.5);
           const std::array<TriangleId, 3> likely{ m_NearPosition, m_Near[fan.next], m_Near[fan.last] };
           return findNear(Mix(position, next, 0.5), likely) != TriangleTree::None &&
                  findNear(Mix(position, oppositeMiddle, 2.0 / 3.0), likely) != TriangleTree::None;
         });
}

/** Whether all witnesses of the triangles at an edge are near the triangles around its new position. */
bool
EdgeCollapse::AreWitnessesNear(PointId from, PointId to, const PositionType & position)
{
  m_Assigned.clear();
  bool areNear = true;
  this->ForEachTriangle(
    from, [&](TriangleId id, PointId, PointId) { areNear = areNear && this->AssignWitnesses(id, position); });
  if (!m_Stays[to])
  {
    this->ForEachTriangle(to, [&](TriangleId id, PointId next, PointId last) {
      if (next != from && last != from)
      {
        areNear = areNear && this->AssignWitnesses(id, position);
      }
    });
  }
  return areNear;
}

/** Assigns the witnesses of a triangle to the nearest triangles around a position, until one is too far away. Returns
 * whether all are near. */
bool
EdgeCollapse::AssignWitnesses(TriangleId triangle, const PositionType & position)
{
  for (WitnessId id = m_FirstWitness[triangle]; id != None; id = m_NextWitness[id])
  {
    const PositionType & witness = m_WitnessPositions[id];
    double least = std::numeric_limits<double>::infinity();
    TriangleId nearest = None;
    for (const FanTriangle & fan : m_Fan)
    {
      const double squared = SquaredDistance(
        witness, ClosestOnTriangle(witness, { position, m_Positions[fan.next], m_Positions[fan.last] }));
      nearest = squared < least ? fan.id : nearest;
      least = std::min(least, squared);
    }
    if (!(least <= m_Original.limit * m_Original.limit))
    {
      return false;
    }
    m_Assigned.emplace_back(id, nearest);
  }
  return true;
}

void
EdgeCollapse::Collapse(PointId from, PointId to, const PositionType & position)
{
  if (!m_Stays[to])
  {
    this->MixNormals(from, to, position);
    m_Positions[to] = position;
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
    m_Near[to] = m_NearPosition;
    this->MoveWitnesses();
  }
}

void
EdgeCollapse::MoveWitnesses()
{
  for (const FanTriangle & fan : m_Fan)
  {
    m_FirstWitness[fan.id] = None;
  }
  for (const auto & [witness, triangle] : m_Assigned)
  {
    m_NextWitness[witness] = m_FirstWitness[triangle];
    m_FirstWitness[triangle] = witness;
  }
}

/** Interpolates the normal at the point of the edge nearest to the new position. */
void
EdgeCollapse::MixNormals(PointId from, PointId to, const PositionType & position)
{
  if (m_Normals.empty())
  {
    return;
  }
  const PositionType edge = Subtract(m_Positions[to], m_Positions[from]);
  const double share = Dot(Subtract(position, m_Positions[from]), edge) / Dot(edge, edge);
  const PositionType mixed = Mix(m_Normals[from], m_Normals[to], std::clamp(share, 0.0, 1.0));
  const double length = Length(mixed);
  if (length > 0.0)
  {
    m_Normals[to] = { mixed[0] / length, mixed[1] / length, mixed[2] / length };
  }
}

CollapsedPart
EdgeCollapse::GetResult() const
{
  CollapsedPart result;
  for (const bool isNew : { false, true })
  {
    for (TriangleId id = 0; id < m_Triangles.size(); ++id)
    {
      if (!m_IsLeft[id] || (m_IsNew[id] != 0) != isNew)
      {
        continue;
      }
      const auto index = static_cast<TriangleId>(result.part.triangles.size());
      const auto & [a, b, c] = m_Triangles[id];
      result.part.triangles.push_back({ m_Ids[a], m_Ids[b], m_Ids[c] });
      result.numberOfOldTriangles += isNew ? 0 : 1;
      for (WitnessId witness = m_FirstWitness.empty() ? None : m_FirstWitness[id]; witness != None;
           witness = m_NextWitness[witness])
      {
        result.part.witnesses.push_back({ m_WitnessPoints[witness], index });
      }
    }
  }
  for (PointId point = 0; point < m_Positions.size(); ++point)
  {
    if (m_HasMoved[point] && !m_IsGone[point])
    {
      result.movedPoints.push_back({ m_Ids[point],
                                     ToPoint(Add(m_Positions[point], m_Origin)),
                                     m_Normals.empty() ? TriangleSurface::NormalType{} : ToPoint(m_Normals[point]),
                                     m_Near.empty() ? None : m_Near[point] });
    }
  }
  result.wasHeldBack = m_WasHeldBack;
  return result;
}

} // namespace

CollapsedPart
CollapseEdges(const TriangleSurface & surface,
              const SurfacePart & part,
              const std::vector<std::uint8_t> & isHeld,
              const OriginalSurface & original,
              const CollapseGoal & goal)
{
  EdgeCollapse collapse(surface, part, isHeld, original);
  const std::vector<CollapseProgress> progress = collapse.Run(goal);
  CollapsedPart result = collapse.GetResult();
  result.progress = progress;
  return result;
}

} // namespace itk
