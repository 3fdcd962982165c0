#include "itkLabelTopology.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace itk
{
namespace
{

constexpr float RaisedMargin = 0.2f; // by which a raised weight exceeds the largest other weight of the site

/** The neighbours that have a label, as bits of their directions. */
unsigned int
SetOf(LabelTopology::LabelType label, const std::array<LabelTopology::LabelType, FCCCells::Directions> & neighbors)
{
  unsigned int set = 0;
  for (unsigned int n = 0; n < FCCCells::Directions; ++n)
  {
    set |= neighbors[n] == label ? 1u << n : 0u;
  }
  return set;
}

template <typename TChange>
void
SortByGain(BulkVector<TChange> & changes)
{
  std::stable_sort(
    changes.begin(), changes.end(), [](const TChange & a, const TChange & b) { return a.gain > b.gain; });
}

/** Calls change(element) for the elements of a list in its order, again and again, and removes those for which it
 * returns true, until there are no more of these. */
template <typename TElement, typename TChange>
void
ChangeEach(BulkVector<TElement> & elements, const TChange & change)
{
  for (std::size_t before = elements.size() + 1; before != elements.size();)
  {
    before = elements.size();
    elements.erase(std::remove_if(elements.begin(), elements.end(), change), elements.end());
  }
}

} // namespace

float *
LabelTopology::FindWeight(SizeValueType site, LabelType label)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  return const_cast<float *>(m_Weights.Find(site / width, static_cast<std::uint32_t>(site % width), label));
}

float
LabelTopology::GetWeight(SizeValueType site, LabelType label)
{
  const float * const weight = this->FindWeight(site, label);
  return weight != nullptr ? *weight : -FCCLabelWeights::Limit;
}

LabelTopology::NeighborsType
LabelTopology::FindNeighbors(SizeValueType site) const
{
  const Index<3> index = m_Labels.ComputeIndex(static_cast<OffsetValueType>(site));
  const IndexValueType parity = FCCLattice::Parity(index[1], index[2]);
  NeighborsType neighbors;
  for (unsigned int n = 0; n < FCCCells::Directions; ++n)
  {
    const Index<3> neighbor = index + FCCLattice::OffsetOf(FCCCells::StepOf(n), parity);
    neighbors[n] =
      m_Labels.GetLargestPossibleRegion().IsInside(neighbor) ? m_Labels.GetPixel(neighbor) : LabelType{ 0 };
  }
  return neighbors;
}

bool
LabelTopology::MeetsGroup(LabelType label, const NeighborsType & neighbors) const
{
  const auto groupOf = [this](LabelType of) { return of < m_Groups.size() ? m_Groups[of] : LabelType{ 0 }; };
  const LabelType group = groupOf(label);
  return group != 0 && std::any_of(neighbors.begin(), neighbors.end(), [&](LabelType neighbor) {
           return neighbor != label && groupOf(neighbor) == group;
         });
}

bool
LabelTopology::PassesBackground(SizeValueType site, unsigned int direction) const
{
  const FCCLattice::SiteType from = FCCLattice::SiteOf(m_Labels.ComputeIndex(static_cast<OffsetValueType>(site)));
  const FCCLattice::SiteType step = FCCCells::StepOf(direction);
  for (const double share : { 0.25, 0.5, 0.75 })
  {
    std::array<double, 3> place;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      place[axis] = static_cast<double>(from[axis]) + share * static_cast<double>(step[axis]);
    }
    if (m_IsBackground(m_Labels.TransformLatticeToPhysicalPoint<double>(place)))
    {
      return true;
    }
  }
  return false;
}

bool
LabelTopology::MeetsAcrossBackground(SizeValueType site, LabelType label, const NeighborsType & neighbors) const
{
  for (unsigned int n = 0; n < FCCCells::Directions && label != 0; ++n)
  {
    if (neighbors[n] != 0 && neighbors[n] != label && this->PassesBackground(site, n))
    {
      return true;
    }
  }
  return false;
}

void
LabelTopology::Give(SizeValueType site, LabelType label)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  LabelType & own = this->LabelOf(site);
  for (const LabelType each : { own, label })
  {
    if (label != own && this->FindWeight(site, each) == nullptr)
    {
      const float weight = each == own ? FCCLabelWeights::Limit : -FCCLabelWeights::Limit;
      m_Weights.Add(site / width, { static_cast<std::uint16_t>(site % width), each, weight });
      m_UnsortedRows.insert(site / width);
    }
  }
  own = label;
}

void
LabelTopology::SortWeights()
{
  for (const SizeValueType row : m_UnsortedRows)
  {
    m_Weights.SortRow(row);
  }
  m_UnsortedRows.clear();
}

