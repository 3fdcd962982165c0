#ifndef itkFCCClusterPoints_h
#define itkFCCClusterPoints_h

#include "itkFCCClusterPlane.h"
#include "itkFCCExtent.h"
#include "itkFCCPointKernels.h"

namespace itk
{

/** \class FCCClusterPoints
 * \brief Places the vertices of sites that gather their crossings.
 *
 * Vertices of sites in the image are moved onto the reconstructed surface (see FCCPointKernels::PlaceClusters()). Those
 * of sites in the layer around it, where a closed surface ends, stay the mean of their crossings with the faces of the
 * image's extent.
 *
 * Thread safety: immutable.
 *
 * \ingroup FCCIsosurface
 */
class FCCClusterPoints
{
public:
  FCCClusterPoints(const ImageRegion<3> & region, const FCCFrame & frame)
    : m_Extent(region)
    , m_Frame(frame)
  {}

  /** Places the vertices of the clusters of plane \a k, row by row, and their normals unless null. The arrays begin
   * with the first of them. The field must have loaded the values around the plane and its gradients. */
  void
  Place(const FCCSigns & signs,
        const FCCClusterPlane & plane,
        SizeValueType k,
        const FCCFieldPlanes & field,
        TriangleSurface::PointType * points,
        TriangleSurface::NormalType * normals) const;

private:
  using SiteType = FCCLattice::SiteType;

  void
  PlaceOnBorder(const SiteType & site,
                unsigned int owned,
                TriangleSurface::PointType & point,
                TriangleSurface::NormalType & normal) const;

  FCCExtent m_Extent;
  FCCFrame m_Frame;
};

} // namespace itk

#endif
