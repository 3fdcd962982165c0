#include "itkTriangleSurfaceSimplification.h"

#include "itkParallelBlocks.h"
#include "itkSimplifiedPatch.h"
#include "itkTriangleContact.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <cmath>
#include <memory>
#include <numeric>
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
using Contact = TriangleContactEnums::Contact;

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
  PointType centre; // times 3
  TriangleType corners;
};

constexpr double ShareOfMaximumError = 0.5; // for the mean error that meshoptimizer knows
constexpr double FirstError = 0.125;        // in mean sides of triangles, doubled with each step towards a target
constexpr double LeastGain = 0.98;          // of the triangles left by a step that was worth while

double
MeanSide(const TriangleSurface & surface)
{
  return std::sqrt(4.0 / std::sqrt(3.0) * ComputeArea(surface) / static_cast<double>(surface.GetNumberOfTriangles()));
}

double
Diagonal(const TriangleSurface & surface)
{
  const std::array<double, 6> bounds = surface.GetBounds();
  return std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
}

Box
Grown(Box box, float by)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lowest[axis] -= by;
    box.highest[axis] += by;
  }
  return box;
}

Box
Intersection(const Box & a, const Box & b)
{
  Box box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lowest[axis] = std::max(a.lowest[axis], b.lowest[axis]);
    box.highest[axis] = std::min(a.highest[axis], b.highest[axis]);
  }
  return box;
}

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

/** Whether two surfaces with the same points have the same topology and are equally sound. */
bool
HaveSameTopology(const TriangleSurfaceTopology & a, const TriangleSurfaceTopology & b)
{
  return a.components == b.components && a.eulerCharacteristic == b.eulerCharacteristic &&
         a.boundaryEdges == b.boundaryEdges && a.nonManifoldEdges == b.nonManifoldEdges &&
         a.misorientedEdges == b.misorientedEdges && a.nonManifoldPoints == b.nonManifoldPoints &&
         a.degenerateTriangles == b.degenerateTriangles;
}

/** A surface that gets simpler step by step. All states have the same points. */
class Simplification
{
public:
  Simplification(const TriangleSurface & surface,
                 const TriangleSurfaceTopology & topology,
                 const TriangleSurfaceSimplificationSettings & settings)
    : m_Settings(settings)
    , m_Topology(topology)
    , m_Original(surface)
    , m_State(TriangleSurface::New())
  {
    m_State->GetPoints() = surface.GetPoints();
    m_State->GetTriangles() = surface.GetTriangles();
    if (std::isfinite(settings.maximumError))
    {
      m_OriginalTree = std::make_unique<TriangleTree>(surface);
    }
  }

  TriangleSurfaceSimplificationReport
  Run();

  Triangles &
  GetTriangles()
  {
    return m_State->GetTriangles();
  }

private:
  using Places = std::vector<std::vector<Box>>; // of each patch

  bool
  IsAtTarget() const
  {
    return m_Settings.targetTriangles > 0 && m_State->GetNumberOfTriangles() <= m_Settings.targetTriangles;
  }
  bool
  Step(double error, double cut);
  void
  CutIntoPatches(double cut);
  void
  SimplifyPatches(const std::vector<std::uint32_t> & which);
  void
  AimAtTarget();
  void
  PutTogether();
  void
  FindContacts(const TriangleTree & state, const std::vector<std::uint32_t> & patches, Places & places) const;
  std::vector<std::uint32_t>
  FindPlacesLeft(const TriangleTree & state, const std::vector<std::uint32_t> & doubtful, Places & places) const;
  void
  AddNear(const std::vector<std::uint32_t> & patches, std::vector<std::uint32_t> & doubtful) const;
  std::uint32_t
  PatchOf(std::uint32_t triangle) const;
  bool
  IsNew(std::uint32_t triangle) const;

