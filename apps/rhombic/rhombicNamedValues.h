#ifndef rhombicNamedValues_h
#define rhombicNamedValues_h

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <string>
#include <utility>
#include <vector>

namespace rhombic
{

/** The words that an option takes, in the order in which they are listed, and what they mean. */
template <typename TValue>
using NamedValues = std::vector<std::pair<std::string, TValue>>;

/** What a word means. Throws Failure(Usage), with what is near and all of them; \a what is what they name. */
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
