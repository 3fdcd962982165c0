#include "rhombicBulkMemory.h"

#include "itkRecyclingMemory.h"

#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#include <optional>

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
};

} // namespace

void *
AllocateBulk(std::size_t bytes)
{
  MappedBlocks & mapped = MappedBlocks::Get();
  if (const auto store = mapped.FindStore())
  {
    auto pages = MapTemporaryFile(*store, bytes);
    void * const block = pages->GetAddress();
    const std::lock_guard<std::mutex> lock(mapped.mutex);
    mapped.blocks.emplace(block, std::move(pages));
    return block;
  }
  constexpr std::size_t hugePage = std::size_t{ 1 } << 21;
  void * const block = std::aligned_alloc(hugePage, (bytes + hugePage - 1) / hugePage * hugePage);
  if (block == nullptr)
  {
    throw std::bad_alloc();
  }
  itk::AdviseHugePages(block, bytes);
  return block;
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
