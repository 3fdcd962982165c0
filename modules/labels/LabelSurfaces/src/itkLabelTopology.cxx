#include "itkLabelTopology.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <limits>

namespace itk
{
namespace
{

constexpr float RaisedMargin = 0.2f; // by which the weight of a site's label exceeds others after it was raised

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

/** The elements of all rows. */
template <typename TElement>
std::vector<TElement>
Join(const std::vector<std::vector<TElement>> & rows)
{
  std::vector<TElement> all;
  for (const auto & row : rows)
  {
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

template <typename TChange>
void
SortByGain(std::vector<TChange> & changes)
{
  std::stable_sort(
    changes.begin(), changes.end(), [](const TChange & a, const TChange & b) { return a.gain > b.gain; });
}

/** Calls change(element) for the elements of a list in its order, again and again, and removes those for which it
 * returns true, until there are no more of these. */
template <typename TElement, typename TChange>
void
ChangeEach(std::vector<TElement> & elements, const TChange & change)
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

void
LabelTopology::Give(SizeValueType site, LabelType label)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  LabelType & own = m_Labels.GetBufferPointer()[site];
  for (const LabelType each : { own, label })
  {
    if (label != own && this->FindWeight(site, each) == nullptr)
    {
      const float weight = each == own ? FCCLabelWeights::Limit : -FCCLabelWeights::Limit;
      m_Weights.Add(site / width, { static_cast<std::uint16_t>(site % width), each, weight });
      m_UnsortedRows.push_back(site / width);
    }
  }
  own = label;
}

void
LabelTopology::SortWeights()
{
  std::sort(m_UnsortedRows.begin(), m_UnsortedRows.end());
  m_UnsortedRows.erase(std::unique(m_UnsortedRows.begin(), m_UnsortedRows.end()), m_UnsortedRows.end());
  for (const SizeValueType row : m_UnsortedRows)
  {
    m_Weights.SortRow(row);
  }
  m_UnsortedRows.clear();
}

void
LabelTopology::Grant(std::vector<Claim> claims)
{
  std::stable_sort(claims.begin(), claims.end(), [](const Claim & a, const Claim & b) { return a.site < b.site; });
  for (auto begin = claims.begin(), end = begin; begin != claims.end(); begin = end)
  {
    const LabelType own = m_Labels.GetBufferPointer()[begin->site];
    const auto strengthOf = [&](const Claim & claim) {
      const float strength =
        claim.label == own ? std::numeric_limits<float>::max() : this->GetWeight(claim.site, claim.label);
      return std::make_pair(claim.label != 0, strength);
    };
    end = std::find_if(begin, claims.end(), [&](const Claim & claim) { return claim.site != begin->site; });
    const Claim & best =
      *std::max_element(begin, end, [&](const Claim & a, const Claim & b) { return strengthOf(a) < strengthOf(b); });
    this->Give(best.site, best.label);
    m_IsHeld[best.site] = best.isHeld;
  }
  this->SortWeights();
  this->AddOffsets({});
  this->LowerRaised();
  this->SeparateGroups();
  this->PlaceLost();
  this->AddOffsets({});
}

template <typename TTest>
std::vector<LabelTopology::Change>
LabelTopology::FindWeights(const TTest & test) const
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  std::vector<std::vector<Change>> found(m_Weights.GetNumberOfRows());
  rhombic::ForEachInBlocks(found.size(), 64, [&](std::size_t row) {
    for (const FCCLabelWeights::Entry & entry : m_Weights.GetRow(row))
    {
      const SizeValueType site = row * width + entry.i;
      if (test(site, entry))
      {
        found[row].push_back({ site, entry.label, entry.weight });
      }
    }
  });
  return Join(found);
}

LabelTopology::Change
LabelTopology::FindReplacement(SizeValueType site)
{
  const NeighborsType neighbors = this->FindNeighbors(site);
  const LabelType label = m_Labels.GetBufferPointer()[site];
  const float * const own = this->FindWeight(site, label);
  Change replacement{ site, 0, this->GetWeight(site, 0) };
  for (const LabelType other : neighbors)
  {
    const float weight = this->GetWeight(site, other);
    if (other != label && weight > replacement.gain && !this->MeetsGroup(other, neighbors))
    {
      replacement = { site, other, weight };
    }
  }
  replacement.gain -= own != nullptr ? *own : FCCLabelWeights::Limit;
  return replacement;
}

void
LabelTopology::SeparateGroups()
{
  const LabelType * const labels = m_Labels.GetBufferPointer();
  const auto meets = [this, labels](SizeValueType site, const FCCLabelWeights::Entry & entry) {
    return entry.label == labels[site] && this->MeetsGroup(entry.label, this->FindNeighbors(site));
  };
  std::vector<Change> meetings;
  for (const Change & meeting : this->FindWeights(meets))
  {
    meetings.push_back(this->FindReplacement(meeting.site));
  }
  SortByGain(meetings);
  for (const bool canBeAlone : { false, true })
  {
    ChangeEach(meetings, [&](const Change & meeting) {
      const NeighborsType neighbors = this->FindNeighbors(meeting.site);
      if (!this->MeetsGroup(labels[meeting.site], neighbors))
      {
        return true;
      }
      const unsigned int same = SetOf(labels[meeting.site], neighbors);
      const bool canChange = FCCCells::IsDisk(same) || (canBeAlone && same == 0);
      if (canChange)
      {
        this->Give(meeting.site, this->FindReplacement(meeting.site).label);
      }
      return canChange;
    });
  }
  this->SortWeights();
}

void
LabelTopology::PlaceLost()
{
  const LabelType * const labels = m_Labels.GetBufferPointer();
  std::vector<bool> hasSites(std::numeric_limits<LabelType>::max() + std::size_t{ 1 });
  hasSites[0] = true;
  for (SizeValueType site = 0; site < m_Labels.GetLargestPossibleRegion().GetNumberOfPixels(); ++site)
  {
    hasSites[labels[site]] = true;
  }
  std::vector<Change> places = this->FindWeights(
    [&hasSites](SizeValueType, const FCCLabelWeights::Entry & entry) { return !hasSites[entry.label]; });
  SortByGain(places);
  for (const Change & place : places)
  {
    const NeighborsType neighbors = this->FindNeighbors(place.site);
    const LabelType own = labels[place.site];
    if (!hasSites[place.label] && (own == 0 || FCCCells::IsDisk(SetOf(own, neighbors))) &&
        !this->MeetsGroup(place.label, neighbors))
    {
      this->Give(place.site, place.label);
      hasSites[place.label] = true;
    }
  }
  this->SortWeights();
}

std::vector<LabelTopology::Change>
LabelTopology::FindOutweighed(std::vector<double> offsets)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  std::vector<std::vector<Change>> found(m_Weights.GetNumberOfRows());
  offsets.resize(std::numeric_limits<LabelType>::max() + std::size_t{ 1 });
  rhombic::ForEachInBlocks(found.size(), 64, [&](std::size_t row) {
    FCCLabelWeights::RowType & entries = m_Weights.GetRow(row);
    for (auto begin = entries.begin(), end = begin; begin != entries.end(); begin = end)
    {
      // The weights of one site: the weight of its label, if stored, is to be exceeded.
      const SizeValueType site = row * width + begin->i;
      const LabelType label = m_Labels.GetBufferPointer()[site];
      float own = std::numeric_limits<float>::max();
      auto strongest = begin;
      for (; end != entries.end() && end->i == begin->i; ++end)
      {
        end->weight += static_cast<float>(offsets[end->label]);
        own = end->label == label ? end->weight : own;
        strongest = end->weight > strongest->weight ? end : strongest;
      }
      if (strongest->weight > own)
      {
        found[row].push_back({ site, strongest->label, strongest->weight - own });
      }
    }
  });
  return Join(found);
}

bool
LabelTopology::CanChange(const Change & change) const
{
  const NeighborsType neighbors = this->FindNeighbors(change.site);
  return !m_IsHeld[change.site] && !this->MeetsGroup(change.label, neighbors) &&
         FCCCells::IsDisk(SetOf(m_Labels.GetBufferPointer()[change.site], neighbors)) &&
         FCCCells::IsDisk(SetOf(change.label, neighbors));
}

void
LabelTopology::MakeChanges(std::vector<Change> & changes)
{
  SortByGain(changes);
  ChangeEach(changes, [this](const Change & change) {
    const bool canChange = this->CanChange(change);
    if (canChange)
    {
      m_Labels.GetBufferPointer()[change.site] = change.label;
    }
    return canChange;
  });
}

void
LabelTopology::LowerRaised()
{
  for (const Change & raised : m_Raised)
  {
    *this->FindWeight(raised.site, m_Labels.GetBufferPointer()[raised.site]) -= raised.gain;
  }
  m_Raised.clear();
}

void
LabelTopology::AddOffsets(std::vector<double> offsets)
{
  this->LowerRaised();
  m_Raised = this->FindOutweighed(offsets);
  this->MakeChanges(m_Raised);
  for (Change & change : m_Raised)
  {
    change.gain += RaisedMargin;
    *this->FindWeight(change.site, m_Labels.GetBufferPointer()[change.site]) += change.gain;
  }
}

} // namespace itk
