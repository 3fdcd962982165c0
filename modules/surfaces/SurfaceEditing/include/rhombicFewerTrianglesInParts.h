#ifndef rhombicFewerTrianglesInParts_h
#define rhombicFewerTrianglesInParts_h

#include "itkTriangleSurface.h"

#include <array>
#include <map>
#include <vector>

namespace rhombic
{

/** \class WholeSurface
 * \brief Size and position of a surface with all its triangles, in LPS mm. */
struct WholeSurface
{
  itk::SizeValueType points = 0;
  itk::SizeValueType triangles = 0;
  double volume = 0.0; ///< mm^3
  double area = 0.0;   ///< mm^2
  std::array<double, 6> bounds{};
  std::array<double, 3> centroid{}; ///< 0 if the volume is 0
};

/** \class FewerTrianglesInParts
 * \brief A surface to look at, in fewer triangles, as InFewerTriangles() makes it, of a closed surface that comes in
 * parts: planes of points and of triangles, one after the other, as itk::FCCSurfaceParts has them.
 *
 * The planes are divided into blocks by the numbers of their points alone, so that the result does not depend on the
 * parts. In each block normals are smoothed (itk::SmoothTriangleSurfaceNormals()) with the planes around it, which
 * gives the normals of the whole surface, and triangles are made fewer while the points that it shares with other
 * blocks stay, so that the joined surface is closed. Then blocks that lie beside each other are made fewer together,
 * without those points.
 *
 * Memory: about 200 bytes for each point of a block and of 8 planes on either side, 150 for each triangle of
 * MostTrianglesTogether, and the surface that is made. */
class FewerTrianglesInParts
{
public:
  static constexpr itk::SizeValueType PointsOfBlock = 500'000;
  static constexpr itk::SizeValueType MostTrianglesTogether = 1'500'000;

  /** \param firstPoints the number of the first point of each plane, and at the end that of all points
   * \param distance mm, above 0: see InFewerTriangles() */
  FewerTrianglesInParts(std::vector<itk::SizeValueType> firstPoints,
                        double distance,
                        itk::SizeValueType pointsOfBlock = PointsOfBlock);

  /** Adds the planes up to \a end - 1. */
  void
  Add(const itk::TriangleSurface & part, itk::SizeValueType end);

  /** The surface so far; after the last part, all of it. */
  const itk::TriangleSurface &
  GetSurface() const
  {
    return *m_Joined;
  }

  /** GetSurface(), to be changed. */
  itk::TriangleSurface::Pointer
  TakeSurface()
  {
    return m_Joined;
  }

  /** Of the planes that were added; after the last part, of the whole surface. */
  WholeSurface
  GetWhole() const;

private:
  using Triangles = itk::TriangleSurface::TrianglesContainer;

  /** The planes of a block, with those around it. */
  struct Window;

  itk::SizeValueType
  EndOfWindow(itk::SizeValueType block) const;

  Window
  MakeWindow(itk::SizeValueType block) const;

  void
  Measure(const Window & window, itk::SizeValueType block);

  void
  Join(const Window & window, const Triangles & fewer, itk::SizeValueType end);

  void
  SimplifyTogether();

  void
  DropPlanes(itk::SizeValueType end);

  std::vector<itk::SizeValueType> m_FirstPoints;
  std::vector<itk::SizeValueType> m_Planes; ///< the first of each block, and the plane behind the last
  double m_Distance;
  itk::SizeValueType m_Block = 0; ///< the next

  itk::SizeValueType m_FirstPending = 0; ///< the number of the first point that is kept
  itk::TriangleSurface::Pointer
    m_Pending; ///< what came and is still needed; triangles have the whole surface's numbers

  itk::TriangleSurface::Pointer m_Joined;
  std::size_t m_PointsBefore = 0;    ///< those of m_Joined that stay, and the same for triangles
  std::size_t m_TrianglesBefore = 0; ///< that are not made fewer any more
  std::map<itk::SizeValueType, std::uint32_t>
    m_Shared; ///< points that the next block uses too, and what they are in m_Joined

  WholeSurface m_Whole;
  std::array<double, 3> m_Origin{}; ///< the first point, so that volumes far from LPS 0 keep their digits
  std::array<double, 3> m_Moment{};
};

} // namespace rhombic

#endif
