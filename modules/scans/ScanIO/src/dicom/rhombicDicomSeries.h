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

/** Slices that may be one volume: with the same SeriesInstanceUID, kind, orientation, size and pixel spacing. If two
 * would be at the same position, also with the same image type, echo, time, stack or acquisition, whichever separates
 * them. */
struct DicomSeries
{
  std::string id;   ///< SeriesSummary::id
  std::string kind; ///< SeriesSummary::kind
  std::vector<DicomSlice> slices;
};

/** Splits slices into series, sorted by series number, UID, size, kind and axes, not by file names. Files without UID
 * are separated by folder. */
std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices);

/** The series to read, and the reason. */
struct SeriesChoice
{
  std::size_t index = 0;
  std::string reason;
};

/** The series that \a wanted names (see ScanReadOptions::series). If \a wanted is empty: the only series that can be a
 * volume, or the one that has at least twice as many slices as any other; nothing when there is no such series. Throws
 * Failure(Usage), listing the series, when \a wanted names none or more than one. */
std::optional<SeriesChoice>
FindSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

/** FindSeries(). Throws Failure: Usage, listing the series, when it finds none; Unreadable when the series can't be a
 * volume. */
SeriesChoice
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder);

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen);

} // namespace rhombic

#endif
