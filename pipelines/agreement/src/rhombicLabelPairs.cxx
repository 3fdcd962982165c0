#include "rhombicLabelPairs.h"

#include "rhombicFailure.h"
#include "rhombicSceneRules.h"
#include "rhombicWording.h"

#include <algorithm>
#include <iterator>

namespace rhombic
{
namespace
{

using Labels = std::vector<ComparedLabel>;

bool
HasNames(const Labels & labels)
{
  return std::any_of(labels.begin(), labels.end(), [](const ComparedLabel & label) { return label.isNamed; });
}

std::vector<std::string>
NamesOf(const Labels & labels)
{
  std::vector<std::string> names;
  std::transform(
    labels.begin(), labels.end(), std::back_inserter(names), [](const auto & label) { return label.name; });
  return names;
}

/** The first names of a list, for a message. */
std::string
NameSome(const Labels & labels)
{
  constexpr std::size_t most = 4;
  std::vector<std::string> names = NamesOf(labels);
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  if (more > 0)
  {
    names.push_back(std::to_string(more) + " more");
  }
  return Enumerate(names, "and");
}

/** The pairs that a user names. */
std::vector<LabelPair>
TakeNamedPairs(const Labels & first, const Labels & second, const PairingRules & rules)
{
  std::vector<LabelPair> pairs;
  for (const auto & [inFirst, inSecond] : rules.pairs)
  {
    const LabelPair pair{ inFirst, FindLabel(first, inFirst), FindLabel(second, inSecond) };
    if (!pair.first && !pair.second)
    {
      throw Failure(FailureKind::Usage,
                    "A has no label " + inFirst + " and B has no label " + inSecond + SuggestLabel(first, inFirst) +
                      "; A has " + NameSome(first) + ", B has " + NameSome(second) + ".");
    }
    pairs.push_back(pair);
    pairs.back().name = pair.first ? first[*pair.first].name : inFirst;
  }
  return pairs;
}

/** Throws Failure(Usage) for a label that a user puts into two pairs. */
void
RequireSinglePairs(const std::vector<LabelPair> & pairs, std::optional<std::size_t> LabelPair::*side)
{
  for (auto pair = pairs.begin(); pair != pairs.end(); ++pair)
  {
    const auto isSame = [&](const LabelPair & other) { return other.*side == (*pair).*side; };
    if ((*pair).*side && std::any_of(pair + 1, pairs.end(), isSame))
    {
      throw Failure(FailureKind::Usage,
                    "The label " + pair->name + " is in two pairs; name each label of A and of B once.");
    }
  }
}

/** Throws Failure(Usage) for names that two labels of a segmentation have. */
void
RequireSingleNames(const Labels & labels, const std::string & side)
{
  std::vector<std::string> names = NamesOf(labels);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end())
  {
    throw Failure(FailureKind::Usage,
                  "Two labels of " + side + " are called " + *twice +
                    ", so labels cannot be paired by name; pair them by value with --by-value, or give them names of "
                    "their own.");
  }
}

/** Throws Failure(Usage) for maps of which only one has names. */
void
RequireOneKindOfNames(const Labels & first, const Labels & second, const PairingRules & rules)
{
  if (rules.isByValue || rules.areSingle || !rules.pairs.empty() || first.empty() || second.empty() ||
      HasNames(first) == HasNames(second))
  {
    return;
  }
  throw Failure(FailureKind::Usage,
                std::string("Only the labels of ") + (HasNames(first) ? "A" : "B") + " have names (" +
                  NameSome(HasNames(first) ? first : second) +
                  "), so they cannot be paired by name; pair them by value with --by-value, or name the pairs, as "
                  "--pair liver=5, or a table of names (--label-table, --label-table-b).");
}

bool
IsShown(const std::string & name, const PairingRules & rules)
{
  const auto fits = [&name](const std::string & pattern) { return FitsPattern(pattern, name); };
  return (rules.only.empty() || std::any_of(rules.only.begin(), rules.only.end(), fits)) &&
         std::none_of(rules.hidden.begin(), rules.hidden.end(), fits);
}

/** Throws Failure(Usage) for a pattern that fits no pair. */
void
RequirePatterns(const std::vector<LabelPair> & pairs, const PairingRules & rules)
{
  std::vector<std::string> patterns = rules.only;
  patterns.insert(patterns.end(), rules.hidden.begin(), rules.hidden.end());
  std::vector<std::string> names;
  std::transform(pairs.begin(), pairs.end(), std::back_inserter(names), [](const auto & pair) { return pair.name; });
  for (const std::string & pattern : patterns)
  {
    if (std::none_of(names.begin(), names.end(), [&](const auto & name) { return FitsPattern(pattern, name); }))
    {
      throw Failure(FailureKind::Usage, DescribeUnknown("label", pattern, names, "use " + Enumerate(names)));
    }
  }
}

} // namespace

