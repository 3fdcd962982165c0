#include "rhombicCompareLabels.h"

#include "rhombicAffineFile.h"
#include "rhombicAgreementTable.h"
#include "rhombicComparedSide.h"
#include "rhombicFailure.h"
#include "rhombicLabelParts.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPackedWalls.h"
#include "rhombicSceneRules.h"
#include "rhombicSurfaceMeasures.h"
#include "rhombicVoxelMetrics.h"
#include "rhombicVoxelSurface.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceMeasures.h"

#include <vnl/vnl_det.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;
using SurfacePointer = itk::TriangleSurface::ConstPointer;

/** The maps between the two spaces; null for one space. */
struct SpaceMaps
{
  AffineMap::Pointer toSecond;
  AffineMap::Pointer toFirst;

  PointType
  ToFirst(const PointType & point) const
  {
    return toFirst != nullptr ? toFirst->TransformPoint(point) : point;
  }
};

SpaceMaps
ReadSpaceMaps(const CompareLabelsSettings & settings)
{
  SpaceMaps maps;
  if (!settings.transform.empty())
  {
    const AffineMap::Pointer read = ReadAffineMap(settings.transform);
    const AffineMap::Pointer inverse = InverseOf(*read);
    maps.toSecond = settings.isTransformInverted ? inverse : read;
    maps.toFirst = settings.isTransformInverted ? read : inverse;
  }
  return maps;
}

/** Says by what factor a transform changes volumes, if it does. Throws Failure(Usage) for one that mirrors. */
void
NoteScale(const SpaceMaps & maps, const Events & events)
{
  if (maps.toSecond == nullptr)
  {
    return;
  }
  const double factor = vnl_det(maps.toSecond->GetMatrix().GetVnlMatrix());
  if (factor < 0.0)
  {
    throw Failure(FailureKind::Usage,
                  "The transform mirrors, which no registration of a patient does; check the file and its direction.");
  }
  constexpr double notable = 1e-3;
  if (std::abs(factor - 1.0) > notable)
  {
    events.Note("the transform changes volumes by the factor " + FormatNumber(factor, 4) +
                "; volumes in the table are those of each segmentation's own space");
  }
}

/** The box around points, along the patient's axes. */
std::pair<PointType, PointType>
FindBox(const std::vector<PointType> & points)
{
  std::pair<PointType, PointType> box{ points.front(), points.front() };
  for (const PointType & point : points)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.first[axis] = std::min(box.first[axis], point[axis]);
      box.second[axis] = std::max(box.second[axis], point[axis]);
    }
  }
  return box;
}

/** Throws Failure(Geometry) for segmentations whose boxes lie apart. */
void
RequireOneSpace(const ComparedSide & first, const ComparedSide & second, const SpaceMaps & maps)
{
  const std::vector<PointType> corners = FindCorners(first);
  std::vector<PointType> others = FindCorners(second);
  if (corners.empty() || others.empty())
  {
    return;
  }
  std::transform(others.begin(), others.end(), others.begin(), [&](const auto & point) { return maps.ToFirst(point); });
  const auto [low, high] = FindBox(corners);
  const auto [otherLow, otherHigh] = FindBox(others);
  double squared = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double apart = std::max({ 0.0, otherLow[axis] - high[axis], low[axis] - otherHigh[axis] });
    squared += apart * apart;
  }
  if (squared > 0.0)
  {
    throw Failure(FailureKind::Geometry,
                  first.file + " and " + second.file + " do not lie in one space: their boxes are " +
                    FormatNumber(std::sqrt(squared), 4) +
                    " mm apart; check that both are of one patient and one scan, or name the transform of their "
                    "registration with --transform.");
  }
}

constexpr double GridTolerance = 0.01; // mm

/** The largest distance in mm of the corners of two grids of one size; nothing for other grids. */
std::optional<double>
FindGridOffset(const ComparedSide & first, const ComparedSide & second, const SpaceMaps & maps)
{
  if (!first.map || !second.map || maps.toFirst != nullptr ||
      GeometryOf(first.map->scan.image).GetLargestPossibleRegion() !=
        GeometryOf(second.map->scan.image).GetLargestPossibleRegion())
  {
    return std::nullopt;
  }
  const std::vector<PointType> corners = FindCorners(first);
  const std::vector<PointType> others = FindCorners(second);
  double farthest = 0.0;
  for (std::size_t n = 0; n < corners.size(); ++n)
  {
    farthest = std::max(farthest, corners[n].EuclideanDistanceTo(others[n]));
  }
  return farthest;
}

