#ifndef rhombicDicomSeries_h
#define rhombicDicomSeries_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Slices that may make a volume: of one SeriesInstanceUID, kind, orientation, size and pixel spacing. When there would
 * be two at one place, also of one image type, echo, time, stack or acquisition, whichever tells them apart. */
struct DicomSeries
{
  std::string id;   ///< SeriesSummary::id
  std::string kind; ///< SeriesSummary::kind
  std::vector<DicomSlice> slices;
};

/** Splits slices into series, in the order of series number, then UID, then size, then kind and axes,
 * whatever the files are called. Files without UID are told apart by
 * their folder. */
std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices);

/** Which series to read. */
struct SeriesChoice
{
  std::size_t index = 0;
  std::string reason;
};

/** The series that is wanted (see ScanReadOptions::series); when \a wanted is empty, the only one that can be a volume,
 * or that with at least twice as many slices as any other, or none where there are several such. Throws Failure(Usage),
 * listing them, when none or more than one is called as wanted. */
std::optional<SeriesChoice>
FindSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

/** FindSeries(). Throws Failure: also Usage, listing them, when it finds none, Unreadable when none of them can be a
 * volume. */
SeriesChoice
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen);

} // namespace rhombic

#endif