template <typename TVisit>
LabelTopology::Changes
LabelTopology::CollectChanges(const TVisit & visit)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  constexpr std::size_t block = 64; // rows
  std::vector<Changes> found((m_Weights.GetNumberOfRows() + block - 1) / block);
  rhombic::ForEachInBlocks(m_Weights.GetNumberOfRows(), block, [&](std::size_t row) {
    visit(m_Weights.GetRow(row), row * width, found[row / block]);
  });
  Changes all;
  for (const auto & changes : found)
  {
    all.insert(all.end(), changes.begin(), changes.end());
  }
  return all;
}

template <typename TTest>
LabelTopology::Changes
LabelTopology::FindWeights(const TTest & test)
{
  return this->CollectChanges([&test](const auto & entries, SizeValueType firstSite, Changes & found) {
    for (const FCCLabelWeights::Entry & entry : entries)
    {
      if (test(firstSite + entry.i, entry.label))
      {
        found.push_back({ firstSite + entry.i, entry.label, entry.weight });
      }
    }
  });
}

BulkVector<std::uint8_t>
LabelTopology::FindRowsToChange(const std::vector<double> & offsets, const std::vector<ImageRegion<3>> & boxes) const
{
  const ImageRegion<3> & whole = m_Labels.GetLargestPossibleRegion();
  BulkVector<std::uint8_t> rows(m_Weights.GetNumberOfRows(), boxes.empty() ? 1 : 0);
  for (std::size_t label = 0; label < std::min(offsets.size(), boxes.size()); ++label)
  {
    const ImageRegion<3> & box = boxes[label];
    for (SizeValueType k = 0; k < box.GetSize(2) && offsets[label] != 0.0; ++k)
    {
      const auto y = static_cast<SizeValueType>(box.GetIndex(1) - whole.GetIndex(1));
      const SizeValueType z = static_cast<SizeValueType>(box.GetIndex(2) - whole.GetIndex(2)) + k;
      std::fill_n(rows.data() + z * whole.GetSize(1) + y, box.GetSize(1), std::uint8_t{ 1 });
    }
  }
  for (const Change & raised : m_Raised)
  {
    rows[raised.site / whole.GetSize(0)] = 1;
  }
  return rows;
}

LabelTopology::Changes
LabelTopology::FindChanges(const std::vector<double> & offsets, const BulkVector<std::uint8_t> & areRowsToChange)
{
  std::vector<float> added(offsets.begin(), offsets.end());
  added.resize(std::numeric_limits<LabelType>::max() + std::size_t{ 1 });
  return this->CollectChanges([&](auto & entries, SizeValueType firstSite, Changes & found) {
    if (areRowsToChange[firstSite / m_Labels.GetLargestPossibleRegion().GetSize(0)] == 0)
    {
      return;
    }
    for (auto begin = entries.begin(), end = begin; begin != entries.end(); begin = end)
    {
      // The weights of one site: the weight of its label, if stored, is to be exceeded.
      const SizeValueType site = firstSite + begin->i;
      const LabelType label = this->LabelOf(site);
      float own = std::numeric_limits<float>::max();
      auto strongest = begin;
      for (; end != entries.end() && end->i == begin->i; ++end)
      {
        end->weight += added[end->label];
        own = end->label == label ? end->weight : own;
        strongest = end->weight > strongest->weight ? end : strongest;
      }
      if (strongest->weight > own)
      {
        found.push_back({ site, strongest->label, strongest->weight - own });
      }
    }
  });
}

bool
LabelTopology::IsAllowed(const Change & change) const
{
  const NeighborsType neighbors = this->FindNeighbors(change.site);
  return !m_IsLocked[change.site] && this->IsApart(change.site, change.label, neighbors) &&
         FCCCells::IsDisk(SetOf(m_Labels.GetBufferPointer()[change.site], neighbors)) &&
         FCCCells::IsDisk(SetOf(change.label, neighbors));
}

void
LabelTopology::MakeChanges(Changes & changes)
{
  SortByGain(changes);
  ChangeEach(changes, [this](const Change & change) {
    const bool isAllowed = this->IsAllowed(change);
    if (isAllowed)
    {
      this->LabelOf(change.site) = change.label;
    }
    return isAllowed;
  });
}

LabelTopology::Change
LabelTopology::FindReplacement(SizeValueType site)
{
  const NeighborsType neighbors = this->FindNeighbors(site);
  const LabelType label = this->LabelOf(site);
  const float * const own = this->FindWeight(site, label);
  Change replacement{ site, 0, this->GetWeight(site, 0) };
  for (const LabelType other : neighbors)
  {
    const float weight = this->GetWeight(site, other);
    if (other != label && weight > replacement.gain && this->IsApart(site, other, neighbors))
    {
      replacement = { site, other, weight };
    }
  }
  replacement.gain -= own != nullptr ? *own : FCCLabelWeights::Limit;
  return replacement;
}

