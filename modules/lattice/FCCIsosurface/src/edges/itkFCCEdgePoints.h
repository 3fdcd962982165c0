#ifndef itkFCCEdgePoints_h
#define itkFCCEdgePoints_h

#include "itkFCCCutEdges.h"
#include "itkFCCExtent.h"
#include "itkFCCFieldPlanes.h"

namespace itk
{

/** \class FCCEdgeBatch
 * \brief Cut edges, gathered so that many points are placed at once.
 */
struct FCCEdgeBatch
{
  static constexpr SizeValueType Capacity = 64;

  SizeValueType count = 0;
  float value[4][Capacity];       ///< at -1, 0, 1 and 2 edge lengths from the first end, less the isovalue
  float gradient[2][Capacity][4]; ///< x, y, z and nothing, at both ends, in lattice coordinates
  float step[3][Capacity];        ///< from the edge's first end to the other
  double site[3][Capacity];       ///< the first end
};

/** Places the points of a batch of cut edges: where the line through the values at both ends crosses zero, or with
 * \a cubic, where the cubic polynomial through all four values does. Points stay \a minimumFraction of the edge away
 * from both ends. A normal is along the gradient at the point, interpolated between the ends; where that is zero or
 * not finite, along the edge. Without \a normals none are computed. batch.value[0] and [3] are read for \a cubic only.
 */
void
PlaceOnEdges(const FCCEdgeBatch & batch,
             const FCCFrame & frame,
             bool cubic,
             double minimumFraction,
             TriangleSurface::PointType * points,
             TriangleSurface::NormalType * normals);

/** \class FCCEdgePoints
 * \brief Places the surface's points on the cut edges of an FCC image.
 *
 * Between two samples a point lies where their values' interpolation along the edge crosses the isovalue. An edge may
 * lead to a site outside the image (see FCCIsosurfaceFilter on closed surfaces); there, points lie on the faces of the
 * image's extent, with the normals of these faces.
 */
class FCCEdgePoints
{
public:
  using SiteType = FCCLattice::SiteType;

  /** \param cubic whether values are interpolated by the cubic through four samples instead of linearly; along x,
   *         where samples are further apart than around, by a cubic that also passes through the edge's middle
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

} // namespace itk

#endif
