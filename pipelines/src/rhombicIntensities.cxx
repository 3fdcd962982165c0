#include "rhombicIntensities.h"

#include "rhombicFailure.h"

#include "itkHistogram.h"
#include "itkOtsuThresholdCalculator.h"

#include <cmath>
#include <limits>

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

template <typename TPixel>
Intensities
Compute(const TPixel * values, std::size_t count)
{
  Intensities found;
  found.lowest = std::numeric_limits<double>::infinity();
  found.highest = -found.lowest;
  const auto isCounted = [](TPixel value) {
    return std::is_integral_v<TPixel> || std::isfinite(static_cast<double>(value));
  };
  for (std::size_t n = 0; n < count; ++n)
  {
    if (isCounted(values[n]))
    {
      found.lowest = std::min(found.lowest, static_cast<double>(values[n]));
      found.highest = std::max(found.highest, static_cast<double>(values[n]));
    }
  }
  if (found.lowest > found.highest)
  {
    throw Failure(FailureKind::Unreadable, "The scan has no finite values; check that it was exported completely.");
  }
  if (found.lowest == found.highest)
  {
    found.otsu = found.lowest;
    return found;
  }

  constexpr std::size_t bins = 256;
  std::vector<itk::SizeValueType> frequencies(bins, 0);
  const double scale = static_cast<double>(bins) / (found.highest - found.lowest);
  for (std::size_t n = 0; n < count; ++n)
  {
    if (isCounted(values[n]))
    {
      const auto bin = static_cast<std::size_t>((static_cast<double>(values[n]) - found.lowest) * scale);
      ++frequencies[std::min(bin, bins - 1)];
    }
  }
  const auto histogram = Histogram::New();
  Histogram::SizeType size(1);
  Histogram::MeasurementVectorType low(1);
  Histogram::MeasurementVectorType high(1);
  size[0] = bins;
  low[0] = found.lowest;
  high[0] = found.highest;
  histogram->SetMeasurementVectorSize(1);
  histogram->Initialize(size, low, high);
  for (std::size_t bin = 0; bin < bins; ++bin)
  {
    histogram->SetFrequency(bin, frequencies[bin]);
  }
  found.otsu = OtsuThreshold(histogram, std::is_integral_v<TPixel>);
  return found;
}

template <typename TVolume>
Intensities
ComputeOfAny(const TVolume & volume)
{
  return std::visit(
    [](const auto & image) {
      return Compute(image->GetBufferPointer(), image->GetBufferedRegion().GetNumberOfPixels());
    },
    volume);
}

} // namespace

Intensities
ComputeIntensities(const ScanImage & image)
{
  return ComputeOfAny(image);
}

Intensities
ComputeIntensities(const FCCVolume & volume)
{
  return ComputeOfAny(volume);
}

} // namespace rhombic
