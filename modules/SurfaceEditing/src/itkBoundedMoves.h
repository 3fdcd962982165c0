#ifndef itkBoundedMoves_h
#define itkBoundedMoves_h

#include "detail/itkPositionArithmetic.h"

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

  const Points &
  GetStart() const
  {
    return m_Start;
  }

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
