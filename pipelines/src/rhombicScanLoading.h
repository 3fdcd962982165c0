#ifndef rhombicScanLoading_h
#define rhombicScanLoading_h

#include "rhombicLabelSurfaces.h"
#include "rhombicScanPipeline.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace rhombic
{

/** The scan, and the label map with its table; those that there are not are empty. */
std::vector<std::filesystem::path>
InputsOf(const ScanSource & source, const SurfaceSelection & selection);

/** Finds out before the work begins whether outputs can be written, and that none takes the place of an input or of
 * another output. Throws Failure. */
void
CheckOutputs(const std::vector<std::filesystem::path> & outputs, const std::vector<std::filesystem::path> & inputs);

/** Reads a scan, and says what it is and what the reader had to assume. */
Scan
LoadScan(const ScanSource & source, const Events & events);

/** A scan's report for outputs: the names of its path and file may be the patient's. */
Report
ReportWithoutNames(const Scan & scan, const std::filesystem::path & path);

/** \class LoadedSource
 * \brief What surfaces are made of. */
struct LoadedSource
{
  std::optional<Scan> scan;             ///< none when the source is a lattice volume or a label map
  FCCVolume lattice;                    ///< the scan's, if there are requests
  itk::ImageBase<3>::Pointer grid;      ///< the scan's, without its values; null when there is none or it is slanted
  std::vector<SurfaceRequest> requests; ///< with their isovalues
  std::optional<LabelMap> labels;
  bool isOriented = true; ///< whether it is known how it lies in the patient
  Report report;
};

/** Reads, takes the table out and resamples. Throws Failure. */
LoadedSource
LoadSource(const ScanSource & source, const SurfaceSelection & selection, const Events & events);

/** How an isosurface was asked for, how large it is, and what was left out. */
Report
ReportSurface(const SurfaceRequest & request, const ExtractedSurface & surface, itk::FCCIsosurfaceMode mode);

/** How label surfaces are made. */
LabelSurfaceSettings
GetLabelSettings(const ScanSource & source, const SurfaceSelection & selection);

} // namespace rhombic

#endif
