#include "itkPatchTopology.h"

#include "itkDisjointSets.h"

#include <tuple>

namespace itk
{

PatchTopology::PatchTopology(const std::vector<TriangleType> & triangles,
                             std::size_t numberOfPoints,
                             const std::function<bool(PointId)> & isChecked)
  : m_Triangles(triangles)
  , m_Components(numberOfPoints)
  , m_EulerCharacteristics(numberOfPoints, 0)
{
  this->FindComponents();
  this->FindSides(isChecked);
  this->CheckEdges();
  this->CheckFans(isChecked);
  std::sort(m_BadTriangles.begin(), m_BadTriangles.end());
  m_BadTriangles.erase(std::unique(m_BadTriangles.begin(), m_BadTriangles.end()), m_BadTriangles.end());
  std::sort(m_Border.begin(), m_Border.end());
}

void
PatchTopology::FindComponents()
{
  DisjointSets sets(m_Components.size());
  std::vector<bool> isUsed(m_Components.size());
  for (const TriangleType & triangle : m_Triangles)
  {
    sets.Join(triangle[0], triangle[1]);
    sets.Join(triangle[1], triangle[2]);
    for (const PointId point : triangle)
    {
      isUsed[point] = true;
    }
  }
  for (PointId point = 0; point < m_Components.size(); ++point)
  {
    m_Components[point] = sets.Find(point);
    m_EulerCharacteristics[m_Components[point]] += isUsed[point] ? 1 : 0;
  }
  for (const TriangleType & triangle : m_Triangles)
  {
    ++m_EulerCharacteristics[m_Components[triangle[0]]];
  }
}

void
PatchTopology::FindSides(const std::function<bool(PointId)> & isChecked)
{
  m_Sides.reserve(3 * m_Triangles.size());
  for (std::uint32_t corner = 0; corner < 3 * m_Triangles.size(); ++corner)
  {
    const PointId from = PointAt(corner);
    const PointId to = PointAt(Next(corner));
    if (!isChecked || isChecked(from) || isChecked(to))
    {
      m_Sides.push_back({ std::min(from, to), std::max(from, to), corner });
    }
  }
  std::sort(m_Sides.begin(), m_Sides.end(), [](const Side & a, const Side & b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
}

/** Whether two sides of one edge run in opposite directions and belong to triangles with different third points. */
bool
PatchTopology::AreNeighbours(std::uint32_t corner, std::uint32_t other) const
{
  return PointAt(corner) != PointAt(other) && PointAt(Next(Next(corner))) != PointAt(Next(Next(other)));
}

void
PatchTopology::CheckEdges()
{
  for (std::size_t begin = 0, end = 0; begin < m_Sides.size(); begin = end)
  {
    const Side & first = m_Sides[begin];
    for (end = begin; end < m_Sides.size() && m_Sides[end].low == first.low && m_Sides[end].high == first.high;)
    {
      ++end;
    }
    --m_EulerCharacteristics[m_Components[first.low]];
    if (end - begin == 1)
    {
      m_Border.push_back({ PointAt(first.corner), PointAt(Next(first.corner)) });
    }
    else if (end - begin > 2 || !AreNeighbours(first.corner, m_Sides[begin + 1].corner))
    {
      for (std::size_t side = begin; side < end; ++side)
      {
        m_BadTriangles.push_back(m_Sides[side].corner / 3);
      }
    }
  }
}

/** Corners at one point that are joined through triangles with a common edge are a fan. */
void
PatchTopology::CheckFans(const std::function<bool(PointId)> & isChecked)
{
  const auto numberOfCorners = static_cast<std::uint32_t>(3 * m_Triangles.size());
  DisjointSets fans(numberOfCorners);
  for (std::size_t side = 0; side + 1 < m_Sides.size(); ++side)
  {
    const Side & a = m_Sides[side];
    const Side & b = m_Sides[side + 1];
    if (a.low == b.low && a.high == b.high && AreNeighbours(a.corner, b.corner))
    {
      fans.Join(a.corner, Next(b.corner));
      fans.Join(Next(a.corner), b.corner);
    }
  }
  std::vector<std::uint32_t> numberOfFans(m_Components.size(), 0);
  for (std::uint32_t corner = 0; corner < numberOfCorners; ++corner)
  {
    numberOfFans[PointAt(corner)] += fans.Find(corner) == corner ? 1 : 0;
  }
  std::vector<std::uint32_t> leavingBorder(m_Components.size(), 0);
  for (const DirectedEdge & edge : m_Border)
  {
    ++leavingBorder[edge[0]];
  }
  for (std::uint32_t corner = 0; corner < numberOfCorners; ++corner)
  {
    const PointId point = PointAt(corner);
    const bool isJudged = !isChecked || isChecked(point);
    if (isJudged && numberOfFans[point] != std::max(1u, leavingBorder[point]))
    {
      m_BadTriangles.push_back(corner / 3);
    }
  }
}

} // namespace itk
