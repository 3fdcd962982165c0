#ifndef rhombicIsolatedDecoder_h
#define rhombicIsolatedDecoder_h

#include "rhombicVoxelDecoder.h"

#include <cstdint>

namespace rhombic
{

/** \class IsolatedDecoder
 * \brief Decodes files in child processes: a file that crashes its decoder, hangs it or makes it take all memory
 * becomes a Failure that names the file.
 *
 * The constructor forks a small server, which forks workers when they are needed, one for each file that is decoded at
 * the same time. Construct it before the process starts threads, best at the beginning of main(): a worker is a copy of
 * that early process, which takes a millisecond instead of the start of a program. Workers have no terminal, can't make
 * files, and are limited in memory, processor time and open files; bytes come back through shared memory. All child
 * processes end with this object, or with the process.
 *
 * Thread safety: any number of threads may call Decode() at once. */
class IsolatedDecoder : public VoxelDecoder
{
public:
  /** Limits of a worker for one request. */
  struct Limits
  {
    std::uintmax_t memory = 512u << 20; ///< bytes besides five times the size of the request
    unsigned int seconds = 5;           ///< processor time; one more second for each 4 MiB of the request
    unsigned int patience = 4;          ///< limit of wall clock time, as a multiple of the limit of processor time
  };

  /** \param workers the largest number of workers; 0: one for each processor. Throws Failure(Internal) when the system
   * allows no more processes. */
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
