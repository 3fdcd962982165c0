#include "rhombicDicomStack.h"

#include "rhombicFailure.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicVoxelGrid.h"
#include "rhombicWording.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using Slices = std::vector<DicomSlice>;
using Vector = itk::Vector<double, 3>;
using Policy = ScanReadOptions::Policy;

[[noreturn]] void
Refuse(const Slices & slices, const std::string & why, const std::string & advice)
{
  throw Failure(FailureKind::Geometry,
                "The slices in " + slices.front().file->path.parent_path().string() +
                  " make no regular volume: " + why + "; " + advice + ".");
}

/** The names of two files, with their folders if these differ. */
std::string
NamesOf(const DicomSlice & first, const DicomSlice & second)
{
  const auto folder = [](const DicomSlice & slice) { return slice.file->path.parent_path(); };
  const bool areTogether = folder(first) == folder(second);
  const auto name = [&](const DicomSlice & slice) {
    return areTogether ? NameOf(slice) : (folder(slice) / NameOf(slice)).string();
  };
  return name(first) + " and " + name(second);
}

void
RequirePlanes(const Slices & slices)
{
  for (const DicomSlice & slice : slices)
  {
    RefuseGeometryIf(!slice.plane, slice.file->path, slice.planeProblem + "; export the series again from its source");
  }
  FailIf(slices.size() < 2,
         FailureKind::Geometry,
         "There is only one slice, " + slices.front().file->path.string() +
           ", in the series, and one slice is no volume; give the folder of the whole series.");
}

/** Sorts by the distance along the normal, and returns the distances. */
std::vector<double>
SortAlongNormal(Slices & slices)
{
  const Vector normal = NormalOf(*slices.front().plane);
  const auto distance = [&normal](const DicomSlice & slice) {
    return slice.plane->position.GetVectorFromOrigin() * normal;
  };
  std::sort(slices.begin(), slices.end(), [&distance](const DicomSlice & first, const DicomSlice & second) {
    const auto key = [&](const DicomSlice & slice) { return std::tie(slice.file->path, slice.frame); };
    const double difference = distance(first) - distance(second);
    return difference < 0 || (difference == 0 && key(first) < key(second));
  });
  std::vector<double> distances;
  std::transform(slices.begin(), slices.end(), std::back_inserter(distances), distance);
  return distances;
}

double
MedianOf(std::vector<double> steps)
{
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/** The index of the first step of about 0; the number of steps when there is none. */
std::size_t
FindDuplicate(const std::vector<double> & steps)
{
  constexpr double smallest = 1e-6; // millimetres
  std::vector<double> actual;
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(actual), [](double step) { return step > smallest; });
  const double none = std::max(smallest, actual.empty() ? 0 : 0.01 * MedianOf(actual));
  const auto found = std::find_if(steps.begin(), steps.end(), [none](double step) { return step <= none; });
  return static_cast<std::size_t>(found - steps.begin());
}

std::vector<SliceBlock>
FindBlocks(const std::vector<double> & steps)
{
  std::vector<SliceBlock> blocks;
  for (const double step : steps)
  {
    if (blocks.empty() || std::abs(step - blocks.back().step) > EvenSliceTolerance(step))
    {
      blocks.push_back({ 0, step });
    }
    SliceBlock & block = blocks.back();
    const auto count = static_cast<double>(block.numberOfSteps);
    block.step = (block.step * count + step) / (count + 1);
    ++block.numberOfSteps;
  }
  return blocks;
}

/** The larger of two medians: of up to five steps before step \a i, and of up to five after it. A step that is much
 * larger than both is a gap, and not the border between two blocks of slices with different steps. */
double
UsualStepAround(const std::vector<double> & steps, std::size_t i)
{
  constexpr std::size_t reach = 5;
  const auto step = steps.begin() + static_cast<std::ptrdiff_t>(i);
  const auto before = static_cast<std::ptrdiff_t>(std::min(reach, i));
  const auto after = static_cast<std::ptrdiff_t>(std::min(reach, steps.size() - 1 - i));
  const double medianBefore = before > 0 ? MedianOf({ step - before, step }) : 0;
  const double medianAfter = after > 0 ? MedianOf({ step + 1, step + 1 + after }) : 0;
  return std::max(medianBefore, medianAfter);
}

/** Whether a step is a multiple of the stack's usual step, with usual steps on both its sides: then slices are missing,
 * even if many steps of the stack are gaps. */
