#include "itkTriangleSurfaceSmoothing.h"

#include "detail/itkBoundedMoves.h"

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;

// Taubin's filter passes frequencies of the graph Laplacian up to 1 / Inwards + 1 / Outwards = 0.1, of [0, 2].
constexpr double Inwards = 0.5;
constexpr double Outwards = -1.0 / (1.0 / Inwards - 0.1);

/** The points towards whose mean each point moves: those around it in a sheet, the two beside it on a curve, none if it
 * stays. */
class Neighbours
{
public:
  Neighbours(const TrianglesOfPoints & fans, const PointStrata & strata)
    : m_Begin(1, 0)
  {
    m_Begin.reserve(strata.strata.size() + 1);
    auto curve = strata.curves.begin();
    for (PointId point = 0; point < strata.strata.size(); ++point)
    {
      if (strata.strata[point] == Stratum::Sheet)
      {
        fans.VisitNeighbours(point, [&](PointId next, PointId) { m_Ids.push_back(next); });
      }
      else if (strata.strata[point] == Stratum::Curve)
      {
        m_Ids.insert(m_Ids.end(), curve->neighbours.begin(), curve->neighbours.end());
        ++curve;
      }
      m_Begin.push_back(m_Ids.size());
    }
  }

  /** The point moved by \a share of the way to the mean. */
  PointType
  MoveTowardsMean(const Points & points, SizeValueType point, double share) const
  {
    const std::size_t count = m_Begin[point + 1] - m_Begin[point];
    const PositionType position = ToPosition(points[point]);
    PositionType sum{};
    for (std::size_t n = m_Begin[point]; n < m_Begin[point + 1]; ++n)
    {
      sum = Add(sum, Subtract(ToPosition(points[m_Ids[n]]), position));
    }
    return count > 0 ? BoundedMoves::Move(points[point], share / static_cast<double>(count), sum) : points[point];
  }

private:
  std::vector<std::size_t> m_Begin; ///< index of each point's first neighbour, and the end of the last
  std::vector<PointId> m_Ids;
};

} // namespace

void
TakeSmoothingSteps(const TriangleSurface & surface,
                   const TrianglesOfPoints & fans,
                   const PointStrata & strata,
                   unsigned int iterations,
                   BoundedMoves & moves,
                   rhombic::StagedProgress & progress,
                   double stageEnd)
{
  const Neighbours neighbours(fans, strata);
  progress.Begin(stageEnd, 2 * iterations * surface.GetNumberOfPoints());
  for (unsigned int n = 0; n < 2 * iterations; ++n)
  {
    const double share = n % 2 == 0 ? Inwards : Outwards;
    moves.Step([&](SizeValueType point) { return neighbours.MoveTowardsMean(surface.GetPoints(), point, share); },
               progress);
  }
}

void
TriangleSurfaceSmoothingSettings::Verify() const
{
  if (!(maximumMove >= 0.0 && std::isfinite(maximumMove)))
  {
    itkGenericExceptionMacro("A point can't move by at most "
                             << maximumMove << " mm when a surface is smoothed; give a number from 0");
  }
}

TriangleSurfaceSmoothingReport
SmoothTriangleSurface(TriangleSurface & surface,
                      const TriangleSurfaceSmoothingSettings & settings,
                      const rhombic::ProgressFunction & report)
{
  settings.Verify();
  rhombic::StagedProgress progress(report);
  const TrianglesOfPoints fans(surface);
  const PointStrata strata = FindStrata(surface, fans);
  BoundedMoves moves(surface, fans, settings.maximumMove);
  TakeSmoothingSteps(surface, fans, strata, settings.iterations, moves, progress, 0.7);
  moves.PutBackMeeting(progress, 1.0);
  surface.Modified();
  return moves.Finish(strata);
}

} // namespace itk
