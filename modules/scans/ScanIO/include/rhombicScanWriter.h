#ifndef rhombicScanWriter_h
#define rhombicScanWriter_h

#include "rhombicAtomicFile.h"
#include "rhombicScan.h"

#include <filesystem>

namespace rhombic
{

/** Throws Failure(Usage) for an extension that WriteScan() refuses: for a check before long work. */
void
CheckScanPath(const std::filesystem::path & path);

/** Writes a Cartesian volume as NRRD (.nrrd), NIfTI (.nii, .nii.gz) or MetaImage (.mha), by the path's extension, with
 * only the pixels and the geometry. The file is read back and compared before it appears, because ITK's writers report
 * success on a full disk. Throws Failure: Usage for another extension, Output. */
void
WriteScan(const ScanImage & image, const std::filesystem::path & path);

/** As WriteScan(), but the file appears with all others of \a staged. */
void
StageScan(const ScanImage & image, const std::filesystem::path & path, StagedFiles & staged);

} // namespace rhombic

#endif
