#include "itkTriangleSurfaceSimplification.h"

#include "itkForEachBlock.h"
#include "itkPositionArithmetic.h"
#include "itkSimplifiedPatch.h"
#include "itkTriangleDistanceProof.h"
#include "itkTriangleContact.h"
#include "itkTrianglePartition.h"
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
constexpr std::size_t BlockSize = 1024;
constexpr SizeValueType MostMeasured = 500000; // triangles, for the report

/** Where the triangles are cut in two, in the steps one after the other: patches of successive steps have few borders
 * in common. */
constexpr std::array<double, 3> Cuts{ 0.5, 0.36, 0.64 };

constexpr double ShareOfMaximumError = 0.7; // for root mean squares
constexpr double ShareForCentres = 0.8;     // of the maximumError, so that what is between them is seldom further
constexpr double FirstError = 0.125;        // in mean sides of triangles, doubled with each step towards a target
// What was before is within the maximumError, and so is held for good after a few rounds.
constexpr double GrowthOfPlaces = 0.5;
constexpr unsigned int MostRounds = 6;
constexpr double LeastGain = 0.97; // of the triangles left by a step that was worth while

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
      m_OriginalNear.resize(surface.GetNumberOfPoints());
      for (std::uint32_t id = 0; id < surface.GetNumberOfTriangles(); ++id)
      {
        for (const PointId point : surface.GetTriangles()[id])
        {
          m_OriginalNear[point] = id;
        }
      }
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
  using PatchId = std::uint32_t;
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
  SimplifyPatches(const std::vector<PatchId> & which);
  void
  AimAtTarget();
  void
  PutTogether();
  void
  FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Places & places) const;
  void
  FindStrays(const std::vector<PatchId> & patches, Places & places) const;
  std::vector<std::uint32_t>
  FindLeftBehind(const TriangleTree & state, const std::vector<std::uint32_t> & doubtful) const;
  Places
  FindPlacesNear(const std::vector<std::uint32_t> & originals, double share) const;
  std::vector<PatchId>
  Hold(const Places & bad, const Places & nearLeftBehind);
  void
  AddNearDropped(const std::vector<PatchId> & patches, std::vector<std::uint32_t> & doubtful) const;
  TriangleDistanceProof::Triangle
  Positions(const TriangleType & triangle) const
  {
    const auto & points = m_Original.GetPoints();
    return { points[triangle[0]], points[triangle[1]], points[triangle[2]] };
  }
  static TriangleDistanceProof::Near
  Near(const TriangleType & triangle, const std::vector<std::uint32_t> & nearPoints)
  {
    return { nearPoints[triangle[0]], nearPoints[triangle[1]], nearPoints[triangle[2]] };
  }
  PatchId
  PatchOf(std::uint32_t triangle) const;

  const TriangleSurfaceSimplificationSettings m_Settings;
  const TriangleSurfaceTopology m_Topology;
  const TriangleSurface & m_Original;
  std::unique_ptr<TriangleTree> m_OriginalTree; // where there is a limit to the error
  std::vector<std::uint32_t> m_OriginalNear;    // a triangle of each point, where there is a limit to the error
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
  report.distances = ComputeTwoDistances(m_Original, *m_State, MostMeasured);
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
  for (unsigned int round = 0; !changed.empty() || (!doubtful.empty() && round < MostRounds); ++round)
  {
    this->PutTogether();
    Places bad(m_Patches.size());
    {
      const TriangleTree state(*m_State);
      this->FindContacts(state, changed, bad);
      this->FindStrays(changed, bad);
      doubtful = this->FindLeftBehind(state, doubtful);
    }
    m_PlacesTakenBack += doubtful.size();
    changed = this->Hold(bad, this->FindPlacesNear(doubtful, GrowthOfPlaces * round));
    this->SimplifyPatches(changed);
    this->AddNearDropped(changed, doubtful);
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
  const std::vector<TriangleRange> ranges = SortIntoRanges(m_Original.GetPoints(), m_Before, PatchSize, cut);
  m_Patches.clear();
  for (const TriangleRange & range : ranges)
  {
    m_Patches.emplace_back(m_Original.GetPoints(), m_Before.data() + range.begin, m_Before.data() + range.end);
  }
}

