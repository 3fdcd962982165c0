#include "rhombicIntensities.h"

#include "rhombicFailure.h"
#include "rhombicMappedVoxels.h"

#include "rhombicForEachBlock.h"
#include "itkHistogram.h"
#include "itkOtsuThresholdCalculator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

namespace rhombic
{
namespace
{

using Histogram = itk::Statistics::Histogram<double>;

/** The bin of the histogram that separates two classes best; whole numbers are split between two of them. */
double
OtsuThreshold(const Histogram * histogram, bool isInteger)
{
  const auto calculator = itk::OtsuThresholdCalculator<Histogram, double>::New();
  calculator->SetInput(histogram);
  calculator->Compute();
  const double threshold = calculator->GetThreshold();
  return isInteger ? std::floor(threshold) + 0.5 : threshold;
}

constexpr std::size_t ValuesOfBlock = std::size_t{ 1 } << 18;
constexpr std::size_t Bins = 256;

template <typename TPixel>
bool
IsCounted(TPixel value)
{
  return std::is_integral_v<TPixel> || std::isfinite(static_cast<double>(value));
}

/** The lowest and the highest finite value. */
template <typename TPixel>
std::pair<TPixel, TPixel>
FindRange(const TPixel * values, std::size_t count)
{
  constexpr TPixel least = std::numeric_limits<TPixel>::lowest();
  constexpr TPixel most = std::numeric_limits<TPixel>::max();
  std::pair<TPixel, TPixel> range{ most, least };
  std::mutex mutex;
  ForEachBlock(count, ValuesOfBlock, [&](std::size_t begin, std::size_t end) {
    TPixel lowest = most, highest = least;
    for (std::size_t n = begin; n < end; ++n)
    {
      lowest = IsCounted(values[n]) ? std::min(lowest, values[n]) : lowest;
      highest = IsCounted(values[n]) ? std::max(highest, values[n]) : highest;
    }
    const std::lock_guard<std::mutex> lock(mutex);
    range = { std::min(range.first, lowest), std::max(range.second, highest) };
  });
  return range;
}

/** Histogram of the values from lowest to highest; others are left out. */
template <typename TPixel>
Histogram::Pointer
MakeHistogram(const TPixel * values, std::size_t count, double lowest, double highest)
{
  using Frequencies = std::array<itk::SizeValueType, Bins>;
  Frequencies frequencies{};
  std::mutex mutex;
  const double scale = static_cast<double>(Bins) / (highest - lowest);
  ForEachBlock(count, ValuesOfBlock, [&](std::size_t begin, std::size_t end) {
    Frequencies ofBlock{};
    for (std::size_t n = begin; n < end; ++n)
    {
      if (IsCounted(values[n]) && static_cast<double>(values[n]) >= lowest && static_cast<double>(values[n]) <= highest)
      {
        const auto bin = static_cast<std::size_t>((static_cast<double>(values[n]) - lowest) * scale);
        ++ofBlock[std::min(bin, Bins - 1)];
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    std::transform(ofBlock.begin(), ofBlock.end(), frequencies.begin(), frequencies.begin(), std::plus<>());
  });
  const auto histogram = Histogram::New();
  Histogram::SizeType size(1);
  Histogram::MeasurementVectorType low(1);
  Histogram::MeasurementVectorType high(1);
  size[0] = Bins;
  low[0] = lowest;
  high[0] = highest;
  histogram->SetMeasurementVectorSize(1);
  histogram->Initialize(size, low, high);
  for (std::size_t bin = 0; bin < Bins; ++bin)
  {
    histogram->SetFrequency(bin, frequencies[bin]);
  }
  return histogram;
}

/** Called behind a part of the values. */
using PartDone = std::function<void()>;

/** FindRange() of one part of the values after the other. */
template <typename TPixel>
std::pair<TPixel, TPixel>
FindRangeOfParts(const TPixel * values, std::size_t count, const PartDone & partDone)
{
  constexpr std::size_t part = std::size_t{ 1 } << 26;
  std::pair<TPixel, TPixel> range{ std::numeric_limits<TPixel>::max(), std::numeric_limits<TPixel>::lowest() };
  for (std::size_t begin = 0; begin < count; begin += part)
  {
    const auto [lowest, highest] = FindRange(values + begin, std::min(part, count - begin));
    range = { std::min(range.first, lowest), std::max(range.second, highest) };
    partDone();
  }
  return range;
}

template <typename TPixel>
Intensities
Compute(const TPixel * values, std::size_t count, bool findsOtsu, const PartDone & partDone)
{
  const auto [lowest, highest] = FindRangeOfParts(values, count, partDone);
  Intensities found;
  found.lowest = found.otsu = found.lowOtsu = found.lowestOtsu = found.highOtsu = static_cast<double>(lowest);
  found.highest = static_cast<double>(highest);
  if (found.lowest > found.highest)
  {
    throw Failure(FailureKind::Unreadable, "The scan has no finite values; check that it was exported completely.");
  }
  if (findsOtsu && found.lowest < found.highest)
  {
    constexpr bool isInteger = std::is_integral_v<TPixel>;
    const auto otsuBetween = [&](double low, double high) {
      return OtsuThreshold(MakeHistogram(values, count, low, high), isInteger);
    };
    found.otsu = otsuBetween(found.lowest, found.highest);
    found.lowOtsu = otsuBetween(found.lowest, found.otsu);
    found.lowestOtsu = otsuBetween(found.lowest, found.lowOtsu);
    found.highOtsu = otsuBetween(found.otsu, found.highest);
  }
  return found;
}

template <typename TVolume>
Intensities
ComputeOfAny(const TVolume & volume, bool findsOtsu, const PartDone & partDone)
{
  return std::visit(
    [&](const auto & image) {
      return Compute(image->GetBufferPointer(), image->GetBufferedRegion().GetNumberOfPixels(), findsOtsu, partDone);
    },
    volume);
}

} // namespace

Intensities
ComputeIntensities(const ScanImage & image, bool findsOtsu)
{
  return ComputeOfAny(image, findsOtsu, [&image] { DropPages(image); });
}

Intensities
ComputeIntensities(const FCCVolume & volume, bool findsOtsu)
{
  return ComputeOfAny(volume, findsOtsu, [] {});
}

} // namespace rhombic