bool
IsMultipleAmidUsual(const std::vector<double> & steps, std::size_t i, double usual)
{
  constexpr double tolerance = 0.05; // relative to a step
  const auto isUsual = [usual](double step) { return std::abs(step - usual) <= tolerance * usual; };
  const auto step = steps.begin() + static_cast<std::ptrdiff_t>(i);
  const double ratio = std::round(*step / usual);
  return ratio >= 2 && std::abs(*step - ratio * usual) <= tolerance * usual &&
         std::any_of(steps.begin(), step, isUsual) && std::any_of(step, steps.end(), isUsual);
}

std::vector<SliceGap>
FindGaps(const std::vector<double> & distances, const std::vector<double> & steps)
{
  constexpr double abrupt = 1.9; // relative to the steps around it
  const double usual = MedianOf(steps);
  std::vector<SliceGap> gaps;
  for (std::size_t i = 0; i < steps.size() && steps.size() > 1; ++i)
  {
    const bool isMultiple = IsMultipleAmidUsual(steps, i, usual);
    const double around = isMultiple ? usual : UsualStepAround(steps, i);
    if (isMultiple || steps[i] >= abrupt * around)
    {
      gaps.push_back({ distances[i], steps[i], static_cast<std::size_t>(std::lround(steps[i] / around)) - 1 });
    }
  }
  return gaps;
}

/** The sideways shift of slices for each millimetre along their normal: the median of all steps, in each coordinate. */
Vector
SlopeOf(const Slices & slices, const std::vector<double> & steps, const Vector & normal)
{
  Vector slope;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> slopes;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      const Vector step = slices[i + 1].plane->position - slices[i].plane->position;
      slopes.push_back((step[axis] - normal[axis] * steps[i]) / steps[i]);
    }
    slope[axis] = MedianOf(slopes);
  }
  return slope;
}

/** Refuses slices that are not on a line: adjacent slices with a sideways shift of more than a pixel beyond the median
 * shift, and lines with a larger tilt than any gantry's. */
void
RequireLine(const Slices & slices, const std::vector<double> & steps)
{
  constexpr double steepest = 1.73; // a tilt of 60 degrees
  const SlicePlane & first = *slices.front().plane;
  const double pixel = std::min(first.columnStep.GetNorm(), first.rowStep.GetNorm());
  const Vector normal = NormalOf(first);
  const Vector slope = SlopeOf(slices, steps, normal);
  const std::string advice = "put slices that belong together into a folder of their own";
  if (slope.GetNorm() > steepest)
  {
    Refuse(slices,
           "they are shifted sideways by " + FormatNumber(slope.GetNorm(), 4) +
             " mm for each mm between them, more than a tilt",
           advice);
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const Vector step = slices[i + 1].plane->position - slices[i].plane->position;
    const double jump = (step - (normal + slope) * steps[i]).GetNorm();
    if (jump > pixel + EvenSliceTolerance(steps[i]))
    {
      Refuse(slices,
             NamesOf(slices[i], slices[i + 1]) + " are shifted sideways by " + FormatNumber(jump, 4) +
               " mm against each other, which no tilt explains",
             advice);
    }
  }
}

/** The angle between the slices' normal and the line from the first to the last. */
double
TiltOf(const Slices & slices, double normalExtent)
{
  const Vector line = slices.back().plane->position - slices.front().plane->position;
  return std::acos(std::min(1.0, normalExtent / line.GetNorm()));
}

/** The number of missing slices, and their position. */
std::string
DescribeGaps(const std::vector<SliceGap> & gaps)
{
  const SliceGap & gap = gaps.front();
  return Count(gap.numberOfMissing, "slice is", "slices are") + " missing at " +
         FormatNumber(gap.position + gap.step / static_cast<double>(gap.numberOfMissing + 1), 4) + " mm" +
         (gaps.size() > 1 ? " and in " + Count(gaps.size() - 1, "more place") : "");
}

/** The names of the files on both sides of a gap. */
std::string
NamesAround(const Slices & slices, const std::vector<double> & distances, const SliceGap & gap)
{
  const auto after = std::upper_bound(distances.begin(), distances.end(), gap.position);
  const auto index = static_cast<std::size_t>(after - distances.begin());
  return NamesOf(slices[index - 1], slices[index]);
}

std::string
DescribeBlocks(const std::vector<SliceBlock> & blocks)
{
  constexpr std::size_t named = 4;
  std::string text;
  for (std::size_t n = 0; n < std::min(named, blocks.size()); ++n)
  {
    text +=
      (n > 0 ? ", " : "") + std::to_string(blocks[n].numberOfSteps) + " of " + FormatNumber(blocks[n].step, 4) + " mm";
  }
  return text + (blocks.size() > named ? ", ..." : "");
}

