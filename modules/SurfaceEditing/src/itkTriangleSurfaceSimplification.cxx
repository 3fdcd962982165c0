#include "itkTriangleSurfaceSimplification.h"

#include "itkForEachBlock.h"
#include "itkSimplifiedPatch.h"
#include "detail/itkTriangleContact.h"
#include "itkTrianglePartition.h"
#include "itkTriangleProximity.h"
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

using PatchId = std::uint32_t;
using PointId = std::uint32_t;
using TriangleId = std::uint32_t;
using Box = TriangleTree::Box;
using Contact = TriangleContactEnums::Contact;
using Corners = std::array<PositionType, 3>;
using Places = std::vector<std::vector<Box>>; // of each patch

constexpr std::size_t PatchSize = 4096;
constexpr std::size_t BlockSize = 1024;

/** Where the triangles are cut in two, in the steps one after the other: patches of successive steps have few borders
 * in common. */
constexpr std::array<double, 3> Cuts{ 0.5, 0.36, 0.64 };

constexpr double FirstError = 1.0 / 32.0; // in mean sides of triangles, doubled with each step
constexpr double LeastGain = 0.95;        // of the triangles left by a step that was worth while
constexpr double ShareForWitnesses = 0.9; // of the maximumError: what is between them is seldom further than that then
constexpr unsigned int MostRounds = 32;   // of taking back; in the second half, whole patches are

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

bool
HaveSameTopology(const TriangleSurfaceTopology & a, const TriangleSurfaceTopology & b)
{
  return a.components == b.components && a.eulerCharacteristic == b.eulerCharacteristic &&
         a.boundaryEdges == b.boundaryEdges && a.nonManifoldEdges == b.nonManifoldEdges &&
         a.misorientedEdges == b.misorientedEdges && a.nonManifoldPoints == b.nonManifoldPoints &&
         a.degenerateTriangles == b.degenerateTriangles;
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

Corners
CornersOf(const TriangleSurface & surface, std::size_t id)
{
  const auto & points = surface.GetPoints();
  const auto & triangle = surface.GetTriangles()[id];
  return { ToPosition(points[triangle[0]]), ToPosition(points[triangle[1]]), ToPosition(points[triangle[2]]) };
}

/** How many triangles of a patch are left after all edges of up to an error have shrunk. */
std::size_t
TrianglesLeft(const SimplifiedPatch & patch, double error)
{
  const auto & progress = patch.GetProgress();
  const auto after =
    std::upper_bound(progress.begin(), progress.end(), error, [](double value, const SimplifiedPatch::Progress & step) {
      return value < step.error;
    });
  return after == progress.begin() ? patch.GetNumberOfTrianglesBefore() : std::prev(after)->triangles;
}

std::size_t
TrianglesLeft(const std::vector<SimplifiedPatch> & patches, double error)
{
  return std::accumulate(
    patches.begin(), patches.end(), std::size_t{ 0 }, [error](std::size_t sum, const SimplifiedPatch & patch) {
      return sum + TrianglesLeft(patch, error);
    });
}

/** A surface that gets simpler step by step. */
class Simplification
{
public:
  /** \param original null if there is no limit to the distance from it */
  Simplification(TriangleSurface & surface,
                 const TriangleSurfaceTopology & topology,
                 const TriangleSurfaceSimplificationSettings & settings,
                 const TriangleTree * original)
    : m_Target(settings.targetTriangles)
    , m_MaximumError(settings.maximumError)
    , m_Topology(topology)
    , m_State(surface)
    , m_Original{ original, ShareForWitnesses * settings.maximumError, &m_NearPoints }
    , m_Before(TriangleSurface::New())
  {
    if (original != nullptr)
    {
      m_NearPoints.resize(surface.GetNumberOfPoints());
      for (TriangleId id = 0; id < surface.GetNumberOfTriangles(); ++id)
      {
        for (const PointId point : surface.GetTriangles()[id])
        {
          m_NearPoints[point] = id;
        }
      }
      m_WitnessTriangles = m_NearPoints;
    }
  }

  TriangleSurfaceSimplificationReport
  Run();

private:
  bool
  IsAtTarget() const
  {
    return m_Target > 0 && m_State.GetNumberOfTriangles() <= m_Target;
  }
  bool
  Step(double error, double cut);
  void
  SwapWithBefore();
  void
  CutIntoPatches(double cut);
  void
  SimplifyPatches(const std::vector<PatchId> & which);
  void
  AimAtTarget(const std::vector<PatchId> & all);
  void
  PutTogether();
  Places
  FindBad(const std::vector<PatchId> & patches, bool looksAtAll) const;
  void
  FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Places & bad) const;
  void
  FindStrays(const std::vector<PatchId> & patches, Places & bad) const;
  void
  FindLeftBehind(const TriangleTree & state, const std::vector<PatchId> & patches, bool looksAtAll, Places & bad) const;
  std::vector<PatchId>
  Hold(const Places & bad, bool holdsAll);

  const SizeValueType m_Target;
  const double m_MaximumError;
  const TriangleSurfaceTopology m_Topology;
  TriangleSurface & m_State;
  const EdgeCollapse::Original m_Original;

  // empty where there is no limit to the distance
  std::vector<TriangleId> m_NearPoints;       // a triangle of the original near each point of m_State
  std::vector<TriangleId> m_WitnessTriangles; // of m_State, that stands for what was at each point of the original

  // of one step
  TriangleSurface::Pointer m_Before;
  std::vector<SimplifiedPatch> m_Patches;
  std::vector<SimplifiedPatch::Goal> m_Goals;
  std::vector<TriangleId> m_Begin; // of each patch's triangles in m_State, and their end
  std::vector<PatchId> m_PatchOf;  // each triangle of m_State
  std::vector<std::uint8_t> m_IsNew;
  SizeValueType m_PlacesTakenBack = 0;
  bool m_IsHeldBack = false; // by the maximumError
};

