#ifndef itkBulkResource_h
#define itkBulkResource_h

#include <cstddef>
#include <map>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace itk
{

/** \class BulkResource
 * \brief Memory for thousands of arrays of kilobytes, in a few blocks of rhombic::AllocateBulk(): in temporary files
 * where a surface's own arrays are. An array takes up to an eighth more than its bytes. For any thread. */
class BulkResource : public std::pmr::memory_resource
{
public:
  BulkResource() = default;
  ~BulkResource() override;
  BulkResource(const BulkResource &) = delete;
  BulkResource &
  operator=(const BulkResource &) = delete;

private:
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
  std::map<std::size_t, std::vector<void *>> m_Free; ///< arrays that were given back, by size
};

} // namespace itk

#endif
