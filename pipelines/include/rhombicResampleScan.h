#ifndef rhombicResampleScan_h
#define rhombicResampleScan_h

#include "rhombicEvents.h"
#include "rhombicScanSource.h"
#include "rhombicSidecar.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** From a scan to a lattice volume, or from a lattice volume to a Cartesian volume. */
struct ResampleScanSettings
{
  ScanSource source;
  std::filesystem::path volume; ///< .nrrd for a lattice volume; .nrrd, .nii, .nii.gz, .mha for a Cartesian one
  Provenance provenance;
};

/** Checks the settings, without reading or writing anything. Returns the files that ResampleScan() writes. Throws
 * Failure(Usage). */
std::vector<std::filesystem::path>
CheckResampleScan(const ResampleScanSettings & settings);

/** Resamples a scan onto the lattice, or, when the source is a lattice volume, onto a Cartesian grid of the source's
 * lattice spacing; returns all files. Throws Failure. */
std::vector<MadeFile>
ResampleScan(const ResampleScanSettings & settings, const Events & events);

} // namespace rhombic

#endif
