#ifndef rhombicLabelPairs_h
#define rhombicLabelPairs_h

#include "rhombicCompareLabels.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** A label or surface of a segmentation. */
struct ComparedLabel
{
  std::string name;
  int value = 0;        ///< 0 for surfaces of files
  bool isNamed = false; ///< otherwise the name is made from the value
  Colour colour{ 0.8, 0.8, 0.8 };
};

/** How labels are paired: see CompareLabelsSettings. */
struct PairingRules
{
  std::vector<std::pair<std::string, std::string>> pairs;
  bool isByValue = false;
  bool areSingle = false; ///< two segmentations of one label each, whose names do not matter
  std::vector<std::string> only;
  std::vector<std::string> hidden;
};

/** A row of the comparison: numbers of labels in the two lists; nothing where a segmentation lacks the label. */
struct LabelPair
{
  std::string name;
  std::optional<std::size_t> first;
  std::optional<std::size_t> second;
  std::string whole = {};                ///< the label, of which the pair is a part; empty for whole labels
  std::optional<PartChange> change = {}; ///< for parts
};

/** The number of the label with this name, else with this value. */
std::optional<std::size_t>
FindLabel(const std::vector<ComparedLabel> & labels, const std::string & nameOrValue);

/** "(did you mean liver?)" with a blank before it, or nothing, for a label that is not in the list. */
std::string
SuggestLabel(const std::vector<ComparedLabel> & labels, const std::string & name);

/** The pairs in the order of the first list, then what the second list has alone. Throws Failure(Usage): see
 * CompareLabels(). */
std::vector<LabelPair>
PairLabels(const std::vector<ComparedLabel> & first,
           const std::vector<ComparedLabel> & second,
           const PairingRules & rules);

} // namespace rhombic

#endif
