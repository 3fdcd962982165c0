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
   *  \param cubic whether values are interpolated by the cubic through four samples instead of linearly
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
    std::uint8_t firstType;
    std::uint8_t lastType;
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

} // namespace itk

#endif