  const TriangleSurfaceSimplificationSettings m_Settings;
  const TriangleSurfaceTopology m_Topology;
  const TriangleSurface & m_Original;
  std::unique_ptr<TriangleTree> m_OriginalTree; // where there is a limit to the error
  TriangleSurface::Pointer m_State;

  // of one step
  Triangles m_Before;
  std::vector<SimplifiedPatch> m_Patches;
  std::vector<SimplifiedPatch::Goal> m_Goals;
  std::vector<std::uint32_t> m_Begin; // of each patch's triangles in m_State, and their end
  SizeValueType m_PlacesTakenBack = 0;
};

TriangleSurfaceSimplificationReport
Simplification::Run()
{
  TriangleSurfaceSimplificationReport report;
  report.trianglesBefore = m_State->GetNumberOfTriangles();
  const double limit = m_OriginalTree ? ShareOfMaximumError * m_Settings.maximumError : Diagonal(m_Original);
  double error = m_Settings.targetTriangles > 0 ? std::min(limit, FirstError * MeanSide(m_Original)) : limit;
  report.end = SimplificationEnd::Target;
  for (std::size_t step = 0; !this->IsAtTarget(); ++step)
  {
    const SizeValueType before = m_State->GetNumberOfTriangles();
    const bool isSound = this->Step(error, Cuts[step % Cuts.size()]);
    const bool isStuck = m_State->GetNumberOfTriangles() > LeastGain * static_cast<double>(before);
    if (!isSound || (isStuck && error >= limit))
    {
      report.end = m_OriginalTree ? SimplificationEnd::MaximumError : SimplificationEnd::Topology;
      break;
    }
    error = std::min(limit, 2.0 * error);
  }
  report.trianglesAfter = m_State->GetNumberOfTriangles();
  report.placesTakenBack = m_PlacesTakenBack;
  return report;
}

/** Simplifies the state once. Returns whether the result's topology is as it should be; without that it is the state
 * from before. */
bool
Simplification::Step(double error, double cut)
{
  this->CutIntoPatches(cut);
  m_Goals.assign(m_Patches.size(), { error, 0 });
  std::vector<std::uint32_t> changed(m_Patches.size());
  std::iota(changed.begin(), changed.end(), 0u);
  this->SimplifyPatches(changed);
  this->AimAtTarget();

  std::vector<std::uint32_t> doubtful(m_OriginalTree ? m_Original.GetNumberOfTriangles() : 0);
  std::iota(doubtful.begin(), doubtful.end(), 0u);
  for (;;)
  {
    this->PutTogether();
    Places places(m_Patches.size());
    {
      const TriangleTree state(*m_State);
      this->FindContacts(state, changed, places);
      doubtful = this->FindPlacesLeft(state, doubtful, places);
    }
    changed.clear();
    for (std::uint32_t patch = 0; patch < m_Patches.size(); ++patch)
    {
      if (!places[patch].empty())
      {
        changed.push_back(patch);
      }
    }
    if (changed.empty())
    {
      break;
    }
    this->AddNear(changed, doubtful);
    for (const std::uint32_t patch : changed)
    {
      m_Patches[patch].Hold(places[patch]);
      m_PlacesTakenBack += places[patch].size();
    }
    this->SimplifyPatches(changed);
  }
  const bool isSound = HaveSameTopology(ComputeTopology(*m_State), m_Topology);
  if (!isSound)
  {
    m_State->GetTriangles().swap(m_Before);
  }
  return isSound;
}

void
Simplification::CutIntoPatches(double cut)
{
  m_Before.swap(m_State->GetTriangles());
  const std::vector<Range> ranges = SortIntoPatches(m_Original.GetPoints(), m_Before, cut);
  m_Patches.clear();
  for (const Range & range : ranges)
  {
    m_Patches.emplace_back(m_Original.GetPoints(), m_Before.data() + range.begin, m_Before.data() + range.end);
  }
}

