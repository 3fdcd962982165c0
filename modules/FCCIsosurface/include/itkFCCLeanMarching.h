#ifndef itkFCCLeanMarching_h
#define itkFCCLeanMarching_h

#include "itkFCCClusterPlane.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** For each site of a plane: how many triangles between clusters use it and the edges that it stores, one byte each.
 * Bytes 0 to 6 are FCCLattice::OwnedEdges, byte 7 is the site. Zero until counted into. */
struct FCCTriangleUse
{
  SizeValueType stride; ///< sites from a row to the next
  std::vector<std::uint64_t> counts;
};

/** Adds the triangles between the planes \a k and \a k + 1, as they would be if no site were split, to the counts of
 * both planes. Returns how many they are. */
SizeValueType
CountTriangleUse(const FCCSigns & signs,
                 SizeValueType k,
                 const FCCClusterPlane & lower,
                 const FCCClusterPlane & upper,
                 FCCTriangleUse & lowerUse,
                 FCCTriangleUse & upperUse);

/** The triangles between the planes \a k and \a k + 1, with numbered vertices. Returns how many they are; writes none
 * when \a triangles is null. \a reversed turns them all over. */
SizeValueType
FillLeanTriangles(const FCCSigns & signs,
                  SizeValueType k,
                  const FCCClusterPlane & lower,
                  const FCCClusterPlane & upper,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
