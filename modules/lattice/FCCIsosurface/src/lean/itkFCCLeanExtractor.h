#ifndef itkFCCLeanExtractor_h
#define itkFCCLeanExtractor_h

#include "itkFCCClusterPlane.h"
#include "itkFCCSplitSites.h"

namespace itk
{

/** \class FCCLeanExtractor
 * \brief Extracts a surface with few, well-shaped triangles: that of the tetrahedra, whose points gather at sites.
 *
 * Every point of the tetrahedra's surface moves to the nearer end of its edge. All points of one site become one
 * vertex, which is moved onto the reconstructed surface, and triangles that lose a side vanish (G. Treece, R. Prager,
 * A. Gee, "Regularised marching tetrahedra", 1999), but where the surface would not stay a manifold of the same
 * topology (see FCCSplitSites).
 *
 * Count reads the values and keeps what the crossings are nearer to, less than a byte for each crossing.
 */
class FCCLeanExtractor : public FCCSurfaceExtractor
{
public:
  FCCLeanExtractor(const FCCSigns & signs, const FCCScalarField & field);

  bool
  CountReadsSamples() const override
  {
    return true;
  }

  /** Counts points and triangles, and looks for sites that might have to be split. */
  void
  Count(SizeValueType begin, SizeValueType end) override;

  /** Splits sites, and sums up how many points there are and how many triangles there may be. */
  void
  Resolve(const Crew & crew) override;

  SizeValueType
  GetNumberOfPoints() const override
  {
    return m_FirstPoint.back();
  }

  SizeValueType
  GetMostTriangles() const override
  {
    return m_FirstTriangle.back();
  }

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override;

  /** Moves the triangles of all slabs together, and removes those that close a surface that is to stay open. */
  void
  Finish(TriangleSurface & surface) override;

private:
  const FCCSigns & m_Signs;
  FCCScalarField m_Field;
  FCCSplitSites m_Splits;
  std::vector<FCCNearerEnds::Packed> m_NearerEnds; ///< by plane
  std::vector<SizeValueType> m_FirstPoint;         ///< first point of each plane; counts until Resolve()
  std::vector<SizeValueType> m_FirstTriangle; ///< by plane: where the triangles of a slab that begins there are written
  std::vector<SizeValueType> m_Filled;        ///< by plane: the number of triangles of the slab that began there
  std::vector<std::uint8_t> m_AreOutside;     ///< by point, unless closed: whether its site is outside the image
};

} // namespace itk

#endif