void
Simplification::SimplifyPatches(const std::vector<std::uint32_t> & which)
{
  SimplifiedPatch::Check isAllowed;
  if (m_OriginalTree)
  {
    isAllowed = [this](const std::array<PointType, 3> & corners) {
      return IsWithinDistance(corners, *m_OriginalTree, m_Settings.maximumError);
    };
  }
  ForEachInBlocks(
    which.size(), 1, [&](SizeValueType n) { m_Patches[which[n]].Simplify(m_Goals[which[n]], isAllowed); });
}

/** Where the patches have become fewer triangles than asked for, lets each lose less, by the same share. */
void
Simplification::AimAtTarget()
{
  std::size_t after = 0;
  for (const SimplifiedPatch & patch : m_Patches)
  {
    after += patch.GetTriangles().size();
  }
  if (after >= m_Settings.targetTriangles)
  {
    return;
  }
  const double share =
    static_cast<double>(m_Before.size() - m_Settings.targetTriangles) / static_cast<double>(m_Before.size() - after);
  std::vector<std::uint32_t> all;
  for (std::uint32_t patch = 0; patch < m_Patches.size(); ++patch)
  {
    const double before = static_cast<double>(m_Patches[patch].GetNumberOfTrianglesBefore());
    const double lost = before - static_cast<double>(m_Patches[patch].GetTriangles().size());
    m_Goals[patch].triangles = static_cast<std::size_t>(before - share * lost);
    all.push_back(patch);
  }
  this->SimplifyPatches(all);
}

void
Simplification::PutTogether()
{
  m_Begin.assign(1, 0);
  Triangles & triangles = m_State->GetTriangles();
  triangles.clear();
  for (const SimplifiedPatch & patch : m_Patches)
  {
    triangles.insert(triangles.end(), patch.GetTriangles().begin(), patch.GetTriangles().end());
    m_Begin.push_back(static_cast<std::uint32_t>(triangles.size()));
  }
}

std::uint32_t
Simplification::PatchOf(std::uint32_t triangle) const
{
  return static_cast<std::uint32_t>(std::upper_bound(m_Begin.begin(), m_Begin.end(), triangle) - m_Begin.begin() - 1);
}

/** Whether a triangle of the state is not one that is held. */
bool
Simplification::IsNew(std::uint32_t triangle) const
{
  const std::uint32_t patch = PatchOf(triangle);
  return triangle - m_Begin[patch] >= m_Patches[patch].GetNumberOfOldTriangles();
}

/** Finds where new triangles of some patches meet other triangles than their neighbours. */
void
Simplification::FindContacts(const TriangleTree & state,
                             const std::vector<std::uint32_t> & patches,
                             Places & places) const
{
  const auto & points = m_Original.GetPoints();
  const auto & triangles = m_State->GetTriangles();
  std::vector<std::vector<std::pair<std::uint32_t, Box>>> found(patches.size());
  ForEachInBlocks(patches.size(), 1, [&](SizeValueType n) {
    const std::uint32_t patch = patches[n];
    for (auto id = m_Begin[patch] + m_Patches[patch].GetNumberOfOldTriangles(); id < m_Begin[patch + 1]; ++id)
    {
      const Box box = BoxOf(points, triangles[id]);
      state.VisitTriangles(box, [&](std::uint32_t other) {
        if (other != id && FindContact(points, triangles[id], triangles[other]) != Contact::Apart)
        {
          const Box common = Intersection(box, BoxOf(points, triangles[other]));
          found[n].push_back({ patch, common });
          if (this->IsNew(other))
          {
            found[n].push_back({ this->PatchOf(other), common });
          }
        }
      });
    }
  });
  for (const auto & ofPatch : found)
  {
    for (const auto & [patch, box] : ofPatch)
    {
      places[patch].push_back(box);
    }
  }
}

