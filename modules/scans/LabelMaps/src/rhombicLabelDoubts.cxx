#include "rhombicLabelDoubts.h"

#include "rhombicForEachBlock.h"
#include "rhombicWording.h"

#include "itkBoundingBox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;
using VectorType = itk::Vector<double, 3>;
using Mirrors = std::array<bool, 3>;

/** A voxel of the label map. */
struct LabelledVoxel
{
  itk::Index<3> index;
  std::int32_t value;
};

/** Mean values in HU that tissues of these names have. */
struct TissueRule
{
  std::vector<std::string> patterns;
  double lowest;
  double highest;
};

const TissueRule *
FindTissueRule(const std::string & name)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  static const std::array<TissueRule, 3> rules{
    { { { "lung", "lungs", "lung?left", "lung?right", "left?lung", "right?lung", "lung_*lobe*", "trachea*", "airway*" },
        -none,
        -300.0 },
      { { "*bone",     "bones",    "rib",       "ribs",    "rib_*",   "*vertebra*",  "spine",
          "sternum*",  "sacrum*",  "skull*",    "*femur*", "pelvis",  "*clavicula*", "*scapula*",
          "*humerus*", "hip_left", "hip_right", "mandib*", "*tibia*", "*fibula*" },
        40.0,
        none },
      { { "liver*",   "spleen*",    "*kidney*",    "gallbladder*", "urinary_bladder*", "prostate*",    "heart*",
          "*atrium*", "*aorta*",    "*vena_*",     "*vein*",       "*artery*",         "spinal_cord*", "muscle*",
          "gluteus*", "iliopsoas*", "autochthon*", "quadriceps*",  "thigh*",           "sartorius*",   "brain*" },
        -50.0,
        500.0 } }
  };
  const auto fits = [&name](const std::string & pattern) { return MatchesPattern(pattern, name); };
  const auto * const rule = std::find_if(rules.begin(), rules.end(), [&](const TissueRule & candidate) {
    return std::any_of(candidate.patterns.begin(), candidate.patterns.end(), fits);
  });
  return rule != rules.end() ? rule : nullptr;
}

/** Up to some 130 thousand voxels of the map, at equal distances in memory. */
std::vector<LabelledVoxel>
TakeVoxels(const ScanImage & labels)
{
  constexpr std::size_t most = std::size_t{ 1 } << 17;
  return std::visit(
    [](const auto & image) {
      const std::size_t count = image->GetBufferedRegion().GetNumberOfPixels();
      const std::size_t step = (count / most) | 1; // odd, so that not all voxels are from the same columns
      std::vector<LabelledVoxel> voxels;
      for (std::size_t n = 0; n < count; n += step)
      {
        voxels.push_back({ image->ComputeIndex(static_cast<itk::OffsetValueType>(n)),
                           static_cast<std::int32_t>(image->GetBufferPointer()[n]) });
      }
      return voxels;
    },
    labels);
}

/** The scan's values at voxels of a map, with the voxels' labels; voxels outside the scan are left out. */
struct LabelledValues
{
  std::vector<std::int32_t> labels;
  std::vector<double> values;
};

/** \param mirrors the axes of the map's grid about whose middle it is mirrored
 * \param shift of the map, in mm */
LabelledValues
ValuesAt(const Scan & scan,
         const itk::ImageBase<3> & map,
         const std::vector<LabelledVoxel> & voxels,
         const Mirrors & mirrors,
         const VectorType & shift)
{
  const auto & grid = GeometryOf(scan.image);
  const auto region = map.GetLargestPossibleRegion();
  LabelledValues found;
  std::visit(
    [&](const auto & image) {
      for (const LabelledVoxel & voxel : voxels)
      {
        itk::Index<3> index = voxel.index;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto last = region.GetIndex(axis) + static_cast<itk::IndexValueType>(region.GetSize(axis)) - 1;
          index[axis] = mirrors[axis] ? region.GetIndex(axis) + last - index[axis] : index[axis];
        }
        PointType point;
        map.TransformIndexToPhysicalPoint(index, point);
        itk::Index<3> inScan;
        const double value = grid.TransformPhysicalPointToIndex(point + shift, inScan)
                               ? static_cast<double>(image->GetPixel(inScan))
                               : std::numeric_limits<double>::quiet_NaN();
        if (std::isfinite(value))
        {
          found.labels.push_back(voxel.value);
          found.values.push_back(value);
        }
      }
    },
    scan.image);
  return found;
}

