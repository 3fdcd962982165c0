#include "rhombicLabelMap.h"

#include "rhombicForEachBlock.h"
#include "rhombicMemoryBudget.h"
#include "rhombicScanFormats.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkCastImageFilter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The table that was named, or that in or beside the label map. */
LabelTable
FindTable(const Scan & scan, const LabelMapSource & source)
{
  if (!source.table.empty())
  {
    FailIf(source.paths.size() > 1 ||
             (scan.format != "DICOM" && scan.format != "OME-Zarr" && fs::is_directory(source.GetFirstPath())),
           FailureKind::Usage,
           "The label table " + source.table.string() +
             " can't name the labels of several files, which are called as their files and numbered in their "
             "order; leave it out, or make one label map of them.");
    return ReadLabelTable(source.table);
  }
  if (!scan.labels.empty() || scan.format == "DICOM" || source.paths.size() != 1)
  {
    return scan.labels;
  }
  return FindLabelTable(source.paths.front()).value_or(LabelTable());
}

/** The label map, or all of them as one. */
UnreadScan
OpenLabels(const std::vector<fs::path> & paths, const ScanReadOptions & options)
{
  if (paths.size() == 1)
  {
    return OpenScan(paths.front(), options);
  }
  std::vector<fs::path> files;
  for (const fs::path & path : paths)
  {
    std::error_code error;
    const std::vector<fs::path> masks =
      fs::is_directory(path, error) ? FindMasks(path, options.followsLinks) : std::vector<fs::path>();
    files.insert(files.end(), masks.begin(), masks.end());
    if (masks.empty())
    {
      files.push_back(path);
    }
  }
  return OpenLabelFiles(files, options);
}

using ProbabilityImage = itk::Image<float, 3>;

/** A volume of a file. */
struct ProbabilityVolume
{
  fs::path path;
  std::size_t frame = 0;
};

/** The volumes of all files. Checks the memory that they take. */
std::vector<ProbabilityVolume>
FindVolumes(const std::vector<fs::path> & paths, ScanReadOptions options)
{
  constexpr std::size_t most = 4096;
  options.onSeveralFrames = ScanReadOptions::Policy::Accept;
  std::vector<ProbabilityVolume> volumes;
  double bytes = 0.0;
  double largest = 0.0; // of a volume as it is read, and of the labels
  for (const fs::path & path : paths)
  {
    const Scan scan = OpenScan(path, options).scan;
    const auto voxels = static_cast<double>(GeometryOf(scan.image).GetLargestPossibleRegion().GetNumberOfPixels());
    largest = std::max(largest, 6.0 * voxels);
    bytes += voxels * static_cast<double>(scan.numberOfFrames * sizeof(float));
    FailIf(scan.numberOfFrames > most - volumes.size(),
           FailureKind::Usage,
           "There can be 4096 volumes of probabilities; name fewer.");
    for (std::size_t frame = 0; frame < scan.numberOfFrames; ++frame)
    {
      volumes.push_back({ path, frame });
    }
  }
  RequireMemory(static_cast<std::uintmax_t>(bytes + largest),
                options.maximumMemory,
                "Reading " + std::to_string(volumes.size()) + " volumes of probabilities",
                "crop or coarsen them, or name fewer");
  return volumes;
}

void
CheckGrid(const Scan & scan, const Scan & first, const fs::path & path)
{
  const bool isUneven = !scan.sliceOrigins.empty();
  FailIf(isUneven || !AreSameGrids(GeometryOf(scan.image), GeometryOf(first.image)),
         FailureKind::Geometry,
         "Cannot use the probabilities in " + path.string() + ": " +
           (isUneven ? "its slices are unevenly spaced" : "its voxels are not those of the first volume") +
           "; resample all volumes to one grid.");
}

/** The voxels as float, in memory of their own. */
ProbabilityImage::Pointer
ToFloat(const ScanImage & image)
{
  return std::visit(
    [](const auto & pixels) -> ProbabilityImage::Pointer {
      using Filter = itk::CastImageFilter<typename std::decay_t<decltype(*pixels)>, ProbabilityImage>;
      const auto cast = Filter::New();
      cast->SetInput(pixels);
      cast->Update();
      ProbabilityImage::Pointer output = cast->GetOutput();
      output->DisconnectPipeline();
      return output;
    },
    image);
}

/** The value that stands for certainty: 1, 100 for percent, or 255. */
float
FindCertainty(const std::vector<ProbabilityImage::Pointer> & volumes)
{
  float lowest = 0.0f;
  float highest = 0.0f;
  for (const auto & volume : volumes)
  {
    const float * const begin = volume->GetBufferPointer();
    const auto [low, high] = std::minmax_element(begin, begin + volume->GetBufferedRegion().GetNumberOfPixels());
    lowest = std::min(lowest, *low);
    highest = std::max(highest, *high);
  }
  constexpr float rounding = 1.1f; // resampled maps overshoot
  for (const float certainty : { 1.0f, 100.0f, 255.0f })
  {
    if (highest <= rounding * certainty && lowest >= (1.0f - rounding) * certainty)
    {
      return certainty;
    }
  }
  throw Failure(FailureKind::Unreadable,
                "The volumes hold no probabilities: their values are from " + FormatNumber(lowest) + " to " +
                  FormatNumber(highest) + " and should be from 0 to 1, 100 or 255.");
}

/** The most probable label of each voxel, where label n + 1 has the n-th volume, and 0 what is left to certainty.
 * Divides the volumes by it. */
