#include "itkFCCClusterPoints.h"
#include "itkFCCExtractors.h"
#include "itkFCCLeanMarching.h"
#include "itkFCCSplitSites.h"

#include <algorithm>

namespace itk
{
namespace
{

/** Three consecutive planes. Each plane is found once, from the plane below it. */
class PlaneSequence
{
public:
  PlaneSequence(const FCCSigns & signs, const FCCSplitRows * splits, std::pmr::memory_resource * scratch)
    : m_Depth(signs.GetDepth())
    , m_Splits(splits)
    , m_Planes{ FCCClusterPlane(signs, scratch), FCCClusterPlane(signs, scratch), FCCClusterPlane(signs, scratch) }
  {}

  /** Finds plane \a k, if there is one, with vertices numbered from \a first on: findNearerEnds(k, FCCNearerEnds) and
   * then the vertices. */
  template <typename TFindNearerEnds>
  void
  Find(SizeValueType k, const TFindNearerEnds & findNearerEnds, SizeValueType first = 0)
  {
    if (k < m_Depth)
    {
      findNearerEnds(k, this->Get(k).GetNearerEnds());
      this->Get(k).Find(k, this->Get(k + m_Planes.size() - 1), m_Splits, static_cast<std::uint32_t>(first));
    }
  }

  FCCClusterPlane &
  Get(SizeValueType k)
  {
    return m_Planes[k % m_Planes.size()];
  }

private:
  SizeValueType m_Depth;
  const FCCSplitRows * m_Splits;
  std::array<FCCClusterPlane, 3> m_Planes;
};

/** The sites of a plane that break a condition of FCCSplitSites, and the starts of edges that do, by a count of all
 * triangles at the plane's sites and edges. The counts are zero afterwards. */
std::vector<std::uint32_t>
TakeSuspects(const FCCSigns & signs, const FCCClusterPlane & plane, FCCTriangleUse & use)
{
  std::vector<std::uint32_t> suspects;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    plane.ForEachWholeSite(j, [&](SizeValueType i, unsigned int crossings) {
      if (FCCTriangleUse::BreakCondition(use.Take(j, i)) || !FCCCells::IsDisk(crossings))
      {
        suspects.push_back(static_cast<std::uint32_t>(j * signs.GetWidth() + i));
      }
    });
  }
  return suspects;
}

class FCCLeanExtractor : public FCCSurfaceExtractor
{
public:
  FCCLeanExtractor(const FCCSigns & signs, const FCCScalarField & field)
    : FCCSurfaceExtractor(signs, field)
    , m_Splits(signs, field.scratch)
    , m_NearerEnds(signs.GetDepth())
  {}

  bool
  CountReadsSamples() const override
  {
    return true;
  }

  void
  Count(SizeValueType begin, SizeValueType end) override;

  void
  Resolve(const Workers & workers) override;

  void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) override;

  void
  Finish(TriangleSurface & surface) override;

private:
  FCCSplitSites m_Splits;
  std::vector<FCCNearerEnds::Packed> m_NearerEnds; ///< by plane
  std::vector<std::uint8_t> m_AreOutside;          ///< by point, unless closed: whether its site is outside the image
};

