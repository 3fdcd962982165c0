#include "itkLabelTopology.h"

#include "itkForEachBlock.h"

#include <algorithm>
#include <array>
#include <limits>

namespace itk
{
namespace
{

constexpr float RaisedMargin = 0.1f; // by which the weight of a site's label exceeds others after it was raised

/** The neighbours of a site in the lattice's tetrahedra, and which of these are neighbours of each other. */
struct Link
{
  static constexpr unsigned int Size = 14;
  using SetType = unsigned int; ///< a bit for each neighbour

  std::array<FCCLattice::SiteType, Size> steps;
  std::array<SetType, Size> neighbors{};

  Link()
  {
    for (unsigned int n = 0; n < FCCLattice::OwnedEdges.size(); ++n)
    {
      const auto & [x, y, z] = FCCLattice::OwnedEdges[n];
      steps[2 * n] = { x, y, z };
      steps[2 * n + 1] = { -x, -y, -z };
    }
    for (unsigned int a = 0; a < Size; ++a)
    {
      for (unsigned int b = 0; b < Size; ++b)
      {
        const FCCLattice::SiteType step{ steps[b][0] - steps[a][0],
                                         steps[b][1] - steps[a][1],
                                         steps[b][2] - steps[a][2] };
        neighbors[a] |= std::find(steps.begin(), steps.end(), step) != steps.end() ? 1u << b : 0u;
      }
    }
  }

  /** Whether a set is connected and not empty. */
  bool
  IsConnected(SetType set) const
  {
    SetType reached = set & (~set + 1);
    for (SetType before = 0; reached != before;)
    {
      before = reached;
      for (unsigned int n = 0; n < Size; ++n)
      {
        reached |= (before >> n & 1) != 0 ? neighbors[n] & set : 0u;
      }
    }
    return set != 0 && reached == set;
  }

  /** On a sphere, a set is a disk if it and the rest are connected. */
  bool
  IsDisk(SetType set) const
  {
    return this->IsConnected(set) && this->IsConnected(~set & ((1u << Size) - 1));
  }
};

} // namespace

float *
LabelTopology::FindWeight(SizeValueType site, LabelType label)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  return const_cast<float *>(m_Weights.Find(site / width, static_cast<std::uint32_t>(site % width), label));
}

void
LabelTopology::Grant(std::vector<Claim> claims)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  LabelType * const labels = m_Labels.GetBufferPointer();
  std::stable_sort(claims.begin(), claims.end(), [](const Claim & a, const Claim & b) { return a.site < b.site; });
  std::vector<SizeValueType> rows; // that get weights
  for (auto begin = claims.begin(), end = begin; begin != claims.end(); begin = end)
  {
    const LabelType own = labels[begin->site];
    const auto strengthOf = [&](const Claim & claim) {
      const float * const weight = this->FindWeight(claim.site, claim.label);
      const float known = weight != nullptr ? *weight : -FCCLabelWeights::Limit;
      const float strength = claim.label == own ? std::numeric_limits<float>::max() : known;
      return std::make_pair(claim.label != 0, strength);
    };
    end = std::find_if(begin, claims.end(), [&](const Claim & claim) { return claim.site != begin->site; });
    const Claim & best =
      *std::max_element(begin, end, [&](const Claim & a, const Claim & b) { return strengthOf(a) < strengthOf(b); });
    for (const LabelType label : { own, best.label })
    {
      if (best.label != own && this->FindWeight(best.site, label) == nullptr)
      {
        const float weight = label == own ? FCCLabelWeights::Limit : -FCCLabelWeights::Limit;
        m_Weights.Add(best.site / width, { static_cast<std::uint32_t>(best.site % width), label, weight });
        rows.push_back(best.site / width);
      }
    }
    labels[best.site] = best.label;
    m_IsHeld[best.site] = best.isHeld;
  }
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (const SizeValueType row : rows)
  {
    m_Weights.SortRow(row);
  }
  this->AddOffsets({});
}