itk::Image<std::uint16_t, 3>::Pointer
FindMostProbable(const std::vector<ProbabilityImage::Pointer> & volumes, float certainty)
{
  const auto labels = itk::Image<std::uint16_t, 3>::New();
  labels->CopyInformation(volumes.front());
  labels->SetRegions(volumes.front()->GetBufferedRegion());
  labels->Allocate();
  ForEachInBlocks(volumes.front()->GetBufferedRegion().GetNumberOfPixels(), 4096, [&](std::size_t voxel) {
    float sum = 0.0f;
    float largest = 0.0f;
    std::size_t label = 0;
    for (std::size_t n = 0; n < volumes.size(); ++n)
    {
      float & value = volumes[n]->GetBufferPointer()[voxel];
      value = std::clamp(value / certainty, 0.0f, 1.0f);
      sum += value;
      if (value > largest)
      {
        largest = value;
        label = n + 1;
      }
    }
    labels->GetBufferPointer()[voxel] = static_cast<std::uint16_t>(largest > 1.0f - sum ? label : 0);
  });
  return labels;
}

/** The table that was named, or that of a single file. Others have no names: files' names may be the patient's. */
LabelTable
FindNames(const LabelMapSource & source)
{
  if (!source.table.empty())
  {
    return ReadLabelTable(source.table);
  }
  return source.probabilities.size() > 1 ? LabelTable()
                                         : FindLabelTable(source.probabilities.front()).value_or(LabelTable());
}

/** Reads volumes of probabilities as a label map of the most probable labels (see LabelMapSource::probabilities).
 * Throws Failure as OpenScan() does, and: Geometry for volumes with other voxels than the first, or with unevenly
 * spaced slices; Unreadable for values more than a tenth beyond their range; Memory; Usage for more than 4096 volumes.
 */
LabelMap
ReadProbabilities(const LabelMapSource & source, ScanReadOptions options)
{
  const std::vector<ProbabilityVolume> volumes = FindVolumes(source.probabilities, options);
  LabelMap map;
  for (const ProbabilityVolume & volume : volumes)
  {
    options.frame = volume.frame;
    const Scan scan = ReadVoxels(OpenScan(volume.path, options));
    if (map.probabilities.empty())
    {
      map.scan = WithoutVoxels(scan);
    }
    else if (volume.frame == 0)
    {
      map.scan.files.insert(map.scan.files.end(), scan.files.begin(), scan.files.end());
    }
    for (const std::string & note : scan.notes)
    {
      if (std::find(map.scan.notes.begin(), map.scan.notes.end(), note) == map.scan.notes.end())
      {
        map.scan.notes.push_back(note);
      }
    }
    CheckGrid(scan, map.scan, volume.path);
    map.probabilities.push_back(ToFloat(scan.image));
    map.probabilities.back()->CopyInformation(map.probabilities.front());
  }
  const float certainty = FindCertainty(map.probabilities);
  map.scan.image = FindMostProbable(map.probabilities, certainty);
  if (certainty > 1.0f)
  {
    map.scan.notes.push_back("probabilities: values up to " + std::to_string(std::lround(certainty)) +
                             " stand for certainty");
  }
  map.labels = SummarizeLabels(map.scan, FindNames(source));
  const double voxel = VoxelVolumes(map.scan).front() / CubicMillimetresPerMl;
  for (LabelSummary & summary : map.labels)
  {
    const auto & volume = *map.probabilities[static_cast<std::size_t>(summary.label.value - 1)];
    const float * const begin = volume.GetBufferPointer();
    summary.millilitres = voxel * std::accumulate(begin, begin + volume.GetBufferedRegion().GetNumberOfPixels(), 0.0);
  }
  return map;
}

} // namespace

bool
IsLabelMap(const Scan & scan)
{
  return !scan.labels.empty() || LooksLikeLabelMap(scan);
}

std::vector<LabelSummary>
FindLabels(const Scan & scan, const LabelMapSource & source)
{
  LabelTable table = FindTable(scan, source);
  if (!table.empty())
  {
    return SummarizeLabels(scan, table);
  }
  FailIf(!LooksLikeLabelMap(scan),
         FailureKind::Unreadable,
         "Cannot take " + source.GetFirstPath().string() +
           " for a label map: its values look like intensities; if it is one, give a LabelMapSource::table.");
  const bool isFile = source.paths.size() == 1 && !VolumeFormatOf(source.paths.front()).empty();
  table = isFile ? FindDatasetTable(source.paths.front()).value_or(LabelTable()) : table;
  std::vector<LabelSummary> labels = SummarizeLabels(scan, table);
  if (isFile && source.namesMask && table.empty() && IsMask(labels))
  {
    Label & label = labels.front().label;
    label = NamedLabel(label.value, StemOfVolume(source.paths.front()));
  }
  return labels;
}

LabelMap
ReadLabelMap(const LabelMapSource & source,
             const ScanReadOptions & options,
             const Scan & scan,
             const std::filesystem::path & scanPath)
{
  ScanReadOptions mapOptions = options;
  mapOptions.series.clear(); // chosen for the scan, not for the map
  mapOptions.frame.reset();
  mapOptions.level = 0;
  mapOptions.voxelSize.reset();
  mapOptions.raw.reset();
  LabelMap map;
  if (source.probabilities.empty())
  {
    map.scan = ReadVoxels(OpenLabels(source.paths, mapOptions));
    map.labels = FindLabels(map.scan, source);
  }
  else
  {
    map = ReadProbabilities(source, mapOptions);
  }
  if (const std::string note = RequireOverlap(scan, map.scan, scanPath, source.GetFirstPath()); !note.empty())
  {
    map.scan.notes.push_back(note);
  }
  return map;
}

} // namespace rhombic
