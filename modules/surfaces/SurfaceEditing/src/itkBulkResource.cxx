#include "itkBulkResource.h"

#include "rhombicBulkMemory.h"

#include <algorithm>

namespace itk
{
namespace
{

constexpr std::size_t SmallestBlock = std::size_t{ 1 } << 21;
constexpr unsigned int MostDoublings = 5;

/** The size of an array with what is left free behind it: 8 to 15 times a power of two, at least 64. */
std::size_t
RoundUp(std::size_t bytes)
{
  std::size_t step = 64;
  while (16 * step <= bytes)
  {
    step *= 2;
  }
  return std::max((bytes + step - 1) / step, std::size_t{ 1 }) * step;
}

} // namespace

BulkResource::~BulkResource()
{
  std::for_each(m_Blocks.begin(), m_Blocks.end(), rhombic::FreeBulk);
}

void *
BulkResource::do_allocate(std::size_t bytes, std::size_t)
{
  const std::size_t size = RoundUp(bytes);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (auto & free = m_Free[size]; !free.empty())
  {
    void * const array = free.back();
    free.pop_back();
    return array;
  }
  if (size > m_Left)
  {
    const auto doublings = std::min<std::size_t>(m_Blocks.size(), MostDoublings);
    const std::size_t block = std::max(SmallestBlock << doublings, size);
    m_Blocks.reserve(m_Blocks.size() + 1);
    m_Next = static_cast<std::byte *>(rhombic::AllocateBulk(block));
    m_Blocks.push_back(m_Next);
    m_Left = block;
  }
  void * const array = m_Next;
  m_Next += size;
  m_Left -= size;
  return array;
}

void
BulkResource::do_deallocate(void * array, std::size_t bytes, std::size_t)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Free[RoundUp(bytes)].push_back(array);
}

bool
BulkResource::do_is_equal(const std::pmr::memory_resource & other) const noexcept
{
  return this == &other;
}

} // namespace itk
