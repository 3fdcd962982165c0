#ifndef itkBulkAllocator_h
#define itkBulkAllocator_h

#include "rhombicBulkMemory.h"

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace itk
{

/** \class BulkAllocator
 * \brief Allocator for arrays of millions of plain elements that several threads fill.
 *
 * Growing a container leaves new elements uninitialised, so that the thread that fills a page is the first to touch it.
 * Large blocks are those of rhombic::AllocateBulk(). Throws as that.
 *
 * \ingroup TriangleSurface
 */
template <typename T>
class BulkAllocator
{
public:
  using value_type = T;

  BulkAllocator() noexcept = default;

  template <typename U>
  BulkAllocator(const BulkAllocator<U> &) noexcept
  {}

  T *
  allocate(std::size_t count)
  {
    if (count > static_cast<std::size_t>(-1) / (2 * sizeof(T)))
    {
      throw std::bad_array_new_length();
    }
    const std::size_t bytes = count * sizeof(T);
    return static_cast<T *>(bytes < rhombic::SmallestBulk ? ::operator new(bytes) : rhombic::AllocateBulk(bytes));
  }

  void
  deallocate(T * block, std::size_t count) noexcept
  {
    count * sizeof(T) < rhombic::SmallestBulk ? ::operator delete(block) : rhombic::FreeBulk(block);
  }

  template <typename U, typename... TArguments>
  void
  construct(U * element, TArguments &&... arguments)
  {
    if constexpr (sizeof...(TArguments) == 0)
    {
      ::new (static_cast<void *>(element)) U;
    }
    else
    {
      ::new (static_cast<void *>(element)) U(std::forward<TArguments>(arguments)...);
    }
  }

  friend bool
  operator==(const BulkAllocator &, const BulkAllocator &) noexcept
  {
    return true;
  }
  friend bool
  operator!=(const BulkAllocator &, const BulkAllocator &) noexcept
  {
    return false;
  }
};

template <typename T>
using BulkVector = std::vector<T, BulkAllocator<T>>;

} // namespace itk

#endif