/** Says by how much two grids of one size differ, where they do. */
void
NoteGrids(const std::optional<double> & offset, const Events & events)
{
  if (offset && *offset > 0.0)
  {
    events.Note("the grids of A and B are of one size and up to " + FormatNumber(*offset, 2) + " mm apart" +
                (*offset <= GridTolerance
                   ? ", within the tolerance of " + FormatNumber(GridTolerance) + " mm for one grid"
                   : "; each keeps its place"));
  }
}

/** Throws Failure(Usage) unless two maps have one grid of evenly spaced slices. */
void
RequireOneGrid(const ComparedSide & first, const ComparedSide & second, const std::optional<double> & offset)
{
  if (!offset || *offset > GridTolerance || !first.map->scan.sliceOrigins.empty() ||
      !second.map->scan.sliceOrigins.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Voxel metrics need label maps on one grid of evenly spaced slices; leave out --voxel-metrics, or "
                  "resample one map to the grid of the other.");
  }
}

/** Centroids of pairs of labels, B's in A's space. */
using Centroids = std::vector<std::pair<PointType, PointType>>;

constexpr double NoticeableShift = 10.0; // mm

/** The words of a doubt that all of B's labels lie beside A's, all in one direction; else empty. */
std::string
FindShift(const Centroids & centroids)
{
  constexpr double mostSpread = 0.2; // of the shift
  itk::Vector<double, 3> mean(0.0);
  for (const auto & [one, other] : centroids)
  {
    mean += (other - one) / static_cast<double>(centroids.size());
  }
  double spread = 0.0;
  for (const auto & [one, other] : centroids)
  {
    spread += (other - one - mean).GetNorm() / static_cast<double>(centroids.size());
  }
  return mean.GetNorm() > NoticeableShift && spread < mostSpread * mean.GetNorm()
           ? "the labels of B lie " + FormatNumber(mean.GetNorm(), 3) +
               " mm beside those of A, all in one direction; check that both are in one space"
           : "";
}

/** The words of a doubt that B is mirrored: labels fit much better after B's are mirrored about the middle of their
 * box; else empty. */
std::string
FindMirroring(const Centroids & centroids)
{
  constexpr double muchBetter = 4.0; // factor of the squared distances
  std::vector<PointType> seconds;
  std::transform(
    centroids.begin(), centroids.end(), std::back_inserter(seconds), [](const auto & pair) { return pair.second; });
  const auto [low, high] = FindBox(seconds);
  constexpr const char * names[] = { "left to right", "front to back", "head to feet" };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    double asIs = 0.0;
    double mirrored = 0.0;
    for (const auto & [one, other] : centroids)
    {
      PointType turned = other;
      turned[axis] = low[axis] + high[axis] - other[axis];
      asIs += one.SquaredEuclideanDistanceTo(other);
      mirrored += one.SquaredEuclideanDistanceTo(turned);
    }
    if (asIs > static_cast<double>(centroids.size()) * NoticeableShift * NoticeableShift &&
        asIs > muchBetter * mirrored)
    {
      return std::string("the labels of B fit those of A better if B is mirrored from ") + names[axis] +
             "; check that neither map was mirrored on its way";
    }
  }
  return "";
}

/** What speaks against two maps being in one space, from the places of at least three pairs of labels; else empty. */
std::string
FindDoubt(const ComparedSide & first,
          const ComparedSide & second,
          const std::vector<LabelPair> & pairs,
          const SpaceMaps & maps)
{
  constexpr std::size_t fewest = 3;
  Centroids centroids;
  for (const LabelPair & pair : pairs)
  {
    if (pair.first && pair.second && first.map && second.map)
    {
      centroids.emplace_back(first.moments.at(first.labels[*pair.first].value).centroid,
                             maps.ToFirst(second.moments.at(second.labels[*pair.second].value).centroid));
    }
  }
  if (centroids.size() < fewest)
  {
    return "";
  }
  const std::string mirroring = FindMirroring(centroids);
  return mirroring.empty() ? FindShift(centroids) : mirroring;
}

/** A surface of B in A's space. */
SurfacePointer
BringToFirst(const SurfacePointer & surface, const SpaceMaps & maps)
{
  if (maps.toFirst == nullptr)
  {
    return surface;
  }
  const auto moved = itk::TriangleSurface::New();
  moved->Graft(surface);
  moved->GetNormals().clear();
  for (auto & point : moved->GetPoints())
  {
    const PointType position = maps.toFirst->TransformPoint(PointType(point.data()));
    point = { static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2]) };
  }
  return moved;
}

