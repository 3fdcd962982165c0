#ifndef rhombicDicomSeries_h
#define rhombicDicomSeries_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"

#include <vector>

namespace rhombic
{

/** Slices that may make a volume: of one SeriesInstanceUID, orientation, size and pixel spacing. */
struct DicomSeries
{
  std::string id; ///< SeriesSummary::id
  std::vector<DicomSlice> slices;
};

/** Splits slices into series, in the order of series number, then UID. */
std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices);

/** The index of the series that is wanted (see ScanReadOptions::series), or, when \a wanted is empty, of the one
 * with most slices among those that can be volumes. Throws Failure(Usage) when there is none or more than one such
 * series, Failure(Unreadable) when none of them can be a volume. */
std::size_t
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen);

} // namespace rhombic

#endif
