#include "itkEdgeCollapse.h"

#include "detail/itkClosestOnTriangle.h"
#include "itkTriangleDistances.h"
#include "itkQuadric.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
constexpr double SliverQuality = 0.1; // the normal of a worse triangle is unreliable, and no new triangle may be worse
constexpr unsigned int MostAround = 64;  // triangles around a point that vanishes; more would take too long
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

/** Numbers for the distinct points of some triangles: indices into their ascending ids. */
class LocalIds
{
public:
  explicit LocalIds(const std::pmr::vector<TriangleType> & triangles)
  {
    std::size_t size = 16;
    while (size < 3 * triangles.size()) // closed surfaces have a sixth as many points
    {
      size *= 2;
    }
    m_Slots.assign(size, { None, 0 });
    for (const TriangleType & triangle : triangles)
    {
      for (const PointId id : triangle)
      {
        Slot & slot = this->FindSlot(id);
        if (slot.id == None)
        {
          slot.id = id;
          m_Ids.push_back(id);
        }
      }
    }
    std::sort(m_Ids.begin(), m_Ids.end());
    for (PointId local = 0; local < m_Ids.size(); ++local)
    {
      this->FindSlot(m_Ids[local]).local = local;
    }
  }

  const std::vector<PointId> &
  GetIds() const
  {
    return m_Ids;
  }

  std::pmr::vector<TriangleType>
  ToLocal(std::pmr::vector<TriangleType> triangles)
  {
    for (TriangleType & triangle : triangles)
    {
      for (PointId & point : triangle)
      {
        point = this->FindSlot(point).local;
      }
    }
    return triangles;
  }

private:
  struct Slot
  {
    PointId id; ///< None if the slot is free
    PointId local;
  };

  /** The slot of an id, or the free one where it belongs. */
  Slot &
  FindSlot(PointId id)
  {
    constexpr std::uint32_t golden = 0x9e3779b9; // 2^32 divided by the golden ratio, which scatters successive numbers
    std::size_t place = (id * golden >> 8) & (m_Slots.size() - 1);
    while (m_Slots[place].id != id && m_Slots[place].id != None)
    {
      place = (place + 1) & (m_Slots.size() - 1);
    }
    return m_Slots[place];
  }

  std::vector<Slot> m_Slots; ///< a power of two, more than there are points
  std::vector<PointId> m_Ids;
};

/** The state of the triangles while edges collapse. Points have local ids. */
class EdgeCollapse
{
public:
  EdgeCollapse(const SurfaceOfParts & whole, const SurfacePart & part, LocalIds ids)
    : m_Original(whole.original)
    , m_Ids(ids.GetIds())
    , m_Origin(ToPosition(whole.surface.GetPoints()[m_Ids.front()]))
    , m_Triangles(ids.ToLocal(part.triangles))
    , m_Sheets(part.sheets)
    , m_Remains(m_Triangles.size(), 1)
    , m_Remaining(m_Triangles.size())
    , m_Changes(m_Triangles.size(), 0)
    , m_FirstCorner(m_Ids.size(), None)
    , m_NextCorner(3 * m_Triangles.size())
    , m_IsGone(m_Ids.size(), 0)
    , m_HasMoved(m_Ids.size(), 0)
    , m_Near(m_Ids.size(), None)
  {
    this->LinkCorners();
    m_Positions.reserve(m_Ids.size());
    for (const PointId id : m_Ids)
    {
      m_Positions.push_back(Subtract(ToPosition(whole.surface.GetPoints()[id]), m_Origin));
      if (whole.surface.HasNormals())
      {
        m_Normals.push_back(ToPosition(whole.surface.GetNormals()[id]));
      }
    }
    std::vector<std::uint32_t> inPart(m_Ids.size(), 0);
    for (const TriangleType & triangle : m_Triangles)
    {
      for (const PointId point : triangle)
      {
        ++inPart[point];
      }
    }
    for (PointId point = 0; point < m_Ids.size(); ++point)
    {
      const PointId id = m_Ids[point];
      m_Strata.push_back(whole.points.strata[id]);
      m_IsOnBorder.push_back(m_Strata[point] == Stratum::Fixed || inPart[point] != whole.points.triangles[id] ? 1 : 0);
      m_Stays.push_back(m_IsOnBorder[point] | whole.points.isHeld[id]);
    }
    if (m_Original.surface != nullptr)
    {
      this->AddWitnesses(part.witnesses);
    }
  }

