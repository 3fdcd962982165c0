#ifndef itkRecyclingMemory_h
#define itkRecyclingMemory_h

#include <map>
#include <memory_resource>
#include <mutex>
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
 * Thread safety: any number of threads may use it at once, but for its destruction, after all blocks are back.
 */
class RecyclingMemory : public std::pmr::memory_resource
{
public:
  RecyclingMemory() = default;
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
    for (const auto & [kind, block] : m_Spare)
    {
      m_System->deallocate(block, kind.first, kind.second);
    }
    m_Spare.clear();
  }

private:
  using Kind = std::pair<std::size_t, std::size_t>; ///< bytes and alignment

  void *
  do_allocate(std::size_t bytes, std::size_t alignment) override
  {
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      const auto found = m_Spare.find(Kind(bytes, alignment));
      if (found != m_Spare.end())
      {
        void * const block = found->second;
        m_Spare.erase(found);
        return block;
      }
    }
    return m_System->allocate(bytes, alignment);
  }

  void
  do_deallocate(void * block, std::size_t bytes, std::size_t alignment) override
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Spare.emplace(Kind(bytes, alignment), block);
  }

  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override
  {
    return this == &other;
  }

  std::pmr::memory_resource * m_System{ std::pmr::new_delete_resource() };
  std::mutex m_Mutex;
  std::multimap<Kind, void *> m_Spare;
};

} // namespace itk

#endif
