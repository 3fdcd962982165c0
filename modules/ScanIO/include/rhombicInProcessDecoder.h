#ifndef rhombicInProcessDecoder_h
#define rhombicInProcessDecoder_h

#include "rhombicVoxelDecoder.h"

#include <mutex>

namespace rhombic
{

/** \class InProcessDecoder
 * \brief Unpacks voxels in this process, one file at a time, because GDCM's codecs share state.
 *
 * For hosts that trust their files, or can't have other processes: damaged files may end this one. */
class InProcessDecoder : public VoxelDecoder
{
public:
  unsigned int
  GetNumberOfWorkers() const override;

  std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request) override;

private:
  std::mutex m_Mutex;
};

} // namespace rhombic

#endif
