#ifndef itkFCCEdgeExtractor_h
#define itkFCCEdgeExtractor_h

#include "itkFCCEdgePoints.h"

#include <algorithm>
#include <utility>

namespace itk
{

/** The cut edges around plane k that have points. */
struct FCCLayerEdges
{
  const FCCCutEdges * inPlane[3]; ///< cut edges within the planes k - 1, k and k + 1
  const FCCCutEdges * between[2]; ///< cut edges between the planes k - 1 and k, and k and k + 1
};

/** \class FCCEdgeExtractor
 * \brief Base of the extractors that put one point on each cut edge: counts, numbers and fills the points. Derived
 * classes count and fill the triangles, plane by plane.
 *
 * Signs alone say which edges are cut and which triangles there are; samples are read to place the points.
 */
class FCCEdgeExtractor : public FCCSurfaceExtractor
{
public:
  void
  Count(SizeValueType begin, SizeValueType end) override
  {
    for (SizeValueType k = begin; k < end; ++k)
    {
      m_InPlane[k] = FCCCutEdges::Count(m_Signs, Group::InPlane, k, m_Types);
      m_FirstPoint[k] = m_InPlane[k] + FCCCutEdges::Count(m_Signs, Group::Between, k, m_Types);
      m_FirstTriangle[k] = this->CountTriangles(k);
    }
  }

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override
  {
    FCCFieldPlanes field(m_Signs, m_Field, 2);
    const auto make = [this](Group group) { return FCCCutEdges(m_Signs, group, m_Types, m_Field.scratch); };
    // Cut edges of the planes before, at and after plane k; before the first plane there are none.
    FCCCutEdges inPlane[3] = { make(Group::InPlane), make(Group::InPlane), make(Group::InPlane) };
    FCCCutEdges between[2] = { make(Group::Between), make(Group::Between) };
    if (begin > 0 && m_UsesPlaneBefore)
    {
      this->Find(begin - 1, inPlane[0]);
      this->FindBetween(begin - 1, between[0]);
    }
    this->Find(begin, inPlane[1]);
    for (SizeValueType k = begin; k < end; ++k)
    {
      this->FindBetween(k, between[1]);
      this->Find(k + 1, inPlane[2]);
      this->FillPoints(k, inPlane[1], between[1], field, surface);
      this->FillTriangles(k,
                          { { &inPlane[0], &inPlane[1], &inPlane[2] }, { &between[0], &between[1] } },
                          surface.GetTriangles().data() + this->PlaceOfTriangles(k));
      std::rotate(std::begin(inPlane), std::begin(inPlane) + 1, std::end(inPlane));
      std::swap(between[0], between[1]);
    }
  }

protected:
  /** \param types of edges that have points: bits, as FCCStoredEdges has them
   *  \param cubic see FCCEdgePoints
   *  \param usesPlaneBefore whether FillTriangles() reads the cut edges of plane k - 1 */
  FCCEdgeExtractor(const FCCSigns & signs,
                   const FCCScalarField & field,
                   std::uint8_t types,
                   bool cubic,
                   bool usesPlaneBefore)
    : FCCSurfaceExtractor(signs, field)
    , m_Types(types)
    , m_UsesPlaneBefore(usesPlaneBefore)
    , m_EdgePoints(field, cubic, field.closed ? 1 : 0)
    , m_InPlane(signs.GetDepth())
  {}

  /** Number of triangles between plane \a k and the next, or of layer \a k of cells. */
  virtual SizeValueType
  CountTriangles(SizeValueType k) const = 0;

  /** Writes these triangles. */
  virtual void
  FillTriangles(SizeValueType k, const FCCLayerEdges & edges, TriangleSurface::TriangleType * triangles) const = 0;

private:
  using Group = FCCStoredEdges::Group;

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
      const SizeValueType first = this->PlaceOfPoint(edges->GetFirstId());
      m_EdgePoints.Place(m_Signs,
                         *edges,
                         k,
                         field,
                         surface.GetPoints().data() + first,
                         hasNormals ? surface.GetNormals().data() + first : nullptr);
    }
  }

  std::uint8_t m_Types;
  bool m_UsesPlaneBefore;
  FCCEdgePoints m_EdgePoints;
  std::vector<SizeValueType> m_InPlane; ///< by plane: points on edges within the plane, which come first
};

} // namespace itk

#endif
