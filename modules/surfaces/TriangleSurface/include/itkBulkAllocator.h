#ifndef itkBulkAllocator_h
#define itkBulkAllocator_h

#include "itkRecyclingMemory.h"

#include <cstdlib>
#include <new>
#include <utility>

namespace itk
{

/** \class BulkAllocator
 * \brief Allocator for arrays of millions of plain elements that several threads fill.
 *
 * Growing a container leaves new elements uninitialised, so that the thread that fills a page is the first to touch it.
 * Large blocks ask the system for huge pages: a mesh of 300 MB costs 150 page faults instead of 75,000. Throws
 * std::bad_alloc.
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
    if (bytes < SmallestHugeBlock)
    {
      return static_cast<T *>(::operator new(bytes));
    }
    void * const block = std::aligned_alloc(HugePage, (bytes + HugePage - 1) / HugePage * HugePage);
    if (block == nullptr)
    {
      throw std::bad_alloc();
    }
    AdviseHugePages(block, bytes);
    return static_cast<T *>(block);
  }

  void
  deallocate(T * block, std::size_t count) noexcept
  {
    if (count * sizeof(T) < SmallestHugeBlock)
    {
      ::operator delete(block);
    }
    else
    {
      std::free(block);
    }
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

private:
  static constexpr std::size_t HugePage = std::size_t{ 1 } << 21;
  static constexpr std::size_t SmallestHugeBlock = 2 * HugePage;
};

} // namespace itk

#endif
