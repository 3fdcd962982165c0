#include "rhombicDicomStack.h"

#include "rhombicDicomHeader.h"
#include "rhombicFailure.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace rhombic
{
namespace
{

using Slices = std::vector<DicomSlice>;

bool
HaveSameAxes(const SlicePlane & first, const SlicePlane & second)
{
  constexpr double tolerance = 1e-4; // relative to the pixel spacing
  return (first.columnStep - second.columnStep).GetNorm() <= tolerance * first.columnStep.GetNorm() &&
         (first.rowStep - second.rowStep).GetNorm() <= tolerance * first.rowStep.GetNorm();
}

/** The axes in thousandths of a millimetre: a key to sort by. */
std::vector<long>
AxesOf(const DicomSlice & slice)
{
  std::vector<long> axes;
  for (unsigned int n = 0; n < 6 && slice.plane; ++n)
  {
    const double number = n < 3 ? slice.plane->columnStep[n] : slice.plane->rowStep[n - 3];
    axes.push_back(std::lround(1000 * number));
  }
  return axes;
}

/** The properties that all slices of a series share, except for their axes. The frames of a segmentation stay together,
 * wherever they are. */
auto
KeyOf(const DicomSlice & slice)
{
  const bool isAlone = slice.kind == DicomSlice::Kind::Segmentation;
  const std::filesystem::path & path = slice.file->path;
  return std::make_tuple(slice.seriesUID,
                         isAlone                   ? path
                         : slice.seriesUID.empty() ? path.parent_path()
                                                   : std::filesystem::path(),
                         slice.kind,
                         slice.file->format.rows,
                         slice.file->format.columns,
                         slice.refusal,
                         !isAlone && slice.plane.has_value());
}

std::vector<Slices>
GroupByKeyAndAxes(const Slices & slices)
{
  std::map<decltype(KeyOf(slices.front())), std::vector<Slices>> groups;
  for (const DicomSlice & slice : slices)
  {
    std::vector<Slices> & group = groups[KeyOf(slice)];
    const auto found = std::find_if(group.begin(), group.end(), [&slice](const Slices & part) {
      return slice.kind == DicomSlice::Kind::Segmentation || !slice.plane ||
             HaveSameAxes(*part.front().plane, *slice.plane);
    });
    (found == group.end() ? group.emplace_back() : *found).push_back(slice);
  }
  std::vector<Slices> all;
  for (auto & [key, group] : groups)
  {
    std::move(group.begin(), group.end(), std::back_inserter(all));
  }
  return all;
}

/** Groups slices by their distinctions from number \a first to \a last. */
std::vector<DicomSeries>
SplitBy(const Slices & slices, std::size_t first, std::size_t last)
{
  std::map<std::string, Slices> parts;
  for (const DicomSlice & slice : slices)
  {
    std::string kind;
    for (std::size_t n = first; n < last; ++n)
    {
      kind += (kind.empty() || slice.distinctions[n].empty() ? "" : " ") + slice.distinctions[n];
    }
    parts[kind].push_back(slice);
  }
  std::vector<DicomSeries> series;
  for (auto & [kind, part] : parts)
  {
    series.push_back({ "", parts.size() > 1 ? kind : "", std::move(part) });
  }
  return series;
}

/** Splits a series with several slices at the same position by the first distinction that separates them all; else by
 * all distinctions together; and if that does not separate them either, not at all. */
std::vector<DicomSeries>
SplitDuplicates(const Slices & slices)
{
  const auto isUnique = [](const DicomSeries & series) { return !HaveDuplicates(series.slices); };
  constexpr std::size_t all = DicomSlice::NumberOfDistinctions;
  if (slices.front().kind == DicomSlice::Kind::Scan && HaveDuplicates(slices))
  {
    for (std::size_t n = 0; n <= all; ++n)
    {
      auto parts = n < all ? SplitBy(slices, n, n + 1) : SplitBy(slices, 0, all);
      if (std::all_of(parts.begin(), parts.end(), isUnique))
      {
        return parts;
      }
    }
  }
  return { { "", "", slices } };
}

/** Sets the ids: a hash, as the UID itself could lead to the patient, and a number for the parts of a series that was
 * split. */
void
NameSeries(std::vector<DicomSeries> & series)
{
  std::map<std::string, int> parts;
  for (DicomSeries & named : series)
  {
    const std::string & uid = named.slices.front().seriesUID;
    const int part = ++parts[uid];
    named.id = HashText(uid) + (part > 1 ? "-" + std::to_string(part) : "");
  }
}

std::string
EnumerateSeries(const std::vector<DicomSeries> & series)
{
  std::string list;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const DicomSlice & slice = series[i].slices.front();
    list += (i > 0 ? ", " : "") + std::to_string(i + 1) + " (" + (slice.modality.empty() ? "?" : slice.modality) +
            ", " + Count(series[i].slices.size(), "slice") + (series[i].kind.empty() ? "" : ", " + series[i].kind) +
            ", id " + series[i].id + ")";
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
  FailIf(found.size() != 1,
         FailureKind::Usage,
         std::string(found.empty() ? "No series" : "More than one series") + " in " + folder.string() +
           " has this id, UID, number or position in the list; choose by id from " + EnumerateSeries(series) + ".");
  return *found.begin();
}

/** Indices of the series, the most suitable first: readable ones, scans, those of more slices. */
std::vector<std::size_t>
RankSeries(const std::vector<DicomSeries> & series)
{
  const auto rank = [&series](std::size_t i) {
    const DicomSlice & slice = series[i].slices.front();
    return std::make_tuple(slice.refusal.empty(), slice.kind == DicomSlice::Kind::Scan, series[i].slices.size());
  };
  std::vector<std::size_t> indices(series.size());
  std::iota(indices.begin(), indices.end(), 0u);
  std::stable_sort(indices.begin(), indices.end(), [&rank](std::size_t first, std::size_t second) {
    return rank(first) > rank(second);
  });
  return indices;
}

/** The most suitable series; nothing when several are about as suitable. */
std::optional<SeriesChoice>
FindBest(const std::vector<DicomSeries> & series)
{
  const std::vector<std::size_t> indices = RankSeries(series);
  const DicomSeries & best = series[indices[0]];
  if (series.size() == 1)
  {
    return SeriesChoice{ 0, "it is the only series" };
  }
  const DicomSeries & next = series[indices[1]];
  const auto isRival = [&best](const DicomSeries & other) {
    return other.slices.front().refusal.empty() && other.slices.front().kind == best.slices.front().kind &&
           other.slices.size() > 1;
  };
  if (!isRival(next))
  {
    return SeriesChoice{ indices[0], "it is the only series that can be a volume" };
  }
  if (best.slices.size() < 2 * next.slices.size())
  {
    return std::nullopt;
  }
  return SeriesChoice{ indices[0],
                       "it has the most slices by far (" + std::to_string(best.slices.size()) + ", the next has " +
                         std::to_string(next.slices.size()) + ")" };
}

} // namespace

std::vector<DicomSeries>
GroupIntoSeries(const std::vector<DicomSlice> & slices)
{
  std::vector<DicomSeries> series;
  for (const Slices & group : GroupByKeyAndAxes(slices))
  {
    auto parts = SplitDuplicates(group);
    std::move(parts.begin(), parts.end(), std::back_inserter(series));
  }
  std::stable_sort(series.begin(), series.end(), [](const DicomSeries & first, const DicomSeries & second) {
    const auto key = [](const DicomSeries & keyed) {
      const DicomSlice & slice = keyed.slices.front();
      return std::make_tuple(std::atoi(slice.seriesNumber.c_str()),
                             slice.seriesUID,
                             -static_cast<std::int64_t>(keyed.slices.size()),
                             keyed.kind,
                             slice.file->format.columns,
                             slice.file->format.rows,
                             AxesOf(slice));
    };
    return key(first) < key(second);
  });
  NameSeries(series);
  return series;
}

std::optional<SeriesChoice>
FindSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder)
{
  return wanted.empty() ? FindBest(series) : SeriesChoice{ FindWanted(series, wanted, folder), "it was asked for" };
}