std::vector<std::size_t>
ChosenOf(const std::vector<LabelPair> & pairs, std::optional<std::size_t> LabelPair::*side)
{
  std::vector<std::size_t> chosen;
  for (const LabelPair & pair : pairs)
  {
    if (pair.*side)
    {
      chosen.push_back(*(pair.*side));
    }
  }
  return chosen;
}

double
FindTolerance(const std::vector<LabelTolerance> & tolerances, const std::string & label)
{
  const auto fits = [&label](const LabelTolerance & tolerance) { return FitsPattern(tolerance.pattern, label); };
  const auto found = std::find_if(tolerances.rbegin(), tolerances.rend(), fits);
  if (found == tolerances.rend())
  {
    throw Failure(FailureKind::Usage,
                  "The table of tolerances has none for " + label + "; add a line for it, or one for *.");
  }
  return found->millimetres;
}

/** The tolerance of a pair of labels, or of the labels of which it is a part. */
double
FindTolerance(const std::vector<LabelTolerance> & tolerances, const LabelPair & pair)
{
  return FindTolerance(tolerances, pair.whole.empty() ? pair.name : pair.whole);
}

/** The smallest region around two. */
itk::ImageRegion<3>
RegionAround(const itk::ImageRegion<3> & one, const itk::ImageRegion<3> & other)
{
  itk::Index<3> low = one.GetIndex();
  itk::Index<3> high = one.GetUpperIndex();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::min(low[axis], other.GetIndex(axis));
    high[axis] = std::max(high[axis], other.GetUpperIndex()[axis]);
  }
  itk::ImageRegion<3> region;
  region.SetIndex(low);
  region.SetUpperIndex(high);
  return region;
}

/** Mean distances in mm from the surfaces of labels of a map to those of their voxels, by the labels' numbers. */
std::vector<std::optional<double>>
FindNoiseFloors(const ComparedSide & side, const std::vector<std::size_t> & labels)
{
  constexpr itk::SizeValueType measured = 500; // triangles
  std::vector<std::optional<double>> floors(side.labels.size());
  for (const std::size_t label : labels)
  {
    const auto moments = side.moments.find(side.labels[label].value);
    if (moments == side.moments.end())
    {
      continue;
    }
    const itk::TriangleTree voxels(
      *ExtractVoxelSurface(side.map->scan, side.labels[label].value, moments->second.region));
    itk::TriangleSurfaceDistanceSettings settings;
    settings.mostTriangles = measured;
    floors[label] = ComputeTriangleSurfaceDistance(*side.GetSurface(label), voxels, settings).GetMean();
  }
  return floors;
}

/** Measures of the surface and the voxels of a label. */
ComparedVolume
MeasureVolume(const ComparedSide & side, const std::optional<std::size_t> & label, const SurfacePointer & surface)
{
  ComparedVolume volume;
  if (label)
  {
    volume.millilitres = ComputeTriangleSurfaceVolume(*surface) / CubicMillimetresPerMl;
  }
  if (side.map)
  {
    const auto moments = label ? side.moments.find(side.labels[*label].value) : side.moments.end();
    volume.voxelMillilitres = moments != side.moments.end() ? moments->second.volume / CubicMillimetresPerMl : 0.0;
  }
  return volume;
}

/** The centroid of a label's voxels, or of the solid that the surface bounds. */
PointType
FindCentroid(const ComparedSide & side, std::size_t label, const SurfacePointer & surface)
{
  const auto moments = side.moments.find(side.labels[label].value);
  if (moments != side.moments.end())
  {
    return moments->second.centroid;
  }
  return PointType(MeasureSurface(*surface).centroid.data());
}

/** \class Comparison
 * \brief Two segmentations and their pairs of labels, compared one by one. */