  CollapseLog
  Run(double largestError, std::size_t fewestTriangles)
  {
    m_LargestError = largestError;
    m_Versions.assign(m_Ids.size(), 0);
    m_Marks.assign(m_Ids.size(), 0);
    this->AddQuadrics();
    this->ProposeAll();
    CollapseLog log;
    while (!m_Candidates.empty() && m_Remaining > fewestTriangles)
    {
      const Candidate best = m_Candidates.top();
      m_Candidates.pop();
      if (this->TryCandidate(best, log))
      {
        this->CollectFan(best.to, m_ToFan);
        for (const FanTriangle & fan : m_ToFan)
        {
          this->Propose(best.to, fan.next);
        }
      }
    }
    log.wasHeldBack = m_WasHeldBack;
    return log;
  }

  void
  Replay(const CollapseLog & log, const std::pmr::vector<std::uint16_t> & mostChanges)
  {
    m_IsOther.assign(m_Ids.size(), 0);
    for (const EdgeToCollapse & edge : log.edges)
    {
      this->CollectFans(edge.from, edge.to);
      if (!this->IsAsLogged() || !this->MayChange(mostChanges))
      {
        m_IsOther[edge.from] = m_IsOther[edge.to] = 1;
        continue;
      }
      this->CollectWitnesses();
      m_Covering.assign(log.covering.begin() + edge.witnesses - static_cast<std::ptrdiff_t>(m_Moved.size()),
                        log.covering.begin() + edge.witnesses);
      this->Collapse(edge);
    }
  }

  CollapsedPart
  GetResult() const
  {
    CollapsedPart result;
    for (const bool isNew : { false, true })
    {
      for (TriangleId id = 0; id < m_Triangles.size(); ++id)
      {
        if (!m_Remains[id] || (m_Changes[id] > 0) != isNew)
        {
          continue;
        }
        const auto index = static_cast<TriangleId>(result.part.triangles.size());
        const auto & [a, b, c] = m_Triangles[id];
        result.part.triangles.push_back({ m_Ids[a], m_Ids[b], m_Ids[c] });
        result.part.sheets.push_back(m_Sheets[id]);
        result.ids.push_back(id);
        result.changes.push_back(m_Changes[id]);
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
                                       m_Near[point] });
      }
    }
    return result;
  }

