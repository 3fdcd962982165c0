#include "rhombicDenoising.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicEvents.h"
#include "rhombicWording.h"

#include "itkGradientAnisotropicDiffusionImageFilter.h"
#include "itkFCCGaussianImageFilter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace rhombic
{
namespace
{

using RealImage = itk::Image<float, 3>;

bool
IsPositive(double number)
{
  return number > 0.0 && std::isfinite(number);
}

/** An image of the same grid, with the values that \a convert makes of the image's. */
template <typename TOutput, typename TInput, typename TConvert>
typename TOutput::Pointer
Converted(const TInput & image, const TConvert & convert)
{
  const auto output = TOutput::New();
  output->CopyInformation(&image);
  output->SetRegions(image.GetBufferedRegion());
  output->Allocate();
  const auto * const begin = image.GetBufferPointer();
  std::transform(begin, begin + image.GetBufferedRegion().GetNumberOfPixels(), output->GetBufferPointer(), convert);
  return output;
}

/** Throws Failure(Unreadable) for values that are not finite. */
template <typename TPixel>
RealImage::Pointer
ToReal(const itk::Image<TPixel, 3> & image)
{
  return Converted<RealImage>(image, [](TPixel sample) {
    const auto value = static_cast<float>(sample);
    if (std::is_floating_point_v<TPixel> && !std::isfinite(value))
    {
      throw Failure(FailureKind::Unreadable,
                    "The scan has values that are not finite, which edge-preserving smoothing would spread; use "
                    "Denoising::Kind::Gaussian, which leaves them out.");
    }
    return value;
  });
}

/** The steps of ITK's explicit scheme: short enough to be stable, and as many as smooth regions without edges by sigma.
 */
struct Steps
{
  unsigned int count;
  double length;
};

/** ITK's scheme multiplies differences by 1 / spacing once, where a diffusion in mm does so twice: its time is in mm,
 * and a step adds 2 length spacing to sigma^2 along each axis. ITK warns of steps beyond a 16th of the smallest
 * spacing. */
Steps
FindSteps(double sigma, const RealImage::SpacingType & spacing)
{
  constexpr double mostSteps = 1000.0;
  constexpr double margin = 0.9;
  const double finest = *std::min_element(spacing.Begin(), spacing.End());
  const double time = sigma * sigma / (2.0 * finest);
  const double count = std::ceil(time / (margin * finest / 16.0));
  if (!(count <= mostSteps))
  {
    throw Failure(FailureKind::Usage,
                  "Edge-preserving smoothing over " + FormatNumber(sigma) + " mm would take " +
                    std::to_string(static_cast<std::uintmax_t>(std::min(count, 1e18))) +
                    " steps at this scan's spacing; use a smaller sigma, or Denoising::Kind::Gaussian.");
  }
  return { static_cast<unsigned int>(count), time / count };
}

/** "35 seconds", "2 minutes". */
std::string
DescribeDuration(double seconds)
{
  const bool isShort = seconds < 100.0;
  return Count(static_cast<std::uintmax_t>(std::lround(isShort ? seconds : seconds / 60.0)),
               isShort ? "second" : "minute");
}

/** After the filter's first iteration, notes how long all of them will take, if that is long. */
template <typename TFilter>
void
AnnounceDuration(TFilter & filter, const Events & events)
{
  constexpr double worthSaying = 10.0; // s
  const auto start = std::chrono::steady_clock::now();
  filter.AddObserver(itk::IterationEvent(), [&filter, &events, start](const itk::EventObject &) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    const double seconds = passed.count() * filter.GetNumberOfIterations();
    if (filter.GetElapsedIterations() == 1 && seconds >= worthSaying)
    {
      events.Note("edge-preserving smoothing takes about " + DescribeDuration(seconds));
    }
  });
}

RealImage::Pointer
KeepEdges(RealImage::Pointer image, const Denoising & denoising, const Events & events)
{
  const Steps steps = FindSteps(denoising.sigma, image->GetSpacing());
  const auto filter = itk::GradientAnisotropicDiffusionImageFilter<RealImage, RealImage>::New();
  filter->SetNumberOfIterations(steps.count);
  filter->SetTimeStep(steps.length);
  filter->SetFixedAverageGradientMagnitude(denoising.edge);
  filter->SetConductanceParameter(1.0); // relative to that gradient
  filter->InPlaceOn();
  filter->SetInput(image);
  ObserveProgress(*filter, "smoothing", events);
  AnnounceDuration(*filter, events);
  filter->Update();
  return filter->GetOutput();
}

} // namespace

