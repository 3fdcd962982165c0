#include "rhombicScanReader.h"

#include "rhombicDicomFolder.h"
#include "rhombicFailure.h"
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
    return ReadDicomFolder(path, options.series);
  }
  if (!fs::is_regular_file(status))
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": it is a device or pipe; give a file or folder.");
  }
  if (!IsVolumeFileName(path))
  {
    RefuseSingleDicomFile(path);
  }
  if (!options.series.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Cannot choose a series of " + path.string() +
                    ": only folders of DICOM files have series; leave it out.");
  }
  return ReadVolumeFile(path);
}

/** What an exception of a library says, without its class names, addresses and line breaks. */
std::string
Clean(const std::exception & exception)
{
  const auto * const fromITK = dynamic_cast<const itk::ExceptionObject *>(&exception);
  std::string text = fromITK ? fromITK->GetDescription() : exception.what();
  const auto prefixEnd = text.find("): ");
  if (text.compare(0, 4, "ITK ") == 0 || text.compare(0, 5, "itk::") == 0)
  {
    text.erase(0, prefixEnd == std::string::npos ? 0 : prefixEnd + 3);
  }
  text.erase(std::min(text.find('\n'), text.size()));
  text.erase(text.find_last_not_of(" .:") + 1);
  return text;
}

} // namespace

Scan
ReadScan(const fs::path & path, const ScanReadOptions & options)
{
  const QuietLibraries quiet;
  const auto outOfMemory = [&path] {
    return Failure(FailureKind::Memory,
                   "Cannot read " + path.string() + ": it does not fit into memory; free some or crop the scan.");
  };
  try
  {
    return Read(path, options);
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
                  "Cannot read " + path.string() + ": " + Clean(exception) + "; it may be damaged, so copy it again.");
  }
}

} // namespace rhombic
