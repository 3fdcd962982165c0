#include "rhombicScanFormats.h"

#include "rhombicDicomHeader.h"
#include "rhombicDicomSlice.h"
#include "rhombicDicomStack.h"
#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicStoredVolume.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <set>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Throws Failure with the reason why a folder has no DICOM images. */
[[noreturn]] void
RefuseFolder(const fs::path & folder, const FolderFiles & files, const Scan & scan)
{
  const auto volume = std::find_if(
    files.paths.begin(), files.paths.end(), [](const fs::path & path) { return !VolumeFormatOf(path).empty(); });
  std::string why = "it holds no DICOM images; give the folder that does";
  if (volume != files.paths.end())
  {
    why = "it holds no DICOM images; to read " + volume->filename().string() +
          ", give the file itself: " + volume->string();
  }
  else if (!scan.fileNotes.empty())
  {
    why = "it holds no DICOM images that can be read (" + scan.fileNotes.front() + "); copy it again from its source";
  }
  else if (files.unreadableFolders > 0)
  {
    why = "it, or a folder in it, may not be read by you; ask its owner for permission";
  }
  else if (files.symbolicLinks > 0)
  {
    why = "it holds symbolic links, which are not followed, and no DICOM images; have them followed with "
          "ScanReadOptions::followsLinks";
  }
  else if (files.paths.empty())
  {
    why = "it is empty; give the folder that holds the scan";
  }
  throw Failure(FailureKind::NotFound, "Found no scan in " + folder.string() + ": " + why + ".");
}

/** The first three names of a list, and the number of others. */
std::string
Shorten(const std::vector<std::string> & names)
{
  constexpr std::size_t named = 3;
  std::string list;
  for (std::size_t n = 0; n < std::min(named, names.size()); ++n)
  {
    list += (n > 0 ? ", " : "") + names[n];
  }
  return list + (names.size() > named ? " and " + std::to_string(names.size() - named) + " more" : "");
}

/** Notes about the series that were not read. */
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
                      Count(summary.numberOfFiles, "file") + ", id " + summary.id + ") was not read" +
                      (summary.problem.empty() ? "" : ": " + summary.problem) + ".");
    }
  }
  return notes;
}

/** The slices of a folder's files. Counts all other files in the scan's report. */
std::vector<DicomSlice>
CollectSlices(const FolderFiles & files, Scan & scan)
{
  if (files.symbolicLinks > 0)
  {
    scan.filesSkipped["symbolic links"] = files.symbolicLinks;
  }
  if (files.others > 0)
  {
    scan.filesSkipped["devices or pipes"] = files.others;
  }
  scan.filesConsidered = files.paths.size() + files.symbolicLinks + files.others;
  std::vector<DicomSlice> slices;
  std::vector<std::string> damaged;
  const auto leaveOut = [&](const fs::path & path, const char * reason, const char * damage) {
    ++scan.filesSkipped[reason];
    if (damage != nullptr)
    {
      damaged.push_back(path.filename().string() + damage);
    }
  };
  for (const fs::path & path : files.paths)
  {
    const auto found = ReadDicomSlices(path);
    if (found.empty())
    {
      IsReadable(path) ? leaveOut(path, "not DICOM", nullptr) : leaveOut(path, "not readable", " can't be opened");
    }
    else if (found.front().kind != DicomSlice::Kind::NoImage)
    {
      slices.insert(slices.end(), found.begin(), found.end());
    }
    else if (const std::string & damage = found.front().file->pixelDamage;
             !damage.empty() && found.front().refusal == damage)
    {
      leaveOut(path, "damaged", " is damaged");
    }
    else
    {
      leaveOut(path, "DICOM without image (reports, plans, DICOMDIR)", nullptr);
    }
  }
  if (!damaged.empty())
  {
    // A slice that is missing at an end of the stack leaves no visible gap.
    scan.notes.push_back("Slices may be missing, because " + Count(damaged.size(), "file") + " could not be read.");
    scan.fileNotes.push_back(Shorten(damaged));
  }
  return slices;
}

