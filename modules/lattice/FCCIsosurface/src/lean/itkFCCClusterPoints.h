#ifndef itkFCCClusterPoints_h
#define itkFCCClusterPoints_h

#include "itkFCCClusterKernels.h"
#include "itkFCCClusterPlane.h"
#include "itkFCCEdgePoints.h"

namespace itk
{

/** \class FCCClusterPoints
 * \brief Places the vertices of sites that gather their crossings.
 *
 * Vertices of several crossings are moved to the reconstructed surface (see PlaceClusters()) when their site is in the
 * image; when it is in the layer around the image, where a closed surface ends, they are the mean of their crossings
 * with the faces of the image's extent. Vertices of one crossing are points on its edge.
 */
class FCCClusterPoints
{
public:
  explicit FCCClusterPoints(const FCCScalarField & field)
    : m_Frame(field.frame)
    , m_MinimumFraction(field.minimumFraction)
    , m_EdgePoints(field, true, 1)
  {}

  /** Places the vertices of plane \a k, and their normals unless null, and sets for each, unless null, whether its site
   * is outside the image. The arrays begin with the first of them. The field must have loaded the gradients of the
   * plane, and for normals of those next to it, too. */
  void
  Place(const FCCSigns & signs,
        const FCCClusterPlane & plane,
        SizeValueType k,
        const FCCFieldPlanes & field,
        TriangleSurface::PointType * points,
        TriangleSurface::NormalType * normals,
        std::uint8_t * areOutside) const;

private:
  using SiteType = FCCLattice::SiteType;

  /** How far a vertex moves from its crossings' mean to the surface, in units of the distance of nearest neighbours. */
  static constexpr float FarthestOfWhole = 0.5f;
  static constexpr float FarthestOfPart = 0.25f; ///< for the parts of a split site, so that they stay apart

  /** The field around the sites of one row in the image. */
  class Row;

  /** Vertices that are placed batch by batch, in order. */
  class Output;

  void
  PlaceWholeSites(const FCCSigns & signs,
                  const FCCClusterPlane & plane,
                  SizeValueType k,
                  const FCCFieldPlanes & field,
                  Output & output) const;

  void
  PlaceSplitSites(const FCCClusterPlane & plane, SizeValueType k, const FCCFieldPlanes & field, Output & output) const;

  void
  PlaceOnBorder(const SiteType & site, unsigned int crossings, Output & output) const;

  FCCFrame m_Frame;
  double m_MinimumFraction;
  FCCEdgePoints m_EdgePoints;
};

} // namespace itk

#endif
