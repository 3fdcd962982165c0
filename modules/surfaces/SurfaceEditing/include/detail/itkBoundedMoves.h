#ifndef itkBoundedMoves_h
#define itkBoundedMoves_h

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"
#include "detail/itkPointStrata.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "itkTriangleTree.h"

#include <optional>

namespace itk
{

/** The ids of which the marks are not 0, ascending. */
inline BulkVector<std::uint32_t>
FindMarked(const BulkVector<std::uint8_t> & marks)
{
  BulkVector<std::uint32_t> ids;
  for (std::size_t id = 0; id < marks.size(); ++id)
  {
    if (marks[id] != 0)
    {
      ids.push_back(static_cast<std::uint32_t>(id));
    }
  }
  return ids;
}

/** \class MoveBound
 * \brief How far a point may move from its start: within a ball, and within an ellipsoid if there is one. */
class MoveBound
{
public:
  using AxesType = std::array<PositionType, 3>;

  explicit MoveBound(const TriangleSurfaceSmoothingSettings & settings);

  /** The length of a move over the largest in its direction: above 1 out of bounds. */
  double
  Measure(const PositionType & way) const
  {
    const double measure = m_PerMove * Length(way);
    return m_ToUnit ? std::max(measure,
                               Length({ Dot((*m_ToUnit)[0], way), Dot((*m_ToUnit)[1], way), Dot((*m_ToUnit)[2], way) }))
                    : measure;
  }

  /** The largest move in the direction in which it is least, in mm. */
  double
  GetLeast() const
  {
    return m_Least;
  }

  /** The volume of the box with some edges. */
  static double
  FindVolume(const AxesType & edges)
  {
    return Dot(edges[0], Cross(edges[1], edges[2]));
  }

private:
  double m_PerMove;                 ///< 1 / mm; infinite if no move is allowed
  std::optional<AxesType> m_ToUnit; ///< the rows of the matrix that makes the ellipsoid the ball of radius 1
  double m_Least;
};

/** How far a triangle may turn and shrink when its points move. */
struct TriangleLimits
{
  double leastCosineOfTurn = 0.1736; ///< that of 80 degrees
  double leastShareOfArea = 0.1;
};

/** \class BoundedMoves
 * \brief Moves the points of a surface in steps, none out of a bound around its start.
 *
 * The points of a triangle that would turn or shrink more than its limits since the start stay where they are in that
 * step. The same for any number of threads. */
class BoundedMoves
{
public:
  using Points = TriangleSurface::PointsContainer;
  using PointType = TriangleSurface::PointType;

  /** \param fans the triangles at the points of the surface; both must live longer */
  BoundedMoves(TriangleSurface & surface,
               const TrianglesOfPoints & fans,
               const MoveBound & bound,
               const TriangleLimits & limits = {});

  const MoveBound &
  GetBound() const
  {
    return m_Bound;
  }

  /** Moves each point to find(point), which may be called on several threads at once, or as near as it may go. Counts
   * the points as completed parts. */
  template <typename TFind>
  void
  Step(const TFind & find, rhombic::StagedProgress & progress)
  {
    this->FindNext(find, progress);
    this->PutBackSpoilt(this->FindSpoilt());
    m_Surface.GetPoints().swap(m_Next);
  }

  /** Moves some points as Step() moves all.
   * \param points each once
   * \param triangles those at the points, see FindTrianglesAt() */
  template <typename TFind>
  void
  StepSome(const BulkVector<std::uint32_t> & points, const BulkVector<std::uint32_t> & triangles, const TFind & find)
  {
    this->CopyCorners(triangles, m_Surface.GetPoints(), m_Next);
    rhombic::ForEachInBlocks(
      points.size(), MovedBlock, [&](SizeValueType n) { this->SetNext(points[n], find(points[n])); });
    this->PutBackSpoilt(this->FindSpoilt(triangles));
    this->CopyCorners(triangles, m_Next, m_Surface.GetPoints());
  }

  /** The triangles at some points, ascending. */
  BulkVector<std::uint32_t>
  FindTrianglesAt(const BulkVector<std::uint32_t> & points) const;

  /** Moves each point to find(point), as Step() does, or as far as triangles at it and around it may turn and shrink:
   * where one of them may not, a point and those around it move a quarter less, two quarters less and so on, so that
   * no point is left behind alone. */
  template <typename TFind>
  void
  MoveTowards(const TFind & find, rhombic::StagedProgress & progress)
  {
    this->FindNext(find, progress);
    this->BeginRetreats();
    this->Retreat(this->FindSpoilt());
    m_Surface.GetPoints().swap(m_Next);
  }

  /** Moves the points of triangles that meet others, elsewhere than at shared corners and sides, back towards their
   * start as MoveTowards() does, until the triangles that meet are all at their start. It is one stage of the progress.
   */
  void
  PutBackMeeting(rhombic::StagedProgress & progress, double stageEnd);

  /** After the last step: computes the normals anew, if there are any, and returns how far points have moved. */
  TriangleSurfaceSmoothingReport
  Finish(const PointStrata & strata);

  /** A point moved by a multiple of a vector. */
  static PointType
  Move(const PointType & point, double factor, const PositionType & way)
  {
    return ToPoint(Along(ToPosition(point), way, factor));
  }

private:
  static constexpr SizeValueType MovedBlock = 4096;
  static constexpr std::uint8_t MostRetreats = 4;

  template <typename TFind>
  void
  FindNext(const TFind & find, rhombic::StagedProgress & progress)
  {
    rhombic::ForEachBlock(m_Next.size(), MovedBlock, [&](SizeValueType begin, SizeValueType end) {
      for (SizeValueType point = begin; point < end; ++point)
      {
        this->SetNext(point, find(point));
      }
      progress.Completed(end - begin);
    });
  }

  void
  SetNext(SizeValueType point, const PointType & position)
  {
    const PositionType way = Subtract(ToPosition(position), ToPosition(m_Start[point]));
    m_Next[point] = m_Bound.Measure(way) < 0.999 ? position : this->LimitMove(m_Start[point], position);
  }

  PointType
  LimitMove(const PointType & start, PointType position) const;
  bool
  IsSpoilt(std::uint32_t triangle) const;
  BulkVector<std::uint32_t>
  FindSpoilt() const;
  BulkVector<std::uint32_t>
  FindSpoilt(const BulkVector<std::uint32_t> & triangles) const;
  void
  PutBackSpoilt(BulkVector<std::uint32_t> spoilt);
  void
  CopyCorners(const BulkVector<std::uint32_t> & triangles, const Points & from, Points & to) const;
  BulkVector<std::uint32_t>
  FindCorners(const BulkVector<std::uint32_t> & triangles) const;
  void
  BeginRetreats();
  BulkVector<std::uint32_t>
  Retreat(BulkVector<std::uint32_t> triangles);
  BulkVector<std::uint32_t>
  FindMovedInTree() const;
  void
  UpdateTree(const BulkVector<std::uint32_t> & triangles);

  TriangleSurface & m_Surface;
  const TrianglesOfPoints & m_Fans;
  const MoveBound m_Bound;
  const TriangleLimits m_Limits;
  const Points m_Start;
  BulkVector<PositionType> m_StartAreas; ///< of the triangles, see AreaVector()
  Points m_Next;
  Points m_Moved;                      ///< from where points retreat
  BulkVector<std::uint8_t> m_Retreats; ///< of each point: quarters of its way back to the start
  std::optional<TriangleTree> m_Tree;  ///< of the surface, since triangles that meet were first put back
  Points m_InTree;                     ///< the points that the tree has
};

} // namespace itk

#endif