/** Number and sums of values. */
struct Sums
{
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;

  void
  Add(double value)
  {
    ++count;
    sum += value;
    squares += value * value;
  }
};

/** Shares of the variance of ranks that are between the labels. */
struct Fit
{
  double withBackground = 0.0;
  double ofLabels = 0.0;

  double
  GetProduct() const
  {
    return withBackground * ofLabels;
  }
};

double
ShareBetween(const std::map<std::int32_t, Sums> & labels)
{
  Sums all;
  double between = 0.0;
  for (const auto & [value, sums] : labels)
  {
    all.count += sums.count;
    all.sum += sums.sum;
    all.squares += sums.squares;
    between += sums.sum * sums.sum / sums.count;
  }
  const double square = all.count > 0.0 ? all.sum * all.sum / all.count : 0.0;
  return all.squares > square ? (between - square) / (all.squares - square) : 0.0;
}

/** \class Ranks
 * \brief The ranks of values in a list of numbers, many of which are equal. */
class Ranks
{
public:
  explicit Ranks(std::vector<double> list)
  {
    std::sort(list.begin(), list.end());
    for (auto first = list.begin(), last = first; first != list.end(); first = last)
    {
      last = std::upper_bound(first, list.end(), *first);
      m_Values.push_back(*first);
      m_Begins.push_back(static_cast<double>(first - list.begin()));
    }
    m_Begins.push_back(static_cast<double>(list.size()));
  }

  /** How many numbers are smaller, and how many are not larger, together. */
  double
  Find(double value) const
  {
    const auto found = std::lower_bound(m_Values.begin(), m_Values.end(), value);
    const auto place = static_cast<std::size_t>(found - m_Values.begin());
    const bool isInList = found != m_Values.end() && *found == value;
    return m_Begins[place] + m_Begins[isInList ? place + 1 : place];
  }

private:
  std::vector<double> m_Values; ///< of the list, each once, ascending
  std::vector<double> m_Begins; ///< how many numbers are smaller than each of them, and how many there are
};

/** How well labels part a scan's values, which are taken by their ranks. */
Fit
FindFit(const Ranks & ranks, const LabelledValues & values)
{
  std::map<std::int32_t, Sums> labels;
  auto last = labels.end(); // mostly that of the next, too
  for (std::size_t n = 0; n < values.values.size(); ++n)
  {
    if (last == labels.end() || last->first != values.labels[n])
    {
      last = labels.try_emplace(values.labels[n]).first;
    }
    last->second.Add(ranks.Find(values.values[n]));
  }
  Fit fit;
  fit.withBackground = ShareBetween(labels);
  labels.erase(0);
  fit.ofLabels = ShareBetween(labels);
  return fit;
}

/** A way to move a label map. */
struct Move
{
  Mirrors mirrors{};
  VectorType shift{ 0.0 };
  std::string words;
};

/** The direction of the patient nearest to a vector in LPS. */
std::string
NameDirection(const VectorType & direction)
{
  constexpr const char * names[3][2] = { { "left", "right" }, { "back", "front" }, { "head", "feet" } };
  unsigned int nearest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    nearest = std::abs(direction[axis]) > std::abs(direction[nearest]) ? axis : nearest;
  }
  return names[nearest][direction[nearest] < 0.0 ? 1 : 0];
}

std::vector<Move>
ListMoves(const itk::ImageBase<3> & map)
{
  std::vector<Move> moves;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const VectorType direction(map.GetDirection().GetVnlMatrix().get_column(axis).data_block());
    for (const double distance : { -15.0, -5.0, 5.0, 15.0 })
    {
      Move move;
      move.shift = direction * distance;
      move.words = "moved by " + FormatNumber(std::abs(distance)) + " mm towards the " + NameDirection(move.shift);
      moves.push_back(move);
    }
    Move mirrored;
    mirrored.mirrors[axis] = true;
    mirrored.words = "mirrored from " + NameDirection(direction) + " to " + NameDirection(-direction);
    moves.push_back(mirrored);
  }
  Move turned;
  turned.mirrors = { true, true, false };
  turned.words = "turned by 180 degrees";
  moves.push_back(turned);
  return moves;
}