private:
  /** A triangle {point, next, last} around a point. */
  struct FanTriangle
  {
    TriangleId id;
    PointId next;
    PointId last;
  };

  using Fan = std::vector<FanTriangle>;

  /** A witness and the sheet that it lies in. */
  struct MovedWitness
  {
    WitnessId witness;
    std::uint32_t sheet;
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

  void
  LinkCorners()
  {
    for (CornerId corner = 0; corner < m_NextCorner.size(); ++corner)
    {
      const PointId point = m_Triangles[corner / 3][corner % 3];
      m_NextCorner[corner] = m_FirstCorner[point];
      m_FirstCorner[point] = corner;
    }
  }

  void
  AddWitnesses(const std::pmr::vector<Witness> & witnesses)
  {
    m_FirstWitness.assign(m_Triangles.size(), None);
    for (const Witness & witness : witnesses)
    {
      m_WitnessPoints.push_back(witness.point);
      m_WitnessPositions.push_back(Subtract(ToPosition(m_Original.surface->GetPoints()[witness.point]), m_Origin));
      m_NextWitness.push_back(m_FirstWitness[witness.triangle]);
      m_FirstWitness[witness.triangle] = static_cast<WitnessId>(m_WitnessPositions.size() - 1);
    }
  }

  void
  AddQuadrics()
  {
    m_Quadrics.resize(m_Ids.size());
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

  void
  ProposeAll()
  {
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
  }

  /** Makes an edge a candidate. If one of its points stays or is of a higher stratum, the other point vanishes. */
  void
  Propose(PointId a, PointId b)
  {
    if (m_Stays[a] && m_Stays[b])
    {
      return;
    }
    const bool keepsFirst = m_Stays[a] || (!m_Stays[b] && m_Strata[a] > m_Strata[b]);
    const PointId from = keepsFirst ? b : a;
    const PointId to = keepsFirst ? a : b;
    if (m_Strata[from] > m_Strata[to])
    {
      return;
    }
    Quadric quadric = m_Quadrics[from];
    quadric.Add(m_Quadrics[to]);
    const double error = quadric.ComputeDistance(this->FindPosition(from, to, quadric));
    if (error <= m_LargestError)
    {
      m_Candidates.push({ static_cast<float>(error), from, to, m_Versions[from] + m_Versions[to] });
    }
    else
    {
      m_WasHeldBack = true;
    }
  }

  /** Whether the point to which an edge collapses stays where it is. */
  bool
  KeepsPlace(PointId from, PointId to) const
  {
    return m_Stays[to] || m_Strata[to] > m_Strata[from];
  }

  /** The position to which an edge collapses, rounded to the surface's precision. \param quadric the sum of both */
  PositionType
  FindPosition(PointId from, PointId to, const Quadric & quadric) const
  {
    if (this->KeepsPlace(from, to))
    {
      return m_Positions[to];
    }
    const PositionType middle = Mix(m_Positions[from], m_Positions[to], 0.5);
    PositionType position = quadric.FindMinimum(middle);
    const double squaredEdge = SquaredDistance(m_Positions[to], m_Positions[from]);
    if (!(SquaredDistance(position, middle) <= FarthestPosition * FarthestPosition * squaredEdge))
    {
      position = middle;
    }
    return Subtract(ToPosition(ToPoint(Add(position, m_Origin))), m_Origin);
  }

  /** Collapses an edge if it may collapse; returns whether it did. */
  bool
  TryCandidate(const Candidate & candidate, CollapseLog & log)
  {
    const auto & [error, from, to, version] = candidate;
    if (m_IsGone[from] || m_IsGone[to] || m_Versions[from] + m_Versions[to] != version)
    {
      return false;
    }
    this->CollectFans(from, to);
    if (!this->KeepsTopology(from, to))
    {
      return false;
    }
    Quadric quadric = m_Quadrics[from];
    quadric.Add(m_Quadrics[to]);
    EdgeToCollapse edge{ from, to, this->FindPosition(from, to, quadric), None, 0, error };
    if (!this->KeepsShape(from, to, edge.position) || !this->KeepsOrder(from, to, edge.position))
    {
      return false;
    }
    if (!this->StaysNear(edge))
    {
      m_WasHeldBack = true;
      return false;
    }
    m_Quadrics[to].Add(m_Quadrics[from]);
    m_Versions[to] += m_Versions[from] + 1;
    this->Collapse(edge);
    log.covering.insert(log.covering.end(), m_Covering.begin(), m_Covering.end());
    edge.witnesses = static_cast<std::uint32_t>(log.covering.size());
    edge.error = log.edges.empty() ? edge.error : std::max(edge.error, log.edges.back().error);
    log.edges.push_back(edge);
    return true;
  }

  /** Also unlinks the corners of triangles that are gone. */
  void
  CollectFan(PointId point, Fan & fan)
  {
    fan.clear();
    for (CornerId * link = &m_FirstCorner[point]; *link != None;)
    {
      const CornerId corner = *link;
      const TriangleId id = corner / 3;
      if (!m_Remains[id])
      {
        *link = m_NextCorner[corner];
        continue;
      }
      const TriangleType & triangle = m_Triangles[id];
      fan.push_back({ id, triangle[(corner + 1) % 3], triangle[(corner + 2) % 3] });
      link = &m_NextCorner[corner];
    }
  }

  /** Collects the triangles at the two points of an edge, and those of them that change when it collapses. */
  void
  CollectFans(PointId from, PointId to)
  {
    this->CollectFan(from, m_FromFan);
    this->CollectFan(to, m_ToFan);
    m_Changed.clear();
    for (const FanTriangle & fan : m_FromFan)
    {
      if (fan.next != to && fan.last != to)
      {
        m_Changed.push_back(fan);
      }
    }
    m_NumberFromChanged = m_Changed.size();
    for (const FanTriangle & fan : m_ToFan)
    {
      if (!this->KeepsPlace(from, to) && fan.next != from && fan.last != from)
      {
        m_Changed.push_back(fan);
      }
    }
  }

  /** The link condition: the common neighbours of the two points are the points opposite to the edge, and no two
   * triangles become duplicates. A point of a curve vanishes along the curve, and not where the curve would close or
   * meet another. The point that vanishes is inside the part. */
  bool
  KeepsTopology(PointId from, PointId to)
  {
    m_Mark += 2; // m_Mark for neighbours of point to, m_Mark + 1 for neighbours of both points
    for (const FanTriangle & fan : m_ToFan)
    {
      m_Marks[fan.next] = m_Mark;
      m_Marks[fan.last] = m_Mark;
    }
    std::size_t common = 0;
    bool joinsBorder = false;
    for (const FanTriangle & fan : m_FromFan)
    {
      for (const PointId point : { fan.next, fan.last })
      {
        if (point != to && m_Marks[point] == m_Mark)
        {
          m_Marks[point] = m_Mark + 1;
          ++common;
        }
        joinsBorder =
          joinsBorder || (point != to && m_Marks[point] < m_Mark && m_IsOnBorder[to] && m_IsOnBorder[point]);
      }
    }
    const std::size_t opposite = m_FromFan.size() - m_NumberFromChanged;
    const bool isAlong = m_Strata[from] == Stratum::Sheet ? opposite == 2 : opposite > 2;
    return common == opposite && isAlong && !joinsBorder && m_FromFan.size() <= MostAround &&
           this->KeepsTriangles(from, to);
  }

  /** Whether no two triangles become duplicates, and no two edges of curves. Common neighbours are marked. */
  bool
  KeepsTriangles(PointId from, PointId to) const
  {
    const auto isCommon = [&](PointId point) { return m_Marks[point] == m_Mark + 1; };
    const auto isDuplicate = [&](const FanTriangle & fan) {
      return isCommon(fan.next) && isCommon(fan.last) &&
             std::any_of(m_FromFan.begin(), m_FromFan.end(), [&](const FanTriangle & other) {
               return (fan.next == other.last && fan.last == other.next) ||
                      (fan.next == other.next && fan.last == other.last);
             });
    };
    const auto closesCurve = [&](const FanTriangle & fan) {
      const PointId opposite = fan.next == to ? fan.last : fan.next;
      return (fan.next == to || fan.last == to) &&
             std::count_if(m_FromFan.begin(), m_FromFan.end(), [&](const FanTriangle & other) {
               return other.next == opposite || other.last == opposite;
             }) > 2;
    };
    return std::none_of(m_ToFan.begin(), m_ToFan.end(), isDuplicate) &&
           (m_Strata[from] == Stratum::Sheet || std::none_of(m_FromFan.begin(), m_FromFan.end(), closesCurve));
  }

  bool
  KeepsShape(PointId from, PointId to, const PositionType & position) const
  {
    return this->KeepsShapeAround(from, to, m_FromFan, position) &&
           (this->KeepsPlace(from, to) || this->KeepsShapeAround(to, from, m_ToFan, position));
  }

  /** Whether no triangle around a point loses its area, turns by much or becomes a worse sliver than there was before.
   */
  bool
  KeepsShapeAround(PointId moved, PointId other, const Fan & fan, const PositionType & position) const
  {
    const auto shapeOf = [&](const FanTriangle & triangle) {
      return Shape(m_Positions[moved], m_Positions[triangle.next], m_Positions[triangle.last]);
    };
    double worstBefore = 1.0;
    for (const FanTriangle & triangle : fan)
    {
      worstBefore = std::min(worstBefore, shapeOf(triangle).quality);
    }
    const auto normalOf = [&](std::uint32_t sheet) {
      PositionType sum{};
      for (const FanTriangle & triangle : fan)
      {
        sum = m_Sheets[triangle.id] == sheet ? Add(sum, shapeOf(triangle).normal) : sum;
      }
      return sum;
    };
    return std::all_of(fan.begin(), fan.end(), [&](const FanTriangle & triangle) {
      const auto & [id, next, last] = triangle;
      if (next == other || last == other)
      {
        return true;
      }
      const Shape before = shapeOf(triangle);
      const Shape after(position, m_Positions[next], m_Positions[last]);
      const auto liesAlong = [&](const PositionType & reference) {
        return Dot(after.normal, reference) > SmallestCosineOfCollapse * after.length * Length(reference);
      };
      return after.quality > 0.0 && after.quality >= std::min(SliverQuality, worstBefore) &&
             (liesAlong(before.normal) || (before.quality < SliverQuality && liesAlong(normalOf(m_Sheets[id]))));
    });
  }

  /** A triangle at an edge: its third corner, and its sheet. */
  struct Leaf
  {
    PositionType apex;
    std::uint32_t sheet;
  };

  /** The sheets around an edge in their order, as seen along the edge from \a begin. */
  static std::vector<std::uint32_t>
  OrderSheets(const PositionType & begin, const PositionType & end, const std::vector<Leaf> & leaves)
  {
    const PositionType axis = Subtract(end, begin);
    const PositionType side = Subtract(leaves.front().apex, begin); // at angle 0
    const PositionType up = Cross(axis, side);
    const PositionType along = Cross(up, axis);
    std::vector<std::pair<double, std::uint32_t>> angles;
    for (const Leaf & leaf : leaves)
    {
      const PositionType way = Subtract(leaf.apex, begin);
      angles.emplace_back(std::atan2(Dot(way, up) * Length(axis), Dot(way, along)), leaf.sheet);
    }
    std::sort(angles.begin(), angles.end());
    std::vector<std::uint32_t> sheets;
    for (const auto & [angle, sheet] : angles)
    {
      sheets.push_back(sheet);
    }
    return sheets;
  }

  /** Whether sheets have the same order around an edge, from whichever sheet on. */
  static bool
  HaveSameOrder(std::vector<std::uint32_t> a, const std::vector<std::uint32_t> & b)
  {
    for (std::size_t n = 0; n < a.size(); ++n)
    {
      if (a == b)
      {
        return true;
      }
      std::rotate(a.begin(), a.begin() + 1, a.end());
    }
    return false;
  }

  /** The triangles of a fan at \a point with another point, but those with a third point. */
  std::vector<Leaf>
  FindLeaves(const Fan & fan, PointId other, PointId without = None) const
  {
    std::vector<Leaf> leaves;
    for (const auto & [id, next, last] : fan)
    {
      if ((next == other || last == other) && next != without && last != without)
      {
        leaves.push_back({ m_Positions[next == other ? last : next], m_Sheets[id] });
      }
    }
    return leaves;
  }

  /** Whether sheets keep their order around each edge of a curve. Where sheets change places, they enclose a region the
   * wrong way round, without a crossing. */
  bool
  KeepsOrder(PointId from, PointId to, const PositionType & position)
  {
    const auto isOnCurve = [this](PointId point) { return m_Strata[point] != Stratum::Sheet; };
    const auto keepsAtPoint = [&](PointId other) { // the edge between the position and the other point
      const bool isOfTo = this->FindLeaves(m_ToFan, other).size() > 2;
      const PointId before = isOfTo ? to : from;
      const std::vector<Leaf> leaves = this->FindLeaves(isOfTo ? m_ToFan : m_FromFan, other);
      std::vector<Leaf> leavesAfter = this->FindLeaves(m_FromFan, other, to);
      const std::vector<Leaf> ofTo = this->FindLeaves(m_ToFan, other, from);
      leavesAfter.insert(leavesAfter.end(), ofTo.begin(), ofTo.end());
      return leaves.size() < 3 || HaveSameOrder(OrderSheets(m_Positions[before], m_Positions[other], leaves),
                                                OrderSheets(position, m_Positions[other], leavesAfter));
    };
    const auto keepsOpposite = [&](PointId next, PointId last, PointId moved) {
      Fan fan;
      this->CollectFan(next, fan);
      const std::vector<Leaf> leaves = this->FindLeaves(fan, last);
      std::vector<Leaf> leavesAfter = this->FindLeaves(fan, last, moved);
      for (const auto & [id, a, b] : fan)
      {
        if ((a == last && b == moved) || (b == last && a == moved))
        {
          leavesAfter.push_back({ position, m_Sheets[id] });
        }
      }
      return leaves.size() < 3 || HaveSameOrder(OrderSheets(m_Positions[next], m_Positions[last], leaves),
                                                OrderSheets(m_Positions[next], m_Positions[last], leavesAfter));
    };
    for (std::size_t n = 0; n < m_Changed.size(); ++n)
    {
      const auto & [id, next, last] = m_Changed[n];
      if ((isOnCurve(next) && !keepsAtPoint(next)) || (isOnCurve(last) && !keepsAtPoint(last)) ||
          (isOnCurve(next) && isOnCurve(last) && !keepsOpposite(next, last, n < m_NumberFromChanged ? from : to)))
      {
        return false;
      }
    }
    return true;
  }

  bool
  StaysNear(EdgeToCollapse & edge)
  {
    return m_Original.surface == nullptr || (this->IsNearOriginal(edge) && this->AreWitnessesNear(edge.position));
  }

  /** Checks the position, the middles of the edges there and the centres of the triangles around it: a witness around
   * the edge, or a triangle of the original at the nearest one, must be near. */
  bool
  IsNearOriginal(EdgeToCollapse & edge)
  {
    m_Around.clear();
    m_NearestPoints.Clear();
    for (const Fan & fan : std::array<std::reference_wrapper<const Fan>, 2>{ m_FromFan, m_ToFan })
    {
      for (const FanTriangle & triangle : fan)
      {
        for (WitnessId id = m_FirstWitness[triangle.id]; id != None; id = m_NextWitness[id])
        {
          m_Around.push_back(id);
          m_NearestPoints.AddPoint(m_WitnessPositions[id]);
        }
      }
    }
    if (m_Around.empty())
    {
      return false;
    }
    const PositionType & position = edge.position;
    m_Samples.assign(1, position);
    for (const FanTriangle & fan : m_Changed)
    {
      const PositionType & next = m_Positions[fan.next];
      const PositionType oppositeMiddle = Mix(next, m_Positions[fan.last], 0.5);
      m_Samples.push_back(Mix(position, next, 0.5));
      m_Samples.push_back(Mix(position, oppositeMiddle, 2.0 / 3.0));
    }
    std::for_each(
      m_Samples.begin(), m_Samples.end(), [this](const auto & sample) { m_NearestPoints.AddSample(sample); });
    m_NearestPoints.Find();
    edge.near = this->FindNear(0);
    bool areNear = edge.near != None;
    for (std::size_t n = 1; n < m_Samples.size() && areNear; ++n)
    {
      areNear =
        m_NearestPoints.GetSquaredDistance(n) <= m_Original.limit * m_Original.limit || this->FindNear(n) != None;
    }
    return areNear;
  }

  /** A triangle of the original near sample \a n, among those at the nearest witness around the edge; None if there is
   * none. */
  TriangleId
  FindNear(std::size_t n) const
  {
    const PositionType absolute = Add(m_Samples[n], m_Origin);
    TriangleId nearest = None;
    double least = m_Original.limit * m_Original.limit;
    m_Original.triangles->VisitTriangles(m_WitnessPoints[m_Around[m_NearestPoints.GetPoint(n)]], [&](TriangleId id) {
      const CornersType corners = CornersOf(*m_Original.surface, m_Original.surface->GetTriangles()[id]);
      const double squared = SquaredDistance(absolute, ClosestOnTriangle(absolute, corners));
      nearest = squared <= least ? id : nearest;
      least = std::min(least, squared);
    });
    return nearest;
  }

  /** Collects the witnesses that move when the edge collapses: those of all triangles of the vanishing point, and of
   * those of the other that change. */
  void
  CollectWitnesses()
  {
    m_Moved.clear();
    if (m_Original.surface == nullptr)
    {
      return;
    }
    const auto collect = [&](const FanTriangle & fan) {
      for (WitnessId id = m_FirstWitness[fan.id]; id != None; id = m_NextWitness[id])
      {
        m_Moved.push_back({ id, m_Sheets[fan.id] });
      }
    };
    std::for_each(m_FromFan.begin(), m_FromFan.end(), collect);
    std::for_each(m_Changed.begin() + static_cast<std::ptrdiff_t>(m_NumberFromChanged), m_Changed.end(), collect);
  }

  /** Finds for each witness that moves the nearest triangle of its sheet around the position. Returns whether all are
   * near. */
  bool
  AreWitnessesNear(const PositionType & position)
  {
    this->CollectWitnesses();
    m_FanDistances.Begin(m_Moved.size());
    for (std::size_t n = 0; n < m_Moved.size(); ++n)
    {
      m_FanDistances.SetWitness(n, Subtract(m_WitnessPositions[m_Moved[n].witness], position), m_Moved[n].sheet);
    }
    for (const FanTriangle & fan : m_Changed)
    {
      m_FanDistances.AddTriangle(
        Subtract(m_Positions[fan.next], position), Subtract(m_Positions[fan.last], position), m_Sheets[fan.id]);
    }
    return m_FanDistances.FindNearest(m_Original.limit * m_Original.limit, m_Covering);
  }

  /** Whether all points around an edge, and its own, are as they were. */
  bool
  IsAsLogged() const
  {
    const auto isAsLogged = [&](const FanTriangle & fan) { return !m_IsOther[fan.next] && !m_IsOther[fan.last]; };
    return std::all_of(m_FromFan.begin(), m_FromFan.end(), isAsLogged) &&
           std::all_of(m_ToFan.begin(), m_ToFan.end(), isAsLogged);
  }

  bool
  MayChange(const std::pmr::vector<std::uint16_t> & mostChanges) const
  {
    return std::all_of(m_Changed.begin(), m_Changed.end(), [&](const FanTriangle & fan) {
      return m_Changes[fan.id] < mostChanges[fan.id];
    });
  }

  void
  Collapse(const EdgeToCollapse & edge)
  {
    const auto & [from, to, position, near, witnesses, error] = edge;
    if (!this->KeepsPlace(from, to))
    {
      this->MixNormals(from, to, position);
      m_Positions[to] = position;
      m_Near[to] = near;
      m_HasMoved[to] = 1;
    }
    m_IsGone[from] = 1;
    for (CornerId corner = m_FirstCorner[from], next = None; corner != None; corner = next)
    {
      next = m_NextCorner[corner];
      TriangleType & triangle = m_Triangles[corner / 3];
      if (!m_Remains[corner / 3])
      {
        continue;
      }
      if (std::find(triangle.begin(), triangle.end(), to) != triangle.end())
      {
        m_Remains[corner / 3] = 0;
        --m_Remaining;
        continue;
      }
      triangle[corner % 3] = to;
      m_NextCorner[corner] = m_FirstCorner[to];
      m_FirstCorner[to] = corner;
    }
    for (const FanTriangle & fan : m_Changed)
    {
      ++m_Changes[fan.id];
    }
    if (m_Original.surface != nullptr)
    {
      this->MoveWitnesses();
    }
  }

  void
  MoveWitnesses()
  {
    for (const FanTriangle & fan : m_Changed)
    {
      m_FirstWitness[fan.id] = None;
    }
    for (std::size_t n = 0; n < m_Moved.size(); ++n)
    {
      WitnessId & first = m_FirstWitness[m_Changed[m_Covering[n]].id];
      m_NextWitness[m_Moved[n].witness] = first;
      first = m_Moved[n].witness;
    }
  }

  /** Interpolates the normal at the point of the edge nearest to the new position. */
  void
  MixNormals(PointId from, PointId to, const PositionType & position)
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

  const OriginalSurface m_Original;
  const std::vector<PointId> m_Ids; ///< the surface's id of each point
  const PositionType m_Origin;      ///< subtracted from positions, to keep digits
  double m_LargestError = 0.0;
  bool m_WasHeldBack = false;
  std::priority_queue<Candidate> m_Candidates;

  // By triangle.
  std::pmr::vector<TriangleType> m_Triangles;
  const std::pmr::vector<std::uint32_t> m_Sheets;
  std::vector<std::uint8_t> m_Remains;
  std::size_t m_Remaining; ///< triangles
  std::vector<std::uint16_t> m_Changes;

  // By point, except m_NextCorner.
  std::vector<CornerId> m_FirstCorner; ///< one corner at the point; the others follow by m_NextCorner
  std::vector<CornerId> m_NextCorner;  ///< by corner: the next corner at the same point
  std::vector<PositionType> m_Positions;
  std::vector<PositionType> m_Normals; ///< empty if the surface has none
  std::vector<Quadric> m_Quadrics;
  std::vector<std::uint32_t> m_Versions; ///< grow when the point takes over another point
  std::vector<Stratum> m_Strata;
  std::vector<std::uint8_t> m_IsOnBorder; ///< of the part, or fixed
  std::vector<std::uint8_t> m_Stays;      ///< on the border or held
  std::vector<std::uint8_t> m_IsGone;
  std::vector<std::uint8_t> m_HasMoved;
  std::vector<std::uint8_t> m_IsOther; ///< while a log is replayed: whether the point is not as it was
  std::vector<std::uint32_t> m_Marks;  ///< equal to m_Mark for the points that are marked
  std::uint32_t m_Mark = 0;

  // Empty unless the distance from the original is limited.
  std::vector<TriangleId> m_Near; ///< by point: a triangle of the original near its new position
  std::vector<PointId> m_WitnessPoints;
  std::vector<PositionType> m_WitnessPositions;
  std::vector<WitnessId> m_FirstWitness; ///< by triangle; its other witnesses follow by m_NextWitness
  std::vector<WitnessId> m_NextWitness;

  // The candidate that is tried.
  std::vector<WitnessId> m_Around;     ///< the witnesses of all triangles at its points
  std::vector<PositionType> m_Samples; ///< its position, and others around it
  NearestPoints m_NearestPoints;       ///< the nearest of m_Around for each of m_Samples
  Fan m_FromFan;
  Fan m_ToFan;
  Fan m_Changed;                         ///< the triangles around its position that change
  std::size_t m_NumberFromChanged = 0;   ///< of them, at the vanishing point; they come first
  std::vector<MovedWitness> m_Moved;     ///< its witnesses
  std::vector<std::uint16_t> m_Covering; ///< for each of them, which of the changed triangles is nearest
  FanDistances m_FanDistances;
};

} // namespace

CollapseLog
CollapseEdges(const SurfaceOfParts & whole,
              const SurfacePart & part,
              double largestError,
              std::size_t fewestTriangles,
              CollapsedPart & collapsed)
{
  EdgeCollapse collapse(whole, part, LocalIds(part.triangles));
  CollapseLog log = collapse.Run(largestError, fewestTriangles);
  collapsed = collapse.GetResult();
  return log;
}

CollapsedPart
ReplayCollapses(const SurfaceOfParts & whole,
                const SurfacePart & part,
                const CollapseLog & log,
                const std::pmr::vector<std::uint16_t> & mostChanges)
{
  EdgeCollapse collapse(whole, part, LocalIds(part.triangles));
  collapse.Replay(log, mostChanges);
  return collapse.GetResult();
}

} // namespace itk
