#ifndef rhombicQuantile_h
#define rhombicQuantile_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rhombic
{

/** The value below which a share of the values lie, linear between values.
 * \param sorted at least one value
 * \param share from 0 to 1 */
inline double
Quantile(const std::vector<double> & sorted, double share)
{
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

} // namespace rhombic

#endif
