#include "rhombicScanReader.h"

#include "rhombicDicomFolder.h"
#include "rhombicFailure.h"
#include "rhombicInProcessDecoder.h"
#include "rhombicQuietLibraries.h"
#include "rhombicVolumeFile.h"

#include <algorithm>
#include <new>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

Scan
Read(const fs::path & path, const ScanReadOptions & options)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
  {
    throw Failure(FailureKind::NotFound,
                  "Cannot read " + path.string() + ": there is no such file or folder; check the spelling.");
  }
  if (fs::is_directory(status))
  {
    return ReadDicomFolder(path, options);
  }
  if (!fs::is_regular_file(status))
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": it is a device or pipe; give a file or folder.");
  }
  if (!IsVolumeFileName(path))
  {
    return ReadDicomFile(path, options);
  }
  if (!options.series.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Cannot choose a series of " + path.string() +
                    ": only folders of DICOM files have series; leave it out.");
  }
  return ReadVolumeFile(path, options);
}

} // namespace

Scan
ReadScan(const fs::path & path, const ScanReadOptions & options)
{
  const QuietLibraries quiet;
  InProcessDecoder inProcess;
  ScanReadOptions used = options;
  used.decoder = options.decoder != nullptr ? options.decoder : &inProcess;
  const auto outOfMemory = [&path] {
    return Failure(FailureKind::Memory,
                   "Cannot read " + path.string() + ": it does not fit into memory; free some or crop the scan.");
  };
  try
  {
    return Read(path, used);
  }
  catch (const Failure &)
  {
    throw;
  }
  catch (const itk::MemoryAllocationError &)
  {
    throw outOfMemory();
  }
  catch (const std::bad_alloc &)
  {
    throw outOfMemory();
  }
  catch (const std::exception & exception)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + DescribeError(exception) +
                    "; it may be damaged, so copy it again.");
  }
}

} // namespace rhombic
