#ifndef itkFCCClusterPoints_h
#define itkFCCClusterPoints_h

#include "itkFCCClusterPlane.h"
#include "itkFCCEdgePoints.h"

namespace itk
{

/** \class FCCClusterBatch
 * \brief Sites that gather crossings in one vertex, collected so that many vertices are placed at once.
 */
struct FCCClusterBatch
{
  static constexpr SizeValueType Capacity = 16;

  SizeValueType count = 0;
  float value[Capacity];                          ///< values at the sites, less the isovalue
  float neighbor[FCCCells::Directions][Capacity]; ///< values at their neighbours, less the isovalue
  float gradient[3][Capacity];                    ///< at the sites, in lattice coordinates
  float farGradient[3][Capacity];                 ///< the mean at the far ends of their crossed edges, for normals
  std::uint32_t crossings[Capacity];              ///< directions of the crossings that the vertex gathers
  float site[3][Capacity];                        ///< in lattice coordinates, from the origin below
  double origin[3];                               ///< in lattice coordinates
  float minimumFraction;                          ///< least distance of a crossing from the site, relative to its edge
  float farthest;                                 ///< largest move of a vertex, in distances of nearest neighbours
};

/** Places the vertices of sites: the mean of the gathered crossings, each where the parabola through the values before,
 * at and after the site crosses zero (along x, at both ends and in the middle of the edge), moved to where triangles
 * straddle the surface of the field's second-order expansion about the site. The expansion has the given gradient and
 * the second differences of the twelve nearest neighbours. Where that is further away than batch.farthest, the
 * expansion does not describe the field, and the mean stays. Normals are along that expansion's gradient where it is
 * within 30 degrees of the gradient interpolated between the site and its edges' far ends, else along the latter; where
 * the values do not change that way, along the changes of the crossed edges. Whole batches are written.
 *
 * Compiled for several instruction sets; the results have the same bits whichever runs. */
void
PlaceClusters(const FCCClusterBatch & batch,
              const FCCFrame & frame,
              TriangleSurface::PointType (&points)[FCCClusterBatch::Capacity],
              TriangleSurface::NormalType (&normals)[FCCClusterBatch::Capacity]);

/** Places the vertices of plane \a k, and their normals unless null, and sets for each, unless null, whether its site
 * is outside the image. The arrays begin with the first of them.
 *
 * Vertices of several crossings are moved to the reconstructed surface (see PlaceClusters()) when their site is in the
 * image; when it is in the layer around the image, where a closed surface ends, they are the mean of their crossings
 * with the faces of the image's extent. Vertices of one crossing are points on its edge.
 *
 * \param field must have loaded the gradients of the plane, and for normals also of the planes next to it */
void
PlaceVertices(const FCCScalarField & scalars,
              const FCCSigns & signs,
              const FCCClusterPlane & plane,
              SizeValueType k,
              const FCCFieldPlanes & field,
              TriangleSurface::PointType * points,
              TriangleSurface::NormalType * normals,
              std::uint8_t * areOutside);

} // namespace itk

#endif
