#include "itkTriangleSurfaceSimplification.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTriangleContact.h"
#include "itkEdgeCollapse.h"
#include "itkForEachBlock.h"
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
using Contact = TriangleContact;
using Boxes = std::vector<std::vector<Box>>; ///< for each patch, boxes in which its triangles are bad

constexpr std::size_t PatchSize = 4096;
constexpr std::size_t SimplifiedBlock = 1024;

/** The share of the triangles in the first part when triangles are cut in two, in successive steps. It varies so that
 * the patches of successive steps have few borders in common. */
constexpr std::array<double, 3> Cuts{ 0.5, 0.36, 0.64 };

constexpr double FirstError = 1.0 / 32.0; // in mean sides of triangles, doubled with each step
constexpr double LargestShareLeft = 0.95; // share of the triangles that are left after a worthwhile step, at most
constexpr double ShareForWitnesses = 0.9; // relative to maximumError, to keep the surface between witnesses within it
constexpr unsigned int MostRounds = 32;   // rounds of putting triangles back; the second half puts back whole patches

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

/** Some triangles of the surface before and after a step. Where a check of the new triangles fails, the old ones are
 * held and the patch is simplified again. */
struct Patch
{
  SurfacePart before;
  Box bounds; ///< box around the triangles before
  std::vector<std::uint8_t> isHeld;
  CollapsedPart after;

  bool
  IsSimplified() const
  {
    return after.numberOfOldTriangles < after.part.triangles.size();
  }
};

Patch
MakePatch(const TriangleSurface & surface, const TriangleRange & range)
{
  Patch patch;
  const auto * const triangles = surface.GetTriangles().data();
  patch.before.triangles.assign(triangles + range.begin, triangles + range.end);
  patch.isHeld.assign(range.Size(), 0);
  patch.bounds = TriangleTree::BoxOf(surface.GetPoints(), patch.before.triangles.front());
  for (const auto & triangle : patch.before.triangles)
  {
    patch.bounds = TriangleTree::Union(patch.bounds, TriangleTree::BoxOf(surface.GetPoints(), triangle));
  }
  return patch;
}

/** Holds the triangles whose boxes meet one of \a boxes. Returns whether any was not held before. */
bool
HoldTriangles(Patch & patch, const TriangleSurface & surface, const std::vector<Box> & boxes)
{
  bool isAnyNew = false;
  for (std::size_t id = 0; id < patch.isHeld.size(); ++id)
  {
    const Box own = TriangleTree::BoxOf(surface.GetPoints(), patch.before.triangles[id]);
    if (!patch.isHeld[id] &&
        std::any_of(boxes.begin(), boxes.end(), [&own](const Box & box) { return box.Overlaps(own); }))
    {
      patch.isHeld[id] = 1;
      isAnyNew = true;
    }
  }
  return isAnyNew;
}

/** How many triangles of a patch are left after all edges of up to an error have collapsed. */
std::size_t
CountTriangles(const Patch & patch, double error)
{
  const auto & progress = patch.after.progress;
  const auto after =
    std::upper_bound(progress.begin(), progress.end(), error, [](double value, const CollapseProgress & step) {
      return value < step.error;
    });
  return after == progress.begin() ? patch.before.triangles.size() : std::prev(after)->triangles;
}

std::size_t
CountTriangles(const std::vector<Patch> & patches, double error)
{
  return std::accumulate(patches.begin(),
                         patches.end(),
                         std::size_t{ 0 },
                         [error](std::size_t sum, const Patch & patch) { return sum + CountTriangles(patch, error); });
}