TriangleSurfaceSimplificationReport
Simplification::Run()
{
  TriangleSurfaceSimplificationReport report;
  report.trianglesBefore = m_State.GetNumberOfTriangles();
  const double limit = std::min(m_MaximumError, Diagonal(m_State));
  double error = std::min(limit, FirstError * MeanSide(m_State));
  report.end = SimplificationEnd::Target;
  for (std::size_t step = 0; !this->IsAtTarget(); ++step)
  {
    const SizeValueType before = m_State.GetNumberOfTriangles();
    const bool isSound = this->Step(error, Cuts[step % Cuts.size()]);
    const bool isStuck = m_State.GetNumberOfTriangles() > LeastGain * static_cast<double>(before);
    if (!isSound || (isStuck && !(error < limit) && !this->IsAtTarget()))
    {
      report.end =
        m_IsHeldBack && m_Original.tree != nullptr ? SimplificationEnd::MaximumError : SimplificationEnd::Topology;
      break;
    }
    error = std::min(limit, 2.0 * error);
  }
  report.trianglesAfter = m_State.GetNumberOfTriangles();
  report.placesTakenBack = m_PlacesTakenBack;
  return report;
}

/** Simplifies the state once. Returns whether the result's topology is as it should be; without that it is the state
 * from before. */
bool
Simplification::Step(double error, double cut)
{
  this->SwapWithBefore();
  this->CutIntoPatches(cut);
  m_Goals.assign(m_Patches.size(), { error, 0 });
  std::vector<PatchId> changed(m_Patches.size());
  std::iota(changed.begin(), changed.end(), 0u);
  this->SimplifyPatches(changed);
  this->AimAtTarget(changed);
  this->PutTogether();
  m_IsHeldBack = false;
  bool looksAtAll = true;
  unsigned int round = 0;
  for (; round < MostRounds; ++round)
  {
    const Places bad = this->FindBad(changed, looksAtAll);
    changed = this->Hold(bad, 2 * round >= MostRounds);
    if (changed.empty() && looksAtAll)
    {
      break;
    }
    looksAtAll = changed.empty();
    this->SimplifyPatches(changed);
    this->PutTogether();
  }
  m_IsHeldBack = m_IsHeldBack || std::any_of(m_Patches.begin(), m_Patches.end(), [](const SimplifiedPatch & patch) {
                   return patch.WasHeldBack();
                 });
  const bool isSound = round < MostRounds && HaveSameTopology(ComputeTopology(m_State), m_Topology);
  if (!isSound)
  {
    this->SwapWithBefore();
  }
  m_Patches.clear();
  return isSound;
}

void
Simplification::SwapWithBefore()
{
  m_State.GetPoints().swap(m_Before->GetPoints());
  m_State.GetNormals().swap(m_Before->GetNormals());
  m_State.GetTriangles().swap(m_Before->GetTriangles());
}

