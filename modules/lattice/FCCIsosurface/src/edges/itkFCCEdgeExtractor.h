#ifndef itkFCCEdgeExtractor_h
#define itkFCCEdgeExtractor_h

#include "itkFCCEdgePoints.h"

namespace itk
{

/** \class FCCEdgeExtractor
 * \brief What the extractors that put one point on each cut edge have in common: counting and numbering.
 *
 * Signs alone say which edges are cut and which triangles there are; samples are read to place the points.
 */
class FCCEdgeExtractor : public FCCSurfaceExtractor
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
  /** \param types of edges that have points: bits, as FCCStoredEdges has them
   *  \param cubic see FCCEdgePoints */
  FCCEdgeExtractor(const FCCSigns & signs, const FCCScalarField & field, std::uint8_t types, bool cubic);

  /** Number of triangles between plane \a k and the next, or of layer \a k of cells. */
  virtual SizeValueType
  CountTriangles(SizeValueType k) const = 0;

  FCCCutEdges
  MakeCutEdges(FCCStoredEdges::Group group) const
  {
    return FCCCutEdges(m_Signs, group, m_Types, m_Field.scratch);
  }

  /** Finds the cut edges of plane \a k, with the ids of their points; of planes past the last, none. */
  void
  Find(SizeValueType k, FCCCutEdges & inPlane) const
  {
    inPlane.Find(k, static_cast<std::uint32_t>(m_InPlane[k]));
  }

  /** Finds the cut edges between plane \a k and the next. */
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
  // By plane: counts until Resolve(), then the number of the first one, and the total at the end.
  std::vector<SizeValueType> m_InPlane;   ///< points on edges within the plane
  std::vector<SizeValueType> m_Between;   ///< points on edges to the next plane
  std::vector<SizeValueType> m_Triangles; ///< results of CountTriangles()
};

} // namespace itk

#endif