/** A surface that is simplified in steps. */
class Simplification
{
public:
  /** \param original null if the distance from it has no limit */
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
  SimplifyPatches(const std::vector<PatchId> & patches);
  void
  AimAtTarget(const std::vector<PatchId> & all);
  bool
  PutBackBadTriangles(std::vector<PatchId> changed);
  void
  JoinPatches();
  Boxes
  FindBad(const std::vector<PatchId> & patches, bool checksAll) const;
  void
  FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Boxes & bad) const;
  void
  FindStrays(const std::vector<PatchId> & patches, Boxes & bad) const;
  void
  FindUncovered(const TriangleTree & state, const std::vector<PatchId> & patches, bool checksAll, Boxes & bad) const;
  std::vector<PatchId>
  Hold(const Boxes & bad, bool holdsAll);

  const SizeValueType m_Target;
  const double m_MaximumError;
  const TriangleSurfaceTopology m_Topology;
  TriangleSurface & m_State;
  const OriginalSurface m_Original;
  SizeValueType m_PlacesPutBack = 0;
  bool m_IsHeldBack = false; ///< whether maximumError kept edges from collapsing in the last step

  // Empty if the distance has no limit.
  std::vector<TriangleId> m_NearPoints; ///< for each point of m_State, a triangle of the original nearby
  std::vector<TriangleId>
    m_WitnessTriangles; ///< for each point of the original, the triangle of m_State that covers it

  // The current step.
  TriangleSurface::Pointer m_Before;
  std::vector<Patch> m_Patches;
  std::vector<CollapseGoal> m_Goals; ///< by patch
  std::vector<TriangleId> m_Begin;   ///< first triangle of each patch in m_State, and the end of the last
  std::vector<PatchId> m_PatchOf;    ///< the patch of each triangle of m_State
  std::vector<std::uint8_t> m_IsNew; ///< for each triangle of m_State, whether it was not there before the step
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
    const bool isStuck = m_State.GetNumberOfTriangles() > LargestShareLeft * static_cast<double>(before);
    if (!isSound || (isStuck && !(error < limit) && !this->IsAtTarget()))
    {
      report.end =
        m_IsHeldBack && m_Original.tree != nullptr ? SimplificationEnd::MaximumError : SimplificationEnd::Topology;
      break;
    }
    error = std::min(limit, 2.0 * error);
  }
  report.trianglesAfter = m_State.GetNumberOfTriangles();
  report.placesTakenBack = m_PlacesPutBack;
  return report;
}

/** Simplifies the state once. If the result's topology is not that of the original, restores the state from before and
 * returns false. */
bool
Simplification::Step(double error, double cut)
{
  this->SwapWithBefore();
  this->CutIntoPatches(cut);
  m_Goals.assign(m_Patches.size(), { error, 0 });
  std::vector<PatchId> all(m_Patches.size());
  std::iota(all.begin(), all.end(), 0u);
  this->SimplifyPatches(all);
  this->AimAtTarget(all);
  this->JoinPatches();
  const bool isSound = this->PutBackBadTriangles(all) && HaveSameTopology(ComputeTopology(m_State), m_Topology);
  m_IsHeldBack =
    std::any_of(m_Patches.begin(), m_Patches.end(), [](const Patch & patch) { return patch.after.wasHeldBack; });
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
  struct TriangleOfPatch
  {
    PatchId patch;
    TriangleId triangle;
  };
  std::vector<TriangleOfPatch> newIds(oldIds.size());
  m_Patches.clear();
  for (const TriangleRange & range : ranges)
  {
    for (std::size_t id = range.begin; id < range.end; ++id)
    {
      newIds[oldIds[id]] = { static_cast<PatchId>(m_Patches.size()), static_cast<TriangleId>(id - range.begin) };
    }
    m_Patches.push_back(MakePatch(*m_Before, range));
  }
  for (PointId point = 0; point < m_WitnessTriangles.size(); ++point)
  {
    const auto & [patch, triangle] = newIds[m_WitnessTriangles[point]];
    m_Patches[patch].before.witnesses.push_back({ point, triangle });
  }
}

/** Simplifies everything in some patches that is not held. */
void
Simplification::SimplifyPatches(const std::vector<PatchId> & patches)
{
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    Patch & patch = m_Patches[patches[n]];
    patch.after = CollapseEdges(*m_Before, patch.before, patch.isHeld, m_Original, m_Goals[patches[n]]);
  });
}

/** If the patches together have fewer triangles than the target, simplifies them again to just the target: finds the
 * error at which they pass it, and shares the last triangles among them. */
