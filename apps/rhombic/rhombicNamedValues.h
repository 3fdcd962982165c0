#ifndef rhombicNamedValues_h
#define rhombicNamedValues_h

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** The words that an option takes, in the order in which messages list them, and their values. */
template <typename TValue>
using NamedValues = std::vector<std::pair<std::string, TValue>>;

/** The value of a word. Throws Failure(Usage) for other words, with the nearest word and all of them.
 * \param what a noun for the value, as "mode" */
template <typename TValue>
TValue
FindNamed(const std::string & what, const std::string & word, const NamedValues<TValue> & values)
{
  std::vector<std::string> names;
  for (const auto & [name, value] : values)
  {
    if (name == word)
    {
      return value;
    }
    names.push_back(name);
  }
  throw Failure(FailureKind::Usage, DescribeUnknown(what, word, names, "use " + Enumerate(names)));
}

} // namespace rhombic

#endif