std::vector<LabelTopology::Doubt>
LabelTopology::FindDoubts(const std::map<LabelType, double> & offsets)
{
  const SizeValueType width = m_Labels.GetLargestPossibleRegion().GetSize(0);
  std::vector<std::vector<Doubt>> found(m_Weights.GetNumberOfRows());
  ForEachInBlocks(found.size(), 64, [&](std::size_t row) {
    FCCLabelWeights::RowType & entries = m_Weights.GetRow(row);
    for (auto begin = entries.begin(), end = begin; begin != entries.end(); begin = end)
    {
      // The weights of one site: its label's, if it is stored, is the one to exceed.
      const SizeValueType site = row * width + begin->i;
      const LabelType label = m_Labels.GetBufferPointer()[site];
      float own = std::numeric_limits<float>::max();
      auto strongest = begin;
      for (; end != entries.end() && end->i == begin->i; ++end)
      {
        const auto offset = offsets.find(end->label);
        end->weight += offset != offsets.end() ? static_cast<float>(offset->second) : 0.0f;
        own = end->label == label ? end->weight : own;
        strongest = end->weight > strongest->weight ? end : strongest;
      }
      if (strongest->weight > own)
      {
        found[row].push_back({ site, strongest->label, strongest->weight - own });
      }
    }
  });
  std::vector<Doubt> doubts;
  for (const auto & inRow : found)
  {
    doubts.insert(doubts.end(), inRow.begin(), inRow.end());
  }
  return doubts;
}

bool
LabelTopology::CanChange(const Doubt & doubt) const
{
  static const Link link;
  const Index<3> index = m_Labels.ComputeIndex(static_cast<OffsetValueType>(doubt.site));
  const LabelType label = m_Labels.GetBufferPointer()[doubt.site];
  Link::SetType before = 0;
  Link::SetType after = 0;
  for (unsigned int n = 0; n < Link::Size; ++n)
  {
    const Index<3> neighbor = index + FCCLattice::OffsetOf(link.steps[n], FCCLattice::Parity(index[1], index[2]));
    const bool isIn = m_Labels.GetLargestPossibleRegion().IsInside(neighbor);
    const LabelType other = isIn ? m_Labels.GetPixel(neighbor) : LabelType{ 0 };
    before |= other == label ? 1u << n : 0u;
    after |= other == doubt.strongest ? 1u << n : 0u;
  }
  return !m_IsHeld[doubt.site] && link.IsDisk(before) && link.IsDisk(after);
}

void
LabelTopology::Settle(std::vector<Doubt> & doubts)
{
  std::stable_sort(
    doubts.begin(), doubts.end(), [](const Doubt & a, const Doubt & b) { return a.lacking > b.lacking; });
  for (std::size_t before = 0; before != doubts.size();)
  {
    before = doubts.size();
    doubts.erase(std::remove_if(doubts.begin(),
                                doubts.end(),
                                [this](const Doubt & doubt) {
                                  const bool canChange = this->CanChange(doubt);
                                  if (canChange)
                                  {
                                    m_Labels.GetBufferPointer()[doubt.site] = doubt.strongest;
                                  }
                                  return canChange;
                                }),
                 doubts.end());
  }
}

void
LabelTopology::AddOffsets(const std::map<LabelType, double> & offsets)
{
  const LabelType * const labels = m_Labels.GetBufferPointer();
  for (const Doubt & raised : m_Raised)
  {
    *this->FindWeight(raised.site, labels[raised.site]) -= raised.lacking;
  }
  m_Raised = this->FindDoubts(offsets);
  this->Settle(m_Raised);
  for (Doubt & doubt : m_Raised)
  {
    doubt.lacking += RaisedMargin;
    *this->FindWeight(doubt.site, labels[doubt.site]) += doubt.lacking;
  }
}

} // namespace itk