/** Finds where the state has moved away from triangles of the original. Returns those. */
std::vector<std::uint32_t>
Simplification::FindPlacesLeft(const TriangleTree & state,
                               const std::vector<std::uint32_t> & doubtful,
                               Places & places) const
{
  std::vector<std::uint8_t> isLeft(doubtful.size());
  ForEachInBlocks(doubtful.size(), 1024, [&](SizeValueType n) {
    const auto & points = m_Original.GetPoints();
    const auto & triangle = m_Original.GetTriangles()[doubtful[n]];
    isLeft[n] = IsWithinDistance(
                  { points[triangle[0]], points[triangle[1]], points[triangle[2]] }, state, m_Settings.maximumError)
                  ? 0
                  : 1;
  });
  std::vector<std::uint32_t> left;
  for (std::size_t n = 0; n < doubtful.size(); ++n)
  {
    if (!isLeft[n])
    {
      continue;
    }
    left.push_back(doubtful[n]);
    const Box box = Grown(BoxOf(m_Original.GetPoints(), m_Original.GetTriangles()[doubtful[n]]),
                          static_cast<float>(m_Settings.maximumError));
    std::vector<std::uint32_t> patches;
    state.VisitTriangles(box, [&](std::uint32_t id) {
      if (this->IsNew(id))
      {
        patches.push_back(this->PatchOf(id));
      }
    });
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    for (const std::uint32_t patch : patches)
    {
      places[patch].push_back(box);
    }
  }
  return left;
}

/** Adds the triangles of the original that may rely on new triangles of these patches. */
void
Simplification::AddNear(const std::vector<std::uint32_t> & patches, std::vector<std::uint32_t> & doubtful) const
{
  if (!m_OriginalTree)
  {
    return;
  }
  for (const std::uint32_t patch : patches)
  {
    for (const TriangleType & triangle : m_Patches[patch].GetTriangles())
    {
      m_OriginalTree->VisitTriangles(
        Grown(BoxOf(m_Original.GetPoints(), triangle), static_cast<float>(m_Settings.maximumError)),
        [&](std::uint32_t id) { doubtful.push_back(id); });
    }
  }
  std::sort(doubtful.begin(), doubtful.end());
  doubtful.erase(std::unique(doubtful.begin(), doubtful.end()), doubtful.end());
}

void
VerifyPreconditions(const TriangleSurfaceTopology & topology, const TriangleSurfaceSimplificationSettings & settings)
{
  if (!(settings.maximumError > 0.0))
  {
    itkGenericExceptionMacro("A simplified surface can't be within " << settings.maximumError
                                                                     << " mm of the original; give a number above 0");
  }
  if (settings.targetTriangles == 0 && !std::isfinite(settings.maximumError))
  {
    itkGenericExceptionMacro("How far to simplify is not said; give a number of triangles or a largest error");
  }
  if (topology.nonManifoldEdges + topology.nonManifoldPoints + topology.misorientedEdges +
        topology.degenerateTriangles >
      0)
  {
    itkGenericExceptionMacro("Only sound surfaces can be simplified; this one has "
                             << topology.nonManifoldEdges << " non-manifold edges, " << topology.nonManifoldPoints
                             << " non-manifold points, " << topology.misorientedEdges << " misoriented edges and "
                             << topology.degenerateTriangles << " degenerate triangles; repair it first");
  }
}

} // namespace

std::ostream &
operator<<(std::ostream & os, SimplificationEnd end)
{
  switch (end)
  {
    case SimplificationEnd::Target:
      return os << "target";
    case SimplificationEnd::MaximumError:
      return os << "maximum error";
    case SimplificationEnd::Topology:
      return os << "topology";
  }
  return os << "unknown";
}

TriangleSurfaceSimplificationReport
SimplifySurface(TriangleSurface & surface, const TriangleSurfaceSimplificationSettings & settings)
{
  const TriangleSurfaceTopology topology = ComputeTopology(surface);
  VerifyPreconditions(topology, settings);
  TriangleSurfaceSimplificationReport report;
  {
    Simplification simplification(surface, topology, settings);
    report = simplification.Run();
    surface.GetTriangles().swap(simplification.GetTriangles());
  }
  surface.RemoveUnusedPoints();
  return report;
}

} // namespace itk