class Comparison
{
public:
  Comparison(const CompareLabelsSettings & settings, const Events & events)
    : m_Settings(settings)
    , m_Events(events)
    , m_Maps(ReadSpaceMaps(settings))
    , m_First(LoadSide(settings, false, events))
    , m_Second(LoadSide(settings, true, events))
  {
    NoteScale(m_Maps, events);
    RequireOneSpace(m_First, m_Second, m_Maps);
    const std::optional<double> gridOffset = FindGridOffset(m_First, m_Second, m_Maps);
    NoteGrids(gridOffset, events);
    if (m_First.map && m_Second.map && m_Maps.toSecond == nullptr)
    {
      NoteFramesOfReference(ReadDicomExamination(m_First.map->scan).frameOfReference,
                            ReadDicomExamination(m_Second.map->scan).frameOfReference,
                            settings.second.path,
                            events);
    }
    if (settings.hasVoxelMetrics)
    {
      RequireOneGrid(m_First, m_Second, gridOffset);
    }
    const bool areSingle = m_First.isSingle && m_Second.isSingle;
    m_Pairs = PairLabels(m_First.labels,
                         m_Second.labels,
                         { settings.pairs, settings.pairsByValue, areSingle, settings.only, settings.hidden });
    for (const LabelPair & pair : m_Pairs)
    {
      FindTolerance(settings.tolerances, pair); // before long work
    }
    this->NotePairing();
    DivideIntoParts(settings.parts, m_Maps.toSecond, settings.first.lattice.maximumMemory, m_First, m_Second, m_Pairs);
  }

  std::vector<LabelAgreement>
  Run()
  {
    this->CompareVoxels();
    const std::vector<std::optional<VoxelMetrics>> voxels = this->MeasureVoxels();
    const std::vector<std::size_t> ofFirst = ChosenOf(m_Pairs, &LabelPair::first);
    ExtractSide(m_Settings, ofFirst, m_Events, m_First);
    std::vector<std::optional<double>> noise(m_First.labels.size());
    if (m_First.mesh)
    {
      noise = FindNoiseFloors(m_First, ofFirst);
    }
    const std::vector<PackedWalls> waiting = PackWalls(m_First);
    DropMap(m_First);
    ExtractSide(m_Settings, ChosenOf(m_Pairs, &LabelPair::second), m_Events, m_Second);
    DropMap(m_Second);
    UnpackWalls(waiting, m_First);
    std::vector<LabelAgreement> agreements;
    for (std::size_t n = 0; n < m_Pairs.size(); ++n)
    {
      m_Events.Progress("comparing", static_cast<double>(n) / static_cast<double>(m_Pairs.size()));
      const LabelPair & pair = m_Pairs[n];
      agreements.push_back(this->Compare(pair));
      agreements.back().noiseFloor = pair.first ? noise[*pair.first] : std::nullopt;
      agreements.back().voxels = voxels[n];
      m_Events.Note(SummarizeAgreement(agreements.back()));
    }
    if (agreements.empty()) // both hold background only
    {
      LabelAgreement & none = agreements.emplace_back();
      none.label = "all labels";
      none.status = AgreementStatus::BothEmpty;
      none.dice = none.iou = 1.0;
      none.tolerance = m_Settings.tolerances.front().millimetres;
    }
    m_Events.Progress("comparing", 1.0);
    return agreements;
  }

private:
  /** The walls of a side, which are left empty until UnpackWalls(). */
  static std::vector<PackedWalls>
  PackWalls(ComparedSide & side)
  {
    std::vector<PackedWalls> packed;
    for (std::size_t n = 0; side.mesh && n < side.mesh->walls.size(); ++n)
    {
      packed.emplace_back(*side.mesh->walls[n]);
    }
    return packed;
  }

  static void
  UnpackWalls(const std::vector<PackedWalls> & packed, ComparedSide & side)
  {
    for (std::size_t n = 0; n < packed.size(); ++n)
    {
      packed[n].Unpack(*side.mesh->walls[n]);
    }
  }

  /** Frees the voxels; what is needed of them is known. What making the walls has freed goes back to the system. */
  static void
  DropMap(ComparedSide & side)
  {
    if (side.map)
    {
      side.map->scan = WithoutVoxels(side.map->scan);
    }
    GiveBackFreedMemory();
  }

  void
  NotePairing() const
  {
    const auto isNamed = [](const ComparedLabel & label) { return label.isNamed; };
    const bool areNamed = std::any_of(m_First.labels.begin(), m_First.labels.end(), isNamed);
    m_Events.Note(m_First.isSingle && m_Second.isSingle  ? "A and B hold one label each, which are compared"
                  : m_Settings.pairsByValue || !areNamed ? "labels are paired by value"
                                                         : "labels are paired by name");
    for (const auto & [inFirst, inSecond] : m_Settings.pairs)
    {
      const bool isOfFirst = !FindLabel(m_First.labels, inFirst);
      if (isOfFirst || !FindLabel(m_Second.labels, inSecond))
      {
        m_Events.Note(isOfFirst ? "warning: A has no label " + inFirst + SuggestLabel(m_First.labels, inFirst)
                                : "warning: B has no label " + inSecond + SuggestLabel(m_Second.labels, inSecond));
      }
    }
    const std::string doubt = FindDoubt(m_First, m_Second, m_Pairs, m_Maps);
    if (!doubt.empty())
    {
      m_Events.Note("warning: " + doubt);
    }
  }