/** A note on gaps. Throws Failure when they are not accepted. */
std::string
AcceptGaps(const Slices & slices,
           const std::vector<double> & distances,
           const std::vector<SliceGap> & gaps,
           const ScanReadOptions & options)
{
  const std::string description = DescribeGaps(gaps);
  if (options.onGap == Policy::Refuse)
  {
    Refuse(slices,
           description + (gaps.size() > 1 ? ", the first between " : ", between ") +
             NamesAround(slices, distances, gaps.front()),
           "find the missing files, or take values across the gap with ScanReadOptions::onGap");
  }
  return "Values are interpolated where slices are missing: " + description + ".";
}

/** A note on uneven steps. Throws Failure when they are not accepted. \a offLine is in mm. */
std::string
AcceptUnevenSteps(const Slices & slices,
                  const std::vector<SliceBlock> & blocks,
                  double offLine,
                  const ScanReadOptions & options)
{
  const std::string description = "the steps between them are uneven: " + DescribeBlocks(blocks) +
                                  "; slices are up to " + FormatNumber(offLine, 4) + " mm off a regular line";
  if (options.onUneven == Policy::Refuse)
  {
    Refuse(slices,
           description,
           "accept ScanReadOptions::onUneven, in ITK pipelines by reader->AcceptUnevenOn() and "
           "lattice->SetScan(reader->GetScan()), to have them resampled from their true positions");
  }
  return "The slices are resampled from their true positions, because " + description + ".";
}

/** A note on a tilt. Throws Failure when it is not accepted. */
std::string
AcceptTilt(const Slices & slices, double degrees, const ScanReadOptions & options)
{
  const std::string description =
    "they are sheared by " + FormatNumber(degrees, 4) + " degrees against their normal, as a tilted CT gantry does";
  if (options.onTilted == Policy::Refuse)
  {
    Refuse(slices, description, "accept ScanReadOptions::onTilted to have them resampled from their true positions");
  }
  return "The slices are resampled from their true positions: " + description + ".";
}

} // namespace

std::vector<double>
StepsOf(const std::vector<double> & distances)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < distances.size(); ++i)
  {
    steps.push_back(distances[i] - distances[i - 1]);
  }
  return steps;
}

bool
HaveDuplicates(const std::vector<DicomSlice> & slices)
{
  Slices sorted = slices;
  const auto hasPlane = [](const DicomSlice & slice) { return slice.plane.has_value(); };
  if (slices.size() < 2 || !std::all_of(slices.begin(), slices.end(), hasPlane))
  {
    return false;
  }
  const auto steps = StepsOf(SortAlongNormal(sorted));
  return FindDuplicate(steps) < steps.size();
}

DicomStack
StackSlices(std::vector<DicomSlice> & slices, const ScanReadOptions & options)
{
  RequirePlanes(slices);
  const std::vector<double> distances = SortAlongNormal(slices);
  const std::vector<double> steps = StepsOf(distances);
  if (const std::size_t i = FindDuplicate(steps); i < steps.size())
  {
    Refuse(slices,
           NamesOf(slices[i], slices[i + 1]) + " are at the same place",
           "put one set of slices into a folder of its own");
  }
  RequireLine(slices, steps);

  DicomStack stack;
  stack.report.tiltDegrees = TiltOf(slices, distances.back() - distances.front()) * 180 / itk::Math::pi;
  stack.report.firstPosition = distances.front();
  stack.report.lastPosition = distances.back();
  stack.report.blocks = FindBlocks(steps);
  stack.report.gaps = FindGaps(distances, steps);

  std::vector<itk::Point<double, 3>> origins;
  for (const DicomSlice & slice : slices)
  {
    origins.push_back(slice.plane->position);
  }
  const double offLine = DistanceFromEvenSlices(origins);
  const bool isEven = offLine <= EvenSliceTolerance(MedianOf(steps));
  if (!isEven && !stack.report.gaps.empty())
  {
    stack.notes.push_back(AcceptGaps(slices, distances, stack.report.gaps, options));
  }
  else if (!isEven)
  {
    stack.notes.push_back(AcceptUnevenSteps(slices, stack.report.blocks, offLine, options));
  }
  if (stack.report.tiltDegrees * itk::Math::pi / 180 > 1e-3)
  {
    stack.notes.push_back(AcceptTilt(slices, stack.report.tiltDegrees, options));
  }
  const SlicePlane & first = *slices.front().plane;
  const Vector step = (origins.back() - origins.front()) / static_cast<double>(steps.size());
  const itk::Size<3> size{ { slices.front().file->format.columns, slices.front().file->format.rows, slices.size() } };
  const Vector axes[3] = { first.columnStep, first.rowStep, step };
  stack.geometry = MakeGeometry(size, first.position, axes);
  stack.sliceOrigins = isEven ? std::vector<itk::Point<double, 3>>() : std::move(origins);
  return stack;
}

} // namespace rhombic
