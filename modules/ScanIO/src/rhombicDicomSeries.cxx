#include "rhombicDicomSeries.h"

#include "rhombicFailure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

namespace rhombic
{
namespace
{

bool
HaveSameAxes(const SlicePlane & first, const SlicePlane & second)
{
  constexpr double tolerance = 1e-4; // relative to the pixel spacing
  return (first.columnStep - second.columnStep).GetNorm() <= tolerance * first.columnStep.GetNorm() &&
         (first.rowStep - second.rowStep).GetNorm() <= tolerance * first.rowStep.GetNorm();
}

bool
BelongTogether(const DicomSlice & first, const DicomSlice & second)
{
  return first.seriesUID == second.seriesUID && first.rows == second.rows && first.columns == second.columns &&
         first.refusal == second.refusal && first.plane.has_value() == second.plane.has_value() &&
         (!first.plane || HaveSameAxes(*first.plane, *second.plane));
}

/** FNV-1a, 64 bits, in hexadecimal: the UID itself could lead to the patient. */
std::string
HashOf(const std::string & text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const char letter : text)
  {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  }
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4)
  {
    digits += "0123456789abcdef"[hash >> shift & 15];
  }
  return digits;
}

/** The parts of a series UID are told apart by a number, the largest part first. */
void
NameSeries(std::vector<DicomSeries> & series)
{
  std::map<std::string, int> parts;
  for (DicomSeries & one : series)
  {
    const std::string & uid = one.slices.front().seriesUID;
    const int part = ++parts[uid];
    one.id = HashOf(uid) + (part > 1 ? "-" + std::to_string(part) : "");
  }
}

std::string
ListSeries(const std::vector<DicomSeries> & series)
{
  std::string list;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const DicomSlice & slice = series[i].slices.front();
    list += (i > 0 ? ", " : "") + std::to_string(i + 1) + " (" + (slice.modality.empty() ? "?" : slice.modality) +
            ", " + std::to_string(series[i].slices.size()) + " files, id " + series[i].id + ")";
  }
  return list;
}

std::size_t
FindWanted(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder)
{
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const DicomSlice & slice = series[i].slices.front();
    if (wanted == series[i].id)
    {
      return i;
    }
    if (wanted == slice.seriesUID || wanted == slice.seriesNumber || wanted == std::to_string(i + 1))
    {
      found.insert(i);
    }
  }
  if (found.size() != 1)
  {
    throw Failure(FailureKind::Usage,
                  std::string(found.empty() ? "No series" : "More than one series") + " in " + folder.string() +
                    " goes by the name that was asked for; choose by id from " + ListSeries(series) + ".");
  }
  return *found.begin();
}

} // namespace

std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices)
{
  std::vector<DicomSeries> series;
  for (const DicomSlice & slice : slices)
  {
    const auto found = std::find_if(series.begin(), series.end(), [&slice](const DicomSeries & one) {
      return BelongTogether(one.slices.front(), slice);
    });
    (found == series.end() ? series.emplace_back() : *found).slices.push_back(slice);
  }
  std::stable_sort(series.begin(), series.end(), [](const DicomSeries & first, const DicomSeries & second) {
    const auto key = [](const DicomSeries & one) {
      const DicomSlice & slice = one.slices.front();
      return std::make_tuple(
        std::atoi(slice.seriesNumber.c_str()), slice.seriesUID, -static_cast<std::int64_t>(one.slices.size()));
    };
    return key(first) < key(second);
  });
  NameSeries(series);
  return series;
}

std::size_t
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder)
{
  std::size_t chosen = 0;
  if (wanted.empty())
  {
    const auto rank = [](const DicomSeries & one) {
      return std::make_pair(one.slices.front().refusal.empty(), one.slices.size());
    };
    const auto best =
      std::max_element(series.begin(), series.end(), [&rank](const DicomSeries & first, const DicomSeries & second) {
        return rank(first) < rank(second);
      });
    chosen = static_cast<std::size_t>(best - series.begin());
  }
  else
  {
    chosen = FindWanted(series, wanted, folder);
  }
  const DicomSlice & slice = series[chosen].slices.front();
  if (!slice.refusal.empty())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + slice.path.string() + ": " + slice.refusal +
                    "; give a series of plain CT, MR or PET slices.");
  }
  return chosen;
}

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen)
{
  std::vector<SeriesSummary> summaries;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const DicomSlice & slice = series[i].slices.front();
    SeriesSummary summary;
    summary.id = series[i].id;
    summary.number = i + 1;
    summary.seriesNumber = slice.seriesNumber;
    summary.modality = slice.modality;
    summary.numberOfFiles = series[i].slices.size();
    summary.size = { slice.columns, slice.rows, series[i].slices.size() };
    summary.chosen = i == chosen;
    summaries.push_back(summary);
  }
  return summaries;
}

} // namespace rhombic
