#include "itkTriangleSurfaceSimplification.h"

#include "itkParallelBlocks.h"
#include "itkPatchTopology.h"
#include "itkSimplifiedPatch.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceTopology.h"

#include <cmath>
#include <ostream>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using PointType = TriangleSurface::PointType;
using TriangleType = TriangleSurface::TriangleType;
using Triangles = TriangleSurface::TrianglesContainer;
using Box = TriangleTree::Box;

constexpr std::size_t PatchSize = 4096;

/** Triangles [begin, end). */
struct Range
{
  std::size_t begin;
  std::size_t end;

  std::size_t
  Size() const
  {
    return end - begin;
  }
};

/** Where each range of triangles is cut in two, in the steps one after the other: patches of successive steps have few
 * borders in common. */
constexpr std::array<double, 3> Cuts{ 0.5, 0.36, 0.64 };

struct CentredTriangle
{
  PointType    centre; // times 3
  TriangleType corners;
};

/** Sorts triangles into patches: ranges are cut across their longest side until they are small. */
std::vector<Range>
SortIntoPatches(const TriangleSurface::PointsContainer & points, Triangles & triangles, double cut)
{
  std::vector<CentredTriangle> centred(triangles.size());
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    centred[id].corners = triangles[id];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      centred[id].centre[axis] =
        points[triangles[id][0]][axis] + points[triangles[id][1]][axis] + points[triangles[id][2]][axis];
    }
  }
  const auto split = [&centred, cut](const Range & range) {
    PointType lowest = centred[range.begin].centre;
    PointType highest = lowest;
    for (std::size_t id = range.begin; id < range.end; ++id)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        lowest[axis] = std::min(lowest[axis], centred[id].centre[axis]);
        highest[axis] = std::max(highest[axis], centred[id].centre[axis]);
      }
    }
    unsigned int longest = 0;
    for (unsigned int axis = 1; axis < 3; ++axis)
    {
      longest = highest[axis] - lowest[axis] > highest[longest] - lowest[longest] ? axis : longest;
    }
    const auto middle = range.begin + static_cast<std::size_t>(cut * static_cast<double>(range.Size()));
    std::nth_element(centred.begin() + static_cast<std::ptrdiff_t>(range.begin),
                     centred.begin() + static_cast<std::ptrdiff_t>(middle),
                     centred.begin() + static_cast<std::ptrdiff_t>(range.end),
                     [longest](const CentredTriangle & a, const CentredTriangle & b) {
                       return a.centre[longest] < b.centre[longest];
                     });
    return middle;
  };

  std::vector<Range> ranges{ { 0, triangles.size() } };
  std::vector<Range> patches;
  while (!ranges.empty())
  {
    std::vector<std::size_t> middles(ranges.size());
    ForEachInBlocks(ranges.size(), 1, [&](SizeValueType n) {
      middles[n] = ranges[n].Size() > PatchSize ? split(ranges[n]) : ranges[n].end;
    });
    std::vector<Range> next;
    for (std::size_t n = 0; n < ranges.size(); ++n)
    {
      if (middles[n] == ranges[n].end)
      {
        patches.push_back(ranges[n]);
        continue;
      }
      next.push_back({ ranges[n].begin, middles[n] });
      next.push_back({ middles[n], ranges[n].end });
    }
    ranges.swap(next);
  }
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    triangles[id] = centred[id].corners;
  }
  return patches;
}

/** A surface that gets simpler step by step. All states have the same points. */
class Simplification
{
public:
  Simplification(const TriangleSurface & surface, const TriangleSurfaceSimplificationSettings & settings)
    : m_Settings(settings)
    , m_State(TriangleSurface::New())
  {
    m_State->GetPoints() = surface.GetPoints();
    m_State->GetTriangles() = surface.GetTriangles();
    if (std::isfinite(settings.maximumError))
    {
      m_Original = std::make_unique<TriangleTree>(surface);
    }
  }

  TriangleSurfaceSimplificationReport
  Run();

  const Triangles &
  GetTriangles() const
  {
    return m_State->GetTriangles();
  }

private:
  struct BadPlace
  {
    std::size_t patch;
    Box         box;
  };

  bool
  HasErrorLimit() const
  {
    return m_Original != nullptr;
  }
  std::size_t
  CountTriangles() const;
  double
  MeanSide() const;
  void
  Step(double error, double cut);
  void
  SimplifyPatches(const std::vector<std::size_t> & which);
  void
  AimAtTarget();
  void
  PutTogether();
  std::vector<BadPlace>
  FindBadPlaces(const std::vector<std::size_t> & changed);
  void
  FindBadSeams(std::vector<BadPlace> & places) const;
  void
  FindPlacesLeft(const std::vector<std::uint32_t> & doubtful, std::vector<BadPlace> & places);
  std::vector<std::uint32_t>
  FindDoubtful(const std::vector<std::size_t> & changed) const;
  std::size_t
  PatchOf(std::size_t triangle) const;

  const TriangleSurfaceSimplificationSettings m_Settings;
  TriangleSurface::Pointer                    m_State;
  std::unique_ptr<TriangleTree>               m_Original; // where there is a limit to the error

  // of one step
  Triangles                          m_Before;
  std::vector<SimplifiedPatch>       m_Patches;
  std::vector<SimplifiedPatch::Goal> m_Goals;
  std::vector<std::size_t>           m_Begin; // of each patch's triangles in m_State
  std::vector<std::uint8_t>          m_IsOnSeam; // points of several patches
  SizeValueType                      m_PlacesTakenBack = 0;
};

} // namespace
} // namespace itk
