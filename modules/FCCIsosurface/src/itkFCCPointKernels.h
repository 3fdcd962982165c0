#ifndef itkFCCPointKernels_h
#define itkFCCPointKernels_h

#include "itkFCCSurfaceExtraction.h"

namespace itk
{

/** \class FCCEdgeBatch
 * \brief Cut edges, gathered so that many points are placed at once.
 *
 * \ingroup FCCIsosurface
 */
struct FCCEdgeBatch
{
  static constexpr SizeValueType Capacity = 64;

  SizeValueType count = 0;
  float value[4][Capacity];       ///< at the places -1, 0, 1, 2 along the edge's line, less the isovalue
  float gradient[2][Capacity][4]; ///< x, y, z and nothing, at both ends, in lattice coordinates
  float step[3][Capacity];        ///< from the edge's first end to the other
  double site[3][Capacity];       ///< the first end
};

/** \class FCCClusterBatch
 * \brief Sites that gather the crossings they own in one vertex, collected so that many are placed at once.
 *
 * \ingroup FCCIsosurface
 */
struct FCCClusterBatch
{
  static constexpr SizeValueType Capacity = 16;
  static constexpr unsigned int Directions = 2 * FCCLattice::OwnedEdges.size();

  SizeValueType count = 0;
  float value[Capacity];                ///< at the sites, less the isovalue
  float neighbor[Directions][Capacity]; ///< at their neighbours: FCCLattice::OwnedEdges and their opposites
  float gradient[3][Capacity];          ///< at the sites, in lattice coordinates
  float farGradient[3][Capacity];       ///< the mean at the far ends of their owned edges, for normals
  std::uint32_t owned[Capacity];        ///< bit n: direction n has a crossing that the vertex gathers
  float site[3][Capacity];              ///< in lattice coordinates, from the origin below
  double origin[3];                     ///< in lattice coordinates
  float minimumFraction;                ///< of an edge that a crossing stays away from the site
  float farthest;                       ///< that a vertex moves, in units of the distance of nearest neighbours
};

/** \class FCCPointKernels
 * \brief Places points and normals, a batch at a time.
 *
 * Compiled for several instruction sets, as FCCRowKernels are; the results have the same bits whichever runs.
 *
 * Thread safety: the functions write nothing but what they are given.
 *
 * \ingroup FCCIsosurface
 */
struct FCCPointKernels
{
  /** Where the values cross zero between the edges' ends: linearly, or with \a cubic, where the cubic polynomial
   * through four values does. Points stay \a minimumFraction of the edge away from both ends. Without \a normals none
   * are computed; \a batch.value[0], [3] are read for \a cubic only. */
  static void
  PlaceOnEdges(const FCCEdgeBatch & batch,
               const FCCFrame & frame,
               bool cubic,
               double minimumFraction,
               TriangleSurface::PointType * points,
               TriangleSurface::NormalType * normals);

  /** Vertices of sites: the mean of the gathered crossings, each where the parabola through the values before, at and
   * after the site crosses zero (along x, at both ends and in the middle of the edge), moved to where triangles
   * straddle the surface of the field's second-order expansion about the site. The expansion has the given gradient and
   * the second differences of the twelve nearest neighbours. Where that is further away than the batch says, the field
   * is no such thing, and the mean stays. Normals are along that expansion's gradient where it is within 30 degrees of
   * the one interpolated between the site and its edges' far ends, else along the latter; where the values do not
   * change that way, along the changes of the crossed edges. Whole batches are written. */
  static void
  PlaceClusters(const FCCClusterBatch & batch,
                const FCCFrame & frame,
                TriangleSurface::PointType (&points)[FCCClusterBatch::Capacity],
                TriangleSurface::NormalType (&normals)[FCCClusterBatch::Capacity]);
};

} // namespace itk

#endif
