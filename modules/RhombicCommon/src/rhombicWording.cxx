#include "rhombicWording.h"

#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <numeric>
#include <optional>

namespace rhombic
{
namespace
{

/** Insertions, deletions, replacements and exchanges of neighbours that turn one word into the other (Damerau and
 * Levenshtein, each letter changed once at most). */
std::size_t
EditDistance(const std::string & a, const std::string & b)
{
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  std::iota(rows[0].begin(), rows[0].end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    rows[i][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({ rows[i - 1][j] + 1, rows[i][j - 1] + 1, replaced });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
      }
    }
  }
  return rows.back().back();
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