  void
  CompareVoxels()
  {
    if (m_First.map && m_Second.map)
    {
      m_Events.Progress("comparing voxels", 0.0);
      m_Overlap = ComputeLabelOverlap(m_First.map->scan, m_Second.map->scan, m_Maps.toSecond);
    }
  }

  /** The voxel metrics of the pairs, if they are asked for. */
  std::vector<std::optional<VoxelMetrics>>
  MeasureVoxels() const
  {
    std::vector<std::optional<VoxelMetrics>> metrics(m_Pairs.size());
    for (std::size_t n = 0; m_Settings.hasVoxelMetrics && n < m_Pairs.size(); ++n)
    {
      const LabelPair & pair = m_Pairs[n];
      if (pair.first && pair.second)
      {
        const int inFirst = m_First.labels[*pair.first].value;
        const int inSecond = m_Second.labels[*pair.second].value;
        const auto region = RegionAround(m_First.moments.at(inFirst).region, m_Second.moments.at(inSecond).region);
        metrics[n] = ComputeVoxelMetrics({ m_First.map->scan, inFirst },
                                         { m_Second.map->scan, inSecond },
                                         region,
                                         FindTolerance(m_Settings.tolerances, pair));
      }
    }
    return metrics;
  }

  /** Says if a part of a label of B lies outside of A's grid. */
  void
  NoteOutside(const std::string & name, int inSecond) const
  {
    constexpr double notable = 0.05; // of the label; less may be lost between voxels of other sizes
    const double scale =
      m_Maps.toFirst != nullptr ? std::abs(vnl_det(m_Maps.toFirst->GetMatrix().GetVnlMatrix())) : 1.0;
    const double whole = scale * m_Second.moments.at(inSecond).volume;
    const auto found = m_Overlap->second.find(inSecond);
    const double inGrid = found != m_Overlap->second.end() ? found->second : 0.0;
    if (inGrid < (1.0 - notable) * whole)
    {
      m_Events.Note(name + ": " + DescribeVolume((whole - inGrid) / CubicMillimetresPerMl) +
                    " of B lie outside of A's grid, and do not count for Dice and IoU");
    }
  }

  LabelAgreement
  Compare(const LabelPair & pair) const
  {
    LabelAgreement agreement;
    agreement.label = pair.name;
    agreement.days = m_Settings.days;
    agreement.tolerance = FindTolerance(m_Settings.tolerances, pair);
    agreement.change = pair.change;
    const SurfacePointer first = pair.first ? m_First.GetSurface(*pair.first) : nullptr;
    const SurfacePointer unmoved = pair.second ? m_Second.GetSurface(*pair.second) : nullptr;
    const SurfacePointer second = pair.second ? BringToFirst(unmoved, m_Maps) : nullptr;
    agreement.first = MeasureVolume(m_First, pair.first, first);
    agreement.second = MeasureVolume(m_Second, pair.second, unmoved);
    const ComparedLabel & label = pair.first ? m_First.labels[*pair.first] : m_Second.labels[*pair.second];
    agreement.colour = label.colour;
    const bool keepsSurfaces = !m_Settings.page.empty();
    agreement.firstSurface = keepsSurfaces ? first : nullptr;
    agreement.secondSurface = keepsSurfaces ? second : nullptr;
    if (!pair.first || !pair.second)
    {
      agreement.status = pair.first ? AgreementStatus::MissingInSecond : AgreementStatus::MissingInFirst;
      agreement.dice = agreement.iou = 0.0;
      return agreement;
    }
    agreement.surfaces = ComputeTriangleSurfaceAgreement(*first, *second, agreement.tolerance);
    if (m_Overlap)
    {
      const int inFirst = m_First.labels[*pair.first].value;
      const int inSecond = m_Second.labels[*pair.second].value;
      agreement.dice = m_Overlap->GetDice(inFirst, inSecond);
      agreement.iou = m_Overlap->GetIoU(inFirst, inSecond);
      this->NoteOutside(pair.name, inSecond);
    }
    agreement.centroidShift = FindCentroid(m_First, *pair.first, first)
                                .EuclideanDistanceTo(m_Maps.ToFirst(FindCentroid(m_Second, *pair.second, unmoved)));
    return agreement;
  }

