#ifndef rhombicSourceLoading_h
#define rhombicSourceLoading_h

#include "rhombicEvents.h"
#include "rhombicScanSource.h"
#include "rhombicTableRemoval.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Reads a scan, without notes. Throws Failure. */
Scan
ReadScan(const ScanSource & source, const Events & events);

/** Reads a scan or a lattice volume. Notes describe it and list the assumptions of the reader. Throws Failure. */
SourceVolume
LoadVolume(const ScanSource & source, const Events & events);

/** \class LoadedSource
 * \brief The lattice volume that surfaces are extracted from, and the scan behind it. */
struct LoadedSource
{
  std::optional<Scan> scan;                 ///< none when the source is a lattice volume or a label map
  std::optional<TableRemoval> tableRemoval; ///< objects that were removed from the scan
  FCCVolume lattice;                        ///< null without requests
  itk::ImageBase<3>::Pointer grid;          ///< grid of the scan, without values; null for no or a slanted scan
  std::vector<SurfaceRequest> requests;     ///< with their isovalues
  std::optional<LabelMap> labels;
  std::vector<std::string> warnings; ///< doubts that the labels belong to the scan (FindLabelDoubts())

  /** The scan, or the label map when that is the source; null for lattice volumes. */
  const Scan *
  FindScan() const
  {
    return scan ? &*scan : labels ? &labels->scan : nullptr;
  }

  /** Drops the lattice and the labels. The freed memory goes back to the system, so that it does not add to the memory
   * of the steps behind. */
  void
  DropVolumes();
};

/** Reads a source, removes the table if asked and resamples onto the lattice, as far as the selection needs it. Throws
 * Failure.
 *
 * \param volume the source's volume, if the caller has read the source already */
LoadedSource
LoadSource(const ScanSource & source,
           const SurfaceSelection & selection,
           std::optional<SourceVolume> volume,
           const Events & events);

/** Throws Failure(Usage) for rules that fit none of the surfaces, where these are known without reading anything. */
void
CheckSelection(const SurfaceSelection & selection);

/** Throws Failure for an output that can't be written, that is an input, or that is named twice.
 * \param source and \param selection name the inputs */
void
CheckOutputs(const std::vector<std::filesystem::path> & outputs,
             const ScanSource & source,
             const SurfaceSelection & selection = {});

} // namespace rhombic

#endif