/** The move after which the labels fit the values much better; nothing if there is none. */
std::optional<Move>
FindBetterPlace(const Scan & scan,
                const LabelMap & map,
                const std::vector<LabelledVoxel> & voxels,
                const LabelledValues & values)
{
  constexpr std::size_t fewestLabels = 5;
  constexpr double fewestInScan = 0.6; // share of the voxels; fewer say little
  constexpr double leastFit = 0.1;     // of either share of variance, for labels that do fit
  constexpr double muchBetter = 1.05;  // factor of the product
  if (map.labels.size() < fewestLabels || !scan.sliceOrigins.empty() || !map.scan.sliceOrigins.empty())
  {
    return std::nullopt;
  }
  const Ranks ranks(values.values);
  const Fit fit = FindFit(ranks, values);
  std::optional<Move> best;
  double bestProduct = muchBetter * fit.GetProduct();
  const std::vector<Move> moves = ListMoves(GeometryOf(map.scan.image));
  std::vector<Fit> fits(moves.size()); // bad where too few voxels are in the scan
  ForEachOnThreads(moves.size(), [&](std::size_t n) {
    const LabelledValues moved = ValuesAt(scan, GeometryOf(map.scan.image), voxels, moves[n].mirrors, moves[n].shift);
    const double fewest = fewestInScan * static_cast<double>(values.values.size());
    fits[n] = static_cast<double>(moved.values.size()) >= fewest ? FindFit(ranks, moved) : Fit();
  });
  for (std::size_t n = 0; n < moves.size(); ++n)
  {
    const Fit & movedFit = fits[n];
    if (movedFit.GetProduct() > bestProduct && movedFit.withBackground > fit.withBackground &&
        movedFit.ofLabels > fit.ofLabels && std::min(movedFit.withBackground, movedFit.ofLabels) > leastFit)
    {
      best = moves[n];
      bestProduct = movedFit.GetProduct();
    }
  }
  return best;
}

bool
MayBeInHounsfieldUnits(const Scan & scan, const LabelledValues & values)
{
  constexpr double nearAir = -900.0;
  const auto lowest = std::min_element(values.values.begin(), values.values.end());
  return (scan.modality == "CT" || scan.modality.empty()) && lowest != values.values.end() && *lowest < nearAir;
}

/** A label whose mean value its tissue can't have. */
struct OddLabel
{
  std::string name;
  double mean;
  double count;
};

std::string
DescribeOddValues(const LabelMap & map, const LabelledValues & values)
{
  constexpr double fewestVoxels = 10.0;
  constexpr double leastShare = 0.02;
  constexpr std::size_t mostNamed = 3;
  std::map<std::int32_t, Sums> sums;
  for (std::size_t n = 0; n < values.values.size(); ++n)
  {
    sums[values.labels[n]].Add(values.values[n]);
  }
  std::vector<OddLabel> odd;
  double known = 0.0;
  double oddCount = 0.0;
  for (const LabelSummary & summary : map.labels)
  {
    const auto found = sums.find(summary.label.value);
    const TissueRule * const rule = FindTissueRule(LowerCase(summary.label.name));
    if (rule == nullptr || found == sums.end() || found->second.count < fewestVoxels)
    {
      continue;
    }
    const double mean = found->second.sum / found->second.count;
    known += found->second.count;
    if (mean < rule->lowest || mean > rule->highest)
    {
      odd.push_back({ summary.label.name, mean, found->second.count });
      oddCount += found->second.count;
    }
  }
  if (odd.empty() || oddCount < leastShare * known)
  {
    return "";
  }
  std::stable_sort(odd.begin(), odd.end(), [](const OddLabel & a, const OddLabel & b) { return a.count > b.count; });
  std::vector<std::string> names;
  for (std::size_t n = 0; n < std::min(odd.size(), mostNamed); ++n)
  {
    names.push_back(odd[n].name + " " + std::to_string(std::lround(odd[n].mean)) + " HU");
  }
  return "mean values of " + Count(odd.size(), "label") + " are not those of the tissue (" + Enumerate(names, "and") +
         ")";
}

