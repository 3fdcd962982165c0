#ifndef itkFCCCellMarching_h
#define itkFCCCellMarching_h

#include "itkFCCCutEdges.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** The ways to fill space with whole cells of the lattice: FCCOctahedraCases and FCCParallelepipedCases. */
enum class FCCCellScheme : unsigned char
{
  Octahedra,
  Parallelepipeds
};

/** The cut edges that the cells of *layer* k share, those whose anchors are in plane k. */
struct FCCLayerEdges
{
  const FCCCutEdges * inPlane[3]; ///< of the planes k - 1, k and k + 1
  const FCCCutEdges * between[2]; ///< between the planes k - 1 and k, and k and k + 1
};

/** The types of edges with points in a scheme, for FCCCutEdges. */
std::uint8_t
GetEdgeTypes(FCCCellScheme scheme);

/** Number of triangles of layer \a k. With \a closed on, sites beyond the box are outside and every cell that holds a
 * site of the box is marched, but its first and last sites along each axis must be outside: the padding of closed
 * surfaces. With it off, only cells whose corners are all in the box are. */
SizeValueType
CountCellTriangles(const FCCSigns & signs, FCCCellScheme scheme, SizeValueType k, bool closed);

/** The triangles of layer \a k. Writes as many as CountCellTriangles() says; \a reversed turns them all over. Cut edges
 * of planes beyond the box are not looked at. */
void
FillCellTriangles(const FCCSigns & signs,
                  FCCCellScheme scheme,
                  SizeValueType k,
                  const FCCLayerEdges & edges,
                  bool closed,
                  bool reversed,
                  TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