SeriesChoice
ChooseSeries(const std::vector<DicomSeries> & series, const std::string & wanted, const std::filesystem::path & folder)
{
  const auto choice = FindSeries(series, wanted, folder);
  if (!choice)
  {
    throw Failure(FailureKind::Usage,
                  "There is more than one volume in " + folder.string() +
                    "; choose one with ScanReadOptions::series and an id from " + EnumerateSeries(series) + ".");
  }
  const DicomSlice & slice = series[choice->index].slices.front();
  RefuseVolumeIf(
    !slice.refusal.empty(), slice.file->path, slice.refusal + "; give a series of plain CT, MR or PET slices");
  return *choice;
}

std::vector<SeriesSummary>
Summarize(const std::vector<DicomSeries> & series, std::size_t chosen)
{
  std::vector<SeriesSummary> summaries;
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    const DicomSlice & slice = series[i].slices.front();
    std::set<std::filesystem::path> files;
    for (const DicomSlice & other : series[i].slices)
    {
      files.insert(other.file->path);
    }
    SeriesSummary summary;
    summary.id = series[i].id;
    summary.number = i + 1;
    summary.seriesNumber = slice.seriesNumber;
    summary.modality = slice.modality;
    summary.kind = series[i].kind;
    summary.numberOfFiles = files.size();
    summary.size = { slice.file->format.columns, slice.file->format.rows, series[i].slices.size() };
    summary.problem = slice.refusal;
    summary.chosen = i == chosen;
    summaries.push_back(summary);
  }
  return summaries;
}

} // namespace rhombic