double
VolumeOf(const itk::ImageBase<3> & grid)
{
  const auto & spacing = grid.GetSpacing();
  return static_cast<double>(grid.GetLargestPossibleRegion().GetNumberOfPixels()) * spacing[0] * spacing[1] *
         spacing[2];
}

/** The lowest and the highest coordinates of the centres of a grid's voxels. */
std::pair<PointType, PointType>
FindBox(const itk::ImageBase<3> & grid)
{
  const auto & region = grid.GetLargestPossibleRegion();
  const auto corners = itk::BoundingBox<>::PointsContainer::New();
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::Index<3> index = region.GetIndex();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = (corner >> axis & 1u) != 0 ? region.GetUpperIndex()[axis] : index[axis];
    }
    corners->InsertElement(corner, grid.TransformIndexToPhysicalPoint<double>(index));
  }
  const auto box = itk::BoundingBox<>::New();
  box->SetPoints(corners);
  return { box->GetMinimum(), box->GetMaximum() };
}

/** \param inScan share of the map's voxels that are in the scan */
std::string
DescribeOddExtent(const Scan & scan, const Scan & map, double inScan)
{
  constexpr double leastCovered = 0.5;
  if (map.format == "DICOM" || map.format == "NRRD")
  {
    return "";
  }
  const auto & grid = GeometryOf(scan.image);
  const auto & mapGrid = GeometryOf(map.image);
  const double covered = inScan * VolumeOf(mapGrid) / VolumeOf(grid);
  if (covered < leastCovered)
  {
    return "the label map covers " + FormatFixed(100.0 * covered, 0) + " % of the scan's extent";
  }
  const auto [low, high] = FindBox(grid);
  const auto [mapLow, mapHigh] = FindBox(mapGrid);
  const double apart = std::max((low - mapLow).GetNorm(), (high - mapHigh).GetNorm());
  const auto & spacing = grid.GetSpacing();
  const double voxel = std::max({ spacing[0], spacing[1], spacing[2] });
  const bool areAsMany =
    mapGrid.GetLargestPossibleRegion().GetNumberOfPixels() == grid.GetLargestPossibleRegion().GetNumberOfPixels();
  return areAsMany && apart > voxel
           ? "the label map has as many voxels as the scan, but lies up to " + FormatNumber(apart, 3) + " mm beside it"
           : "";
}

} // namespace

std::vector<std::string>
FindLabelDoubts(const Scan & scan, const LabelMap & map)
{
  const std::vector<LabelledVoxel> voxels = TakeVoxels(map.scan.image);
  const LabelledValues values = ValuesAt(scan, GeometryOf(map.scan.image), voxels, {}, VectorType(0.0));
  const double inScan = static_cast<double>(values.values.size()) / static_cast<double>(voxels.size());
  std::vector<std::string> doubts{ DescribeOddExtent(scan, map.scan, inScan) };
  if (MayBeInHounsfieldUnits(scan, values))
  {
    LabelledValues all = values;
    for (const ScanImage & layer : map.scan.furtherLayers)
    {
      const LabelledValues more = ValuesAt(scan, GeometryOf(layer), TakeVoxels(layer), {}, VectorType(0.0));
      all.labels.insert(all.labels.end(), more.labels.begin(), more.labels.end());
      all.values.insert(all.values.end(), more.values.begin(), more.values.end());
    }
    doubts.push_back(DescribeOddValues(map, all));
  }
  if (const auto move = FindBetterPlace(scan, map, voxels, values))
  {
    doubts.push_back("the labels fit the scan's values better " + move->words);
  }
  doubts.erase(std::remove(doubts.begin(), doubts.end(), ""), doubts.end());
  for (std::string & doubt : doubts)
  {
    doubt += "; check that the labels are those of this scan";
  }
  return doubts;
}

} // namespace rhombic
