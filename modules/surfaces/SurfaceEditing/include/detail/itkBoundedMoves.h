#ifndef itkBoundedMoves_h
#define itkBoundedMoves_h

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"
#include "detail/itkPointStrata.h"
#include "itkTriangleSurfaceSmoothing.h"

namespace itk
{

/** \class BoundedMoves
 * \brief Moves the points of a surface in steps, none farther from its start than a distance.
 *
 * The points of a triangle that would turn by 80 degrees or more since the start, or lose more than nine tenths of its
 * area, stay where they are in that step. The same for any number of threads. */
class BoundedMoves
{
public:
  using Points = TriangleSurface::PointsContainer;
  using PointType = TriangleSurface::PointType;

  /** \param fans the triangles at the points of the surface; both must live longer
   *  \param maximumMove in mm */
  BoundedMoves(TriangleSurface & surface, const TrianglesOfPoints & fans, double maximumMove);

  double
  GetMaximumMove() const
  {
    return m_MaximumMove;
  }

  /** Moves each point to find(point), which may be called on several threads at once, or as near as it may go. Counts
   * the points as completed parts. */
  template <typename TFind>
  void
  Step(const TFind & find, rhombic::StagedProgress & progress)
  {
    rhombic::ForEachBlock(m_Next.size(), MovedBlock, [&](SizeValueType begin, SizeValueType end) {
      for (SizeValueType point = begin; point < end; ++point)
      {
        const PointType position = find(point);
        const PositionType way = Subtract(ToPosition(position), ToPosition(m_Start[point]));
        const bool isNear = Dot(way, way) < 0.999 * m_MaximumMove * m_MaximumMove;
        m_Next[point] = isNear ? position : this->LimitMove(m_Start[point], position);
      }
      progress.Completed(end - begin);
    });
    this->FinishStep();
  }

  /** Puts the points of triangles that meet others, elsewhere than at shared corners and sides, back to their start,
   * until the triangles that meet are all at their start. It is one stage of the progress. */
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

  PointType
  LimitMove(const PointType & start, PointType position) const;
  bool
  IsSpoilt(std::uint32_t triangle) const;
  void
  FinishStep();
  std::vector<std::uint32_t>
  PutBack(std::vector<std::uint32_t> spoilt);
  std::vector<std::uint32_t>
  PutBackToStart(const std::vector<std::uint32_t> & triangles);

  TriangleSurface & m_Surface;
  const TrianglesOfPoints & m_Fans;
  const double m_MaximumMove;
  const Points m_Start;
  std::vector<PositionType> m_StartAreas; ///< of the triangles, see AreaVector()
  Points m_Next;
};

/** The steps of SmoothTriangleSurface(), as one stage of the progress. */
void
TakeSmoothingSteps(const TriangleSurface & surface,
                   const TrianglesOfPoints & fans,
                   const PointStrata & strata,
                   unsigned int iterations,
                   BoundedMoves & moves,
                   rhombic::StagedProgress & progress,
                   double stageEnd);

} // namespace itk

#endif
