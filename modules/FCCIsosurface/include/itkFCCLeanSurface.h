#ifndef itkFCCLeanSurface_h
#define itkFCCLeanSurface_h

#include "itkFCCClusterPoints.h"
#include "itkFCCLeanMarching.h"

namespace itk
{

/** \class FCCLeanSurface
 * \brief A surface with few, well-shaped triangles: the tetrahedra's, whose points have gathered at lattice sites.
 *
 * Every point of the tetrahedra's surface belongs to the nearer end of its edge. All points of one site become one
 * vertex, which is moved onto the reconstructed surface, and triangles that lose a side vanish (G. Treece, R. Prager,
 * A. Gee, "Regularised marching tetrahedra", 1999), but where the surface would not stay a manifold of the same
 * topology (see FCCSplitSites).
 *
 * Count all slabs of planes, in any order and by any number of threads; Resolve once; Fill all slabs.
 *
 * \ingroup FCCIsosurface
 */
class FCCLeanSurface
{
public:
  /** \param signs with a layer of sites around the image */
  FCCLeanSurface(const FCCSigns & signs,
                 const ImageRegion<3> & region,
                 const FCCFrame & frame,
                 bool insideIsBelow,
                 double minimumFraction,
                 FCCFieldPlanes::RowReader readRow);

  /** Counts points and triangles, and looks for sites that might have to be split. */
  void
  Count(SizeValueType begin, SizeValueType end);

  /** Splits sites, and sums up how many points there are and how many triangles there may be. */
  void
  Resolve(const FCCSplitSites::ValueReader & readValues, const FCCSplitSites::ParallelFor & parallelFor);

  SizeValueType
  GetNumberOfPoints() const
  {
    return m_FirstPoint.back();
  }
  /** No surface has more: how many there are is known when they are. */
  SizeValueType
  GetMostTriangles() const
  {
    return m_FirstTriangle.back();
  }

  /** Fills a slab of planes. The surface must have room for all points and triangles; normals are left out where it has
   * none. With \a areOutside, one byte a point says whether its site is outside the image: triangles of such points are
   * those that close the surface. */
  void
  Fill(SizeValueType begin, SizeValueType end, bool reversed, TriangleSurface & surface, std::uint8_t * areOutside);

  /** Moves the triangles of all slabs together. */
  void
  Finish(TriangleSurface & surface) const;

private:
  FCCFieldPlanes
  MakeField() const;

  const FCCSigns & m_Signs;
  ImageRegion<3> m_Region;
  FCCFrame m_Frame;
  bool m_InsideIsBelow;
  double m_MinimumFraction;
  FCCFieldPlanes::RowReader m_ReadRow;
  FCCSplitSites m_Splits;
  std::vector<SizeValueType> m_FirstPoint;    ///< of each plane; counts until Resolve()
  std::vector<SizeValueType> m_FirstTriangle; ///< where there is room for those of a slab that begins at the plane
  std::vector<SizeValueType> m_Filled;        ///< triangles of the slab that began at the plane
};

} // namespace itk

#endif
