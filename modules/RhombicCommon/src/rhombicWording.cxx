#include "rhombicWording.h"

#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <numeric>
#include <optional>

namespace rhombic
{
namespace
{

/** Insertions, deletions and replacements that turn one word into the other (Levenshtein). */
std::size_t
EditDistance(const std::string & a, const std::string & b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row.back();
}

/** How far two words in lower case are apart, if they are near each other. */
std::optional<std::size_t>
NearDistance(const std::string & a, const std::string & b)
{
  constexpr std::size_t shortestPart = 3;
  const std::string & shorter = a.size() < b.size() ? a : b;
  const std::string & longer = a.size() < b.size() ? b : a;
  const std::size_t distance = EditDistance(a, b);
  const bool isPart = shorter.size() >= shortestPart && longer.find(shorter) != std::string::npos;
  return isPart || 3 * distance <= longer.size() ? std::optional(distance) : std::nullopt;
}

} // namespace

std::string
Count(std::uintmax_t number, const std::string & noun, const std::string & plural)
{
  return std::to_string(number) + ' ' + (number == 1 ? noun : plural.empty() ? noun + 's' : plural);
}

std::string
Enumerate(const std::vector<std::string> & words, const std::string & conjunction)
{
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n)
  {
    text += (n == 0 ? "" : n + 1 < words.size() ? ", " : " " + conjunction + " ") + words[n];
  }
  return text;
}

std::string
NearestName(const std::string & word, const std::vector<std::string> & names)
{
  const std::string lowerCase = itksys::SystemTools::LowerCase(word);
  std::string nearest;
  std::optional<std::size_t> smallest;
  for (const std::string & name : names)
  {
    const auto distance = NearDistance(lowerCase, itksys::SystemTools::LowerCase(name));
    if (distance && (!smallest || *distance < *smallest))
    {
      smallest = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string
DescribeUnknown(const std::string & what,
                const std::string & word,
                const std::vector<std::string> & names,
                const std::string & advice)
{
  const std::string nearest = NearestName(word, names);
  return "There is no " + what + " '" + word + "'; " +
         (nearest.empty() ? advice : "did you mean " + nearest + "? Otherwise " + advice) + ".";
}

} // namespace rhombic
