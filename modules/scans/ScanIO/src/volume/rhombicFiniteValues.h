#ifndef rhombicFiniteValues_h
#define rhombicFiniteValues_h

#include "rhombicScan.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>

namespace rhombic
{

/** The lowest finite value; infinity when there is none. */
template <typename TValue>
TValue
LowestFinite(const TValue * begin, const TValue * end)
{
  TValue lowest = std::numeric_limits<TValue>::infinity();
  std::for_each(
    begin, end, [&lowest](TValue value) { lowest = std::isfinite(value) ? std::min(lowest, value) : lowest; });
  return lowest;
}

/** Replaces values that are not finite, which would spread when the scan is resampled, by the lowest finite value,
 * which \a findLowest gives. Returns their number. Throws Failure when there is no finite value. */
template <typename TValue, typename TFind>
std::size_t
ReplaceNotFinite(TValue * begin, TValue * end, const std::filesystem::path & path, const TFind & findLowest)
{
  const auto isOther = [](TValue value) { return !std::isfinite(value); };
  const auto count = static_cast<std::size_t>(std::count_if(begin, end, isOther));
  if (count > 0)
  {
    const TValue lowest = findLowest();
    RefuseVolumeIf(
      !std::isfinite(lowest), path, "none of its values is a finite number; export it again from its source");
    std::replace_if(begin, end, isOther, lowest);
  }
  return count;
}

/** ReplaceNotFinite() in a scan of floats, which notes it. */
inline void
ReplaceNotFinite(const std::filesystem::path & path, Scan & scan)
{
  const auto * const pointer = std::get_if<itk::Image<float, 3>::Pointer>(&scan.image);
  if (pointer == nullptr)
  {
    return;
  }
  float * const begin = (*pointer)->GetBufferPointer();
  float * const end = begin + (*pointer)->GetBufferedRegion().GetNumberOfPixels();
  if (const std::size_t count = ReplaceNotFinite(begin, end, path, [=] { return LowestFinite(begin, end); }))
  {
    scan.notes.push_back(path.string() + " holds " +
                         Count(count, "value that is no finite number", "values that are not finite numbers") +
                         "; the lowest value took their place.");
  }
}

} // namespace rhombic

#endif
