#include "itkSimplifiedPatch.h"

#include "itkLocalIds.h"
#include "itkPatchTopology.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using PointType = TriangleSurface::PointType;
using TriangleType = TriangleSurface::TriangleType;
using Box = TriangleTree::Box;

constexpr unsigned int MostRounds = 12; // then the whole patch is held

std::vector<PointId>
SortedOnce(std::vector<PointId> ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

bool
HasArea(const std::array<PointType, 3> & corners)
{
  std::array<double, 3> normal{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const unsigned int u = (axis + 1) % 3;
    const unsigned int v = (axis + 2) % 3;
    normal[axis] = (double{ corners[1][u] } - corners[0][u]) * (double{ corners[2][v] } - corners[0][v]) -
                   (double{ corners[1][v] } - corners[0][v]) * (double{ corners[2][u] } - corners[0][u]);
  }
  return normal != std::array<double, 3>{};
}

/** The points of components that have no successor, or several, or one with another Euler characteristic. */
std::vector<bool>
FindLostComponents(const PatchTopology & before,
                   const PatchTopology & after,
                   const std::vector<TriangleType> & trianglesAfter)
{
  const std::vector<PointId> & componentOf = before.GetComponents();
  std::vector<int> euler(componentOf.size(), 0);
  for (PointId point = 0; point < componentOf.size(); ++point)
  {
    euler[componentOf[point]] += after.GetEulerCharacteristics()[point];
  }
  std::vector<bool> isCounted(componentOf.size());
  std::vector<int> successors(componentOf.size(), 0);
  for (const TriangleType & triangle : trianglesAfter)
  {
    const PointId successor = after.GetComponents()[triangle[0]];
    successors[componentOf[successor]] += isCounted[successor] ? 0 : 1;
    isCounted[successor] = true;
  }
  std::vector<bool> isLost(componentOf.size());
  for (PointId point = 0; point < componentOf.size(); ++point)
  {
    const PointId component = componentOf[point];
    isLost[point] = successors[component] != 1 || euler[component] != before.GetEulerCharacteristics()[component];
  }
  return isLost;
}

} // namespace

Box
BoxOf(const TriangleSurface::PointsContainer & points, const TriangleType & triangle)
{
  Box box{ points[triangle[0]], points[triangle[0]] };
  for (const PointId point : triangle)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.lowest[axis] = std::min(box.lowest[axis], points[point][axis]);
      box.highest[axis] = std::max(box.highest[axis], points[point][axis]);
    }
  }
  return box;
}

void
SimplifiedPatch::HoldAround(const std::vector<PointId> & points)
{
  const auto isAny = [&points](PointId point) { return std::binary_search(points.begin(), points.end(), point); };
  for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
  {
    m_IsHeld[id] = m_IsHeld[id] || std::any_of(m_Begin[id].begin(), m_Begin[id].end(), isAny) ? 1 : 0;
  }
}

void
SimplifiedPatch::HoldIn(const std::vector<Box> & boxes)
{
  for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
  {
    const Box own = BoxOf(*m_Points, m_Begin[id]);
    m_IsHeld[id] =
      m_IsHeld[id] || std::any_of(boxes.begin(), boxes.end(), [&own](const Box & box) { return box.Overlaps(own); })
        ? 1
        : 0;
  }
}

void
SimplifiedPatch::TakeBack(const Faults & faults)
{
  ++m_Rounds;
  ++m_PlacesTakenBack;
  if (m_Rounds > MostRounds)
  {
    std::fill(m_IsHeld.begin(), m_IsHeld.end(), std::uint8_t{ 1 });
    return;
  }
  const std::vector<std::uint8_t> wasHeld = m_IsHeld;
  this->HoldAround(SortedOnce(faults.points));
  this->HoldIn(faults.boxes);
  if (m_IsHeld == wasHeld)
  {
    std::vector<PointId> points;
    for (std::size_t id = 0; id < m_NumberHeld; ++id)
    {
      points.insert(points.end(), m_Result[id].begin(), m_Result[id].end());
    }
    this->HoldAround(SortedOnce(points));
  }
}

void
SimplifiedPatch::Simplify(const Goal & goal, const TooFarCheck & isTooFar)
{
  this->SimplifyOnce(goal);
  for (Faults faults = this->FindFaults(isTooFar); !faults.IsEmpty(); faults = this->FindFaults(isTooFar))
  {
    this->TakeBack(faults);
    this->SimplifyOnce(goal);
  }
}

void
SimplifiedPatch::SimplifyOnce(const Goal & goal)
{
  m_Result.clear();
  std::vector<TriangleType> rest;
  for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
  {
    (m_IsHeld[id] ? m_Result : rest).push_back(m_Begin[id]);
  }
  m_NumberHeld = m_Result.size();
  if (rest.empty())
  {
    return;
  }

  const LocalIds ids(rest);
  std::vector<PointType> positions;
  std::vector<TriangleType> local(rest.size());
  const std::vector<TriangleType> localRest = ids.ToLocal(rest);
  for (const PointId id : ids.GetIds())
  {
    positions.push_back((*m_Points)[id]);
  }
  const std::size_t target = goal.triangles > m_NumberHeld ? goal.triangles - m_NumberHeld : 0;
  const float scale = meshopt_simplifyScale(positions.front().data(), positions.size(), sizeof(PointType));
  const std::size_t indices = meshopt_simplify(local.front().data(),
                                               localRest.front().data(),
                                               3 * localRest.size(),
                                               positions.front().data(),
                                               positions.size(),
                                               sizeof(PointType),
                                               3 * target,
                                               static_cast<float>(goal.error) / scale,
                                               meshopt_SimplifyLockBorder,
                                               nullptr);
  local.resize(indices / 3);
  for (const TriangleType & triangle : local)
  {
    m_Result.push_back({ ids.GetIds()[triangle[0]], ids.GetIds()[triangle[1]], ids.GetIds()[triangle[2]] });
  }
}

SimplifiedPatch::Faults
SimplifiedPatch::FindFaults(const TooFarCheck & isTooFar) const
{
  Faults faults;
  if (m_NumberHeld == m_IsHeld.size())
  {
    return faults;
  }
  const std::vector<TriangleType> triangles(m_Begin, m_End);
  const LocalIds ids(triangles);
  const std::vector<TriangleType> before = ids.ToLocal(triangles);
  const std::vector<TriangleType> after = ids.ToLocal(m_Result);
  const PatchTopology topologyBefore(before, ids.GetIds().size());
  const PatchTopology topologyAfter(after, ids.GetIds().size());

  for (const std::uint32_t id : topologyAfter.GetBadTriangles())
  {
    faults.AddTriangle(m_Result[id]);
  }
  for (std::size_t id = m_NumberHeld; id < m_Result.size(); ++id)
  {
    const std::array<PointType, 3> corners{ (*m_Points)[m_Result[id][0]],
                                            (*m_Points)[m_Result[id][1]],
                                            (*m_Points)[m_Result[id][2]] };
    if (!HasArea(corners) || (isTooFar && isTooFar(corners)))
    {
      faults.AddTriangle(m_Result[id]);
    }
  }
  if (faults.IsEmpty())
  {
    const std::vector<bool> isLost = FindLostComponents(topologyBefore, topologyAfter, after);
    const bool isBorderKept = topologyBefore.GetBorder() == topologyAfter.GetBorder();
    for (PointId point = 0; point < isLost.size(); ++point)
    {
      if (!isBorderKept || isLost[point])
      {
        faults.points.push_back(ids.GetIds()[point]);
      }
    }
  }
  return faults;
}

} // namespace itk
