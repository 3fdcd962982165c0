#ifndef itkFCCEdgePoints_h
#define itkFCCEdgePoints_h

#include "itkFCCExtent.h"
#include "itkFCCFieldPlanes.h"
#include "itkFCCMarching.h"
#include "itkFCCPointKernels.h"

namespace itk
{

/** \class FCCEdgePoints
 * \brief Places the surface's points on the cut edges of an FCC image.
 *
 * Between two samples a point lies where their values' interpolation along the edge crosses the isovalue. An edge may
 * lead to a site outside the image (see FCCIsosurfaceFilter on closed surfaces); there, points lie on the faces of the
 * image's extent, and normals are theirs.
 *
 * Thread safety: immutable.
 *
 * \ingroup FCCIsosurface
 */
class FCCEdgePoints
{
public:
  /** \param region the image's samples
   *  \param frame from lattice coordinates to the world
   *  \param cubic whether values are interpolated by the cubic through four samples instead of linearly; along x,
   *         where these are further apart than those around, by one that passes through the edge's middle, too
   *  \param minimumFraction of an edge that a point stays away from its ends
   *  \param margin 1 when signs count sites from a layer around the image, otherwise 0 */
  FCCEdgePoints(const ImageRegion<3> & region,
                const FCCFrame & frame,
                bool cubic,
                double minimumFraction,
                SizeValueType margin);

  /** Some of the edges that the sites of a plane store. */
  struct Edges
  {
    std::uint8_t types;                                                                  ///< bits of their types
    std::function<const FCCSigns::WordType *(SizeValueType j, std::uint8_t type)> masks; ///< bit i: that of site i
  };

  /** Places the points on some edges of plane \a k of the signs, row by row, within a row type by type, and their
   * normals unless null. The arrays begin with the first of these points. */
  void
  Place(const FCCSigns & signs,
        const Edges & edges,
        SizeValueType k,
        const FCCFieldPlanes & field,
        TriangleSurface::PointType * points,
        TriangleSurface::NormalType * normals) const;

  /** Adds to a batch the edge from a site along a step. The site is counted as the field's are. */
  void
  Gather(const std::array<SizeValueType, 3> & site,
         const FCCLattice::SiteType & step,
         const FCCFieldPlanes & field,
         bool withGradients,
         FCCEdgeBatch & batch) const;

  /** Places the points of a batch and empties it. */
  void
  PlaceBatch(FCCEdgeBatch & batch, TriangleSurface::PointType * points, TriangleSurface::NormalType * normals) const
  {
    FCCPointKernels::PlaceOnEdges(batch, m_Frame, m_Cubic, m_MinimumFraction, points, normals);
    batch.count = 0;
  }

private:
  using SiteType = FCCLattice::SiteType;

  void
  GatherBorder(const SiteType & site, const SiteType & step, bool startsOutside, FCCEdgeBatch & batch) const;

  FCCExtent m_Extent;
  FCCFrame m_Frame;
  bool m_Cubic;
  double m_MinimumFraction;
  SizeValueType m_Margin;
};

/** \class FCCEdgePointFiller
 * \brief Fills the points and normals of a surface, plane by plane, from the edges that the planes' sites store.
 *
 * Ask for planes in ascending order. Thread safety: each thread uses its own.
 *
 * \ingroup FCCIsosurface
 */
class FCCEdgePointFiller
{
public:
  FCCEdgePointFiller(const FCCSigns & signs, const FCCScalarField & field, const FCCEdgePoints & edgePoints);

  /** The points on some edges stored by plane \a k of the signs. The surface must have its size; normals are left out
   * where it has none. */
  void
  Fill(SizeValueType k, const FCCCutEdges & inPlane, const FCCCutEdges & between, TriangleSurface & surface);

private:
  const FCCSigns & m_Signs;
  const FCCEdgePoints & m_EdgePoints;
  SizeValueType m_ToField; ///< from a plane of the signs to that of the field
  FCCFieldPlanes m_Field;
  std::vector<std::uint8_t> m_Blocks;
};

} // namespace itk

#endif
