#ifndef itkSimplifiedPatch_h
#define itkSimplifiedPatch_h

#include "itkEdgeCollapse.h"

namespace itk
{

/** \class SimplifiedPatch
 * \brief Some triangles of a surface and the fewer ones that take their place, see EdgeCollapse. Where the new ones
 * turn out to be bad, the old ones can be held and it can be simplified again.
 *
 * \ingroup SurfaceEditing
 */
class SimplifiedPatch
{
public:
  using Box = TriangleTree::Box;
  using Goal = EdgeCollapse::Goal;
  using Progress = EdgeCollapse::Progress;
  using Part = EdgeCollapse::Part;

  /** Of the triangles [begin, end) of a surface, which must stay as it is. */
  SimplifiedPatch(const TriangleSurface & surface, std::size_t begin, std::size_t end);

  /** Adds a witness of one of the triangles, by its number from \a begin. */
  void
  AddWitness(const EdgeCollapse::Witness & witness);

  /** Simplifies all that is not held. */
  void
  Simplify(const Goal & goal, const EdgeCollapse::Original & original);

  /** From the next Simplify() on, holds the triangles whose boxes meet one of the \a places. Returns whether there are
   * any that were not held before. */
  bool
  Hold(const std::vector<Box> & places);

  /** From the next Simplify() on, holds all triangles. */
  void
  HoldAll();

  std::size_t
  GetNumberOfTrianglesBefore() const
  {
    return m_Before.triangles.size();
  }
  /** The box around the triangles from before. */
  const Box &
  GetBounds() const
  {
    return m_Bounds;
  }
  /** First the triangles that were there before, then the new ones. */
  const Part &
  GetResult() const
  {
    return m_Result;
  }
  std::size_t
  GetNumberOfOldTriangles() const
  {
    return m_NumberOfOldTriangles;
  }
  bool
  IsSimplified() const
  {
    return m_NumberOfOldTriangles < m_Result.triangles.size();
  }
  /** Whether edges did not shrink because of the error or the distance from the original. */
  bool
  WasHeldBack() const
  {
    return m_WasHeldBack;
  }
  /** Points of the new triangles that are elsewhere than they were. */
  const std::vector<EdgeCollapse::MovedPoint> &
  GetMovedPoints() const
  {
    return m_Moved;
  }
  /** How the result came about. */
  const std::vector<Progress> &
  GetProgress() const
  {
    return m_Progress;
  }

private:
  const TriangleSurface * m_Surface;
  Part m_Before;
  Box m_Bounds;
  std::vector<std::uint8_t> m_IsHeld;
  Part m_Result;
  std::size_t m_NumberOfOldTriangles = 0;
  std::vector<EdgeCollapse::MovedPoint> m_Moved;
  std::vector<Progress> m_Progress;
  bool m_WasHeldBack = false;
};

/** The box around a triangle. */
TriangleTree::Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle);

} // namespace itk

#endif
