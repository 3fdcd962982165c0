#include "rhombicDicomFolder.h"

#include "rhombicDicomPixels.h"
#include "rhombicDicomSeries.h"
#include "rhombicDicomStack.h"
#include "rhombicFailure.h"
#include "rhombicFolderFiles.h"
#include "rhombicVolumeFile.h"

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Says what the folder holds instead of DICOM images. */
[[noreturn]] void
RefuseFolder(const fs::path & folder, const FolderFiles & files)
{
  const auto volume = std::find_if(files.paths.begin(), files.paths.end(), IsVolumeFileName);
  std::string why = "it holds no DICOM images; give the folder that does";
  if (volume != files.paths.end())
  {
    why = "it holds no DICOM images; to read " + volume->filename().string() +
          ", give the file itself: " + volume->string();
  }
  else if (files.symbolicLinks > 0)
  {
    why = "it holds symbolic links, which are not followed, and no DICOM images; copy the files they lead to";
  }
  else if (files.paths.empty())
  {
    why = "it is empty; give the folder that holds the scan";
  }
  throw Failure(FailureKind::NotFound, "Found no scan in " + folder.string() + ": " + why + ".");
}

/** What is put into the log about the series that were not read. */
std::vector<std::string>
NoteOthers(const std::vector<SeriesSummary> & summaries)
{
  std::vector<std::string> notes;
  for (const SeriesSummary & summary : summaries)
  {
    if (!summary.chosen)
    {
      notes.push_back("Series " + std::to_string(summary.number) + " (" +
                      (summary.modality.empty() ? "modality unknown" : summary.modality) + ", " +
                      std::to_string(summary.numberOfFiles) + " files, id " + summary.id + ") was not read.");
    }
  }
  return notes;
}

/** Why a file that GDCM could not make sense of may be a slice all the same; empty when it is something else. */
std::string
DamageOf(const fs::path & path)
{
  constexpr std::streamoff magicOffset = 128;
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    return "can't be opened";
  }
  char magic[4] = {};
  file.seekg(magicOffset).read(magic, sizeof(magic));
  return std::string(magic, sizeof(magic)) == "DICM" ? "is damaged" : "";
}

/** One note for all damaged files: a slice that is missing at an end leaves no gap that could be seen. */
void
NoteDamaged(const std::vector<std::string> & damaged, std::vector<std::string> & notes)
{
  constexpr std::size_t named = 3;
  if (damaged.empty())
  {
    return;
  }
  std::string list;
  for (std::size_t n = 0; n < std::min(named, damaged.size()); ++n)
  {
    list += (n > 0 ? ", " : "") + damaged[n];
  }
  notes.push_back("Slices may be missing: " + list +
                  (damaged.size() > named ? " and " + std::to_string(damaged.size() - named) + " more" : "") + ".");
}

} // namespace

Scan
ReadDicomFolder(const fs::path & folder, const std::string & wanted)
{
  const FolderFiles files = ListFiles(folder);

  Scan scan;
  scan.format = "DICOM";
  if (files.symbolicLinks > 0)
  {
    scan.filesSkipped["symbolic links"] = files.symbolicLinks;
  }
  std::vector<DicomSlice> slices;
  std::vector<std::string> damaged;
  for (const fs::path & path : files.paths)
  {
    auto slice = ReadDicomSlice(path);
    if (slice && slice->isImage)
    {
      slices.push_back(std::move(*slice));
    }
    else
    {
      ++scan.filesSkipped["no DICOM images"];
      if (const std::string damage = slice ? "" : DamageOf(path); !damage.empty())
      {
        damaged.push_back(path.filename().string() + " " + damage);
      }
    }
  }
  if (slices.empty())
  {
    RefuseFolder(folder, files);
  }

  std::vector<DicomSeries> series = GroupIntoSeries(slices);
  const std::size_t chosen = ChooseSeries(series, wanted, folder);
  scan.series = Summarize(series, chosen);
  scan.modality = scan.series[chosen].modality;
  scan.notes = NoteOthers(scan.series);
  NoteDamaged(damaged, scan.notes);

  const VolumeGeometry geometry = StackSlices(series[chosen].slices);
  scan.image = ReadDicomPixels(series[chosen].slices, geometry);
  return scan;
}

void
RefuseSingleDicomFile(const fs::path & path)
{
  const auto slice = ReadDicomSlice(path);
  if (!slice)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() +
                    ": it is neither DICOM nor named like NIfTI, NRRD or MetaImage; check where it came from.");
  }
  if (!slice->refusal.empty())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + slice->refusal +
                    "; give a folder of plain CT, MR or PET slices.");
  }
  throw Failure(FailureKind::Geometry,
                "Cannot read " + path.string() +
                  ": it is a single slice, which is no volume; give the folder of the whole series.");
}

} // namespace rhombic