void
Simplification::AimAtTarget(const std::vector<PatchId> & all)
{
  const std::size_t target = m_Target;
  if (CountTriangles(m_Patches, std::numeric_limits<double>::infinity()) >= target)
  {
    return;
  }
  std::vector<double> errors{ -1.0 }; // less than that of any edge
  for (const Patch & patch : m_Patches)
  {
    for (const CollapseProgress & progress : patch.after.progress)
    {
      errors.push_back(progress.error);
    }
  }
  std::sort(errors.begin(), errors.end());
  errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
  const auto enough = std::partition_point(
    errors.begin() + 1, errors.end(), [&](double error) { return CountTriangles(m_Patches, error) > target; });
  const double tooLittle = *std::prev(enough);
  const std::size_t least = CountTriangles(m_Patches, *enough);
  const double share =
    static_cast<double>(target - least) / static_cast<double>(CountTriangles(m_Patches, tooLittle) - least);
  for (const PatchId id : all)
  {
    const std::size_t left = CountTriangles(m_Patches[id], *enough);
    const double more = share * static_cast<double>(CountTriangles(m_Patches[id], tooLittle) - left);
    m_Goals[id].triangles = left + static_cast<std::size_t>(more);
  }
  this->SimplifyPatches(all);
}

/** Puts triangles back where new ones are bad, until no check fails. At first checks all patches, then only changed
 * ones; a check of all patches comes last. Returns false if that takes too many rounds. */
bool
Simplification::PutBackBadTriangles(std::vector<PatchId> changed)
{
  bool checksAll = true;
  for (unsigned int round = 0; round < MostRounds; ++round)
  {
    changed = this->Hold(this->FindBad(changed, checksAll), 2 * round >= MostRounds);
    if (changed.empty() && checksAll)
    {
      return true;
    }
    checksAll = changed.empty();
    this->SimplifyPatches(changed);
    this->JoinPatches();
  }
  return false;
}

/** Makes the state of what is left of the patches. */
void
Simplification::JoinPatches()
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
    const CollapsedPart & after = m_Patches[id].after;
    for (const Witness & witness : after.part.witnesses)
    {
      m_WitnessTriangles[witness.point] = m_Begin.back() + witness.triangle;
    }
    triangles.insert(triangles.end(), after.part.triangles.begin(), after.part.triangles.end());
    m_IsNew.resize(m_Begin.back() + after.numberOfOldTriangles, 0);
    m_IsNew.resize(triangles.size(), 1);
    m_PatchOf.resize(triangles.size(), id);
    m_Begin.push_back(static_cast<TriangleId>(triangles.size()));
    for (const MovedPoint & moved : after.movedPoints)
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

/** Finds, for each patch, the boxes in which its new triangles must not stay. Checks what some patches have changed, or
 * everything. */
Boxes
Simplification::FindBad(const std::vector<PatchId> & patches, bool checksAll) const
{
  Boxes bad(m_Patches.size());
  const TriangleTree state(m_State);
  this->FindContacts(state, patches, bad);
  if (m_Original.tree != nullptr)
  {
    this->FindStrays(patches, bad);
    this->FindUncovered(state, patches, checksAll, bad);
  }
  return bad;
}

/** Adds the new triangles that meet others elsewhere than at shared corners and sides, for pairs with a triangle in one
 * of \a patches. */
