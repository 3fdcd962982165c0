#ifndef rhombicIsolatedDecoder_h
#define rhombicIsolatedDecoder_h

#include "rhombicVoxelDecoder.h"

#include <cstdint>

namespace rhombic
{

/** \class IsolatedDecoder
 * \brief Unpacks voxels in processes of their own: a file that crashes its decoder, hangs it or makes it take all
 * memory becomes a Failure that names the file.
 *
 * The constructor forks a small server, which in turn forks workers when they are needed, several for decoding several
 * files at once. So it must be made before the process starts threads, at best first thing in main(): a worker is a
 * copy of what the process was then, and costs a millisecond instead of the start of a program. Workers have no
 * terminal, can make no files, and are limited in memory, processor time and open files; voxels come back through
 * shared memory. All of them end with this object, or with the process.
 *
 * Thread safety: any number of threads may call Decode() at once. */
class IsolatedDecoder : public VoxelDecoder
{
public:
  /** What a worker may use for one request. */
  struct Limits
  {
    std::uintmax_t memory = 512u << 20; ///< bytes besides the voxels, and four times these
    unsigned int seconds = 5;           ///< of processor time, and one more for each 4 MiB of voxels
    unsigned int patience = 4;          ///< times as long may pass on the clock
  };

  /** \param workers at once; 0: one for each processor. Throws Failure(Internal) when there can be no more processes.
   */
  explicit IsolatedDecoder(unsigned int workers = 0);
  IsolatedDecoder(unsigned int workers, const Limits & limits);

  ~IsolatedDecoder() override;

  unsigned int
  GetNumberOfWorkers() const override;

  std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request) override;

private:
  class Pool;
  std::unique_ptr<Pool> m_Pool;
};

} // namespace rhombic

#endif
