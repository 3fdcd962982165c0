#ifndef itkLabelTopology_h
#define itkLabelTopology_h

#include "itkFCCCells.h"
#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"

#include <vector>

namespace itk
{

/** \class LabelTopology
 * \brief The labels of the sites of a lattice, by their weights and by the claims of thin parts.
 *
 * A thin part claims the sites that its middle passes, even if another label has a larger weight there. Then each such
 * site goes back to the label of largest weight if that leaves the topology of both labels as it is: if the neighbours
 * of either label are a disk in the site's link (see FCCCells). Offsets that are added to the weights of a label change
 * the labels of sites under the same condition. Labels of one group are kept apart, so that they can be merged later:
 * no edge of the lattice's tetrahedra joins two of them. Where one does, the site whose label has the least advantage
 * in weight goes to another label beside it or to the background 0, if its neighbours of its own label are a disk, or
 * none. Labels that have no site then, and those that lost all their claims, get the one where their weight is largest,
 * if its label can spare it.
 *
 * Where the label of a site has not the largest weight in the end, its weight is raised to that. */
class LabelTopology
{
public:
  using LabelType = FCCLabelWeights::LabelType;
  using LatticeType = FCCImage<LabelType>;

  /** \param labels of largest weight at each site
   * \param weights sorted
   * \param groups of each label, 0 being none; empty: there are none */
  LabelTopology(LatticeType & labels, FCCLabelWeights & weights, const std::vector<LabelType> & groups)
    : m_Labels(labels)
    , m_Weights(weights)
    , m_Groups(groups)
    , m_IsHeld(labels.GetLargestPossibleRegion().GetNumberOfPixels())
  {}

  /** A label's claim of a site; it is held if it must not go back. */
  struct Claim
  {
    SizeValueType site; ///< offset in the buffer
    LabelType label;
    bool isHeld;
  };

  /** Gives the sites to those that claim them; of several to the one of largest weight, and to 0 last. */
  void
  Grant(std::vector<Claim> claims);

  /** Adds an offset to all weights of each label.
   * \param offsets by label; those that are missing are 0 */
  void
  AddOffsets(std::vector<double> offsets);

private:
  /** The labels of a site's neighbours (see FCCCells), by direction; 0 beyond the lattice. */
  using NeighborsType = std::array<LabelType, FCCCells::Directions>;

  /** A label that may get a site of another one, and by how much its weight is larger there. */
  struct Change
  {
    SizeValueType site;
    LabelType label;
    float gain;
  };

  float *
  FindWeight(SizeValueType site, LabelType label);

  /** The weight, or what counts as that of a label at sites of others. */
  float
  GetWeight(SizeValueType site, LabelType label);

  NeighborsType
  FindNeighbors(SizeValueType site) const;

  /** Whether a label is of the group of another one among the neighbours. */
  bool
  MeetsGroup(LabelType label, const NeighborsType & neighbors) const;

  /** Gives a site to a label, and makes sure that weights are stored for it and the one before. Needs SortWeights(). */
  void
  Give(SizeValueType site, LabelType label);

  /** Sorts the rows to which weights were added. */
  void
  SortWeights();

  /** The labels and their weights for which test(site, entry) is true, in the order of the sites. */
  template <typename TTest>
  std::vector<Change>
  FindWeights(const TTest & test) const;

  /** The label beside a site that is to have it in order that its own does not meet another one of its group. */
  Change
  FindGap(SizeValueType site);

  /** Takes sites from labels that meet others of their groups. */
  void
  PartGroups();

  /** Gives a site to each label that has weights but no site. */
  void
  PlaceLost();

  /** Adds the offsets and returns the sites whose labels have not the largest weight, with those that have. */
  std::vector<Change>
  FindDoubts(std::vector<double> offsets);

  /** Makes the changes that keep the topology; leaves the others in the list. */
  void
  Settle(std::vector<Change> & doubts);

  /** Gives the raised weights what they were before. */
  void
  LowerRaised();

  bool
  CanChange(const Change & doubt) const;

  LatticeType & m_Labels;
  FCCLabelWeights & m_Weights;
  const std::vector<LabelType> & m_Groups;
  std::vector<bool> m_IsHeld;
  std::vector<Change> m_Raised; ///< what was added to the weights of the labels of these sites
  std::vector<SizeValueType> m_UnsortedRows;
};

} // namespace itk

#endif