void
Simplification::FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Boxes & bad) const
{
  const auto & points = m_State.GetPoints();
  const auto & triangles = m_State.GetTriangles();
  std::vector<std::uint8_t> isChecked(m_Patches.size(), 0);
  for (const PatchId patch : patches)
  {
    isChecked[patch] = 1;
  }
  // Each pair once: from its new triangle, from the later one if both are new, else from the one in a checked patch.
  const auto isFoundFromOther = [&](TriangleId id, TriangleId other) {
    return m_IsNew[other] && isChecked[m_PatchOf[other]] && (!m_IsNew[id] || other > id);
  };
  std::vector<std::vector<TriangleId>> found(patches.size());
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    const bool isAnyUnchecked = patches.size() < m_Patches.size();
    for (TriangleId id = m_Begin[patches[n]]; id < m_Begin[patches[n] + 1]; ++id)
    {
      if (!m_IsNew[id] && !isAnyUnchecked)
      {
        continue;
      }
      state.VisitTriangles(TriangleTree::BoxOf(points, triangles[id]), [&](TriangleId other) {
        if (other != id && (m_IsNew[id] || m_IsNew[other]) && !isFoundFromOther(id, other) &&
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
        bad[m_PatchOf[id]].push_back(TriangleTree::BoxOf(points, triangles[id]));
      }
    }
  }
}

/** Adds the new triangles of some patches that are farther than maximumError from the original. */
void
Simplification::FindStrays(const std::vector<PatchId> & patches, Boxes & bad) const
{
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    const PatchId patch = patches[n];
    for (TriangleId id = m_Begin[patch]; id < m_Begin[patch + 1]; ++id)
    {
      const auto & [a, b, c] = m_State.GetTriangles()[id];
      if (m_IsNew[id] && !IsWithinDistance(CornersOf(m_State, m_State.GetTriangles()[id]),
                                           *m_Original.tree,
                                           m_MaximumError,
                                           { m_NearPoints[a], m_NearPoints[b], m_NearPoints[c] }))
      {
        bad[patch].push_back(TriangleTree::BoxOf(m_State.GetPoints(), m_State.GetTriangles()[id]));
      }
    }
  });
}

/** Adds the triangles of the original that are farther than maximumError from the state, for all simplified patches
 * near them. A triangle is near if one triangle covers all its corners. Checks the triangles that some patches cover,
 * or all. */
void
Simplification::FindUncovered(const TriangleTree & state,
                              const std::vector<PatchId> & patches,
                              bool checksAll,
                              Boxes & bad) const
{
  std::vector<std::uint8_t> isChecked(m_Patches.size(), checksAll ? 1 : 0);
  for (const PatchId patch : patches)
  {
    isChecked[patch] = 1;
  }
  const TriangleSurface & original = m_Original.tree->GetSurface();
  const auto & triangles = original.GetTriangles();
  std::vector<std::uint8_t> isUncovered(triangles.size(), 0);
  ForEachInBlocks(triangles.size(), SimplifiedBlock, [&](std::size_t id) {
    const auto & [a, b, c] = triangles[id];
    const std::array<TriangleId, 3> near{ m_WitnessTriangles[a], m_WitnessTriangles[b], m_WitnessTriangles[c] };
    const bool isConcerned =
      std::any_of(near.begin(), near.end(), [&](TriangleId other) { return isChecked[m_PatchOf[other]] != 0; });
    if (isConcerned && !(near[0] == near[1] && near[1] == near[2]))
    {
      isUncovered[id] = IsWithinDistance(CornersOf(original, triangles[id]), state, m_MaximumError, near) ? 0 : 1;
    }
  });
  for (TriangleId id = 0; id < triangles.size(); ++id)
  {
    if (!isUncovered[id])
    {
      continue;
    }
    const Box box = Grown(TriangleTree::BoxOf(original.GetPoints(), triangles[id]), static_cast<float>(m_MaximumError));
    for (PatchId patch = 0; patch < m_Patches.size(); ++patch)
    {
      if (m_Patches[patch].IsSimplified() && m_Patches[patch].bounds.Overlaps(box))
      {
        bad[patch].push_back(box);
      }
    }
  }
}

/** Holds the old triangles in the boxes where new ones are bad; if there is none more to hold, or \a holdsAll, holds
 * the whole patch. Returns the patches that changed. */
std::vector<PatchId>
Simplification::Hold(const Boxes & bad, bool holdsAll)
{
  std::vector<PatchId> changed;
  for (PatchId id = 0; id < m_Patches.size(); ++id)
  {
    if (bad[id].empty())
    {
      continue;
    }
    m_PlacesPutBack += bad[id].size();
    changed.push_back(id);
    Patch & patch = m_Patches[id];
    if (holdsAll || !HoldTriangles(patch, *m_Before, bad[id]))
    {
      patch.isHeld.assign(patch.isHeld.size(), 1);
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
