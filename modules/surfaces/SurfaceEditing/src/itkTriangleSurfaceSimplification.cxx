#include "itkTriangleSurfaceSimplification.h"

#include "detail/itkClosestOnTriangle.h"
#include "detail/itkPositionArithmetic.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkEdgeCollapse.h"
#include "rhombicBulkResource.h"
#include "rhombicForEachBlock.h"
#include "itkTrianglePartition.h"
#include "itkTriangleProximity.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <ostream>
#include <unordered_map>

namespace itk
{
namespace
{

using PatchId = std::uint32_t;
using PointId = std::uint32_t;
using TriangleId = std::uint32_t;
using VersionId = std::uint32_t; ///< of a triangle as it is between two changes
using Box = TriangleTree::Box;
using Flags = BulkVector<std::uint8_t>;
using Sheets = BulkVector<std::uint32_t>; ///< for each triangle, the number of its sheet

constexpr std::size_t PatchSize = 4096;
constexpr std::size_t SimplifiedBlock = 1024;

constexpr std::uint16_t Absent = std::numeric_limits<std::uint16_t>::max(); // changes of a triangle that is not there

/** The share of the triangles in the first part when triangles are cut in two, in successive steps. It varies so that
 * the patches of successive steps have few borders in common. */
constexpr std::array<double, 3> Cuts{ 0.5, 0.36, 0.64 };

constexpr double Aim = 0.995;                 // share of the target, since some triangles are put back
constexpr double FirstError = 1.0 / 8.0;      // in mean sides of triangles, doubled with each step
constexpr double SmallestShareKept = 0.4;     // by one step, so that the borders between patches do not differ by much
constexpr double SmallestShareRemoved = 0.05; // of the triangles, in a worthwhile step that is far from the target
constexpr double ShareForWitnesses = 0.9; // relative to maximumError, to keep the surface between witnesses within it
constexpr unsigned int MostRounds = 32;   // rounds of putting triangles back; the second half puts back whole patches

double
MeanSide(const TriangleSurface & surface)
{
  return std::sqrt(4.0 / std::sqrt(3.0) * ComputeTriangleSurfaceArea(surface) /
                   static_cast<double>(surface.GetNumberOfTriangles()));
}

double
Diagonal(const TriangleSurface & surface)
{
  const std::array<double, 6> bounds = surface.GetBounds();
  return std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
}

/** Whether topologies are the same. Curves where sheets meet may have fewer edges and points. */
bool
HaveSameTopology(const TriangleSurfaceTopology & a, const TriangleSurfaceTopology & b, bool isOneSheet)
{
  return a.components == b.components && a.eulerCharacteristic == b.eulerCharacteristic &&
         a.boundaryEdges == b.boundaryEdges && a.misorientedEdges == b.misorientedEdges &&
         a.degenerateTriangles == b.degenerateTriangles && a.duplicateTriangles == b.duplicateTriangles &&
         (!isOneSheet || (a.nonManifoldEdges == b.nonManifoldEdges && a.nonManifoldPoints == b.nonManifoldPoints));
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

/** Some triangles of the surface before and after a step. */
struct Patch
{
  SurfacePart before;
  CollapseLog log;
  std::pmr::vector<std::uint16_t> mostChanges; ///< for each triangle before, how often a corner of it may move
  CollapsedPart after;
  std::pmr::vector<std::uint16_t> checkedChanges; ///< for each triangle before, how often a corner of it had moved at
                                                  ///< the last check; Absent if the triangle had vanished
  std::pmr::vector<VersionId> versions;           ///< for each triangle before, its version at the last check

  /** The memory of all arrays of the patch, which is copied into. */
  explicit Patch(std::pmr::memory_resource * memory)
    : before{ PartIn(memory) }
    , log{ decltype(log.edges)(memory), decltype(log.covering)(memory) }
    , mostChanges(memory)
    , after{ PartIn(memory),
             decltype(after.ids)(memory),
             decltype(after.changes)(memory),
             decltype(after.movedPoints)(memory) }
    , checkedChanges(memory)
    , versions(memory)
  {}

  /** Copies a result of fewer collapses, which grows from round to round. */
  void
  TakeReplayed(const CollapsedPart & replayed)
  {
    const std::size_t most = before.triangles.size();
    Take(replayed.part.triangles, most, after.part.triangles);
    Take(replayed.part.sheets, most, after.part.sheets);
    Take(replayed.part.witnesses, before.witnesses.size(), after.part.witnesses);
    Take(replayed.ids, most, after.ids);
    Take(replayed.changes, most, after.changes);
    Take(replayed.movedPoints, log.edges.size(), after.movedPoints);
  }

private:
  /** Leaves room between the size and the most, so that few arrays are given back. */
  template <typename T>
  static void
  Take(const std::pmr::vector<T> & from, std::size_t most, std::pmr::vector<T> & to)
  {
    if (from.size() > to.capacity())
    {
      to.clear();
      to.reserve((from.size() + most + 1) / 2);
    }
    to.assign(from.begin(), from.end());
  }

  static SurfacePart
  PartIn(std::pmr::memory_resource * memory)
  {
    return { decltype(SurfacePart::triangles)(memory),
             decltype(SurfacePart::sheets)(memory),
             decltype(SurfacePart::witnesses)(memory) };
  }
};

Patch
MakePatch(const TriangleSurface & surface,
          const Sheets & sheets,
          const BulkVector<VersionId> & versions,
          const TriangleRange & range,
          std::pmr::memory_resource * memory)
{
  Patch patch(memory);
  const auto * const triangles = surface.GetTriangles().data();
  patch.before.triangles.assign(triangles + range.begin, triangles + range.end);
  patch.before.sheets.assign(sheets.data() + range.begin, sheets.data() + range.end);
  patch.mostChanges.assign(range.Size(), std::numeric_limits<std::uint16_t>::max());
  patch.checkedChanges.assign(range.Size(), 0);
  patch.versions.assign(versions.data() + range.begin, versions.data() + range.end);
  return patch;
}

/** A tree of each sheet's triangles. */
std::vector<TriangleTree>
TreesOfSheets(const TriangleSurface & surface, const Sheets & sheets, std::size_t numberOfSheets)
{
  std::vector<TriangleTree> trees;
  trees.reserve(numberOfSheets);
  if (numberOfSheets == 1)
  {
    trees.emplace_back(surface);
    return trees;
  }
  std::vector<BulkVector<TriangleId>> triangles(numberOfSheets);
  for (TriangleId id = 0; id < sheets.size(); ++id)
  {
    triangles[sheets[id]].push_back(id);
  }
  for (auto & sheet : triangles)
  {
    trees.emplace_back(surface, std::move(sheet));
  }
  return trees;
}

/** The surface before simplification. Sheets have no points in common, so that each point lies in one sheet. */
struct Original
{
  Sheets sheets;
  std::size_t numberOfSheets;
  TriangleSurface::Pointer surface;
  std::vector<TriangleTree> trees; ///< of the sheets
  TrianglesOfPoints trianglesOfPoints;

  Original(const TriangleSurface & before, const Sheets & sheetsBefore)
    : sheets(sheetsBefore)
    , numberOfSheets(*std::max_element(sheets.begin(), sheets.end()) + std::size_t{ 1 })
    , surface(Copy(before, sheets))
    , trees(TreesOfSheets(*surface, sheets, numberOfSheets))
    , trianglesOfPoints(*surface)
  {}

private:
  static TriangleSurface::Pointer
  Copy(const TriangleSurface & before, const Sheets & sheets)
  {
    auto copy = TriangleSurface::New();
    auto & points = copy->GetPoints();
    points = before.GetPoints();
    copy->GetTriangles() = before.GetTriangles();
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    Sheets sheetsOfPoints(points.size(), none); // the first sheet keeps the point, others get copies
    std::map<std::pair<PointId, std::uint32_t>, PointId> copies;
    for (TriangleId id = 0; id < sheets.size(); ++id)
    {
      for (PointId & point : copy->GetTriangles()[id])
      {
        std::uint32_t & first = sheetsOfPoints[point];
        first = first == none ? sheets[id] : first;
        if (first != sheets[id])
        {
          const auto [found, isNew] = copies.try_emplace({ point, sheets[id] }, static_cast<PointId>(points.size()));
          if (isNew)
          {
            points.push_back(before.GetPoints()[point]);
          }
          point = found->second;
        }
      }
    }
    return copy;
  }
};

/** A surface that is simplified in steps. */
class Simplification
{
public:
  /** \param original null if the distance from it has no limit */
  Simplification(TriangleSurface & surface,
                 Sheets & sheets,
                 bool isOneSheet,
                 const TriangleSurfaceTopology & topology,
                 const TriangleSurfaceSimplificationSettings & settings,
                 const Original * original,
                 rhombic::StagedProgress & progress)
    : m_Progress(progress)
    , m_Target(settings.targetTriangles)
    , m_MaximumError(settings.maximumError)
    , m_Topology(topology)
    , m_State(surface)
    , m_Sheets(sheets)
    , m_IsOneSheet(isOneSheet)
    , m_Original(original)
    , m_Before(TriangleSurface::New())
  {
    if (original != nullptr)
    {
      m_Limits = { original->surface, &original->trianglesOfPoints, ShareForWitnesses * m_MaximumError };
      m_NearPoints.resize(surface.GetNumberOfPoints());
      m_WitnessTriangles.resize(original->surface->GetNumberOfPoints());
      for (TriangleId id = 0; id < surface.GetNumberOfTriangles(); ++id)
      {
        for (unsigned int corner = 0; corner < 3; ++corner)
        {
          m_NearPoints[surface.GetTriangles()[id][corner]] = id;
          m_WitnessTriangles[original->surface->GetTriangles()[id][corner]] = id;
        }
      }
      m_IsCovered.assign(surface.GetNumberOfTriangles(), 1);
    }
    m_Versions.resize(surface.GetNumberOfTriangles());
    std::iota(m_Versions.begin(), m_Versions.end(), 0u);
    m_IsPresent.assign(m_Versions.size(), 1);
    m_Points.strata = FindStrata(surface, TrianglesOfPoints(surface)).strata;
    m_IsHeld.assign(surface.GetNumberOfPoints(), 0);
  }

  TriangleSurfaceSimplificationReport
  Run()
  {
    TriangleSurfaceSimplificationReport report;
    report.trianglesBefore = m_State.GetNumberOfTriangles();
    const double limit = std::min(m_MaximumError, Diagonal(m_State));
    double error = std::min(limit, FirstError * MeanSide(m_State));
    report.end = SimplificationEnd::Target;
    for (std::size_t step = 0; !this->IsAtTarget(); ++step)
    {
      const SizeValueType before = m_State.GetNumberOfTriangles();
      this->BeginStage(report.trianglesBefore);
      const bool isSound = this->Step(error, Cuts[step % Cuts.size()]);
      const SizeValueType removed = before - m_State.GetNumberOfTriangles();
      const bool isStuck = removed < SmallestShareRemoved * static_cast<double>(before) &&
                           (m_Target == 0 || 2 * removed < before - m_Target);
      if (isSound && isStuck && m_EndsEarly)
      {
        m_EndsEarly = false;
        continue;
      }
      if (!isSound || (isStuck && !(error < limit) && !this->IsAtTarget()))
      {
        report.end = isSound && m_IsHeldBack && m_Original != nullptr ? SimplificationEnd::MaximumError
                                                                      : SimplificationEnd::Topology;
        break;
      }
      error = std::min(limit, 2.0 * error);
    }
    report.trianglesAfter = m_State.GetNumberOfTriangles();
    report.placesTakenBack = m_PlacesPutBack;
    return report;
  }

private:
  bool
  IsAtTarget() const
  {
    return m_Target > 0 && m_State.GetNumberOfTriangles() <= m_Target;
  }
  /** Begins the stage of a step, which removes all triangles that a step may remove, as far as is known before. */
  void
  BeginStage(SizeValueType trianglesBefore)
  {
    const auto triangles = static_cast<double>(m_State.GetNumberOfTriangles());
    const auto all = static_cast<double>(trianglesBefore);
    const auto target = static_cast<double>(m_Target);
    const std::size_t checks = m_Original != nullptr ? 3 : 1; // contacts; strays and uncovered triangles
    m_Progress.Begin((all - std::max(target, SmallestShareKept * triangles)) / (all - target),
                     (1 + checks) * m_State.GetNumberOfTriangles());
  }

  /** Calls \a work(id) for the ids of triangles, on several threads, and counts the triangles as completed parts. */
  template <typename TWork>
  void
  ForEachTriangle(std::size_t triangles, const TWork & work) const
  {
    rhombic::ForEachBlock(triangles, SimplifiedBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t id = begin; id < end; ++id)
      {
        work(id);
      }
      m_Progress.Completed(end - begin);
    });
  }

