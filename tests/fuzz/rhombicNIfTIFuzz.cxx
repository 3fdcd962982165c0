#include "rhombicFailure.h"
#include "rhombicFuzzProperty.h"
#include "rhombicReadScan.h"
#include "rhombicTemporaryFolder.h"

#include <fstream>

using rhombicfuzz::Require;

namespace
{

/** Written as what it begins like, because the reader goes by names. */
std::filesystem::path
WriteFile(const std::uint8_t * data, std::size_t size)
{
  static const rhombictest::TemporaryFolder folder;
  const bool isCompressed = size > 1 && data[0] == 0x1f && data[1] == 0x8b;
  const auto path = folder.Path() / (isCompressed ? "fuzz.nii.gz" : "fuzz.nii");
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  Require(file.good(), "the temporary file takes the input");
  return path;
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  rhombic::ScanReadOptions options;
  options.maximumMemory = std::uintmax_t{ 1 } << 28;
  options.acceptsAnalyze = true;
  options.frame = 0;
  try
  {
    rhombic::ReadScan(WriteFile(data, size), options);
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() != rhombic::FailureKind::Internal, "what is wrong is the file's mistake");
  }
  return 0;
}