std::string
DescribeScalingOf(const std::vector<DicomSlice> & slices)
{
  const DicomSlice & first = slices.front();
  const auto isSame = [&first](const DicomSlice & slice) {
    return slice.slope == first.slope && slice.intercept == first.intercept;
  };
  if (!std::all_of(slices.begin(), slices.end(), isSame))
  {
    return "each slice has its own slope and intercept";
  }
  return first.slope == 1 && first.intercept == 0 ? "" : DescribeScaling(ValueScaling{ first.slope, first.intercept });
}

void
NoteCompression(const std::vector<DicomSlice> & slices, Scan & scan)
{
  std::set<std::string> names;
  bool isLossy = false;
  for (const DicomSlice & slice : slices)
  {
    const TransferSyntax syntax = FindTransferSyntax(slice.file->format.transferSyntax);
    names.insert(syntax.name);
    isLossy = isLossy || syntax.isLossy;
  }
  for (const std::string & name : names)
  {
    scan.encoding += (scan.encoding.empty() ? "" : ", ") + name;
  }
  if (isLossy)
  {
    scan.notes.push_back("The values may have been compressed with loss (" + scan.encoding + ").");
  }
}

/** Files that failed, and a sentence for each. */
using FileFailures = std::map<fs::path, std::string>;

/** Files whose headers show that their pixels are incomplete. */
FileFailures
FindDamagedFiles(const std::vector<DicomSlice> & slices)
{
  FileFailures failures;
  for (const DicomSlice & slice : slices)
  {
    if (const std::string & damage = slice.file->pixelDamage; !damage.empty())
    {
      failures.emplace(slice.file->path,
                       "Cannot read " + slice.file->path.string() + ": " + damage + "; copy it again from its source.");
    }
  }
  return failures;
}

/** Leaves out the slices of files that failed, if gaps are accepted; otherwise throws Failure. */
std::vector<DicomSlice>
LeaveOut(const FileFailures & failures, std::vector<DicomSlice> slices, const ScanReadOptions & options, Scan & scan)
{
  if (failures.empty())
  {
    return slices;
  }
  const std::size_t others = failures.size() - 1;
  const auto failed = [&failures](const DicomSlice & slice) { return failures.count(slice.file->path) != 0; };
  slices.erase(std::remove_if(slices.begin(), slices.end(), failed), slices.end());
  FailIf(options.onGap == ScanReadOptions::Policy::Refuse || slices.size() < 2,
         FailureKind::Unreadable,
         failures.begin()->second + (others == 0 ? "" : " (And " + Count(others, "more file") + ".)"));
  scan.notes.push_back("The slices of " + Count(failures.size(), "damaged file") + " were left out.");
  for (const auto & [path, failure] : failures)
  {
    scan.fileNotes.push_back(failure);
  }
  return slices;
}

/** Throws Failure(Unreadable) if a slice lacks slope and intercept that others have. */
void
RequireScaling(const std::vector<DicomSlice> & slices)
{
  const auto isScaled = [](const DicomSlice & slice) { return slice.isScaled; };
  const auto unscaled = std::find_if_not(slices.begin(), slices.end(), isScaled);
  if (unscaled != slices.end() && std::any_of(slices.begin(), slices.end(), isScaled))
  {
    RefuseVolume(unscaled->file->path,
                 "it has no RescaleSlope and RescaleIntercept, which other slices have; export the series again from "
                 "its source");
  }
}

/** Stacks slices without those of files that failed. Files that fail when they are read are left out like a gap, too,
 * if the options accept gaps. */