void
CheckDenoising(const Denoising & denoising)
{
  if (denoising.kind != Denoising::Kind::None && !IsPositive(denoising.sigma))
  {
    throw Failure(FailureKind::Usage, "Denoising::sigma must be a positive number of mm; try 0.7.");
  }
  if (denoising.kind == Denoising::Kind::EdgePreserving && !IsPositive(denoising.edge))
  {
    throw Failure(
      FailureKind::Usage,
      "Denoising::edge, the least gradient of an edge in the scan's units per mm, must be a positive number; "
      "try 60.");
  }
}

ScanImage
DenoiseScan(const ScanImage & image, const Denoising & denoising, std::uintmax_t maximumMemory, const Events & events)
{
  CheckDenoising(denoising);
  if (denoising.kind != Denoising::Kind::EdgePreserving)
  {
    return image;
  }
  return std::visit(
    [&](const auto & input) -> ScanImage {
      using PixelType = typename std::decay_t<decltype(*input)>::PixelType;
      const std::uintmax_t samples = input->GetBufferedRegion().GetNumberOfPixels();
      RequireMemory(samples * (2 * sizeof(float) + sizeof(PixelType)),
                    maximumMemory,
                    "Edge-preserving smoothing",
                    "use Denoising::Kind::Gaussian");
      const RealImage::Pointer smooth = KeepEdges(ToReal(*input), denoising, events);
      return Converted<itk::Image<PixelType, 3>>(*smooth,
                                                 [](float value) { return itk::RoundAndClamp<PixelType>(value); });
    },
    image);
}

FCCVolume
ConnectDenoising(const FCCVolume & volume, const Denoising & denoising, itk::ProcessObject::Pointer & filter)
{
  CheckDenoising(denoising);
  return std::visit(
    [&](const auto & input) -> FCCVolume {
      using ImageType = typename std::decay_t<decltype(*input)>;
      const auto gaussian = itk::FCCGaussianImageFilter<ImageType>::New();
      gaussian->SetInput(input);
      gaussian->SetSigma(denoising.sigma);
      filter = gaussian;
      try
      {
        gaussian->UpdateOutputInformation();
      }
      catch (const itk::ExceptionObject & error)
      {
        throw Failure(FailureKind::Usage, DescribeError(error) + " (Denoising::sigma).");
      }
      const typename ImageType::Pointer output = gaussian->GetOutput();
      return output;
    },
    volume);
}

FCCVolume
DenoiseLattice(const FCCVolume & volume,
               const Denoising & denoising,
               std::uintmax_t maximumMemory,
               const Events & events)
{
  CheckDenoising(denoising);
  if (denoising.kind == Denoising::Kind::None)
  {
    return volume;
  }
  if (denoising.kind == Denoising::Kind::EdgePreserving)
  {
    throw Failure(FailureKind::Usage,
                  "Edge-preserving smoothing works on a scan, before it gets onto the lattice; use "
                  "Denoising::Kind::Gaussian for a lattice volume.");
  }
  return std::visit(
    [&](const auto & input) -> FCCVolume {
      using ImageType = typename std::decay_t<decltype(*input)>;
      RequireMemory(input->GetBufferedRegion().GetNumberOfPixels() * sizeof(typename ImageType::PixelType),
                    maximumMemory,
                    "Smoothing",
                    "leave out Denoising");
      itk::ProcessObject::Pointer filter;
      const auto output = std::get<typename ImageType::Pointer>(ConnectDenoising(input, denoising, filter));
      ObserveProgress(*filter, "smoothing", events);
      output->Update();
      output->DisconnectPipeline();
      return output;
    },
    volume);
}

} // namespace rhombic
