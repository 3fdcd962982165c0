#ifndef itkLabelTopology_h
#define itkLabelTopology_h

#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"

#include <map>
#include <vector>

namespace itk
{

/** \class LabelTopology
 * \brief The labels of the sites of a lattice, by their weights and by the claims of thin parts.
 *
 * A thin part claims the sites that its middle passes, even if another label has a larger weight there. Then each such
 * site goes back to the label of largest weight if that leaves the topology of both labels as it is: if the neighbours
 * of either label are a disk on the sphere around the site (its 14 neighbours in the lattice's tetrahedra, 36 edges and
 * 24 triangles). Offsets that are added to the weights of a label change the labels of sites under the same condition.
 * Where the label of a site has not the largest weight in the end, its weight is raised to that. */
class LabelTopology
{
public:
  using LabelType = FCCLabelWeights::LabelType;
  using LatticeType = FCCImage<LabelType>;

  /** \param labels of largest weight at each site
   * \param weights sorted */
  LabelTopology(LatticeType & labels, FCCLabelWeights & weights)
    : m_Labels(labels)
    , m_Weights(weights)
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

  /** Adds an offset to all weights of each label. */
  void
  AddOffsets(const std::map<LabelType, double> & offsets);

private:
  /** A site whose label has not the largest weight. */
  struct Doubt
  {
    SizeValueType site;
    LabelType strongest;
    float lacking;
  };

  float *
  FindWeight(SizeValueType site, LabelType label);

  /** Adds the offsets and returns the sites in doubt, ascending. */
  std::vector<Doubt>
  FindDoubts(const std::map<LabelType, double> & offsets);

  /** Gives the sites to their strongest labels where that keeps the topology; leaves the others in the list. */
  void
  Settle(std::vector<Doubt> & doubts);

  bool
  CanChange(const Doubt & doubt) const;

  LatticeType & m_Labels;
  FCCLabelWeights & m_Weights;
  std::vector<bool> m_IsHeld;
  std::vector<Doubt> m_Raised; ///< with what was added to the weights of their labels
};

} // namespace itk

#endif
