#ifndef rhombicMeasureTable_h
#define rhombicMeasureTable_h

#include "rhombicAtomicFile.h"
#include "rhombicMeshedSurface.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** Throws Failure(Usage) for an extension other than .csv and .json. */
void
CheckMeasureTablePath(const std::filesystem::path & path);

/** Writes the measures of surfaces, to appear with all others of \a staged: as .csv a line for each surface, with units
 * in the head line and empty fields for what is not known; as .json all of ReportMeshedSurface(). Throws Failure: Usage
 * for another extension, Output. */
void
StageMeasureTable(const std::vector<MeshedSurface> & surfaces,
                  itk::FCCIsosurfaceMode mode,
                  const std::filesystem::path & path,
                  StagedFiles & staged);

} // namespace rhombic

#endif
