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

  /** Whether a triangle, by its corners, may be part of the result. Called by one thread at a time for each patch. */
  using Check = std::function<bool(const std::array<PointType, 3> &)>;

  SimplifiedPatch() = default;

  /** Of the triangles [begin, end), which must stay where they are, as must the points. */
  SimplifiedPatch(const Points & points, const TriangleType * begin, const TriangleType * end);

  /** Simplifies all that is not held. */
  void
  Simplify(const Goal & goal, const Check & isAllowed);

  /** From the next Simplify() on, holds the triangles whose boxes meet a \a place; if all of them are held already,
   * one more ring of triangles around them all; all triangles after many calls. */
  void
  Hold(const std::vector<Box> & places);

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
  std::size_t
  GetNumberOfTrianglesBefore() const
  {
    return static_cast<std::size_t>(m_End - m_Begin);
  }

private:
  const Points * m_Points = nullptr;
  const TriangleType * m_Begin = nullptr;
  const TriangleType * m_End = nullptr;
  std::vector<std::uint8_t> m_IsHeld; // empty while none is
  unsigned int m_Holds = 0;
  std::vector<TriangleType> m_Result;
  std::size_t m_NumberOfOldTriangles = 0;
};

/** The box around a triangle. */
TriangleTree::Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle);

} // namespace itk

#endif