  /** Simplifies the state once. If the result's topology is not that of the original, restores the state from before
   * and returns false. */
  bool
  Step(double error, double cut)
  {
    this->SwapWithBefore();
    m_Points.isHeld = m_IsHeld;
    m_Memory.emplace();
    this->CutIntoPatches(cut);
    const double shareOfPatch = this->FindShareOfPatch();
    rhombic::ForEachInBlocks(m_Patches.size(), 1, [&](std::size_t id) {
      Patch & patch = m_Patches[id];
      const auto fewest = static_cast<std::size_t>(shareOfPatch * static_cast<double>(patch.before.triangles.size()));
      patch.log = CollapseEdges({ *m_Before, m_Points, m_Limits }, patch.before, error, fewest, patch.after);
      m_Progress.Completed(patch.before.triangles.size());
    });
    this->AimAtTarget();
    this->JoinPatches();
    const double removed = static_cast<double>(m_Before->GetNumberOfTriangles()) - m_Aimed;
    const bool isSound = this->PutBackBadTriangles() &&
                         HaveSameTopology(ComputeTriangleSurfaceTopology(m_State), m_Topology, m_IsOneSheet);
    m_SharePutBack = removed > 0.0 ? (static_cast<double>(m_State.GetNumberOfTriangles()) - m_Aimed) / removed : 0.0;
    m_IsHeldBack =
      std::any_of(m_Patches.begin(), m_Patches.end(), [](const Patch & patch) { return patch.log.wasHeldBack; });
    if (!isSound)
    {
      this->SwapWithBefore();
    }
    m_Patches.clear();
    m_Memory.reset();
    return isSound;
  }

