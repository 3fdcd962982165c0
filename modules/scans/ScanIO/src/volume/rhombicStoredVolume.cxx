#include "rhombicStoredVolume.h"

#include "rhombicCompressedFile.h"
#include "rhombicFailure.h"
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

std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes)
{
  constexpr std::uintmax_t largest = std::uintmax_t(1) << 60;
  std::uintmax_t product = 1;
  for (const std::uintmax_t size : sizes)
  {
    if (size > 0 && product > largest / size)
    {
      return std::nullopt;
    }
    product *= size;
  }
  return product;
}

void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan)
{
  RefuseVolumeIf(!options.frame && numberOfFrames > 1 && options.onSeveralFrames == ScanReadOptions::Policy::Refuse,
                 path,
                 "it holds " + std::to_string(numberOfFrames) +
                   " volumes; choose one with ScanReadOptions::frame, from 0 to " + std::to_string(numberOfFrames - 1));
  if (options.frame && *options.frame >= numberOfFrames)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot read volume " + std::to_string(*options.frame) + " of " + path.string() + ": it holds " +
                    std::to_string(numberOfFrames) + ", counted from 0; choose another with ScanReadOptions::frame.");
  }
  scan.numberOfFrames = numberOfFrames;
  scan.frame = options.frame.value_or(0);
}

} // namespace rhombic