UnreadScan
OpenStack(const std::vector<DicomSlice> & all,
          const FileFailures & failures,
          const ScanReadOptions & options,
          Scan scan)
{
  const Scan found = scan;
  std::vector<DicomSlice> slices = LeaveOut(failures, all, options, scan);
  RequireScaling(slices);
  const DicomStack stack = StackSlices(slices, options);
  scan.image = NewDicomImage(slices, stack.geometry);
  scan.sliceOrigins = stack.sliceOrigins;
  scan.stack = stack.report;
  scan.scaling = DescribeScalingOf(slices);
  scan.notes.insert(scan.notes.end(), stack.notes.begin(), stack.notes.end());
  NoteCompression(slices, scan);

  UnreadScan file;
  file.scan = scan;
  file.isTypeCertain = HoldsAllValues(scan.image, slices);
  file.findPlace = [=] { return FindPlaceOfPixels(slices, stack.geometry, options); };
  file.readVoxels = [=](Scan & read) {
    DicomPixels pixels = ReadDicomPixels(slices, stack.geometry, options);
    if (!pixels.failures.empty())
    {
      pixels.failures.insert(failures.begin(), failures.end());
      read = ReadVoxels(OpenStack(all, pixels.failures, options, found));
      return;
    }
    read.image = pixels.image;
    read.paddingValue = pixels.paddingValue;
    read.numberOfPaddingSamples = pixels.numberOfPaddingSamples;
  };
  return file;
}

UnreadScan
OpenSeries(const std::vector<DicomSlice> & slices, const ScanReadOptions & options, Scan scan)
{
  if (slices.front().kind == DicomSlice::Kind::Segmentation)
  {
    NoteCompression(slices, scan);
    return OpenDicomSegmentation(slices, options.maximumMemory, std::move(scan));
  }
  return OpenStack(slices, FindDamagedFiles(slices), options, std::move(scan));
}

UnreadScan
OpenSlices(const std::vector<DicomSlice> & slices, Scan scan, const fs::path & path, const ScanReadOptions & options)
{
  const std::vector<DicomSeries> series = GroupIntoSeries(slices);
  const SeriesChoice choice = ChooseSeries(series, options.series, path);
  scan.format = "DICOM";
  scan.series = Summarize(series, choice.index);
  scan.choice = choice.reason;
  scan.modality = scan.series[choice.index].modality;
  const auto others = NoteOthers(scan.series);
  scan.notes.insert(scan.notes.end(), others.begin(), others.end());
  std::set<fs::path> files; // of several slices each, if they are multi-frame
  for (const DicomSlice & slice : series[choice.index].slices)
  {
    files.insert(slice.file->path);
  }
  scan.files.assign(files.begin(), files.end());
  return OpenSeries(series[choice.index].slices, options, std::move(scan));
}

/** Opens a slice by itself (see ScanReadOptions::onSingleSlice). */
UnreadScan
OpenSingle(const DicomSlice & slice, const ScanReadOptions & options)
{
  const auto file = std::make_shared<DicomImageFile>(*slice.file);
  file->format.padding.reset();
  std::vector<DicomSlice> slices{ slice };
  slices.front().file = file;
  const itk::Vector<double, 3> steps[] = { slice.plane->columnStep,
                                           slice.plane->rowStep,
                                           NormalOf(*slice.plane) * slice.step };
  const VolumeGeometry geometry =
    MakeGeometry({ { file->format.columns, file->format.rows, 1 } }, slice.plane->position, steps);
  UnreadScan opened;
  opened.scan.format = "DICOM";
  opened.scan.modality = slice.modality;
  opened.scan.files = { file->path };
  opened.scan.scaling = DescribeScalingOf(slices);
  NoteCompression(slices, opened.scan);
  opened.scan.image = NewDicomImage(slices, geometry);
  opened.isTypeCertain = HoldsAllValues(opened.scan.image, slices);
  opened.readVoxels = [=](Scan & read) {
    const DicomPixels pixels = ReadDicomPixels(slices, geometry, options);
    FailIf(!pixels.failures.empty(),
           FailureKind::Unreadable,
           pixels.failures.empty() ? "" : pixels.failures.begin()->second);
    read.image = pixels.image;
  };
  return opened;
}

/** The slices of a folder; at least one. */
std::vector<DicomSlice>
ReadFolder(const fs::path & folder, const ScanReadOptions & options, Scan & scan)
{
  const FolderFiles files = ListFiles(folder, options.followsLinks);
  std::vector<DicomSlice> slices = CollectSlices(files, scan);
  if (slices.empty())
  {
    RefuseFolder(folder, files, scan);
  }
  return slices;
}

