#include "rhombicBulkMemory.h"

#include "rhombicSparseBulk.h"

#include "itkRecyclingMemory.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

/** All blocks in temporary files. */
struct MappedBlocks
{
  std::mutex mutex;
  std::list<TemporaryStore> stores; ///< of each BulkInTemporaryFiles; the last is used
  std::map<const void *, std::unique_ptr<MappedPages>> blocks;

  static MappedBlocks &
  Get()
  {
    static auto * const mapped = new MappedBlocks; // arrays may be freed at the end of the program
    return *mapped;
  }

  std::optional<TemporaryStore>
  FindStore()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return stores.empty() ? std::nullopt : std::optional(stores.back());
  }

  /** A new block in a temporary file; null where there is no BulkInTemporaryFiles. */
  void *
  Map(std::size_t bytes)
  {
    const auto store = this->FindStore();
    if (!store)
    {
      return nullptr;
    }
    auto pages = MapTemporaryFile(*store, bytes);
    void * const block = pages->GetAddress();
    const std::lock_guard<std::mutex> lock(mutex);
    blocks.emplace(block, std::move(pages));
    return block;
  }
};

void *
NotNull(void * block)
{
  return block != nullptr ? block : throw std::bad_alloc();
}

/** \class SmallArrays
 * \brief Small arrays in blocks of AllocateBulk(). Freed arrays are used again for others of nearly their size. */
class SmallArrays : public std::pmr::memory_resource
{
public:
  SmallArrays() = default;
  ~SmallArrays() override
  {
    std::for_each(m_Blocks.begin(), m_Blocks.end(), FreeBulk);
  }
  SmallArrays(const SmallArrays &) = delete;
  SmallArrays &
  operator=(const SmallArrays &) = delete;

private:
  static constexpr std::size_t Largest = std::size_t{ 1 } << 20;
  static constexpr std::size_t BlockSize = 4 * Largest;
  static constexpr std::size_t Smallest = 64;

  /** The size of the place for an array: a power of 2, or 5, 6 or 7 eighths of it. */
  static std::size_t
  RoundUp(std::size_t bytes)
  {
    std::size_t power = Smallest;
    while (power < bytes)
    {
      power *= 2;
    }
    const std::size_t step = std::max(power / 8, Smallest / 4);
    return std::max((bytes + step - 1) / step * step, Smallest);
  }

  void *
  do_allocate(std::size_t bytes, std::size_t) override
  {
    if (bytes > Largest)
    {
      return AllocateBulk(bytes);
    }
    const std::size_t size = RoundUp(bytes);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (void *& freed = m_Freed[size])
    {
      return std::exchange(freed, *static_cast<void **>(freed));
    }
    if (m_Blocks.empty() || m_Used + size > BlockSize)
    {
      m_Blocks.push_back(AllocateBulk(BlockSize));
      m_Used = 0;
    }
    m_Used += size;
    return static_cast<std::byte *>(m_Blocks.back()) + (m_Used - size);
  }

  void
  do_deallocate(void * place, std::size_t bytes, std::size_t) override
  {
    if (bytes > Largest)
    {
      return FreeBulk(place);
    }
    const std::lock_guard<std::mutex> lock(m_Mutex);
    *static_cast<void **>(place) = std::exchange(m_Freed[RoundUp(bytes)], place);
  }

  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override
  {
    return this == &other;
  }

  std::mutex m_Mutex;
  std::vector<void *> m_Blocks;
  std::size_t m_Used = 0;                ///< of the last block
  std::map<std::size_t, void *> m_Freed; ///< by size: the place that was freed last, which holds the one before it
};

} // namespace

void *
AllocateBulk(std::size_t bytes)
{
  if (void * const mapped = MappedBlocks::Get().Map(bytes))
  {
    return mapped;
  }
  constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
  void * const block = NotNull(std::aligned_alloc(hugePage, (bytes + hugePage - 1) / hugePage * hugePage));
  itk::AdviseHugePages(block, bytes);
  return block;
}

void *
AllocateSparseBulk(std::size_t bytes, bool isZero)
{
  constexpr std::size_t smallest = std::size_t{ 1 } << 22;
  void * const mapped = bytes < smallest ? nullptr : MappedBlocks::Get().Map(bytes);
  const std::size_t atLeast = std::max<std::size_t>(bytes, 1);
  return mapped != nullptr ? mapped : NotNull(isZero ? std::calloc(atLeast, 1) : std::malloc(atLeast));
}

std::shared_ptr<std::pmr::memory_resource>
ResourceForSmallArrays()
{
  using Resource = std::shared_ptr<std::pmr::memory_resource>;
  return MappedBlocks::Get().FindStore() ? std::make_shared<SmallArrays>()
                                         : Resource(Resource(), std::pmr::new_delete_resource());
}

void
FreeBulk(void * block) noexcept
{
  MappedBlocks & mapped = MappedBlocks::Get();
  std::unique_lock<std::mutex> lock(mapped.mutex);
  const auto node = mapped.blocks.extract(block);
  lock.unlock();
  node.empty() ? std::free(block) : void(); // pages go away with their node
}

BulkInTemporaryFiles::BulkInTemporaryFiles(const TemporaryStore & store)
{
  MappedBlocks & mapped = MappedBlocks::Get();
  const std::lock_guard<std::mutex> lock(mapped.mutex);
  m_Store = mapped.stores.insert(mapped.stores.end(), store);
}

BulkInTemporaryFiles::~BulkInTemporaryFiles()
{
  MappedBlocks & mapped = MappedBlocks::Get();
  const std::lock_guard<std::mutex> lock(mapped.mutex);
  mapped.stores.erase(m_Store);
}

} // namespace rhombic
