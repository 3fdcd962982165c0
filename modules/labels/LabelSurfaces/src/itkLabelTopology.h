#ifndef itkLabelTopology_h
#define itkLabelTopology_h

#include "itkBulkAllocator.h"
#include "itkFCCCells.h"
#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"

#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace itk
{

/** \class LabelTopology
 * \brief Assigns labels to the sites of a lattice, by their weights and so that thin parts stay whole.
 *
 * First the candidates of thin parts get their sites, which the middle of a part passes, even if another label has a
 * larger weight there. Then each such site goes back to the label of largest weight if that leaves the topology of both
 * labels as it is: if the neighbours of either label are a disk in the site's link (see FCCCells). Locked candidates
 * keep their sites. Offsets that are added to the weights of a label change the labels of sites under the same
 * condition.
 *
 * Labels of one group are kept apart, so that they can be merged later: no edge of the lattice's tetrahedra joins two
 * labels of a group. Where an edge does, the site whose label has the least advantage in weight gets the label of a
 * neighbour or the background 0, if its neighbours of its own label are a disk, or it has no such neighbour. Any labels
 * are kept apart in the same way where an edge that joins them passes voxels of the background, unless the site is
 * locked or has no neighbour of its own label. Labels that have no site then get the site where their weight is
 * largest, if the label of that site can spare it.
 *
 * Where another label has a larger weight than the label of a site in the end, the weight of the site's label is raised
 * above it. */
class LabelTopology
{
public:
  using LabelType = FCCLabelWeights::LabelType;
  using LatticeType = FCCImage<LabelType>;

  /** \param labels of largest weight at each site
   * \param weights sorted
   * \param groups of each label; 0, or past the end: no group
   * \param isBackground whether a point in the world is in a voxel of the background */
  LabelTopology(LatticeType & labels,
                FCCLabelWeights & weights,
                const std::vector<LabelType> & groups,
                std::function<bool(const Point<double, 3> &)> isBackground)
    : m_Labels(labels)
    , m_Weights(weights)
    , m_Groups(groups)
    , m_IsBackground(std::move(isBackground))
    , m_IsLocked(labels.GetLargestPossibleRegion().GetNumberOfPixels(), false)
  {}

  /** A site that a thin part of a label passes. */
  struct Candidate
  {
    SizeValueType site; ///< offset in the buffer
    LabelType label;
    bool isLocked; ///< whether the site must not go to another label
  };
  using Candidates = BulkVector<Candidate>;

  /** Gives sites to the labels that are candidates for them; of several, to the label of largest weight, and to 0 last.
   * Then changes labels as the class comment says. */
  void
  Assign(Candidates candidates);

  /** Adds an offset to all weights of each label.
   * \param offsets by label; 0 for labels past the end
   * \param boxes of sites that hold all weights of a label, by label; empty if not known. Rows without a label that has
   * an offset take no time then */
  void
  AddOffsets(const std::vector<double> & offsets, const std::vector<ImageRegion<3>> & boxes = {});

private:
  /** The labels of a site's neighbours (see FCCCells), by direction; 0 beyond the lattice. */
  using NeighborsType = std::array<LabelType, FCCCells::Directions>;

  /** A label that a site may get, and by how much its weight exceeds the weight of the site's label. */
  struct Change
  {
    SizeValueType site;
    LabelType label;
    float gain;
  };
  using Changes = BulkVector<Change>;

  LabelType &
  LabelOf(SizeValueType site)
  {
    return m_Labels.GetBufferPointer()[site];
  }

  /** The stored weight of a label at a site, or null. */
  float *
  FindWeight(SizeValueType site, LabelType label);

  /** The weight of a label at a site; -FCCLabelWeights::Limit if none is stored. */
  float
  GetWeight(SizeValueType site, LabelType label);

  NeighborsType
  FindNeighbors(SizeValueType site) const;

  /** Whether another label among the neighbours is of a label's group. */
  bool
  MeetsGroup(LabelType label, const NeighborsType & neighbors) const;

  /** Whether the edge from a site to its neighbour in a direction passes voxels of the background. */
  bool
  PassesBackground(SizeValueType site, unsigned int direction) const;

  /** Whether an edge that passes voxels of the background would join a label at a site and another label. */
  bool
  MeetsAcrossBackground(SizeValueType site, LabelType label, const NeighborsType & neighbors) const;

  /** Whether a label at a site is apart from the labels that it must not meet. */
  bool
  IsApart(SizeValueType site, LabelType label, const NeighborsType & neighbors) const
  {
    return !this->MeetsGroup(label, neighbors) && !(m_KeepsGaps && this->MeetsAcrossBackground(site, label, neighbors));
  }

  /** Gives a site to a label, and stores weights for the label before and after. SortWeights() must follow. */
  void
  Give(SizeValueType site, LabelType label);

  /** Sorts the rows to which weights were added. */
  void
  SortWeights();

  /** The changes that visit(entries of a row, offset of its first site, changes) adds for each row, row by row. */
  template <typename TVisit>
  Changes
  CollectChanges(const TVisit & visit);

  /** The labels and their weights for which test(site, label) is true, in the order of the sites. */
  template <typename TTest>
  Changes
  FindWeights(const TTest & test);

  /** For each row of the lattice, 1 where weights get an offset or were raised. */
  BulkVector<std::uint8_t>
  FindRowsToChange(const std::vector<double> & offsets, const std::vector<ImageRegion<3>> & boxes) const;

  /** Adds offsets to the weights of some rows, and finds the changes after which each site of the rows has the label of
   * largest weight. */
  Changes
  FindChanges(const std::vector<double> & offsets, const BulkVector<std::uint8_t> & areRowsToChange);

  /** Whether a change keeps the topology of both labels, and labels apart that must not meet. */
  bool
  IsAllowed(const Change & change) const;

  /** Makes the changes that are allowed, and removes them from the list. */
  void
  MakeChanges(Changes & changes);

  /** The label that a site is to get when its own label meets another label of its group: the label of a neighbour with
   * the largest weight, or 0. */
  Change
  FindReplacement(SizeValueType site);

  /** Changes the labels of sites for which meets(site) is true.
   * \param canBeAlone whether sites without a neighbour of their own label may change, too */
  template <typename TMeets>
  void
  Separate(const TMeets & meets, bool canBeAlone);

  /** Separates the labels of groups, then all labels where background lies between them. */
  void
  SeparateLabels();

  /** Gives a site to each label that has weights but no site. */
  void
  PlaceLostLabels();

  /** Undoes the raising of weights. */
  void
  LowerRaised();

  LatticeType & m_Labels;
  FCCLabelWeights & m_Weights;
  const std::vector<LabelType> & m_Groups;
  std::function<bool(const Point<double, 3> &)> m_IsBackground;
  bool m_KeepsGaps{ false }; ///< whether labels must not meet across background
  BulkVector<bool> m_IsLocked;
  Changes m_Raised; ///< sites whose label's weight was raised, and by how much
  std::set<SizeValueType> m_UnsortedRows;
};

} // namespace itk

#endif