void
Simplification::CutIntoPatches(double cut)
{
  std::vector<TriangleId> oldIds(m_Before->GetNumberOfTriangles());
  std::iota(oldIds.begin(), oldIds.end(), 0u);
  const auto ranges = SortIntoRanges(m_Before->GetPoints(), m_Before->GetTriangles(), oldIds, PatchSize, cut);
  struct Place
  {
    PatchId patch;
    TriangleId triangle;
  };
  std::vector<Place> places(oldIds.size());
  m_Patches.clear();
  for (const TriangleRange & range : ranges)
  {
    for (std::size_t id = range.begin; id < range.end; ++id)
    {
      places[oldIds[id]] = { static_cast<PatchId>(m_Patches.size()), static_cast<TriangleId>(id - range.begin) };
    }
    m_Patches.emplace_back(*m_Before, range.begin, range.end);
  }
  for (PointId point = 0; point < m_WitnessTriangles.size(); ++point)
  {
    const Place & place = places[m_WitnessTriangles[point]];
    m_Patches[place.patch].AddWitness({ point, place.triangle });
  }
}

void
Simplification::SimplifyPatches(const std::vector<PatchId> & which)
{
  ForEachInBlocks(which.size(), 1, [&](std::size_t n) { m_Patches[which[n]].Simplify(m_Goals[which[n]], m_Original); });
}

/** Where the patches have become fewer triangles than asked for, finds the error for which they do just so. */
void
Simplification::AimAtTarget(const std::vector<PatchId> & all)
{
  const std::size_t target = m_Target;
  if (TrianglesLeft(m_Patches, std::numeric_limits<double>::infinity()) >= target)
  {
    return;
  }
  std::vector<double> errors{ -1.0 }; // of no edge
  for (const SimplifiedPatch & patch : m_Patches)
  {
    for (const SimplifiedPatch::Progress & progress : patch.GetProgress())
    {
      errors.push_back(progress.error);
    }
  }
  std::sort(errors.begin(), errors.end());
  errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
  const auto enough = std::partition_point(
    errors.begin() + 1, errors.end(), [&](double error) { return TrianglesLeft(m_Patches, error) > target; });
  const double tooLittle = *std::prev(enough);
  const std::size_t least = TrianglesLeft(m_Patches, *enough);
  const double share =
    static_cast<double>(target - least) / static_cast<double>(TrianglesLeft(m_Patches, tooLittle) - least);
  for (const PatchId id : all)
  {
    const std::size_t left = TrianglesLeft(m_Patches[id], *enough);
    const double more = share * static_cast<double>(TrianglesLeft(m_Patches[id], tooLittle) - left);
    m_Goals[id].triangles = left + static_cast<std::size_t>(more);
  }
  this->SimplifyPatches(all);
}

void
Simplification::PutTogether()
{
  auto & triangles = m_State.GetTriangles();
  m_State.GetPoints() = m_Before->GetPoints();
  m_State.GetNormals() = m_Before->GetNormals();
  triangles.clear();
  m_Begin.assign(1, 0);
  m_PatchOf.clear();
  m_IsNew.clear();
  for (PatchId id = 0; id < m_Patches.size(); ++id)
  {
    const SimplifiedPatch & patch = m_Patches[id];
    for (const EdgeCollapse::Witness & witness : patch.GetResult().witnesses)
    {
      m_WitnessTriangles[witness.point] = m_Begin.back() + witness.triangle;
    }
    triangles.insert(triangles.end(), patch.GetResult().triangles.begin(), patch.GetResult().triangles.end());
    m_IsNew.resize(m_Begin.back() + patch.GetNumberOfOldTriangles(), 0);
    m_IsNew.resize(triangles.size(), 1);
    m_PatchOf.resize(triangles.size(), id);
    m_Begin.push_back(static_cast<TriangleId>(triangles.size()));
    for (const EdgeCollapse::MovedPoint & moved : patch.GetMovedPoints())
    {
      m_State.GetPoints()[moved.id] = moved.position;
      if (m_Original.tree != nullptr)
      {
        m_NearPoints[moved.id] = moved.near;
      }
      if (m_Before->HasNormals())
      {
        m_State.GetNormals()[moved.id] = moved.normal;
      }
    }
  }
}

/** Finds places, for each patch, where its new triangles must not stay. Looks at what some patches have changed, or at
 * all. */
Places
Simplification::FindBad(const std::vector<PatchId> & patches, bool looksAtAll) const
{
  Places bad(m_Patches.size());
  const TriangleTree state(m_State);
  this->FindContacts(state, patches, bad);
  if (m_Original.tree != nullptr)
  {
    this->FindStrays(patches, bad);
    this->FindLeftBehind(state, patches, looksAtAll, bad);
  }
  return bad;
}

