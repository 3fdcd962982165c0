#include "rhombicFailure.h"
#include "rhombicFuzzProperty.h"
#include "rhombicOMEZarrImage.h"
#include "rhombicTemporaryFolder.h"

#include <cmath>
#include <fstream>
#include <string_view>

using rhombicfuzz::Require;

namespace
{

void
WriteText(const std::filesystem::path & path, std::string_view text)
{
  std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

} // namespace

/** Folders of OME-Zarr with an array in 0: the input is .zattrs, a zero, .zarray, a zero, and a chunk. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const rhombictest::TemporaryFolder folder;
  const std::string_view input(reinterpret_cast<const char *>(data), size);
  const std::size_t first = std::min(input.find('\0'), input.size());
  const std::size_t second = std::min(input.find('\0', first + 1), input.size());
  const std::string_view array = input.substr(std::min(first + 1, size), second - std::min(first + 1, second));
  std::filesystem::create_directories(folder.Path() / "0/0/0");
  WriteText(folder.Path() / ".zattrs", input.substr(0, first));
  WriteText(folder.Path() / "0/.zarray", array);
  WriteText(folder.Path() / "0/0/0/0", input.substr(std::min(second + 1, size)));
  try
  {
    const rhombic::OMEZarrImage image(folder.Path());
    Require(image.GetNumberOfFrames() > 0 && image.GetNumberOfLevels() > 0, "an image has a frame and a level");
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Require(image.GetSize()[axis] > 0, "an image has voxels");
      Require(std::isfinite(image.GetOrigin()[axis]), "the first voxel has a place");
      const double step = image.GetSteps()[axis].GetNorm();
      Require(step > 0 && std::isfinite(step), "voxels have a size");
    }
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() != rhombic::FailureKind::Internal, "what is wrong is the folder's mistake");
  }
  return 0;
}
