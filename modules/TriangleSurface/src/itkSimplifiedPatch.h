#ifndef itkSimplifiedPatch_h
#define itkSimplifiedPatch_h

#include "itkTriangleTree.h"

#include <functional>

namespace itk
{

/** \class SimplifiedPatch
 * \brief Some triangles of a surface and the fewer ones that take their place.
 *
 * The border stays as it is, so any patch may be simplified or not whatever its neighbours do. So do the triangles that
 * are held because a check has failed where they are.
 *
 * \ingroup TriangleSurface
 */
class SimplifiedPatch
{
public:
  using PointType = TriangleSurface::PointType;
  using TriangleType = TriangleSurface::TriangleType;
  using Box = TriangleTree::Box;
  using Points = TriangleSurface::PointsContainer;

  /** How far a patch is simplified. */
  struct Goal
  {
    double error; ///< mm, mean distance of a point from the planes it stands for
    std::size_t triangles;
  };

  /** Where something is wrong with a result. */
  struct Faults
  {
    std::vector<std::uint32_t> points;
    std::vector<Box> boxes;

    bool
    IsEmpty() const
    {
      return points.empty() && boxes.empty();
    }
    void
    AddTriangle(const TriangleType & triangle)
    {
      points.insert(points.end(), triangle.begin(), triangle.end());
    }
  };

  /** Whether a triangle of the result, by its corners' positions, is too far from the original surface. */
  using TooFarCheck = std::function<bool(const std::array<PointType, 3> &)>;

  SimplifiedPatch() = default;

  /** Of the triangles [begin, end), which must stay where they are. */
  SimplifiedPatch(const Points & points, const TriangleType * begin, const TriangleType * end)
    : m_Points(&points)
    , m_Begin(begin)
    , m_End(end)
    , m_IsHeld(static_cast<std::size_t>(end - begin), 0)
  {}

  /** Holds the triangles of the points and in the boxes, or one ring more around those held where they are held
   * already, and after many calls all triangles. */
  void
  TakeBack(const Faults & faults);

  /** Simplifies what is not held, until checks of topology, degenerate triangles and distance succeed. */
  void
  Simplify(const Goal & goal, const TooFarCheck & isTooFar);

  /** The result. Those held come first. */
  const std::vector<TriangleType> &
  GetTriangles() const
  {
    return m_Result;
  }
  std::size_t
  GetNumberHeld() const
  {
    return m_NumberHeld;
  }
  std::size_t
  GetNumberBefore() const
  {
    return m_IsHeld.size();
  }
  std::size_t
  GetPlacesTakenBack() const
  {
    return m_PlacesTakenBack;
  }

private:
  void
  SimplifyOnce(const Goal & goal);
  Faults
  FindFaults(const TooFarCheck & isTooFar) const;
  void
  HoldAround(const std::vector<std::uint32_t> & points);
  void
  HoldIn(const std::vector<Box> & boxes);

  const Points * m_Points = nullptr;
  const TriangleType * m_Begin = nullptr;
  const TriangleType * m_End = nullptr;
  std::vector<std::uint8_t> m_IsHeld;
  std::size_t m_NumberHeld = 0;
  std::vector<TriangleType> m_Result;
  std::size_t m_PlacesTakenBack = 0;
  unsigned int m_Rounds = 0;
};

/** The box around a triangle. */
TriangleTree::Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle);

} // namespace itk

#endif
