#ifndef itkFCCEdgeExtractor_h
#define itkFCCEdgeExtractor_h

#include "itkFCCEdgePoints.h"

#include <algorithm>

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
  Count(SizeValueType begin, SizeValueType end) override
  {
    for (SizeValueType k = begin; k < end; ++k)
    {
      m_InPlane[k] = FCCCutEdges::Count(m_Signs, FCCStoredEdges::Group::InPlane, k, m_Types);
      m_FirstPoint[k] = m_InPlane[k] + FCCCutEdges::Count(m_Signs, FCCStoredEdges::Group::Between, k, m_Types);
      m_FirstTriangle[k] = this->CountTriangles(k);
    }
  }

protected:
  /** \param types of edges that have points: bits, as FCCStoredEdges has them
   *  \param cubic see FCCEdgePoints */
  FCCEdgeExtractor(const FCCSigns & signs, const FCCScalarField & field, std::uint8_t types, bool cubic)
    : FCCSurfaceExtractor(signs, field)
    , m_Types(types)
    , m_EdgePoints(field, cubic, field.closed ? 1 : 0)
    , m_InPlane(signs.GetDepth())
  {}

  /** Number of triangles between plane \a k and the next, or of layer \a k of cells. */
  virtual SizeValueType
  CountTriangles(SizeValueType k) const = 0;

  FCCCutEdges
  MakeCutEdges(FCCStoredEdges::Group group) const
  {
    return FCCCutEdges(m_Signs, group, m_Types, m_Field.scratch);
  }

  /** Finds the cut edges of plane \a k, with the ids of their points. Planes past the last have no edges. */
  void
  Find(SizeValueType k, FCCCutEdges & inPlane) const
  {
    inPlane.Find(k, static_cast<std::uint32_t>(m_FirstPoint[k]));
  }

  /** Finds the cut edges between plane \a k and the next. */
  void
  FindBetween(SizeValueType k, FCCCutEdges & between) const
  {
    between.Find(k, static_cast<std::uint32_t>(m_FirstPoint[k] + m_InPlane[k]));
  }

  /** Planes of the field's gradients that FillPoints() needs. */
  static constexpr SizeValueType PlanesOfGradients = 2;

  /** Fills the points on the cut edges that plane \a k of the signs stores, and their normals if the surface has any.
   * \a field is that of the planes, in ascending order. */
  void
  FillPoints(SizeValueType k,
             const FCCCutEdges & inPlane,
             const FCCCutEdges & between,
             FCCFieldPlanes & field,
             TriangleSurface & surface) const
  {
    const bool hasNormals = surface.HasNormals();
    const SizeValueType toField = m_Field.closed ? 0 : 1; // from a plane of the signs to that of the field
    for (SizeValueType end = k; end < std::min(k + 2, m_Signs.GetDepth()); ++end) // the planes of the edges' ends
    {
      field.LoadValuesAround(end + toField);
      if (hasNormals)
      {
        field.LoadGradients(end + toField);
      }
    }
    for (const FCCCutEdges * const edges : { &inPlane, &between })
    {
      m_EdgePoints.Place(m_Signs,
                         *edges,
                         k,
                         field,
                         surface.GetPoints().data() + edges->GetFirstId(),
                         hasNormals ? surface.GetNormals().data() + edges->GetFirstId() : nullptr);
    }
  }

  TriangleSurface::TriangleType *
  GetTriangles(SizeValueType k, TriangleSurface & surface) const
  {
    return surface.GetTriangles().data() + m_FirstTriangle[k];
  }

private:
  std::uint8_t m_Types;
  FCCEdgePoints m_EdgePoints;
  std::vector<SizeValueType> m_InPlane; ///< by plane: points on edges within the plane, which come first
};

} // namespace itk

#endif