bool
IsSingle(const std::vector<DicomSlice> & slices)
{
  return slices.size() == 1 && slices.front().kind == DicomSlice::Kind::Scan;
}

/** The slices of a file that holds a volume, or a single slice if the options accept that. */
std::vector<DicomSlice>
ReadFile(const fs::path & path, const ScanReadOptions & options)
{
  std::vector<DicomSlice> slices = ReadDicomSlices(path);
  RefuseOtherIf(
    slices.empty(), path, "it is neither DICOM nor named like NIfTI, NRRD or MetaImage; check where it came from");
  const DicomSlice & first = slices.front();
  const std::string & damage = first.file->pixelDamage;
  if (!first.refusal.empty())
  {
    const auto refuse = first.isOther && damage.empty() ? RefuseOther : RefuseVolume;
    refuse(path, first.refusal + "; give a folder of plain CT, MR or PET slices");
  }
  RefuseVolumeIf(!damage.empty(), path, damage + "; copy it again from its source");
  FailIf(IsSingle(slices) && options.onSingleSlice == ScanReadOptions::Policy::Refuse,
         FailureKind::Geometry,
         "Cannot read " + path.string() +
           ": it is a single slice, which is no volume; give the folder of the whole series.");
  if (IsSingle(slices) && !first.plane)
  {
    const auto refuse = first.isOther ? RefuseOther : RefuseGeometry;
    refuse(path, first.planeProblem + "; export it again from its source");
  }
  return slices;
}

} // namespace

UnreadScan
OpenDicomFolder(const fs::path & folder, const ScanReadOptions & options)
{
  Scan scan;
  const std::vector<DicomSlice> slices = ReadFolder(folder, options, scan);
  return OpenSlices(slices, std::move(scan), folder, options);
}

UnreadScan
OpenDicomFile(const fs::path & path, const ScanReadOptions & options)
{
  const std::vector<DicomSlice> slices = ReadFile(path, options);
  return IsSingle(slices) ? OpenSingle(slices.front(), options) : OpenSlices(slices, Scan(), path, options);
}

SeriesList
ListDicomSeries(const fs::path & path, bool isFolder, const ScanReadOptions & options)
{
  Scan found;
  const std::vector<DicomSlice> slices = isFolder ? ReadFolder(path, options, found) : ReadFile(path, options);
  const std::vector<DicomSeries> series = GroupIntoSeries(slices);
  const auto choice = FindSeries(series, options.series, path);
  SeriesList list{ Summarize(series, choice ? choice->index : series.size()),
                   found.filesConsidered,
                   found.filesSkipped,
                   found.notes,
                   found.fileNotes };
  for (std::size_t i = 0; i < series.size(); ++i)
  {
    SeriesSummary & summary = list.series[i];
    try
    {
      const Scan scan = OpenSeries(series[i].slices, options, Scan()).scan;
      std::copy_n(GeometryOf(scan.image).GetLargestPossibleRegion().GetSize().begin(), 3, summary.size.begin());
      std::copy_n(GeometryOf(scan.image).GetSpacing().Begin(), 3, summary.spacing.begin());
    }
    catch (const Failure & failure)
    {
      summary.problem = summary.problem.empty() ? failure.GetDescription() : summary.problem;
    }
  }
  return list;
}

DicomExamination
ReadDicomExamination(const Scan & scan)
{
  if (scan.format != "DICOM" || scan.files.empty())
  {
    return {};
  }
  const auto header = ReadDicomHeader(
    scan.files.front(), { DicomTags::BodyPartExamined, DicomTags::Units, DicomTags::FrameOfReferenceUID });
  return header ? DicomExamination{ BodyPartOf(header->dataSet.GetText(DicomTags::BodyPartExamined)),
                                    UnitsOf(header->dataSet.GetText(DicomTags::Units)),
                                    header->dataSet.GetText(DicomTags::FrameOfReferenceUID) }
                : DicomExamination();
}

} // namespace rhombic
