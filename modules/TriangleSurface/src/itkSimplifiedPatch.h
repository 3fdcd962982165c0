#ifndef itkSimplifiedPatch_h
#define itkSimplifiedPatch_h

#include "itkTriangleTree.h"

#include <functional>

namespace itk
{

/** \class SimplifiedPatch
 * \brief Some triangles of a surface and the fewer ones that take their place.
 *
 * Edges shrink to one of their points, those of least error first, the error being that of Garland and Heckbert,
 * "Surface simplification using quadric error metrics" (SIGGRAPH 1997): the mean squared distance from the planes of
 * the triangles that the vanishing point has stood for. An edge may shrink only where the link condition of Dey et al.,
 * "Topology preserving edge contraction" (1999) holds, so the topology stays as it is.
 *
 * The patch's border stays, and no new edge joins two of its points: whatever patches are simplified, they fit
 * together.
 *
 * \ingroup TriangleSurface
 */
class SimplifiedPatch
{
public:
  using PointType = TriangleSurface::PointType;
  using TriangleType = TriangleSurface::TriangleType;
  using Points = TriangleSurface::PointsContainer;
  using Box = TriangleTree::Box;

  /** How far a patch is simplified: as far as neither is passed. */
  struct Goal
  {
    double error; ///< mm, root of the mean squared distance that the class comment tells
    std::size_t triangles;
  };

  /** Whether a triangle may be part of the result. */
  using Check = std::function<bool(const TriangleType &)>;

  SimplifiedPatch() = default;

  /** Of the triangles [begin, end), which must stay where they are, as must the points. */
  SimplifiedPatch(const Points & points, const TriangleType * begin, const TriangleType * end);

  /** Simplifies all that is not held. */
  void
  Simplify(const Goal & goal, const Check & isAllowed);

  /** From the next Simplify() on, holds the triangles whose boxes meet one of the \a places. Returns whether there are
   * any that were not held before. */
  bool
  Hold(const std::vector<Box> & places);

  /** From the next Simplify() on, holds all triangles. */
  void
  HoldAll();

  /** Back to no result and nothing held. */
  void
  Restart();

  /** The result: first triangles that were there before, then new ones. */
  const std::vector<TriangleType> &
  GetTriangles() const
  {
    return m_Result;
  }
  std::size_t
  GetNumberOfOldTriangles() const
  {
    return m_NumberOfOldTriangles;
  }
  /** By their places in the result, the new triangles that were not in the result before this one. */
  const std::vector<std::uint32_t> &
  GetFresh() const
  {
    return m_Fresh;
  }
  /** New triangles of the result before this one that are no longer there. */
  const std::vector<TriangleType> &
  GetDropped() const
  {
    return m_Dropped;
  }
  /** The box around the triangles from before. */
  const Box &
  GetBounds() const
  {
    return m_Bounds;
  }
  bool
  IsSimplified() const
  {
    return m_NumberOfOldTriangles < m_Result.size();
  }
  std::size_t
  GetNumberOfTrianglesBefore() const
  {
    return static_cast<std::size_t>(m_End - m_Begin);
  }

private:
  const Points * m_Points = nullptr;
  const TriangleType * m_Begin = nullptr;
  const TriangleType * m_End = nullptr;
  Box m_Bounds{};
  std::vector<std::uint8_t> m_IsHeld;
  std::vector<TriangleType> m_Result;
  std::size_t m_NumberOfOldTriangles = 0;
  std::vector<std::uint32_t> m_Fresh;
  std::vector<TriangleType> m_Dropped;
};

/** The box around a triangle. */
TriangleTree::Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle);

} // namespace itk

#endif
