#ifndef rhombicReadScan_h
#define rhombicReadScan_h

#include "itkNativeScanFileReader.h"

#include <filesystem>

namespace rhombic
{

/** Options that accept unevenly spaced slices. */
inline ScanReadOptions
AcceptUneven()
{
  ScanReadOptions options;
  options.onUneven = ScanReadOptions::Policy::Accept;
  return options;
}

/** Reads a scan in one call. */
inline Scan
ReadScan(const std::filesystem::path & path, const ScanReadOptions & options = AcceptUneven())
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(path.string());
  reader->SetOptions(options);
  reader->Update();
  return *reader->GetOutput()->Get();
}

} // namespace rhombic

#endif
