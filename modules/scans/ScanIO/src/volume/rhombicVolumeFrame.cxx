#include "rhombicVolumeFrame.h"

#include "rhombicFailure.h"
#include "rhombicVolumeRefusal.h"

#include <string>

namespace rhombic
{

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
  if (!options.frame && numberOfFrames > 1 && options.onSeveralFrames == ScanReadOptions::Policy::Refuse)
  {
    RefuseVolume(path,
                 "it holds " + std::to_string(numberOfFrames) + " volumes; choose one with --frame, from 0 to " +
                   std::to_string(numberOfFrames - 1));
  }
  if (options.frame && *options.frame >= numberOfFrames)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot read volume " + std::to_string(*options.frame) + " of " + path.string() + ": it holds " +
                    std::to_string(numberOfFrames) + ", counted from 0; choose another with --frame.");
  }
  scan.numberOfFrames = numberOfFrames;
  scan.frame = options.frame.value_or(0);
}

} // namespace rhombic
