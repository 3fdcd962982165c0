#include "itkKeepLabelVolumes.h"

#include "itkBulkImage.h"
#include "itkFCCLabelSurfaceFilter.h"
#include "itkLabelVolumes.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace itk
{
namespace
{

using LabelType = FCCLabelWeights::LabelType;
using Lattice = FCCImage<LabelType>;

constexpr unsigned int MostCorrections = 10;
constexpr double SettledOffset = 0.06; // of weights, for specks; the next is about a sixth of it
constexpr double LargestSettledOffset = 0.2;
constexpr double MovePerOffset = 0.7;  // of a wall, in voxels: 0.5 for weights that are depths, more for flatter ones
constexpr double FarthestOffset = 2.0; // of weights; twice as far as walls move, in voxels
constexpr double LargestShareAlone = 0.25; // of the lattice's sites: boxes of labels that are corrected alone

/** For each row of a box of the lattice, 1 where a cell around its sites may have a corner of the label: cells reach
 * two rows far. */
std::vector<std::uint8_t>
FindRowsNear(LabelType label, const ImageRegion<3> & box, const Lattice & labels)
{
  constexpr SizeValueType reach = 2;
  const SizeValueType height = box.GetSize(1);
  const SizeValueType depth = box.GetSize(2);
  std::vector<std::uint8_t> areNear(height * depth);
  for (SizeValueType k = 0; k < depth; ++k)
  {
    for (SizeValueType j = 0; j < height; ++j)
    {
      const Index<3> first =
        box.GetIndex() + Offset<3>{ { 0, static_cast<OffsetValueType>(j), static_cast<OffsetValueType>(k) } };
      const LabelType * const row = labels.GetBufferPointer() + labels.ComputeOffset(first);
      if (std::find(row, row + box.GetSize(0), label) == row + box.GetSize(0))
      {
        continue;
      }
      for (SizeValueType z = k - std::min(k, reach); z <= std::min(k + reach, depth - 1); ++z)
      {
        for (SizeValueType y = j - std::min(j, reach); y <= std::min(j + reach, height - 1); ++y)
        {
          areNear[z * height + y] = 1;
        }
      }
    }
  }
  return areNear;
}

/** The surface of a label alone, as label 1, from the walls in a box of the lattice. */
LabelWalls::Pointer
ExtractAlone(LabelType label, const ImageRegion<3> & box, const Lattice & labels, const FCCLabelWeights & weights)
{
  std::map<LabelType, LabelType> numbers{ { 0, 0 } };
  numbers.try_emplace(label, LabelType{ 1 });
  const auto numberOf = [&numbers](LabelType of) {
    return numbers.try_emplace(of, static_cast<LabelType>(numbers.size())).first->second;
  };
  const auto part = Lattice::New();
  part->CopyInformation(&labels);
  part->SetRegions(box);
  AllocateInBulk(*part);
  const auto weightsOfPart = FCCLabelWeights::New();
  weightsOfPart->SetNumberOfRows(box.GetSize(1) * box.GetSize(2));
  const ImageRegion<3> & whole = labels.GetLargestPossibleRegion();
  const auto first = static_cast<SizeValueType>(box.GetIndex(0) - whole.GetIndex(0));
  const std::vector<std::uint8_t> areNear = FindRowsNear(label, box, labels);
  for (SizeValueType row = 0; row < weightsOfPart->GetNumberOfRows(); ++row)
  {
    if (areNear[row] == 0)
    {
      std::fill_n(part->GetBufferPointer() + row * box.GetSize(0), box.GetSize(0), LabelType{ 0 });
      continue;
    }
    Index<3> index = box.GetIndex();
    index[1] += static_cast<IndexValueType>(row % box.GetSize(1));
    index[2] += static_cast<IndexValueType>(row / box.GetSize(1));
    const auto site = static_cast<SizeValueType>(labels.ComputeOffset(index));
    std::transform(labels.GetBufferPointer() + site,
                   labels.GetBufferPointer() + site + box.GetSize(0),
                   part->GetBufferPointer() + row * box.GetSize(0),
                   numberOf);
    const auto & entries = weights.GetRow(site / whole.GetSize(0));
    const auto isBefore = [](const FCCLabelWeights::Entry & entry, SizeValueType i) { return entry.i < i; };
    for (auto entry = std::lower_bound(entries.begin(), entries.end(), first, isBefore);
         entry != entries.end() && entry->i < first + box.GetSize(0);
         ++entry)
    {
      weightsOfPart->Add(row, { static_cast<std::uint16_t>(entry->i - first), numberOf(entry->label), entry->weight });
    }
    weightsOfPart->SortRow(row);
  }
  const auto filter = FCCLabelSurfaceFilter::New();
  filter->SetInput(part);
  filter->SetWeights(weightsOfPart);
  filter->SetJunctionFraction(FCCLabelSurfaceFilter::MinimumFraction); // volumes have to follow offsets
  filter->SetNumberOfWorkUnits(1);
  filter->Update();
  std::vector<LabelType> alone(numbers.size());
  alone[1] = 1;
  filter->GetOutput()->MergeLabels(alone);
  return filter->GetOutput();
}

/** The offsets of labels' weights so far. */
class LabelOffsets
{
public:
  LabelOffsets(const LabelsToKeep & keep, double voxelEdge)
    : m_Keep(keep)
    , m_LayerOfOffset(MovePerOffset * voxelEdge)
    , m_Offsets(keep.volumes.size())
    , m_Together(keep.volumes)
  {}

  /** The steps of all labels' offsets. */
  std::vector<double>
  FindSteps(const Lattice & labels, const FCCLabelWeights & weights)
  {
    const auto filter = FCCLabelSurfaceFilter::New();
    filter->SetInput(&labels);
    filter->SetWeights(&weights);
    filter->SetJunctionFraction(FCCLabelSurfaceFilter::MinimumFraction);
    filter->Update();
    std::vector<double> steps =
      m_Together.FindLayers(LabelSizes(*filter->GetOutput(), m_Offsets.size()),
                            [this](std::size_t label, double layer) { return this->Bound(label, layer); });
    for (std::size_t label = 1; label < steps.size(); ++label)
    {
      steps[label] /= m_LayerOfOffset;
      m_Offsets[label] += steps[label];
    }
    return steps;
  }

  /** The steps of some labels' offsets, while all others stay. */
  std::vector<double>
  FindStepsAlone(const std::vector<std::size_t> & some, const Lattice & labels, const FCCLabelWeights & weights)
  {
    for (const std::size_t label : some)
    {
      m_Alone.try_emplace(label, std::vector<double>{ 0.0, m_Keep.volumes[label] });
    }
    std::vector<double> steps(m_Keep.volumes.size());
    rhombic::ForEachOnThreads(some.size(), [&](std::size_t n) {
      const std::size_t label = some[n];
      const auto walls = ExtractAlone(static_cast<LabelType>(label), m_Keep.sites[label], labels, weights);
      const auto & layers = m_Alone.at(label).FindLayers(
        LabelSizes(*walls, 2), [&](std::size_t, double layer) { return this->Bound(label, layer); });
      steps[label] = layers[1] / m_LayerOfOffset;
      m_Offsets[label] += steps[label];
    });
    return steps;
  }

private:
  /** A layer with which the offset is not beyond the farthest. */
  double
  Bound(std::size_t label, double layer) const
  {
    const double offset = std::clamp(m_Offsets[label] + layer / m_LayerOfOffset, -FarthestOffset, FarthestOffset);
    return m_LayerOfOffset * (offset - m_Offsets[label]);
  }

  const LabelsToKeep & m_Keep;
  double m_LayerOfOffset;
  std::vector<double> m_Offsets;
  LabelVolumes m_Together;
  std::map<std::size_t, LabelVolumes> m_Alone;
};

/** The change of an offset after which the next would change the volume of a label by less than a per cent: for a
 * label of some voxels. */
double
FindSettledOffset(double voxels)
{
  constexpr double small = 100.0; // voxels
  return std::clamp(SettledOffset * std::cbrt(voxels / small), SettledOffset, LargestSettledOffset);
}

} // namespace

void
KeepLabelVolumes(const LabelsToKeep & keep,
                 double voxelEdge,
                 const Lattice & labels,
                 const FCCLabelWeights & weights,
                 LabelTopology & topology)
{
  LabelOffsets offsets(keep, voxelEdge);
  std::vector<std::size_t> unsettled;
  const double mostAlone =
    LargestShareAlone * static_cast<double>(labels.GetLargestPossibleRegion().GetNumberOfPixels());
  bool isTogether = true;
  for (unsigned int n = 0; n < MostCorrections && (n == 0 || !unsettled.empty()); ++n)
  {
    double sites = 0.0;
    for (const std::size_t label : unsettled)
    {
      sites += static_cast<double>(keep.sites[label].GetNumberOfPixels());
    }
    isTogether = isTogether && (n == 0 || sites > mostAlone); // others may move no more once one moves alone
    const std::vector<double> steps =
      isTogether ? offsets.FindSteps(labels, weights) : offsets.FindStepsAlone(unsettled, labels, weights);
    unsettled.clear();
    for (std::size_t label = 1; label < steps.size(); ++label)
    {
      if (std::abs(steps[label]) >= FindSettledOffset(keep.volumes[label] / (voxelEdge * voxelEdge * voxelEdge)))
      {
        unsettled.push_back(label);
      }
    }
    topology.AddOffsets(steps, keep.sites);
  }
}

} // namespace itk
