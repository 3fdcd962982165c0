#include "rhombicStoredVolume.h"

#include "rhombicCompressedFile.h"
#include "rhombicVolumeFrame.h"
#include "rhombicVolumeRefusal.h"

#include <algorithm>

namespace rhombic
{

void
RequireVoxels(const std::vector<std::uintmax_t> & sizes,
              bool areAtEnd,
              const std::filesystem::path & header,
              StoredVolume & volume)
{
  std::vector<std::uintmax_t> factors = sizes;
  factors.push_back(SizeOf(volume.type));
  const auto needed = ProductOf(factors);
  if (!needed)
  {
    RefuseVolume(header, "its dimensions are larger than any volume; export it again from its source");
  }
  StoredVoxels & voxels = volume.voxels;
  const std::uintmax_t size = std::filesystem::file_size(voxels.path);
  const std::uintmax_t stored = size - std::min(voxels.offset, size);
  if ((voxels.isDeflated ? stored * LargestRatio : stored) < voxels.skip + *needed)
  {
    RefuseVolume(header,
                 "its header announces more voxels than " + voxels.path.filename().string() + " can hold (" +
                   std::to_string(stored) + " bytes for " + std::to_string(*needed + voxels.skip) +
                   " bytes of voxels); it is cut off or damaged, so copy it again");
  }
  if (areAtEnd)
  {
    voxels.offset = size - *needed;
  }
}

} // namespace rhombic