void
FCCLeanExtractor::Count(SizeValueType begin, SizeValueType end)
{
  FCCFieldPlanes field(m_Signs, m_Field, 3);
  PlaneSequence planes(m_Signs, nullptr, m_Field.scratch);
  const auto findNearerEnds = [&](SizeValueType k, FCCNearerEnds & nearerEnds) {
    for (SizeValueType near = k; near < std::min(k + 2, m_Signs.GetDepth()); ++near)
    {
      field.LoadValues(near);
    }
    nearerEnds.Find(k, field, m_Field.insideIsBelow);
  };
  std::array<FCCTriangleUse, 2> uses{ FCCTriangleUse(m_Signs, m_Field.scratch),
                                      FCCTriangleUse(m_Signs, m_Field.scratch) };
  const auto useOf = [&uses](SizeValueType k) -> FCCTriangleUse & { return uses[k % uses.size()]; };

  // The triangles below the first plane use its sites and edges, too.
  const SizeValueType first = begin > 0 ? begin - 1 : 0;
  planes.Find(first, findNearerEnds);
  for (SizeValueType k = first; k < end; ++k)
  {
    planes.Find(k + 1, findNearerEnds);
    const bool isLast = k + 1 == m_Signs.GetDepth();
    const SizeValueType triangles =
      isLast ? 0 : CountTriangleUse({ m_Signs, k, planes.Get(k), planes.Get(k + 1) }, useOf(k), useOf(k + 1));
    if (k >= begin)
    {
      m_FirstTriangle[k] = triangles;
      m_FirstPoint[k] = planes.Get(k).GetWholeSites().Count();
      m_Splits.Suspect(k,
                       TakeSuspects(m_Signs, planes.Get(k), useOf(k)),
                       { &planes.Get(k + 2).GetNearerEnds(), // of plane k - 1
                         &planes.Get(k).GetNearerEnds(),
                         &planes.Get(k + 1).GetNearerEnds() });
      m_NearerEnds[k] = planes.Get(k).GetNearerEnds().Pack();
    }
    else
    {
      useOf(k).Clear();
    }
  }
}

void
FCCLeanExtractor::Resolve(const Workers & workers)
{
  m_Splits.Resolve(m_NearerEnds, workers, m_FirstPoint, m_FirstTriangle);
  this->SumUp();
  m_AreOutside.resize(m_Field.closed ? 0 : this->GetNumberOfPoints());
}

void
FCCLeanExtractor::Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface)
{
  FCCFieldPlanes field(m_Signs, m_Field, 3);
  PlaneSequence planes(m_Signs, &m_Splits.GetRows(), m_Field.scratch);
  const auto findNearerEnds = [this](SizeValueType k, FCCNearerEnds & nearerEnds) {
    nearerEnds.Unpack(k, m_NearerEnds[k]);
  };
  const bool reversed = m_Field.frame.IsLeftHanded();
  const SizeValueType around = surface.HasNormals() ? 1 : 0; // planes whose gradients are needed
  if (begin > 0)
  {
    planes.Find(begin - 1, findNearerEnds);
  }
  TriangleSurface::TriangleType * triangles = surface.GetTriangles().data() + this->PlaceOfTriangles(begin);
  planes.Find(begin, findNearerEnds, m_FirstPoint[begin]);
  for (SizeValueType k = begin; k < end; ++k)
  {
    planes.Find(k + 1, findNearerEnds, m_FirstPoint[k + 1]);
    for (SizeValueType near = k - std::min(k, around); near < std::min(k + around + 1, m_Signs.GetDepth()); ++near)
    {
      field.LoadGradients(near);
    }
    const SizeValueType place = this->PlaceOfPoint(m_FirstPoint[k]);
    PlaceVertices(m_Field,
                  m_Signs,
                  planes.Get(k),
                  k,
                  field,
                  surface.GetPoints().data() + place,
                  surface.HasNormals() ? surface.GetNormals().data() + place : nullptr,
                  m_Field.closed ? nullptr : m_AreOutside.data() + m_FirstPoint[k]);
    if (k + 1 < m_Signs.GetDepth())
    {
      triangles += FillLeanTriangles({ m_Signs, k, planes.Get(k), planes.Get(k + 1) }, reversed, triangles);
    }
  }
}

void
FCCLeanExtractor::Finish(TriangleSurface & surface)
{
  if (!m_Field.closed)
  {
    auto & triangles = surface.GetTriangles();
    const auto isOutside = [this](const TriangleSurface::TriangleType & triangle) {
      return (m_AreOutside[triangle[0]] | m_AreOutside[triangle[1]] | m_AreOutside[triangle[2]]) != 0;
    };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isOutside), triangles.end());
  }
}

} // namespace

std::unique_ptr<FCCSurfaceExtractor>
MakeFCCLeanExtractor(const FCCSigns & signs, const FCCScalarField & field)
{
  return std::make_unique<FCCLeanExtractor>(signs, field);
}

} // namespace itk