  void
  SwapWithBefore()
  {
    m_State.GetPoints().swap(m_Before->GetPoints());
    m_State.GetNormals().swap(m_Before->GetNormals());
    m_State.GetTriangles().swap(m_Before->GetTriangles());
    m_Sheets.swap(m_SheetsBefore);
  }

  void
  CutIntoPatches(double cut)
  {
    BulkVector<TriangleId> oldIds(m_Before->GetNumberOfTriangles());
    std::iota(oldIds.begin(), oldIds.end(), 0u);
    const auto ranges = SortIntoRanges(m_Before->GetPoints(), m_Before->GetTriangles(), oldIds, PatchSize, cut);
    struct TriangleOfPatch
    {
      PatchId patch;
      TriangleId triangle;
    };
    const Sheets sheets = std::move(m_SheetsBefore);
    const BulkVector<VersionId> versions = std::move(m_Versions);
    m_SheetsBefore.resize(oldIds.size());
    m_Versions.resize(oldIds.size());
    for (std::size_t n = 0; n < oldIds.size(); ++n)
    {
      m_SheetsBefore[n] = sheets[oldIds[n]];
      m_Versions[n] = versions[oldIds[n]];
    }
    m_Points.triangles.assign(m_Before->GetNumberOfPoints(), 0);
    for (const auto & triangle : m_Before->GetTriangles())
    {
      for (const PointId point : triangle)
      {
        ++m_Points.triangles[point];
      }
    }
    BulkVector<TriangleOfPatch> newIds(oldIds.size());
    for (const TriangleRange & range : ranges)
    {
      for (std::size_t id = range.begin; id < range.end; ++id)
      {
        newIds[oldIds[id]] = { static_cast<PatchId>(m_Patches.size()), static_cast<TriangleId>(id - range.begin) };
      }
      m_Patches.push_back(MakePatch(*m_Before, m_SheetsBefore, m_Versions, range, &*m_Memory));
    }
    std::vector<std::size_t> witnesses(m_Patches.size(), 0);
    for (const TriangleId triangle : m_WitnessTriangles)
    {
      ++witnesses[newIds[triangle].patch];
    }
    for (std::size_t patch = 0; patch < m_Patches.size(); ++patch)
    {
      m_Patches[patch].before.witnesses.reserve(witnesses[patch]);
    }
    for (PointId point = 0; point < m_WitnessTriangles.size(); ++point)
    {
      const auto & [patch, triangle] = newIds[m_WitnessTriangles[point]];
      m_Patches[patch].before.witnesses.push_back({ point, triangle });
    }
  }

