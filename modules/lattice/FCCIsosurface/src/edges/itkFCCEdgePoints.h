#ifndef itkFCCEdgePoints_h
#define itkFCCEdgePoints_h

#include "itkFCCCutEdges.h"
#include "itkFCCEdgeKernels.h"
#include "itkFCCExtent.h"
#include "itkFCCFieldPlanes.h"

namespace itk
{

/** \class FCCEdgePoints
 * \brief Places the surface's points on the cut edges of an FCC image.
 *
 * Between two samples a point lies where their values' interpolation along the edge crosses the isovalue. An edge may
 * lead to a site outside the image (see FCCIsosurfaceFilter on closed surfaces); there, points lie on the faces of the
 * image's extent, and normals are theirs.
 */
class FCCEdgePoints
{
public:
  using SiteType = FCCLattice::SiteType;

  /** \param cubic whether values are interpolated by the cubic through four samples instead of linearly; along x,
   *         where these are further apart than those around, by one that passes through the edge's middle, too
   *  \param margin 1 when signs count sites from a layer around the image, otherwise 0 */
  FCCEdgePoints(const FCCScalarField & field, bool cubic, SizeValueType margin);

  /** Places the points on the cut edges of plane \a k of the signs, in the order of their ids, and their normals unless
   * null. The arrays begin with the first of these points. */
  void
  Place(const FCCSigns & signs,
        const FCCCutEdges & edges,
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
    PlaceOnEdges(batch, m_Frame, m_Cubic, m_MinimumFraction, points, normals);
    batch.count = 0;
  }

  const FCCExtent &
  GetExtent() const
  {
    return m_Extent;
  }

  /** The site with the given indices, which are counted as the field's are. */
  SiteType
  SiteOf(SizeValueType i, SizeValueType j, SizeValueType k) const
  {
    const auto & first = m_Extent.GetRegion().GetIndex();
    return FCCLattice::SiteOf({ { first[0] + static_cast<IndexValueType>(i) - 1,
                                  first[1] + static_cast<IndexValueType>(j) - 1,
                                  first[2] + static_cast<IndexValueType>(k) - 1 } });
  }

private:
  /** A row of the signs whose cut edges of one type get points. */
  struct RowOfEdges
  {
    SizeValueType j; ///< counted as the field's are, as k
    SizeValueType k;
    std::uint8_t type;
    const FCCSigns::WordType * cut;
  };

  template <typename TFlush>
  void
  GatherRow(const FCCSigns & signs,
            const RowOfEdges & edges,
            const FCCFieldPlanes & field,
            bool withGradients,
            FCCEdgeBatch & batch,
            const TFlush & flush) const;

  void
  GatherBorder(const SiteType & site, const SiteType & step, bool startsOutside, FCCEdgeBatch & batch) const;

  /** Completes the edge that has been added to a batch. */
  static void
  AddEdge(const SiteType & site, const SiteType & step, FCCEdgeBatch & batch);

  FCCExtent m_Extent;
  FCCFrame m_Frame;
  bool m_Cubic;
  double m_MinimumFraction;
  SizeValueType m_Margin;
};

/** \class FCCEdgePointFiller
 * \brief Fills the points and normals of a surface, plane by plane, from the edges that the planes' sites store.
 *
 * Ask for planes in ascending order.
 */
class FCCEdgePointFiller
{
public:
  FCCEdgePointFiller(const FCCSigns & signs, const FCCScalarField & field, const FCCEdgePoints & edgePoints);

  /** Fills the points on some edges stored by plane \a k of the signs. The surface must have its size; normals are left
   * out where it has none. */
  void
  Fill(SizeValueType k, const FCCCutEdges & inPlane, const FCCCutEdges & between, TriangleSurface & surface);

private:
  const FCCSigns & m_Signs;
  const FCCEdgePoints & m_EdgePoints;
  SizeValueType m_ToField; ///< from a plane of the signs to that of the field
  FCCFieldPlanes m_Field;
};

} // namespace itk

#endif
