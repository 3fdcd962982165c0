#include "itkTriangleSurfaceUntangling.h"

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleTree.h"
#include "detail/itkSingleSheets.h"
#include "detail/itkTriangleCells.h"
#include "detail/itkTriangleGrid.h"
#include "detail/itkTrianglesOfPoints.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace itk
{
namespace
{

using Ids = BulkVector<std::uint32_t>;                                        ///< ids of points or triangles
using Places = std::unordered_map<std::uint32_t, TriangleSurface::PointType>; ///< of some points

constexpr int MostUntanglingRounds = 40;
constexpr int Patience = 16;         // rounds without progress: two cycles of relaxing and pushing outwards and inwards
constexpr int FirstPushingRound = 4; // the rounds before only relax
constexpr double PushOverMove = 1.0 / 12.0; // length of a push, over the maximum move
constexpr double RoundedMove = 1.0 - 1e-6;  // over the maximum move, so that the nearest float is within it

/** The points of some triangles, and of the triangles around them if \a withNeighbours. */
Ids
FindPoints(const TriangleSurface & surface, const TrianglesOfPoints & fans, const Ids & triangles, bool withNeighbours)
{
  Ids points;
  const auto add = [&](std::uint32_t triangle) {
    const auto & corners = surface.GetTriangles()[triangle];
    points.insert(points.end(), corners.begin(), corners.end());
  };
  std::for_each(triangles.begin(), triangles.end(), add);
  SortUnique(points);
  if (withNeighbours)
  {
    for (const std::uint32_t point : Ids(points))
    {
      fans.VisitTriangles(point, add);
    }
    SortUnique(points);
  }
  return points;
}

/** The triangles at some points. */
Ids
FindTriangles(const TrianglesOfPoints & fans, const Ids & points)
{
  Ids triangles;
  for (const std::uint32_t point : points)
  {
    fans.VisitTriangles(point, [&](std::uint32_t triangle) { triangles.push_back(triangle); });
  }
  SortUnique(triangles);
  return triangles;
}

/** Half way to the mean of the neighbours, each of which counts once for each triangle at the point. */
PositionType
Relax(const TriangleSurface & surface, const TrianglesOfPoints & fans, std::uint32_t point)
{
  PositionType sum{};
  double count = 0.0;
  fans.VisitTriangles(point, [&](std::uint32_t triangle) {
    for (const std::uint32_t corner : surface.GetTriangles()[triangle])
    {
      if (corner != point)
      {
        sum = Add(sum, ToPosition(surface.GetPoints()[corner]));
        count += 1.0;
      }
    }
  });
  const PositionType position = ToPosition(surface.GetPoints()[point]);
  PositionType relaxed;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    relaxed[axis] = 0.5 * (position[axis] + sum[axis] / count);
  }
  return relaxed;
}

/** The point moved by \a distance along its normal, the mean of the triangles' normals weighted by area. */
PositionType
Push(const TriangleSurface & surface, const TrianglesOfPoints & fans, std::uint32_t point, double distance)
{
  PositionType normal{};
  fans.VisitTriangles(point, [&](std::uint32_t triangle) {
    normal = Add(normal, AreaVector(CornersOf(surface, surface.GetTriangles()[triangle])));
  });
  const double length = Length(normal);
  const double scale = length > 0.0 ? distance / length : 0.0;
  return Along(ToPosition(surface.GetPoints()[point]), normal, scale);
}

/** Moves some points, and notes where they were in \a original if they are not there. The first rounds relax all of
 * them. Later rounds come in fours: one relaxes, three push, outwards in one four and inwards in the next. */
void
MovePoints(TriangleSurface & surface,
           const TrianglesOfPoints & fans,
           Places & original,
           double maximumMove,
           const Ids & points,
           int round)
{
  const bool isPushed = round >= FirstPushingRound && round % 4 != 0;
  const double push = (round / 4 % 2 == 1 ? PushOverMove : -PushOverMove) * maximumMove;
  std::vector<PositionType> positions;
  positions.reserve(points.size());
  for (const std::uint32_t point : points)
  {
    positions.push_back(isPushed ? Push(surface, fans, point, push) : Relax(surface, fans, point));
  }
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    TriangleSurface::PointType & point = surface.GetPoints()[points[n]];
    const PositionType origin = ToPosition(original.emplace(points[n], point).first->second);
    const PositionType offset = Subtract(positions[n], origin);
    const double length = Length(offset);
    const double scale = length > RoundedMove * maximumMove ? RoundedMove * maximumMove / length : 1.0;
    point = ToPoint(Along(origin, offset, scale));
  }
}