/** Adds the new triangles that meet others than their neighbours. One of the two is in one of the given patches. */
void
Simplification::FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Places & bad) const
{
  const auto & points = m_State.GetPoints();
  const auto & triangles = m_State.GetTriangles();
  std::vector<std::vector<TriangleId>> found(patches.size());
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    for (TriangleId id = m_Begin[patches[n]]; id < m_Begin[patches[n] + 1]; ++id)
    {
      state.VisitTriangles(BoxOf(points, triangles[id]), [&](TriangleId other) {
        if (other != id && (m_IsNew[id] || m_IsNew[other]) &&
            FindContact(points, triangles[id], triangles[other]) != Contact::Apart)
        {
          found[n].push_back(id);
          found[n].push_back(other);
        }
      });
    }
  });
  for (const auto & ids : found)
  {
    for (const TriangleId id : ids)
    {
      if (m_IsNew[id])
      {
        bad[m_PatchOf[id]].push_back(BoxOf(points, triangles[id]));
      }
    }
  }
}

/** Adds the new triangles of some patches that are not within the maximumError. */
void
Simplification::FindStrays(const std::vector<PatchId> & patches, Places & bad) const
{
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    const PatchId patch = patches[n];
    for (TriangleId id = m_Begin[patch]; id < m_Begin[patch + 1]; ++id)
    {
      const auto & [a, b, c] = m_State.GetTriangles()[id];
      if (m_IsNew[id] && !IsWithinDistance(CornersOf(m_State, id),
                                           *m_Original.tree,
                                           m_MaximumError,
                                           { m_NearPoints[a], m_NearPoints[b], m_NearPoints[c] }))
      {
        bad[patch].push_back(BoxOf(m_State.GetPoints(), m_State.GetTriangles()[id]));
      }
    }
  });
}

/** Adds the triangles of the original that the state is not within the maximumError of, for all patches near them. All
 * is well where one triangle stands for all three corners. Looks at those only that some patches stand for, or at all.
 */
void
Simplification::FindLeftBehind(const TriangleTree & state,
                               const std::vector<PatchId> & patches,
                               bool looksAtAll,
                               Places & bad) const
{
  std::vector<std::uint8_t> isLookedAt(m_Patches.size(), looksAtAll ? 1 : 0);
  for (const PatchId patch : patches)
  {
    isLookedAt[patch] = 1;
  }
  const TriangleSurface & original = m_Original.tree->GetSurface();
  const auto & triangles = original.GetTriangles();
  std::vector<std::uint8_t> isLeft(triangles.size(), 0);
  ForEachInBlocks(triangles.size(), BlockSize, [&](std::size_t id) {
    const auto & [a, b, c] = triangles[id];
    const std::array<TriangleId, 3> near{ m_WitnessTriangles[a], m_WitnessTriangles[b], m_WitnessTriangles[c] };
    const bool isConcerned =
      std::any_of(near.begin(), near.end(), [&](TriangleId n) { return isLookedAt[m_PatchOf[n]] != 0; });
    if (isConcerned && !(near[0] == near[1] && near[1] == near[2]))
    {
      isLeft[id] = IsWithinDistance(CornersOf(original, id), state, m_MaximumError, near) ? 0 : 1;
    }
  });
  for (TriangleId id = 0; id < triangles.size(); ++id)
  {
    if (!isLeft[id])
    {
      continue;
    }
    const Box box = Grown(BoxOf(original.GetPoints(), triangles[id]), static_cast<float>(m_MaximumError));
    for (PatchId patch = 0; patch < m_Patches.size(); ++patch)
    {
      if (m_Patches[patch].IsSimplified() && m_Patches[patch].GetBounds().Overlaps(box))
      {
        bad[patch].push_back(box);
      }
    }
  }
}

/** Holds what was where new triangles are bad. Returns the patches for which this makes a difference. */
std::vector<PatchId>
Simplification::Hold(const Places & bad, bool holdsAll)
{
  std::vector<PatchId> changed;
  for (PatchId patch = 0; patch < m_Patches.size(); ++patch)
  {
    if (bad[patch].empty())
    {
      continue;
    }
    m_PlacesTakenBack += bad[patch].size();
    changed.push_back(patch);
    if (holdsAll || !m_Patches[patch].Hold(bad[patch]))
    {
      m_Patches[patch].HoldAll();
    }
  }
  return changed;
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
  surface.RemoveUnusedPoints();
  if (surface.GetTriangles().empty())
  {
    return {};
  }
  auto original = TriangleSurface::New();
  std::unique_ptr<TriangleTree> tree;
  if (std::isfinite(settings.maximumError))
  {
    original->GetPoints() = surface.GetPoints();
    original->GetTriangles() = surface.GetTriangles();
    tree = std::make_unique<TriangleTree>(*original);
  }
  const auto report = Simplification(surface, topology, settings, tree.get()).Run();
  surface.RemoveUnusedPoints();
  surface.Modified();
  return report;
}

} // namespace itk
