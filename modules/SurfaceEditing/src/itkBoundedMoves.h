#ifndef itkBoundedMoves_h
#define itkBoundedMoves_h

#include "detail/itkPositionArithmetic.h"
#include "itkPointStrata.h"
#include "itkTriangleSurfaceSmoothing.h"

#include <functional>

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

  /** \param maximumMove in mm; the surface must live longer */
  BoundedMoves(TriangleSurface & surface, double maximumMove);

  /** Moves each point to find(point), which may be called on several threads at once, or as near as it may go. */
  void
  Step(const std::function<PointType(SizeValueType point)> & find);

  /** Puts the points of some triangles back to their start, and those of triangles that have then turned or shrunk too
   * much. Returns whether any point had moved. */
  bool
  PutBackToStart(const std::vector<std::uint32_t> & triangles);

  /** After the last step: computes the normals anew, if there are any, and returns how far points have moved. */
  TriangleSurfaceSmoothingReport
  Finish(const TrianglesOfPoints & fans, const PointStrata & strata);

  /** A point moved by a multiple of a vector. */
  static PointType
  Move(const PointType & point, double factor, const PositionType & way);

private:
  bool
  PutBackBadMoves(std::vector<std::uint8_t> & isPutBack);

  TriangleSurface & m_Surface;
  const double m_MaximumMove;
  const Points m_Start;
  Points m_Next;
};

} // namespace itk

#endif
