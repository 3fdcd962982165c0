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
constexpr float Growth = 0.25f;         // of a bad place, by its longest side, with each round

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

/** A box with \a share of its longest side more on every side. */
Box
Inflated(Box box, float share)
{
  float longest = 0.0f;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, box.highest[axis] - box.lowest[axis]);
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lowest[axis] -= share * longest;
    box.highest[axis] += share * longest;
  }
  return box;
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
SimplifiedPatch::TakeBack(const std::vector<Box> & places)
{
  ++m_Rounds;
  m_PlacesTakenBack += places.size();
  if (m_Rounds > MostRounds)
  {
    std::fill(m_IsHeld.begin(), m_IsHeld.end(), std::uint8_t{ 1 });
    return;
  }
  for (const Box & place : places)
  {
    const Box box = Inflated(place, Growth * static_cast<float>(m_Rounds));
    for (std::size_t id = 0; id < m_IsHeld.size(); ++id)
    {
      m_IsHeld[id] = m_IsHeld[id] || BoxOf(*m_Points, m_Begin[id]).Overlaps(box) ? 1 : 0;
    }
  }
}

void
SimplifiedPatch::Simplify(const Goal & goal, const TooFarCheck & isTooFar)
{
  this->SimplifyOnce(goal);
  for (auto bad = this->FindBadPlaces(isTooFar); !bad.empty(); bad = this->FindBadPlaces(isTooFar))
  {
    this->TakeBack(bad);
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

/** Places of the result at which something is wrong. */
std::vector<Box>
SimplifiedPatch::FindBadPlaces(const TooFarCheck & isTooFar) const
{
  if (m_NumberHeld == m_IsHeld.size())
  {
    return {};
  }
  const std::vector<TriangleType> triangles(m_Begin, m_End);
  const LocalIds ids(triangles);
  const std::vector<TriangleType> before = ids.ToLocal(triangles);
  const std::vector<TriangleType> after = ids.ToLocal(m_Result);
  const PatchTopology topologyBefore(before, ids.GetIds().size());
  const PatchTopology topologyAfter(after, ids.GetIds().size());

  std::vector<Box> places;
  for (const std::uint32_t id : topologyAfter.GetBadTriangles())
  {
    places.push_back(BoxOf(*m_Points, m_Result[id]));
  }
  for (std::size_t id = m_NumberHeld; id < m_Result.size(); ++id)
  {
    const std::array<PointType, 3> corners{ (*m_Points)[m_Result[id][0]],
                                            (*m_Points)[m_Result[id][1]],
                                            (*m_Points)[m_Result[id][2]] };
    if (!HasArea(corners) || (isTooFar && isTooFar(corners)))
    {
      places.push_back(BoxOf(*m_Points, m_Result[id]));
    }
  }
  if (places.empty())
  {
    const std::vector<bool> isLost = FindLostComponents(topologyBefore, topologyAfter, after);
    const bool isBorderKept = topologyBefore.GetBorder() == topologyAfter.GetBorder();
    for (std::size_t id = 0; id < before.size(); ++id)
    {
      if (!isBorderKept || isLost[before[id][0]])
      {
        places.push_back(BoxOf(*m_Points, triangles[id]));
      }
    }
  }
  return places;
}

} // namespace itk
