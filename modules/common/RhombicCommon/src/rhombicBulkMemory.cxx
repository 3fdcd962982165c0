#include "rhombicBulkMemory.h"

#include "rhombicBulkResource.h"
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

constexpr std::size_t SmallestHuge = std::size_t{ 1 } << 22; // on huge pages

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
    pages->CloseFile();
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

} // namespace

void *
AllocateBulk(std::size_t bytes)
{
  if (void * const mapped = MappedBlocks::Get().Map(bytes))
  {
    return mapped;
  }
  if (bytes < SmallestHuge)
  {
    return NotNull(std::malloc(bytes));
  }
  // Aligned blocks leave holes that glibc before 2.38 does not fill with others of the same size: only the large blocks
  // of a mesh, which are few, are aligned.
  constexpr std::size_t smallestAligned = std::size_t{ 1 } << 24;
  constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
  void * const block =
    NotNull(bytes < smallestAligned ? std::malloc(bytes)
                                    : std::aligned_alloc(hugePage, (bytes + hugePage - 1) / hugePage * hugePage));
  itk::AdviseHugePages(block, bytes);
  return block;
}

void *
AllocateSparseBulk(std::size_t bytes, bool isZero)
{
  void * const mapped = bytes < SmallestBulk ? nullptr : MappedBlocks::Get().Map(bytes);
  const std::size_t atLeast = std::max<std::size_t>(bytes, 1);
  return mapped != nullptr ? mapped : NotNull(isZero ? std::calloc(atLeast, 1) : std::malloc(atLeast));
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

BulkResource::~BulkResource()
{
  std::for_each(m_Blocks.begin(), m_Blocks.end(), FreeBulk);
}

std::size_t
BulkResource::RoundUp(std::size_t bytes)
{
  std::size_t step = 64;
  while (16 * step <= bytes)
  {
    step *= 2;
  }
  return std::max((bytes + step - 1) / step, std::size_t{ 1 }) * step;
}

void *
BulkResource::do_allocate(std::size_t bytes, std::size_t)
{
  constexpr std::size_t smallestBlock = std::size_t{ 1 } << 21;
  constexpr std::size_t blocksOfSize = 8; // then they are twice as large: few files, and little that is left free
  constexpr std::size_t mostDoublings = 5;
  const std::size_t size = RoundUp(bytes);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (void *& free = m_Free[size])
  {
    return std::exchange(free, *static_cast<void **>(free));
  }
  if (size > m_Left)
  {
    const std::size_t doublings = std::min(m_Blocks.size() / blocksOfSize, mostDoublings);
    const std::size_t block = std::max(smallestBlock << doublings, size);
    m_Blocks.reserve(m_Blocks.size() + 1);
    m_Next = static_cast<std::byte *>(AllocateBulk(block));
    m_Blocks.push_back(m_Next);
    m_Left = block;
  }
  m_Left -= size;
  return std::exchange(m_Next, m_Next + size);
}

void
BulkResource::do_deallocate(void * array, std::size_t bytes, std::size_t)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  *static_cast<void **>(array) = std::exchange(m_Free[RoundUp(bytes)], array);
}

bool
BulkResource::do_is_equal(const std::pmr::memory_resource & other) const noexcept
{
  return this == &other;
}

std::shared_ptr<std::pmr::memory_resource>
ResourceForSmallArrays()
{
  using Resource = std::shared_ptr<std::pmr::memory_resource>;
  return MappedBlocks::Get().FindStore() ? std::make_shared<BulkResource>()
                                         : Resource(Resource(), std::pmr::new_delete_resource());
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