void
Simplification::SimplifyPatches(const std::vector<PatchId> & which)
{
  SimplifiedPatch::Check isAllowed;
  if (m_OriginalTree)
  {
    isAllowed = [this, proof = TriangleDistanceProof(*m_OriginalTree, ShareForCentres * m_Settings.maximumError)](
                  const TriangleType & triangle) {
      return proof.IsCentreWithin(this->Positions(triangle), Near(triangle, m_OriginalNear));
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
    m_Patches[patch].Restart();
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

Simplification::PatchId
Simplification::PatchOf(std::uint32_t triangle) const
{
  return static_cast<PatchId>(std::upper_bound(m_Begin.begin(), m_Begin.end(), triangle) - m_Begin.begin() - 1);
}

/** Finds where fresh triangles of some patches meet other triangles than their neighbours. */
void
Simplification::FindContacts(const TriangleTree & state, const std::vector<PatchId> & patches, Places & places) const
{
  const auto & points = m_Original.GetPoints();
  const auto & triangles = m_State->GetTriangles();
  std::vector<std::vector<std::uint32_t>> found(patches.size());
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    for (const std::uint32_t fresh : m_Patches[patches[n]].GetFresh())
    {
      const std::uint32_t id = m_Begin[patches[n]] + fresh;
      state.VisitTriangles(BoxOf(points, triangles[id]), [&](std::uint32_t other) {
        if (other != id && FindContact(points, triangles[id], triangles[other]) != Contact::Apart)
        {
          found[n].push_back(id);
          found[n].push_back(other);
        }
      });
    }
  });
  for (const auto & ids : found)
  {
    for (const std::uint32_t id : ids)
    {
      const PatchId patch = this->PatchOf(id);
      if (id - m_Begin[patch] >= m_Patches[patch].GetNumberOfOldTriangles())
      {
        places[patch].push_back(BoxOf(points, triangles[id]));
      }
    }
  }
}

/** Finds where fresh triangles of some patches have moved away from the original. */
void
Simplification::FindStrays(const std::vector<PatchId> & patches, Places & places) const
{
  if (!m_OriginalTree)
  {
    return;
  }
  const TriangleDistanceProof proof(*m_OriginalTree, m_Settings.maximumError);
  ForEachInBlocks(patches.size(), 1, [&](std::size_t n) {
    const std::vector<TriangleType> & triangles = m_Patches[patches[n]].GetTriangles();
    for (const std::uint32_t id : m_Patches[patches[n]].GetFresh())
    {
      if (!proof.IsWithin(this->Positions(triangles[id]), Near(triangles[id], m_OriginalNear)))
      {
        places[patches[n]].push_back(BoxOf(m_Original.GetPoints(), triangles[id]));
      }
    }
  });
}

/** Finds the triangles of the original, among the doubtful ones, that the state has moved away from. */
std::vector<std::uint32_t>
Simplification::FindLeftBehind(const TriangleTree & state, const std::vector<std::uint32_t> & doubtful) const
{
  if (doubtful.empty())
  {
    return {};
  }
  const auto & triangles = m_Original.GetTriangles();
  std::vector<std::uint8_t> isDoubtful(m_Original.GetNumberOfPoints(), 0);
  for (const std::uint32_t id : doubtful)
  {
    for (const PointId point : triangles[id])
    {
      isDoubtful[point] = 1;
    }
  }
  std::vector<std::uint32_t> near(m_Original.GetNumberOfPoints(), TriangleTree::None);
  const double squaredLimit = m_Settings.maximumError * m_Settings.maximumError;
  ForEachInBlocks(near.size(), BlockSize, [&](std::size_t point) {
    if (isDoubtful[point])
    {
      near[point] = state.FindClosestPoint(ToPosition(m_Original.GetPoints()[point]), squaredLimit).triangle;
    }
  });
  const TriangleDistanceProof proof(state, m_Settings.maximumError);
  std::vector<std::uint8_t> isLeft(doubtful.size());
  ForEachInBlocks(doubtful.size(), BlockSize, [&](std::size_t n) {
    const TriangleType & triangle = triangles[doubtful[n]];
    isLeft[n] = proof.IsWithin(this->Positions(triangle), Near(triangle, near)) ? 0 : 1;
  });
  std::vector<std::uint32_t> left;
  for (std::size_t n = 0; n < doubtful.size(); ++n)
  {
    if (isLeft[n])
    {
      left.push_back(doubtful[n]);
    }
  }
  return left;
}

/** The boxes around triangles of the original, larger by a share of the maximumError, for patches that they meet. */
Simplification::Places
Simplification::FindPlacesNear(const std::vector<std::uint32_t> & originals, double share) const
{
  Places places(m_Patches.size());
  for (const std::uint32_t id : originals)
  {
    const Box box = Grown(BoxOf(m_Original.GetPoints(), m_Original.GetTriangles()[id]),
                          static_cast<float>(share * m_Settings.maximumError));
    for (PatchId patch = 0; patch < m_Patches.size(); ++patch)
    {
      if (m_Patches[patch].IsSimplified() && m_Patches[patch].GetBounds().Overlaps(box))
      {
        places[patch].push_back(box);
      }
    }
  }
  return places;
}

/** Holds what was where new triangles are bad, and what was near triangles left behind. Returns the patches for which
 * this makes a difference. */
std::vector<Simplification::PatchId>
Simplification::Hold(const Places & bad, const Places & nearLeftBehind)
{
  std::vector<PatchId> changed;
  for (PatchId patch = 0; patch < m_Patches.size(); ++patch)
  {
    m_PlacesTakenBack += bad[patch].size();
    const bool helpsLeftBehind = m_Patches[patch].Hold(nearLeftBehind[patch]);
    if (!bad[patch].empty() && !m_Patches[patch].Hold(bad[patch]) && !helpsLeftBehind)
    {
      m_Patches[patch].HoldAll();
    }
    if (helpsLeftBehind || !bad[patch].empty())
    {
      changed.push_back(patch);
    }
  }
  return changed;
}

/** Adds the triangles of the original that may have relied on what these patches no longer have. */
void
Simplification::AddNearDropped(const std::vector<PatchId> & patches, std::vector<std::uint32_t> & doubtful) const
{
  if (!m_OriginalTree)
  {
    return;
  }
  for (const std::uint32_t patch : patches)
  {
    for (const TriangleType & triangle : m_Patches[patch].GetDropped())
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
  if (surface.GetTriangles().empty())
  {
    return {};
  }
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
