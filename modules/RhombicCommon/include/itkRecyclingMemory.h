#ifndef itkRecyclingMemory_h
#define itkRecyclingMemory_h

#include <algorithm>
#include <map>
#include <memory_resource>
#include <mutex>
#include <new>
#include <utility>

namespace itk
{

/** \class RecyclingMemory
 * \brief Memory for large blocks that tasks on many threads need for a moment, of the same few sizes again and again.
 *
 * A block that is given back goes to the next who asks for one of its size, on whatever thread, until the spare ones
 * are released. So there are never more blocks than were in use at once. malloc() would keep them for the thread that
 * gave them back: with many threads, as many times.
 *
 * Asking for a block throws std::bad_alloc when there is no memory; giving one back needs none and never throws, as
 * destructors do it.
 *
 * Thread safety: any number of threads may use it at once, but for its destruction, after all blocks are back.
 */
class RecyclingMemory : public std::pmr::memory_resource
{
public:
  /** \param system where all memory comes from and goes to; must outlive this */
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

  /** Gives the blocks that are not in use to the system. */
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

  /** What a block holds while it is spare. */
  struct Spare
  {
    Spare * next;
  };

  /** Of the blocks for a request: each can be a Spare. */
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
    Spare *& first = m_Spare.find(KindOf(bytes, alignment))->second; // it is there since the block was asked for
    first = new (block) Spare{ first };
  }

  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override
  {
    return this == &other;
  }

  std::pmr::memory_resource * m_System;
  std::mutex m_Mutex;
  std::pmr::map<Kind, Spare *> m_Spare; ///< the first of each list; linked through the blocks themselves
};

} // namespace itk

#endif
