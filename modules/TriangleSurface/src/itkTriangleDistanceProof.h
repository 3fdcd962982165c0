#ifndef itkTriangleDistanceProof_h
#define itkTriangleDistanceProof_h

#include "itkTriangleTree.h"

namespace itk
{

/** \class TriangleDistanceProof
 * \brief Whether triangles, all places between their corners included, are within a distance of a surface.
 *
 * Proven in one of three ways. All corners are near one and the same triangle of the surface: then all between them is,
 * as the places so near a triangle are a convex set. Or the surface lies above and below the triangle like a sheet:
 * seen along the triangle's normal, it winds around one of the triangle's places, has no border within the triangle,
 * and is within the limit above and below it everywhere. Or each of the four parts that the triangle is cut into is so
 * near, or small. Where all that leads to nothing down to a quarter of the limit, the answer is no; there are places
 * near the limit then, or the surface is wild.
 *
 * Thread safety: all questions may be asked by several threads at once.
 *
 * \ingroup TriangleSurface
 */
class TriangleDistanceProof
{
public:
  /** By its corners. */
  using Triangle = std::array<TriangleSurface::PointType, 3>;

  /** For each corner of a triangle, one of the surface's triangles that is near to it: the nearer, the faster. */
  using Near = std::array<std::uint32_t, 3>;

  /** Distances of up to \a limit mm. The surface's tree must stay. */
  TriangleDistanceProof(const TriangleTree & surface, double limit)
    : m_Surface(surface)
    , m_Limit(limit)
  {}

  /** No where \a near has TriangleTree::None. */
  bool
  IsWithin(const Triangle & triangle, const Near & near) const;

  /** Looks at the triangle's centre only. */
  bool
  IsCentreWithin(const Triangle & triangle, const Near & near) const;

private:
  using PositionType = TriangleTree::PositionType;
  using Corners = std::array<PositionType, 3>;

  /** A triangle of the surface that is near a place. */
  struct Witness
  {
    std::uint32_t triangle;
    double distance;
  };
  using Witnesses = std::array<Witness, 3>;

  bool
  IsBetweenSheets(const Corners & corners) const;
  bool
  IsPartWithin(const Corners & corners, const Witnesses & witnesses, unsigned int cutsLeft) const;
  bool
  IsOneTriangleNear(const Corners & corners, const Witnesses & witnesses) const;
  Witness
  FindWitness(const PositionType & position, const Witness & first, const Witness & second) const;
  double
  DistanceTo(const PositionType & position, std::uint32_t triangle) const;

  const TriangleTree & m_Surface;
  const double m_Limit;
};

} // namespace itk

#endif
