#ifndef rhombicBulkResource_h
#define rhombicBulkResource_h

#include <cstddef>
#include <map>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace rhombic
{

/** \class BulkResource
 * \brief Memory for thousands of arrays of kilobytes, in a few blocks of AllocateBulk(): in temporary files where a
 * surface's own arrays are. An array takes up to an eighth more than its bytes, and is aligned as by malloc(). For any
 * thread. */
class BulkResource : public std::pmr::memory_resource
{
public:
  BulkResource() = default;
  ~BulkResource() override;
  BulkResource(const BulkResource &) = delete;
  BulkResource &
  operator=(const BulkResource &) = delete;

private:
  /** The size of an array with what is left free behind it: 8 to 15 times a power of two, at least 64. */
  static std::size_t
  RoundUp(std::size_t bytes);

  void *
  do_allocate(std::size_t bytes, std::size_t alignment) override;
  void
  do_deallocate(void * array, std::size_t bytes, std::size_t alignment) override;
  bool
  do_is_equal(const std::pmr::memory_resource & other) const noexcept override;

  std::mutex m_Mutex;
  std::vector<void *> m_Blocks;
  std::byte * m_Next = nullptr; ///< what is left of the last block
  std::size_t m_Left = 0;
  std::map<std::size_t, void *> m_Free; ///< by size: the array that was given back last, which holds the one before it
};

/** A BulkResource where there is a BulkInTemporaryFiles, else operator new, which leaves no arrays behind that grow. */
std::shared_ptr<std::pmr::memory_resource>
ResourceForSmallArrays();

} // namespace rhombic

#endif
