#ifndef rhombicInProcessDecoder_h
#define rhombicInProcessDecoder_h

#include "rhombicVoxelDecoder.h"

namespace rhombic
{

/** \class InProcessDecoder
 * \brief Unpacks voxels in this process.
 *
 * For hosts that trust their files, or can't have other processes: damaged files may end this one.
 *
 * Thread safety: any number of threads may call Decode() at once. They take turns, whichever decoder is theirs, because
 * GDCM's codecs share state. */
class InProcessDecoder : public VoxelDecoder
{
public:
  unsigned int
  GetNumberOfWorkers() const override;

  std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request) override;
};

} // namespace rhombic

#endif
