#ifndef itkRecyclingMemory_h
#define itkRecyclingMemory_h

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory_resource>
#include <mutex>
#include <new>
#include <utility>

namespace itk
{

/** \class RecyclingMemory
 * \brief A memory resource for large, short-lived blocks of a few sizes, shared by many threads.
 *
 * A block that is given back is kept, and given to the next request of the same size on any thread, until
 * ReleaseSpare(). So there are never more blocks than were in use at once; malloc() would keep freed blocks for each
 * thread separately.
 *
 * Asking for a block throws std::bad_alloc when there is no memory. Giving one back needs no memory and never throws,
 * as destructors do it.
 *
 * Thread safety: any number of threads may use it at once. Destroy it after all blocks were given back.
 */
class RecyclingMemory : public std::pmr::memory_resource
{
public:
  /** \param system the source of all memory; must outlive this object */
  explicit RecyclingMemory(std::pmr::memory_resource * system = std::pmr::new_delete_resource())
    : m_System(system)
    , m_Spare(system)
  {}
  RecyclingMemory(const RecyclingMemory &) = delete;
  RecyclingMemory &
  operator=(const RecyclingMemory &) = delete;

  ~RecyclingMemory() override
  {
    this->ReleaseSpare();
  }

  /** Gives the blocks that are not in use back to the system. */
  void
  ReleaseSpare()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    for (auto & [kind, first] : m_Spare)
    {
      while (first != nullptr)
      {
        m_System->deallocate(std::exchange(first, first->next), kind.first, kind.second);
      }
    }
  }

private:
  using Kind = std::pair<std::size_t, std::size_t>; ///< bytes and alignment

  /** The contents of a spare block. */
  struct Spare
  {
    Spare * next;
  };

  /** Size and alignment of the block for a request: large enough for a Spare. */
  static Kind
  KindOf(std::size_t bytes, std::size_t alignment)
  {
    return { std::max(bytes, sizeof(Spare)), std::max(alignment, alignof(Spare)) };
  }

  void *
  do_allocate(std::size_t bytes, std::size_t alignment) override
  {
    const Kind kind = KindOf(bytes, alignment);
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      Spare *& first = m_Spare[kind];
      if (first != nullptr)
      {
        return std::exchange(first, first->next);
      }
    }
    return m_System->allocate(kind.first, kind.second);
  }

  void
  do_deallocate(void * block, std::size_t bytes, std::size_t alignment) override
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    Spare *& first = m_Spare.find(KindOf(bytes, alignment))->second; // the list was made when the block was allocated
    first = new (block) Spare{ first };
  }

  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override
  {
    return this == &other;
  }

  std::pmr::memory_resource * m_System;
  std::mutex m_Mutex;
  std::pmr::map<Kind, Spare *> m_Spare; ///< the first block of each linked list
};

/** Asks the operating system for large pages behind memory that is about to be written for the first time. With pages
 * of 4 KiB, page faults take up to a third of the time of resampling a volume. Does nothing on systems other than
 * Linux. Throws nothing. */
void
AdviseHugePages(void * memory, std::size_t bytes);

} // namespace itk

#endif
