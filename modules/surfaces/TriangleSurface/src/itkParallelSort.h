#ifndef itkParallelSort_h
#define itkParallelSort_h

#include "rhombicForEachBlock.h"

namespace itk
{

/** Sorts by operator< on several threads: sorts blocks, then merges them in pairs. Items that compare equal must be
 * indistinguishable. Takes the items' memory once more. */
template <typename TContainer>
void
ParallelSort(TContainer & items)
{
  constexpr std::size_t block = 1 << 16;
  const std::size_t size = items.size();
  const auto at = [size](TContainer & container, std::size_t index) {
    return container.begin() + static_cast<std::ptrdiff_t>(std::min(index, size));
  };
  rhombic::ForEachBlock(
    size, block, [&](std::size_t begin, std::size_t end) { std::sort(at(items, begin), at(items, end)); });
  TContainer merged(size > block ? size : 0);
  for (std::size_t sorted = block; sorted < size; sorted *= 2)
  {
    rhombic::ForEachBlock(size, 2 * sorted, [&](std::size_t begin, std::size_t end) {
      const auto middle = at(items, begin + sorted);
      std::merge(at(items, begin), middle, middle, at(items, end), at(merged, begin));
    });
    items.swap(merged);
  }
}

} // namespace itk

#endif