bool
HaveAreas(const TriangleSurface & surface, const Ids & triangles)
{
  const auto & points = surface.GetPoints();
  return std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
    const auto & [a, b, c] = surface.GetTriangles()[triangle];
    return HasArea(points[a], points[b], points[c]);
  });
}

/** Puts points at their best places, or back to the original ones. */
void
PutPoints(TriangleSurface & surface, const Places & original, const Places & best)
{
  for (const auto & [point, place] : original)
  {
    const auto found = best.find(point);
    surface.GetPoints()[point] = found != best.end() ? found->second : place;
  }
}

/** Which rounds of moves stay. */
enum class KeptRounds
{
  All,
  Better ///< those after which fewer triangles cross; the moves of others are undone
};

/** \class SearchedTriangles
 * \brief The triangles among which untangling looks for crossings: those near triangles that have moved. */
class SearchedTriangles
{
public:
  /** \param cells nothing to search all triangles
   *  \param triangles about which will move */
  SearchedTriangles(const TriangleSurface & surface, const std::optional<TriangleCells> & cells, const Ids & triangles)
    : m_Surface(surface)
    , m_Cells(cells)
  {
    if (!m_Cells)
    {
      m_Trees.emplace_back(surface);
      return;
    }
    TriangleRegion & region = m_Regions.emplace_back(*m_Cells);
    for (const std::uint32_t triangle : triangles)
    {
      region.Add(TriangleTree::BoxOf(surface.GetPoints(), surface.GetTriangles()[triangle]));
    }
    m_Trees.emplace_back(surface, region.FindTriangles(surface));
  }

  /** The triangles of \a moved that cross others, and these others. */
  Ids
  FindCrossing(const TrianglesOfPoints & fans, const Ids & moved) const
  {
    Ids crossing;
    for (const TriangleTree & tree : m_Trees)
    {
      const Ids found = FindCrossingTriangles(tree, fans, moved);
      crossing.insert(crossing.end(), found.begin(), found.end());
    }
    SortUnique(crossing);
    return crossing;
  }

  /** Must be called when triangles have moved, with their boxes before that. */
  void
  Follow(const Ids & moved, const std::vector<TriangleTree::Box> & before)
  {
    std::optional<TriangleRegion> added;
    for (std::size_t n = 0; n < moved.size(); ++n)
    {
      const auto after = TriangleTree::BoxOf(m_Surface.GetPoints(), m_Surface.GetTriangles()[moved[n]]);
      for (const TriangleTree::Box & box : { before[n], after })
      {
        if (m_Cells && !this->Hold(box))
        {
          (added ? *added : added.emplace(*m_Cells)).Add(Enlarged(box));
        }
      }
      for (TriangleTree & tree : m_Trees)
      {
        tree.Enlarge(before[n], after);
      }
    }
    if (added)
    {
      m_Trees.emplace_back(m_Surface, added->FindTriangles(m_Surface));
      m_Regions.push_back(std::move(*added));
    }
  }

private:
  bool
  Hold(const TriangleTree::Box & box) const
  {
    return std::any_of(m_Regions.begin(), m_Regions.end(), [&box](const auto & region) { return region.Holds(box); });
  }

  /** The box with some of its own size around it, so that regions are not added often. */
  static TriangleTree::Box
  Enlarged(TriangleTree::Box box)
  {
    constexpr float sizes = 3.0f;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const float margin = sizes * (box.highest[axis] - box.lowest[axis]);
      box.lowest[axis] -= margin;
      box.highest[axis] += margin;
    }
    return box;
  }

  const TriangleSurface & m_Surface;
  const std::optional<TriangleCells> & m_Cells;
  std::vector<TriangleRegion> m_Regions; ///< each triangle that has moved is in one as it was and as it is
  std::vector<TriangleTree> m_Trees;     ///< of the triangles that meet each region
};

/** Moves points in rounds, notes where they were in \a original, and leaves the surface in the best state found.
 * Returns the crossing triangles then. */