  /** The triangles that this step may leave before bad ones are put back. */
  double
  FindAim() const
  {
    const auto before = static_cast<double>(m_Before->GetNumberOfTriangles());
    const double target = Aim * static_cast<double>(m_Target);
    return std::max(target - m_SharePutBack * std::max(0.0, before - target), SmallestShareKept * before);
  }

  /** The share of its triangles that a patch keeps at least: some can spare more than others. */
  double
  FindShareOfPatch() const
  {
    const double shareRemoved = 1.0 - this->FindAim() / static_cast<double>(m_Before->GetNumberOfTriangles());
    return m_EndsEarly ? 1.0 - std::min(shareRemoved + 0.3, 3.0 * shareRemoved + 0.05) : 0.0;
  }

  /** If the patches together have fewer triangles than this step may leave, takes back the collapses of largest error.
   */
  void
  AimAtTarget()
  {
    BulkVector<double> errors;
    std::size_t removed = 0;
    for (const Patch & patch : m_Patches)
    {
      removed += patch.before.triangles.size() - patch.after.ids.size();
      for (const EdgeToCollapse & edge : patch.log.edges)
      {
        errors.push_back(edge.error);
      }
    }
    const auto before = static_cast<double>(m_Before->GetNumberOfTriangles());
    const double target = this->FindAim();
    m_Aimed = std::max(target, before - static_cast<double>(removed));
    if (static_cast<double>(removed) <= before - target)
    {
      return;
    }
    const double perCollapse = static_cast<double>(removed) / static_cast<double>(errors.size()); // 2 inside of sheets
    const auto enough = static_cast<std::size_t>(std::ceil((before - target) / perCollapse));
    if (errors.size() <= enough)
    {
      return;
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(enough), errors.end());
    const double limit = errors[enough];
    const auto isLess = [](const EdgeToCollapse & edge, double error) { return edge.error < error; };
    const auto isMore = [](double error, const EdgeToCollapse & edge) { return error < edge.error; };
    auto remaining = static_cast<std::ptrdiff_t>(enough) -
                     std::count_if(errors.begin(), errors.end(), [limit](double error) { return error < limit; });
    std::vector<PatchId> changed;
    for (PatchId id = 0; id < m_Patches.size(); ++id)
    {
      auto & edges = m_Patches[id].log.edges;
      const auto first = std::lower_bound(edges.begin(), edges.end(), limit, isLess);
      const auto taken = std::min(remaining, std::upper_bound(first, edges.end(), limit, isMore) - first);
      remaining -= taken;
      if (first + taken != edges.end())
      {
        edges.erase(first + taken, edges.end());
        changed.push_back(id);
      }
    }
    this->Replay(changed);
  }