template <typename TMeets>
void
LabelTopology::Separate(const TMeets & meets, bool canBeAlone)
{
  Changes meetings;
  for (const Change & meeting : this->FindWeights([&](SizeValueType site, LabelType label) {
         return label != 0 && label == this->LabelOf(site) && meets(site);
       }))
  {
    meetings.push_back(this->FindReplacement(meeting.site));
  }
  SortByGain(meetings);
  ChangeEach(meetings, [&](const Change & meeting) {
    if (!meets(meeting.site))
    {
      return true;
    }
    const unsigned int same = SetOf(this->LabelOf(meeting.site), this->FindNeighbors(meeting.site));
    const bool canChange = FCCCells::IsDisk(same) || (canBeAlone && same == 0);
    if (canChange)
    {
      this->Give(meeting.site, this->FindReplacement(meeting.site).label);
    }
    return canChange;
  });
  this->SortWeights();
}

void
LabelTopology::SeparateLabels()
{
  std::vector<std::size_t> sizes(std::numeric_limits<LabelType>::max() + std::size_t{ 1 }); // of groups
  for (const LabelType group : m_Groups)
  {
    ++sizes[group];
  }
  const auto meetsGroup = [&](SizeValueType site) {
    const LabelType label = this->LabelOf(site);
    return label < m_Groups.size() && sizes[m_Groups[label]] > 1 && this->MeetsGroup(label, this->FindNeighbors(site));
  };
  this->Separate(meetsGroup, false);
  this->Separate(meetsGroup, true);
  m_KeepsGaps = true;
  const auto bridgesGap = [&](SizeValueType site) {
    return !m_IsLocked[site] && this->MeetsAcrossBackground(site, this->LabelOf(site), this->FindNeighbors(site));
  };
  this->Separate(bridgesGap, false);
}

void
LabelTopology::PlaceLostLabels()
{
  std::vector<bool> hasSites(std::numeric_limits<LabelType>::max() + std::size_t{ 1 });
  hasSites[0] = true;
  for (SizeValueType site = 0; site < m_Labels.GetLargestPossibleRegion().GetNumberOfPixels(); ++site)
  {
    hasSites[this->LabelOf(site)] = true;
  }
  Changes places = this->FindWeights([&](SizeValueType, LabelType label) { return !hasSites[label]; });
  SortByGain(places);
  for (const Change & place : places)
  {
    const NeighborsType neighbors = this->FindNeighbors(place.site);
    const LabelType own = this->LabelOf(place.site);
    if (!hasSites[place.label] && (own == 0 || FCCCells::IsDisk(SetOf(own, neighbors))) &&
        this->IsApart(place.site, place.label, neighbors))
    {
      this->Give(place.site, place.label);
      hasSites[place.label] = true;
    }
  }
  this->SortWeights();
}

void
LabelTopology::LowerRaised()
{
  for (const Change & raised : m_Raised)
  {
    *this->FindWeight(raised.site, this->LabelOf(raised.site)) -= raised.gain;
  }
  m_Raised.clear();
}

void
LabelTopology::AddOffsets(const std::vector<double> & offsets, const std::vector<ImageRegion<3>> & boxes)
{
  const BulkVector<std::uint8_t> areRowsToChange = this->FindRowsToChange(offsets, boxes);
  this->LowerRaised();
  m_Raised = this->FindChanges(offsets, areRowsToChange);
  this->MakeChanges(m_Raised);
  std::sort(
    m_Raised.begin(), m_Raised.end(), [](const Change & a, const Change & b) { return a.site < b.site; }); // as stored
  for (Change & raised : m_Raised)
  {
    raised.gain += RaisedMargin;
    *this->FindWeight(raised.site, this->LabelOf(raised.site)) += raised.gain;
  }
}

void
LabelTopology::Assign(Candidates candidates)
{
  std::stable_sort(
    candidates.begin(), candidates.end(), [](const Candidate & a, const Candidate & b) { return a.site < b.site; });
  for (auto begin = candidates.begin(), end = begin; begin != candidates.end(); begin = end)
  {
    const auto strengthOf = [&](const Candidate & candidate) {
      const float strength = candidate.label == this->LabelOf(candidate.site)
                               ? std::numeric_limits<float>::max()
                               : this->GetWeight(candidate.site, candidate.label);
      return std::make_pair(candidate.label != 0, strength);
    };
    end =
      std::find_if(begin, candidates.end(), [&](const Candidate & candidate) { return candidate.site != begin->site; });
    const Candidate & best = *std::max_element(
      begin, end, [&](const Candidate & a, const Candidate & b) { return strengthOf(a) < strengthOf(b); });
    this->Give(best.site, best.label);
    m_IsLocked[best.site] = best.isLocked;
  }
  this->SortWeights();
  this->AddOffsets({});
  this->LowerRaised();
  this->SeparateLabels();
  this->PlaceLostLabels();
  this->AddOffsets({});
}

} // namespace itk