  const CompareLabelsSettings & m_Settings;
  const Events & m_Events;
  SpaceMaps m_Maps;
  ComparedSide m_First;
  ComparedSide m_Second;
  std::vector<LabelPair> m_Pairs;
  std::optional<LabelOverlap> m_Overlap;
};

/** The other files that are read: tables, also one beside a label map, and the transform. */
SurfaceSelection
OtherInputs(const fs::path & map, const fs::path & table, const CompareLabelsSettings & settings)
{
  SurfaceSelection selection;
  LabelMapSource & source = selection.labels.emplace().source;
  source.table = table;
  source.paths = { settings.transform, settings.toleranceTable };
  for (const char * const extension : { ".ctbl", ".csv", ".tsv", ".label", ".txt" })
  {
    source.paths.push_back(map.parent_path() / (StemOfVolume(map) + extension));
  }
  return selection;
}

} // namespace

double
CountDays(const std::string & first, const std::string & second)
{
  const auto toDays = [](const std::string & date) {
    std::tm time{};
    const char * const end = strptime(date.c_str(), "%Y-%m-%d", &time);
    std::tm asIs = time;
    const std::time_t seconds = timegm(&time);
    if (end == nullptr || *end != '\0' || time.tm_mday != asIs.tm_mday || time.tm_mon != asIs.tm_mon)
    {
      throw Failure(FailureKind::Usage, "'" + date + "' is no date; write it as 2025-01-31.");
    }
    constexpr double secondsOfDay = 86400.0;
    return static_cast<double>(seconds) / secondsOfDay;
  };
  const double days = toDays(second) - toDays(first);
  if (!(days > 0.0))
  {
    throw Failure(FailureKind::Usage,
                  "The date of B, " + second + ", is not later than that of A, " + first + "; name A's date first.");
  }
  return days;
}

std::vector<fs::path>
CheckCompareLabels(const CompareLabelsSettings & settings)
{
  for (const LabelTolerance & tolerance : settings.tolerances)
  {
    if (!(tolerance.millimetres >= 0.0) || !std::isfinite(tolerance.millimetres))
    {
      throw Failure(FailureKind::Usage,
                    "The tolerance of " + tolerance.pattern + " is " + FormatNumber(tolerance.millimetres) +
                      "; give a length of at least 0 mm.");
    }
  }
  if (settings.isTransformInverted && settings.transform.empty())
  {
    throw Failure(FailureKind::Usage, "No transform is named that could be inverted; name it with --transform.");
  }
  if (settings.kind != ComparedKind::Labels && (!settings.parts.empty() || settings.hasVoxelMetrics))
  {
    throw Failure(FailureKind::Usage,
                  "Only label maps have parts and voxel metrics; leave out --parts and --voxel-metrics.");
  }
  std::vector<fs::path> outputs;
  if (!settings.table.empty())
  {
    CheckAgreementPath(settings.table);
    outputs.push_back(settings.table);
  }
  if (!settings.page.empty())
  {
    outputs.push_back(settings.page);
  }
  return WithSidecars(outputs, settings.provenance);
}

std::vector<LabelAgreement>
CompareLabels(const CompareLabelsSettings & settings, const Events & events, std::vector<MadeFile> & made)
{
  const std::vector<fs::path> outputs = CheckCompareLabels(settings);
  CheckOutputs(outputs, settings.first, OtherInputs(settings.first.path, settings.firstTable, settings));
  CheckOutputs(outputs, settings.second, OtherInputs(settings.second.path, settings.secondTable, settings));
  std::vector<LabelAgreement> agreements = Comparison(settings, events).Run();
  made.clear();
  if (!settings.table.empty())
  {
    OutputFiles files{ settings.provenance };
    Report rows = ReportAgreement(agreements, settings);
    StageText(WriteAgreement(rows, settings.table.extension().string()), settings.table, files.staged);
    AddOutput(settings.table, "agreement", { { "agreement", rows } }, files);
    files.staged.Commit();
    made = files.made;
    rows.erase(rows.size() - 1); // the means
    made.front().measures = rows;
  }
  return agreements;
}

} // namespace rhombic
