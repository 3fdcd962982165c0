#include "rhombicProbabilities.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicWording.h"

#include "itkCastImageFilter.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

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
    if (scan.numberOfFrames > most - volumes.size())
    {
      throw Failure(FailureKind::Usage, "There can be 4096 volumes of probabilities; name fewer.");
    }
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
  if (isUneven || !AreSameGrids(GeometryOf(scan.image), GeometryOf(first.image)))
  {
    throw Failure(FailureKind::Geometry,
                  "Cannot use the probabilities in " + path.string() + ": " +
                    (isUneven ? "its slices are unevenly spaced" : "its voxels are not those of the first volume") +
                    "; resample all volumes to one grid.");
  }
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
                "The volumes hold no probabilities: their values are from " + std::to_string(lowest) + " to " +
                  std::to_string(highest) + " and should be from 0 to 1, 100 or 255.");
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

} // namespace

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

} // namespace rhombic