  void
  Replay(const std::vector<PatchId> & patches)
  {
    rhombic::ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
      Patch & patch = m_Patches[patches[n]];
      patch.TakeReplayed(
        ReplayCollapses({ *m_Before, m_Points, m_Limits }, patch.before, patch.log, patch.mostChanges));
      m_Progress.Completed(0);
    });
  }

  /** Puts triangles back where new triangles are bad, until no check fails. Returns false if that takes too many
   * rounds. */
  bool
  PutBackBadTriangles()
  {
    for (unsigned int round = 0; round < MostRounds; ++round)
    {
      const std::vector<PatchId> changed = this->Hold(this->FindBad(), round);
      if (changed.empty())
      {
        return true;
      }
      this->Replay(changed);
      this->JoinPatches();
    }
    return false;
  }

  /** Makes the state of the remaining triangles of the patches. */
  void
  JoinPatches()
  {
    auto & triangles = m_State.GetTriangles();
    m_State.GetPoints() = m_Before->GetPoints();
    m_State.GetNormals() = m_Before->GetNormals();
    triangles.clear();
    m_Sheets.clear();
    m_Begin.assign(1, 0);
    m_IsNew.clear();
    m_IsFresh.clear();
    m_Versions.clear();
    m_FirstCovered.clear();
    m_CoveredPoints.clear();
    std::fill(m_IsPresent.begin(), m_IsPresent.end(), std::uint8_t{ 0 });
    std::vector<std::uint16_t> changes;
    for (PatchId id = 0; id < m_Patches.size(); ++id)
    {
      Patch & patch = m_Patches[id];
      const CollapsedPart & after = patch.after;
      m_FirstCovered.resize(m_Begin.back() + after.part.triangles.size());
      for (std::size_t n = 0, triangle = 0; triangle < after.part.triangles.size(); ++triangle) // grouped by triangle
      {
        m_FirstCovered[m_Begin.back() + triangle] = static_cast<std::uint32_t>(m_CoveredPoints.size());
        for (; n < after.part.witnesses.size() && after.part.witnesses[n].triangle == triangle; ++n)
        {
          m_CoveredPoints.push_back(after.part.witnesses[n].point);
          m_WitnessTriangles[after.part.witnesses[n].point] = static_cast<TriangleId>(m_Begin.back() + triangle);
        }
      }
      triangles.insert(triangles.end(), after.part.triangles.begin(), after.part.triangles.end());
      m_Sheets.insert(m_Sheets.end(), after.part.sheets.begin(), after.part.sheets.end());
      changes.assign(patch.checkedChanges.size(), Absent);
      for (std::size_t n = 0; n < after.ids.size(); ++n)
      {
        const TriangleId before = after.ids[n];
        changes[before] = after.changes[n];
        m_IsNew.push_back(after.changes[n] > 0 ? 1 : 0);
        m_IsFresh.push_back(after.changes[n] != patch.checkedChanges[before] ? 1 : 0);
        if (m_IsFresh.back() != 0)
        {
          patch.versions[before] = static_cast<VersionId>(m_IsPresent.size());
          m_IsPresent.push_back(1);
        }
        m_IsPresent[patch.versions[before]] = 1;
        m_Versions.push_back(patch.versions[before]);
      }
      std::copy(changes.begin(), changes.end(), patch.checkedChanges.begin());
      m_Begin.push_back(static_cast<TriangleId>(triangles.size()));
      for (const MovedPoint & moved : after.movedPoints)
      {
        m_State.GetPoints()[moved.id] = moved.position;
        if (m_Original != nullptr)
        {
          m_NearPoints[moved.id] = moved.near;
        }
        if (m_Before->HasNormals())
        {
          m_State.GetNormals()[moved.id] = moved.normal;
        }
      }
    }
    m_FirstCovered.push_back(static_cast<std::uint32_t>(m_CoveredPoints.size()));
  }

  /** Finds the new triangles that can't stay: where triangles have changed since the last check, or if all is well
   * there, everywhere. */
  Flags
  FindBad()
  {
    Flags isBad(m_State.GetNumberOfTriangles(), 0);
    std::vector<TriangleTree> trees; // of all triangles, and then, in place of it, of the sheets
    trees.emplace_back(m_State);
    this->FindContacts(trees.front(), isBad);
    if (m_Original != nullptr)
    {
      this->FindStrays(isBad);
      if (m_Original->numberOfSheets > 1)
      {
        trees.clear();
        trees = TreesOfSheets(m_State, m_Sheets, m_Original->numberOfSheets);
      }
      this->FindUncovered(trees, false, isBad);
    }
    this->LeaveOldTriangles(isBad);
    if (m_Original != nullptr && std::find(isBad.begin(), isBad.end(), std::uint8_t{ 1 }) == isBad.end())
    {
      std::fill(m_IsFresh.begin(), m_IsFresh.end(), std::uint8_t{ 0 }); // they were checked
      this->FindUncovered(trees, true, isBad);
      this->LeaveOldTriangles(isBad);
    }
    return isBad;
  }

  /** Takes the triangles that were there before the step for good. */
  void
  LeaveOldTriangles(Flags & isBad) const
  {
    for (TriangleId id = 0; id < isBad.size(); ++id)
    {
      isBad[id] &= m_IsNew[id];
    }
  }

  /** Adds the triangles that meet others elsewhere than at shared corners and sides, for pairs with a triangle that has
   * changed. */
  void
  FindContacts(const TriangleTree & state, Flags & isBad) const
  {
    BulkVector<TriangleId> fresh;
    for (TriangleId id = 0; id < isBad.size(); ++id)
    {
      if (m_IsFresh[id] != 0)
      {
        fresh.push_back(id);
      }
    }
    const TrianglesOfPoints fans(m_State);
    const bool areMany = fresh.size() > isBad.size() / 2;
    for (const TriangleId id : areMany ? FindCrossingTriangles(state, fans, TriangleContact::Touching)
                                       : FindCrossingTriangles(state, fans, fresh, TriangleContact::Touching))
    {
      isBad[id] = 1;
    }
    m_Progress.Completed(isBad.size());
  }

  /** Adds the triangles that have changed and are farther than maximumError from the original. */
  void
  FindStrays(Flags & isBad) const
  {
    const auto & triangles = m_State.GetTriangles();
    this->ForEachTriangle(isBad.size(), [&](std::size_t id) {
      if (m_IsFresh[id] && m_IsNew[id])
      {
        const auto & triangle = triangles[id];
        const CornersType corners = CornersOf(m_State, triangle);
        const TriangleTree & tree = m_Original->trees[m_Sheets[id]];
        std::array<TriangleId, 3> near{};
        for (unsigned int corner = 0; corner < 3; ++corner)
        {
          near[corner] = m_NearPoints[triangle[corner]];
          if (m_Original->sheets[near[corner]] != m_Sheets[id])
          {
            near[corner] = tree.FindClosestPoint(corners[corner]).triangle;
          }
        }
        TriangleProximity proximity(corners, tree, m_MaximumError);
        AddThree(*m_Original->surface, near, proximity.GetNearby());
        if (!proximity.IsNearNearby())
        {
          NearbyTriangles & nearby = proximity.GetNearby();
          nearby.KeepFirst(0);
          this->CollectOriginals(static_cast<TriangleId>(id), nearby);
          const std::size_t collected = nearby.GetSize();
          AddThree(*m_Original->surface, near, nearby);
          if (!proximity.IsNearNearby())
          {
            nearby.KeepFirst(collected);
            isBad[id] |= proximity.IsNearSurface(near) ? 0 : 1;
          }
        }
      }
    });
  }

  /** Adds three triangles of a surface, each of them once. */
  static void
  AddThree(const TriangleSurface & surface, const std::array<TriangleId, 3> & three, NearbyTriangles & nearby)
  {
    for (unsigned int n = 0; n < 3; ++n)
    {
      if (std::find(three.begin(), three.begin() + n, three[n]) == three.begin() + n)
      {
        nearby.Add(three[n], CornersOf(surface, surface.GetTriangles()[three[n]]));
      }
    }
  }

  /** Collects triangles of the original with a corner that a triangle covers, as far as there is room. */
  void
  CollectOriginals(TriangleId id, NearbyTriangles & nearby) const
  {
    const TriangleSurface & original = *m_Original->surface;
    for (std::size_t n = m_FirstCovered[id]; n < m_FirstCovered[id + std::size_t{ 1 }]; ++n)
    {
      const PointId point = m_CoveredPoints[n];
      m_Original->trianglesOfPoints.VisitTriangles(point, [&](TriangleId triangle) {
        const auto & corners = original.GetTriangles()[triangle];
        const auto * const first = std::find_if(
          corners.begin(), corners.end(), [&](PointId corner) { return m_WitnessTriangles[corner] == id; });
        if (*first == point) // one of several covered corners
        {
          nearby.Add(triangle, CornersOf(original, corners));
        }
      });
    }
  }

  /** Whether the triangles that proved that a triangle of the original is near the state are all still there. */
  bool
  IsStillNear(TriangleId id)
  {
    const std::lock_guard<std::mutex> lock(m_ProofsMutex);
    const auto found = m_Proofs.find(id);
    if (found == m_Proofs.end())
    {
      return false;
    }
    const ProximityProof & proof = found->second;
    const auto * const end = proof.triangles.data() + std::min(proof.size, ProximityProof::MostTriangles);
    return proof.size > 0 && proof.IsComplete() &&
           std::all_of(proof.triangles.data(), end, [this](VersionId version) { return m_IsPresent[version] != 0; });
  }

  /** Checks a triangle of the original that the triangles at its corners do not cover, and notes what proves that it is
   * near the state. */
  bool
  ProveNear(TriangleId id,
            const CornersType & corners,
            const TriangleTree & state,
            const std::array<TriangleId, 3> & likely)
  {
    ProximityProof proof;
    const bool isNear = TriangleProximity(corners, state, m_MaximumError, &proof).IsNearSurface(likely);
    for (VersionId & triangle : proof.triangles)
    {
      triangle = m_Versions[triangle];
    }
    const std::lock_guard<std::mutex> lock(m_ProofsMutex);
    m_Proofs[id] = isNear ? proof : ProximityProof();
    return isNear;
  }

  /** Whether a triangle of the original is near the one that covers most of its corners. Those are near it: collapses
   * keep witnesses near. */
  bool
  IsCoveredByMost(const std::array<TriangleId, 3> & near, const CornersType & corners) const
  {
    const unsigned int other = near[0] == near[1] ? 2 : near[0] == near[2] ? 1 : 0; // corners of which one may differ
    const TriangleId most = near[(other + 1) % 3];
    return most == near[(other + 2) % 3] &&
           (most == near[other] ||
            SquaredDistance(corners[other],
                            ClosestOnTriangle(corners[other], CornersOf(m_State, m_State.GetTriangles()[most]))) <=
              m_MaximumError * m_MaximumError);
  }

  /** Adds the triangles around those of the original that are farther than maximumError from the state. Checks those of
   * which corners are covered by a triangle that has changed, or all that are not covered by these triangles alone, but
   * for those whose proof still holds. */
  void
  FindUncovered(const std::vector<TriangleTree> & state, bool checksAll, Flags & isBad)
  {
    const TriangleSurface & original = *m_Original->surface;
    const auto & triangles = original.GetTriangles();
    Flags isUncovered(triangles.size(), 0);
    this->ForEachTriangle(triangles.size(), [&](std::size_t id) {
      const auto & [a, b, c] = triangles[id];
      const std::array<TriangleId, 3> near{ m_WitnessTriangles[a], m_WitnessTriangles[b], m_WitnessTriangles[c] };
      const bool hasChanged = m_IsFresh[near[0]] | m_IsFresh[near[1]] | m_IsFresh[near[2]];
      if (hasChanged || (checksAll && !m_IsCovered[id] && !this->IsStillNear(static_cast<TriangleId>(id))))
      {
        const CornersType corners = CornersOf(original, triangles[id]);
        const TriangleTree & tree = state[m_Original->sheets[id]];
        TriangleProximity proximity(corners, tree, m_MaximumError);
        m_IsCovered[id] = this->IsCoveredByMost(near, corners);
        if (!m_IsCovered[id])
        {
          AddThree(m_State, near, proximity.GetNearby());
          m_IsCovered[id] = proximity.IsNearNearby() ? 1 : 0;
        }
        isUncovered[id] = !m_IsCovered[id] && !this->ProveNear(static_cast<TriangleId>(id), corners, tree, near);
      }
    });
    for (TriangleId id = 0; id < triangles.size(); ++id)
    {
      if (isUncovered[id])
      {
        this->AddAround(id, state[m_Original->sheets[id]], isBad);
      }
    }
  }

  /** Adds the new triangles that cover corners of a triangle of the original; if there are none, all around it. */
  void
  AddAround(TriangleId uncovered, const TriangleTree & state, Flags & isBad) const
  {
    const TriangleSurface & original = *m_Original->surface;
    bool isAnyNew = false;
    for (const PointId corner : original.GetTriangles()[uncovered])
    {
      const TriangleId id = m_WitnessTriangles[corner];
      isBad[id] = 1;
      isAnyNew = isAnyNew || m_IsNew[id];
    }
    if (!isAnyNew)
    {
      const Box box = TriangleTree::BoxOf(original.GetPoints(), original.GetTriangles()[uncovered]);
      state.VisitTriangles(Grown(box, static_cast<float>(m_MaximumError)), [&](TriangleId id) { isBad[id] = 1; });
    }
  }

  /** Lets bad triangles change less often. Returns the patches that have some. */
  std::vector<PatchId>
  Hold(const Flags & isBad, unsigned int round)
  {
    const int less = 1 << (round / 2);
    std::vector<PatchId> changed;
    for (PatchId id = 0; id < m_Patches.size(); ++id)
    {
      Patch & patch = m_Patches[id];
      SizeValueType bad = 0;
      for (std::size_t n = 0; n < patch.after.ids.size(); ++n)
      {
        if (isBad[m_Begin[id] + n])
        {
          patch.mostChanges[patch.after.ids[n]] =
            static_cast<std::uint16_t>(std::max(0, patch.after.changes[n] - less));
          ++bad;
          for (const PointId point : m_State.GetTriangles()[m_Begin[id] + n])
          {
            m_IsHeld[point] |= 1;
          }
        }
      }
      m_PlacesPutBack += bad;
      if (bad > 0)
      {
        changed.push_back(id);
      }
    }
    return changed;
  }

  rhombic::StagedProgress & m_Progress;
  const SizeValueType m_Target;
  const double m_MaximumError;
  const TriangleSurfaceTopology m_Topology;
  TriangleSurface & m_State;
  Sheets & m_Sheets; ///< of m_State
  const bool m_IsOneSheet;
  const Original * const m_Original;
  OriginalSurface m_Limits{};
  SizeValueType m_PlacesPutBack = 0;
  double m_Aimed = 0.0;        ///< triangles in this step before bad ones were put back
  double m_SharePutBack = 0.0; ///< by the last step, of the triangles that it had removed
  bool m_EndsEarly = true;     ///< whether patches end when they have removed more than a step needs
  bool m_IsHeldBack = false;   ///< whether maximumError kept edges from collapsing in the last step

  Flags m_IsHeld; ///< for each point of m_State, whether it stays, because triangles there were bad

  // Empty if the distance has no limit.
  BulkVector<TriangleId> m_NearPoints;       ///< for each point of m_State, a triangle of the original nearby
  BulkVector<TriangleId> m_WitnessTriangles; ///< for each point of the original, the triangle of m_State that covers it
  BulkVector<PointId> m_CoveredPoints;       ///< points of the original, by the triangle that covers them
  BulkVector<std::uint32_t> m_FirstCovered;  ///< for each triangle of m_State, its first of these, and the end
  Flags m_IsCovered; ///< for each triangle of the original, whether the triangles that cover its corners cover it

  std::mutex m_ProofsMutex;
  std::unordered_map<TriangleId, ProximityProof>
    m_Proofs;                       ///< of the few of the original that are not covered: by versions
  BulkVector<VersionId> m_Versions; ///< of the triangles of m_State
  Flags m_IsPresent;                ///< for each version, whether m_State has it

  // The current step.
  TriangleSurface::Pointer m_Before;
  Sheets m_SheetsBefore;
  SurfacePoints m_Points;                        ///< before the step
  std::optional<rhombic::BulkResource> m_Memory; ///< of the patches
  std::vector<Patch> m_Patches;
  std::vector<TriangleId> m_Begin; ///< first triangle of each patch in m_State, and the end of the last
  Flags m_IsNew;                   ///< for each triangle of m_State, whether it was not there before the step
  Flags m_IsFresh;                 ///< for each triangle of m_State, whether it was not there at the last check
};

