#ifndef itkFCCEdgeSurface_h
#define itkFCCEdgeSurface_h

#include "itkFCCEdgePoints.h"

namespace itk
{

/** \class FCCEdgeSurface
 * \brief What the surfaces with one point on each cut edge have in common: the numbers of their points and triangles.
 *
 * Signs alone say which edges are cut and which triangles there are; samples are read to place the points.
 *
 * \ingroup FCCIsosurface
 */
class FCCEdgeSurface : public FCCSurfaceExtraction
{
public:
  bool
  CountReadsSamples() const override
  {
    return false;
  }

  void
  Count(SizeValueType begin, SizeValueType end) override;

  void
  Resolve(const Crew & crew) override;

  SizeValueType
  GetNumberOfPoints() const override
  {
    return m_InPlane.back();
  }

  SizeValueType
  GetMostTriangles() const override
  {
    return m_Triangles.back();
  }

  void
  Finish(TriangleSurface &) override
  {}

protected:
  /** \param types of edges that have points, for FCCCutEdges
   *  \param cubic see FCCEdgePoints */
  FCCEdgeSurface(const FCCSigns & signs, const FCCScalarField & field, std::uint8_t types, bool cubic);

  /** Of plane \a k and the next, or of layer \a k of cells. */
  virtual SizeValueType
  CountTriangles(SizeValueType k) const = 0;

  FCCCutEdges
  MakeCutEdges(FCCCutEdges::Group group) const
  {
    return FCCCutEdges(m_Signs, group, m_Types, m_Field.scratch);
  }

  /** Finds the cut edges of plane \a k, with the ids of their points; of planes past the last, none. */
  void
  Find(SizeValueType k, FCCCutEdges & inPlane) const
  {
    inPlane.Find(k, static_cast<std::uint32_t>(m_InPlane[k]));
  }

  /** The same for those between plane \a k and the next. */
  void
  FindBetween(SizeValueType k, FCCCutEdges & between) const
  {
    between.Find(k, static_cast<std::uint32_t>(m_Between[k]));
  }

  FCCEdgePointFiller
  MakeFiller() const
  {
    return FCCEdgePointFiller(m_Signs, m_Field, m_EdgePoints);
  }

  TriangleSurface::TriangleType *
  GetTriangles(SizeValueType k, TriangleSurface & surface) const
  {
    return surface.GetTriangles().data() + m_Triangles[k];
  }

  const FCCSigns & m_Signs;
  FCCScalarField m_Field;

private:
  std::uint8_t m_Types;
  FCCEdgePoints m_EdgePoints;
  std::vector<SizeValueType>
    m_InPlane; ///< first point on edges within each plane, and the total; counts till Resolve()
  std::vector<SizeValueType> m_Between;   ///< first point on edges to the next plane
  std::vector<SizeValueType> m_Triangles; ///< first triangle
};

} // namespace itk

#endif