Ids
Untangle(TriangleSurface & surface,
         SearchedTriangles & searched,
         const TrianglesOfPoints & fans,
         double maximumMove,
         KeptRounds kept,
         Ids crossing,
         Places & original,
         rhombic::StagedProgress & progress)
{
  progress.Begin(kept == KeptRounds::All ? 0.9 : 1.0, MostUntanglingRounds);
  Ids touched; // triangles with a point that was moved
  Places best;
  for (const auto & [point, place] : original)
  {
    best[point] = surface.GetPoints()[point];
  }
  Ids fewest = crossing;
  int lastBetter = 0;
  for (int round = 0; round < MostUntanglingRounds && round <= lastBetter + Patience && !crossing.empty(); ++round)
  {
    const Ids points = FindPoints(surface, fans, crossing, round % 4 == 3);
    const Ids changed = FindTriangles(fans, points); // all triangles that crossed others are among them
    std::vector<TriangleTree::Box> before;
    std::transform(changed.begin(), changed.end(), std::back_inserter(before), [&](std::uint32_t triangle) {
      return TriangleTree::BoxOf(surface.GetPoints(), surface.GetTriangles()[triangle]);
    });
    MovePoints(surface, fans, original, maximumMove, points, round);
    searched.Follow(changed, before);
    const auto added = touched.insert(touched.end(), changed.begin(), changed.end());
    std::inplace_merge(touched.begin(), added, touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    crossing = searched.FindCrossing(fans, changed);
    progress.Completed(1);
    if (crossing.size() < fewest.size() && HaveAreas(surface, touched))
    {
      fewest = crossing;
      lastBetter = round;
      for (const auto & [point, place] : original)
      {
        best[point] = surface.GetPoints()[point];
      }
    }
    else if (kept == KeptRounds::Better)
    {
      PutPoints(surface, original, best);
      crossing = fewest;
    }
  }
  PutPoints(surface, original, best);
  surface.Modified();
  return fewest;
}

/** The triangles that cross others. */
Ids
FindCrossing(const TriangleSurface & surface,
             const TrianglesOfPoints & fans,
             const std::optional<TriangleSizes> & sizes,
             rhombic::StagedProgress & progress)
{
  constexpr double stageEnd = 0.5;
  if (const auto suspects = sizes ? FindTrianglesOutsideSingleSheets(surface, *sizes) : std::nullopt)
  {
    return FindCrossingTriangles(
      TriangleTree(surface, *suspects), fans, TriangleContact::Crossing, &progress, stageEnd);
  }
  if (sizes)
  {
    const TriangleGrid grid(surface, *sizes, FindUnfoldedPoints(surface, fans));
    return FindCrossingTriangles(grid, progress, stageEnd);
  }
  return FindCrossingTriangles(TriangleTree(surface), fans, TriangleContact::Crossing, &progress, stageEnd);
}

} // namespace

TriangleSurfaceUntanglingReport
UntangleTriangleSurface(TriangleSurface & surface,
                        double maximumMove,
                        const std::optional<CrossingCandidates> & candidates,
                        const rhombic::ProgressFunction & report)
{
  if (!(maximumMove > 0.0) || !std::isfinite(maximumMove))
  {
    itkGenericExceptionMacro("Untangling needs a distance above 0 mm that points may move, not " << maximumMove << ".");
  }
  rhombic::StagedProgress progress(report);
  const TrianglesOfPoints fans(surface);
  std::optional<TriangleSizes> sizes = candidates ? std::nullopt : TriangleSizes::Find(surface);
  Ids crossing =
    candidates ? FindCrossingTriangles(surface, fans, *candidates) : FindCrossing(surface, fans, sizes, progress);
  if (crossing.empty())
  {
    return {};
  }
  TriangleSurfaceUntanglingReport result;
  result.crossingBefore = crossing.size();
  sizes = sizes ? sizes : TriangleSizes::Find(surface);
  constexpr double cellOverMean = 2.5;
  const auto cells = sizes ? std::make_optional<TriangleCells>(*sizes, cellOverMean) : std::nullopt;
  Places original;
  SearchedTriangles searched(surface, cells, FindTriangles(fans, FindPoints(surface, fans, crossing, true)));
  for (const KeptRounds kept : { KeptRounds::All, KeptRounds::Better })
  {
    crossing = Untangle(surface, searched, fans, maximumMove, kept, std::move(crossing), original, progress);
  }
  result.crossingAfter = crossing.size();
  for (const auto & [point, place] : original)
  {
    const auto & moved = surface.GetPoints()[point];
    result.pointsMoved += moved != place ? 1 : 0;
    result.largestMove = std::max(result.largestMove, Distance(ToPosition(moved), ToPosition(place)));
  }
  return result;
}

} // namespace itk