std::optional<std::size_t>
FindLabel(const Labels & labels, const std::string & nameOrValue)
{
  const auto value = ToNumber<int>(nameOrValue);
  const auto find = [&labels](const auto & fits) {
    const auto found = std::find_if(labels.begin(), labels.end(), fits);
    return found != labels.end() ? std::optional(static_cast<std::size_t>(found - labels.begin())) : std::nullopt;
  };
  const auto named = find([&](const ComparedLabel & label) { return label.name == nameOrValue; });
  return named || !value || *value == 0 ? named
                                        : find([&](const ComparedLabel & label) { return label.value == *value; });
}

std::string
SuggestLabel(const Labels & labels, const std::string & name)
{
  const std::string nearest = NearestName(name, NamesOf(labels));
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

std::vector<LabelPair>
PairLabels(const Labels & first, const Labels & second, const PairingRules & rules)
{
  RequireOneKindOfNames(first, second, rules);
  std::vector<LabelPair> pairs = TakeNamedPairs(first, second, rules);
  RequireSinglePairs(pairs, &LabelPair::first);
  RequireSinglePairs(pairs, &LabelPair::second);
  std::vector<char> isTaken(second.size());
  std::vector<char> isPaired(first.size());
  for (const LabelPair & pair : pairs)
  {
    if (pair.first)
    {
      isPaired[*pair.first] = 1;
    }
    if (pair.second)
    {
      isTaken[*pair.second] = 1;
    }
  }
  const bool isByValue = rules.isByValue || (!HasNames(first) && !HasNames(second));
  if (!isByValue && !rules.areSingle)
  {
    RequireSingleNames(first, "A");
    RequireSingleNames(second, "B");
  }
  for (std::size_t n = 0; n < first.size(); ++n)
  {
    if (isPaired[n] != 0)
    {
      continue;
    }
    LabelPair & pair = pairs.emplace_back(LabelPair{ first[n].name, n, std::nullopt });
    if (rules.areSingle && !second.empty() && first[n].name != second.front().name)
    {
      pair.name = "mask"; // names of files, of which neither is that of both
    }
    for (std::size_t other = 0; other < second.size() && !pair.second; ++other)
    {
      const bool isSame =
        rules.areSingle || (isByValue ? first[n].value == second[other].value : first[n].name == second[other].name);
      if (isTaken[other] == 0 && isSame)
      {
        pair.second = other;
        isTaken[other] = 1;
      }
    }
  }
  for (std::size_t other = 0; other < second.size(); ++other)
  {
    if (isTaken[other] == 0)
    {
      pairs.push_back({ second[other].name, std::nullopt, other });
    }
  }
  const bool haveCommon = std::any_of(pairs.begin(), pairs.end(), [](const auto & p) { return p.first && p.second; });
  if (!haveCommon && !first.empty() && !second.empty())
  {
    throw Failure(FailureKind::Usage,
                  "A and B have no label in common: A has " + NameSome(first) + ", B has " + NameSome(second) +
                    "; name the pairs, as --pair " + first.front().name + "=" + second.front().name +
                    ", or pair them --by-value.");
  }
  if (pairs.empty()) // both hold background only
  {
    return pairs;
  }
  RequirePatterns(pairs, rules);
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [&](const auto & pair) { return !IsShown(pair.name, rules); }),
              pairs.end());
  if (pairs.empty())
  {
    throw Failure(FailureKind::Usage, "No label is left to compare; hide fewer, or choose others with --only.");
  }
  return pairs;
}

} // namespace rhombic
