#ifndef rhombicReadScan_h
#define rhombicReadScan_h

#include "itkNativeScanFileReader.h"

#include <filesystem>

namespace rhombic
{

/** Reads a scan in one call. */
inline Scan
ReadScan(const std::filesystem::path & path, const ScanReadOptions & options = {})
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(path.string());
  reader->SetOptions(options);
  reader->Update();
  return *reader->GetOutput()->Get();
}

} // namespace rhombic

#endif
