#ifndef rhombicInProcessDecoder_h
#define rhombicInProcessDecoder_h

#include "rhombicVoxelDecoder.h"

namespace rhombic
{

/** \class InProcessDecoder
 * \brief Decodes files in this process.
 *
 * Damaged files may end the process. Decode() runs on one thread at a time, in all objects of this class, because
 * libraries, such as GDCM's codecs, share state. */
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