/** Throws if an edge has two triangles, of two sheets. */
void
VerifySheets(const TriangleSurface & surface, const Sheets & sheets)
{
  using Side = std::array<std::uint32_t, 3>; // two points and a sheet
  BulkVector<Side> sides;
  sides.reserve(3 * sheets.size());
  for (TriangleId id = 0; id < sheets.size(); ++id)
  {
    const auto & triangle = surface.GetTriangles()[id];
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto & [low, high] = std::minmax(triangle[corner], triangle[(corner + 1) % 3]);
      sides.push_back({ low, high, sheets[id] });
    }
  }
  std::sort(sides.begin(), sides.end());
  for (auto begin = sides.begin(); begin != sides.end();)
  {
    const auto end = std::find_if(
      begin, sides.end(), [begin](const Side & side) { return side[0] != (*begin)[0] || side[1] != (*begin)[1]; });
    if (end - begin == 2 && *begin != begin[1])
    {
      itkGenericExceptionMacro("Sheets " << (*begin)[2] << " and " << begin[1][2]
                                         << " meet at an edge with two triangles; only edges with three or more can "
                                            "part sheets");
    }
    begin = end;
  }
}

void
VerifyTopology(TriangleSurfaceTopology topology, bool isOneSheet)
{
  if (!isOneSheet)
  {
    topology.nonManifoldEdges = topology.nonManifoldPoints = 0; // where sheets meet
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

void
TriangleSurfaceSimplificationSettings::Verify() const
{
  if (!(maximumError > 0.0))
  {
    itkGenericExceptionMacro("A simplified surface can't be within " << maximumError
                                                                     << " mm of the original; give a number above 0");
  }
  if (targetTriangles == 0 && !std::isfinite(maximumError))
  {
    itkGenericExceptionMacro("How far to simplify is not said; give a number of triangles or a largest error");
  }
}

TriangleSurfaceSimplificationReport
SimplifyTriangleSurface(TriangleSurface & surface,
                        const TriangleSurfaceSimplificationSettings & settings,
                        const rhombic::ProgressFunction & report)
{
  Sheets sheets(surface.GetNumberOfTriangles(), 0);
  return SimplifyTriangleSurface(surface, sheets, settings, report);
}

TriangleSurfaceSimplificationReport
SimplifyTriangleSurface(TriangleSurface & surface,
                        BulkVector<std::uint32_t> & sheets,
                        const TriangleSurfaceSimplificationSettings & settings,
                        const rhombic::ProgressFunction & report)
{
  settings.Verify();
  if (sheets.size() != surface.GetNumberOfTriangles())
  {
    itkGenericExceptionMacro("There are sheets of " << sheets.size() << " triangles, but the surface has "
                                                    << surface.GetNumberOfTriangles() << '.');
  }
  const TriangleSurfaceTopology topology = ComputeTriangleSurfaceTopology(surface);
  const bool isOneSheet = std::all_of(sheets.begin(), sheets.end(), [](std::uint32_t sheet) { return sheet == 0; });
  VerifyTopology(topology, isOneSheet);
  if (!isOneSheet)
  {
    VerifySheets(surface, sheets);
  }
  surface.RemoveUnusedPoints();
  if (surface.GetTriangles().empty())
  {
    return {};
  }
  std::optional<Original> original;
  if (std::isfinite(settings.maximumError))
  {
    original.emplace(surface, sheets);
  }
  rhombic::StagedProgress progress(report);
  const auto result =
    Simplification(surface, sheets, isOneSheet, topology, settings, original ? &*original : nullptr, progress).Run();
  surface.RemoveUnusedPoints();
  surface.Modified();
  return result;
}

} // namespace itk
