#include "rhombicScanToLattice.h"

#include "rhombicFailure.h"
#include "rhombicMappedVoxels.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPatientAxes.h"
#include "rhombicEvents.h"
#include "rhombicWording.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"
#include "itkFCCToCartesianImageFilter.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** Bytes of the scan that the limit counts: those in memory, if the limit is given and not a share of what is free. */
std::uintmax_t
CountScanBytes(const Scan & scan, const LatticeSettings & settings)
{
  return settings.maximumMemory == 0 || IsMapped(scan.image)
           ? 0
           : std::visit(
               [](const auto & image) {
                 using Pixel = typename std::decay_t<decltype(*image)>::PixelType;
                 return image->GetBufferedRegion().GetNumberOfPixels() * sizeof(Pixel);
               },
               scan.image);
}

/** Throws Failure(Memory) for a lattice that does not fit, naming a density that would. */
void
RequireLatticeMemory(const LatticePlan & plan, const LatticeSettings & settings)
{
  const std::uintmax_t allowed = MemoryAllowance(settings.maximumMemory);
  const double fitting =
    allowed > plan.scanBytes
      ? 0.95 * settings.density * static_cast<double>(allowed - plan.scanBytes) / static_cast<double>(plan.latticeBytes)
      : 0.0;
  RequireMemory(plan.latticeBytes + plan.scanBytes,
                settings.maximumMemory,
                "The lattice",
                fitting >= 0.001 ? "use a coarser lattice with --density " + FormatNumber(fitting, 2)
                                 : "crop the scan");
}

/** How many planes around a slab of a smoothed lattice are resampled for it. */
template <typename TImage>
itk::SizeValueType
FindReach(TImage & smoothed, TImage & lattice)
{
  itk::ImageRegion<3> plane = smoothed.GetLargestPossibleRegion();
  plane.SetIndex(2, plane.GetIndex(2) + static_cast<itk::IndexValueType>(plane.GetSize(2) / 2));
  plane.SetSize(2, 1);
  smoothed.SetRequestedRegion(plane);
  smoothed.PropagateRequestedRegion();
  return lattice.GetRequestedRegion().GetSize(2) - 1;
}

/** Plans how many planes of a lattice are made at a time when the whole of it does not fit: all that do fit. Throws
 * Failure(Memory) when it is what is made of the lattice that does not fit, or not even a slab does. \param smoothed
 * the lattice as it is used, which is \a lattice itself unless it is smoothed */
template <typename TPixel>
void
PlanSlabs(itk::FCCImage<TPixel> & smoothed,
          itk::FCCImage<TPixel> & lattice,
          const LatticeSettings & settings,
          LatticeStream & stream)
{
  constexpr std::uintmax_t perSite = 2 * sizeof(float); // of extraction, see itk::FCCIsosurfaceFilter
  const bool isSmoothed = &smoothed != &lattice;
  const itk::SizeValueType around = 20 + (isSmoothed ? FindReach(smoothed, lattice) : 0); // further planes of a slab
  const itk::ImageRegion<3> & region = lattice.GetLargestPossibleRegion();
  LatticePlan & plan = stream.plan;
  const std::uintmax_t allowed = MemoryAllowance(settings.maximumMemory);
  const bool isExchanged =
    stream.sources.size() > (isSmoothed ? 2u : 1u); // its planes of the scan take some 1.3 times as much
  const std::size_t pixels = (isSmoothed ? 2 : 1) + (isExchanged ? 2 : 0);
  const std::uintmax_t plane = region.GetSize(0) * region.GetSize(1) * (sizeof(TPixel) * pixels + perSite);
  const std::uintmax_t besideSlab = stream.surfaces.besideSlab;
  const std::uintmax_t least = plan.scanBytes + around * plane;
  if (least + plane <= allowed)
  {
    RequireMemory(least + plane + besideSlab,
                  settings.maximumMemory,
                  "A slab of the lattice with its surfaces",
                  "use a coarser lattice with a smaller --density");
  }
  const std::uintmax_t planes = allowed > least + besideSlab ? (allowed - least - besideSlab) / plane : 0;
  plan.planesOfSlab = std::min<itk::SizeValueType>(planes, region.GetSize(2));
  if (plan.planesOfSlab == 0)
  {
    RequireLatticeMemory(plan, settings);
  }
  plan.slabs = static_cast<unsigned int>((region.GetSize(2) + plan.planesOfSlab - 1) / plan.planesOfSlab);
  plan.peak = least + besideSlab + plan.planesOfSlab * plane;
}

/** Makes the first \a planes of a lattice, and leaves the others for later. */
template <typename TPixel>
void
BeginStream(itk::FCCImage<TPixel> & lattice, itk::SizeValueType planes)
{
  itk::ImageRegion<3> region = lattice.GetLargestPossibleRegion();
  region.SetSize(2, planes);
  lattice.SetRequestedRegion(region);
  lattice.PropagateRequestedRegion();
  lattice.UpdateOutputData();
}

/** Throws Failure(Usage) for a lattice or grid that the filter refuses, naming the options. */
template <typename TFilter>
void
CheckSize(TFilter & filter)
{
  try
  {
    filter.UpdateOutputInformation();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw Failure(FailureKind::Usage, DescribeError(error) + " (--spacing and --density).");
  }
}

template <typename TFilter>
typename TFilter::OutputImageType::Pointer
TakeOutput(TFilter & filter)
{
  typename TFilter::OutputImageType::Pointer output = filter.GetOutput();
  output->DisconnectPipeline();
  return output;
}

/** Throws Failure(Usage) for settings that need evenly spaced slices on perpendicular axes. */
void
CheckSlantedScan(const LatticeSettings & settings)
{
  if (settings.nested)
  {
    throw Failure(FailureKind::Usage,
                  "The scan's slices are tilted, sheared or unevenly spaced, so that no lattice is nested in it; "
                  "leave out --nested.");
  }
  if (settings.denoising.kind == Denoising::Kind::EdgePreserving)
  {
    throw Failure(FailureKind::Usage,
                  "The scan's slices are tilted, sheared or unevenly spaced, which edge-preserving smoothing does not "
                  "support; use --denoise gaussian, which works on the lattice.");
  }
}

/** Makes a lattice in slabs, as planned. */
template <typename TPixel>
void
MakeSlabs(itk::FCCImage<TPixel> & lattice,
          const Scan & scan,
          const LatticeSettings & settings,
          const Events & events,
          LatticeStream & stream)
{
  const LatticePlan & plan = stream.plan;
  events.Note("the lattice of " + DescribeBytes(plan.latticeBytes) + " is more than the " +
              DescribeBytes(MemoryAllowance(settings.maximumMemory)) + " that are allowed; it is made in " +
              Count(plan.slabs, "slab") + ", again for each pass over it" +
              (stream.surfaces.afterwards > 0
                 ? "; the surface will take some " + DescribeBytes(stream.surfaces.afterwards)
                 : ""));
  if (stream.onlyPlans)
  {
    return;
  }
  stream.sources.front()->AddObserver(itk::EndEvent(),
                                      [image = scan.image](const itk::EventObject &) { DropPages(image); });
  BeginStream(lattice, plan.planesOfSlab);
}

/** Runs a filter from a scan's image to the lattice, and smooths the lattice by a Gaussian if that is asked for.
 * \param exchange makes the voxels of the image; null where it has them */
template <typename TFilter>
FCCVolume
Resample(TFilter & filter,
         itk::ProcessObject * exchange,
         const Scan & scan,
         const LatticeSettings & settings,
         const Events & events,
         LatticeStream * stream)
{
  using LatticeType = typename TFilter::OutputImageType;
  CheckSize(filter);
  LatticeStream none;
  LatticeStream & used = stream != nullptr ? *stream : none;
  used.check ? used.check() : void();
  const bool isSmoothed = settings.denoising.kind == Denoising::Kind::Gaussian;
  typename LatticeType::Pointer lattice = filter.GetOutput();
  LatticePlan & plan = used.plan;
  plan.scanBytes = std::max(used.scanBytes, CountScanBytes(scan, settings));
  plan.latticeBytes = lattice->GetLargestPossibleRegion().GetNumberOfPixels() *
                      sizeof(typename LatticeType::PixelType) * (isSmoothed ? 2 : 1);
  const std::uintmax_t exchanged = exchange == nullptr
                                     ? 0
                                     : filter.GetInput()->GetLargestPossibleRegion().GetNumberOfPixels() *
                                         sizeof(typename TFilter::InputImageType::PixelType);
  plan.peak = plan.scanBytes + exchanged + plan.latticeBytes;
  const bool isInSlabs = stream != nullptr && used.mayBeInSlabs && plan.peak > MemoryAllowance(settings.maximumMemory);
  if (isInSlabs)
  {
    used.sources = { &filter };
    if (exchange != nullptr)
    {
      used.sources.emplace_back(exchange);
    }
    filter.SetReleaseDataFlag(isSmoothed);
    const auto smoothed = std::get<typename LatticeType::Pointer>(
      isSmoothed ? ConnectDenoising(lattice, settings.denoising, used.sources.emplace_back()) : FCCVolume(lattice));
    PlanSlabs(*smoothed, *lattice, settings, used);
    lattice = smoothed;
    MakeSlabs(*lattice, scan, settings, events, used);
  }
  else if (plan.scanBytes += exchanged, RequireLatticeMemory(plan, settings); !used.onlyPlans)
  {
    ObserveProgress(filter, "resampling", events);
    filter.Update();
    lattice->DisconnectPipeline();
  }
  events.Note("lattice: " + FormatProduct(lattice->GetLargestPossibleRegion().GetSize()) + " sites, spacing " +
              DescribeSpacing(lattice->GetSpacing()));
  const bool isDone = isInSlabs || used.onlyPlans || !isSmoothed;
  const FCCVolume volume =
    isDone ? FCCVolume(lattice) : DenoiseLattice(lattice, settings.denoising, settings.maximumMemory, events);
  if (isSmoothed)
  {
    events.Note("smoothed by a Gaussian of " + FormatNumber(settings.denoising.sigma) +
                " mm; --denoise none leaves it out");
  }
  return volume;
}

/** \param image the scan's image, or that image denoised */
template <typename TImage>
FCCVolume
ResampleImage(const TImage & image,
              itk::ProcessObject * exchange,
              const Scan & scan,
              const LatticeSettings & settings,
              const Events & events,
              LatticeStream * stream)
{
  if (settings.nested)
  {
    const auto filter = itk::CartesianToNestedFCCImageFilter<TImage>::New();
    filter->SetInput(&image);
    return Resample(*filter, exchange, scan, settings, events, stream);
  }
  const auto filter = itk::CartesianToFCCImageFilter<TImage>::New();
  filter->SetInput(&image);
  filter->SetDensity(settings.density);
  filter->SetOutputSpacing(settings.spacing.data());
  filter->SetKernel(settings.kernel);
  if (exchange == nullptr)
  {
    filter->SetScan(scan);
  }
  return Resample(*filter, exchange, scan, settings, events, stream);
}

} // namespace

Denoising
ParseDenoising(const std::string & text)
{
  Denoising denoising;
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  std::vector<std::string> numbers;
  if (colon != std::string::npos)
  {
    numbers = Split(text.substr(colon + 1), ",");
  }
  const auto numberAt = [&numbers](std::size_t n) {
    return n < numbers.size() ? ToNumber<double>(numbers[n]).value_or(0.0) : 0.0;
  };
  if (name == "gaussian" && numbers.size() <= 1)
  {
    denoising = { Denoising::Kind::Gaussian, numberAt(0), 0.0 };
  }
  else if (name == "edges" && numbers.size() <= 2)
  {
    denoising = { Denoising::Kind::EdgePreserving, numberAt(0), numberAt(1) };
  }
  else if (text != "none")
  {
    throw Failure(FailureKind::Usage,
                  "'" + text +
                    "' is no way to take noise out; write none, gaussian:SIGMA (in mm), for example gaussian:0.7, or "
                    "edges:SIGMA,EDGE (in mm, and in the scan's units per mm), for example edges:0.7,60.");
  }
  CheckDenoising(denoising);
  return denoising;
}

void
CheckLatticeSettings(const LatticeSettings & settings)
{
  if (!(settings.density > 0.0) || !(settings.density <= 64.0))
  {
    throw Failure(FailureKind::Usage,
                  "The lattice's density must be above 0 and at most 64 sites per sample of the scan, not " +
                    std::to_string(settings.density) + "; the default is " +
                    FormatFixed(itk::FCCLattice::DefaultDensity, 2) + ".");
  }
  const auto isUsable = [](double spacing) { return spacing > 0.0 && std::isfinite(spacing); };
  const bool isGiven = std::all_of(settings.spacing.begin(), settings.spacing.end(), isUsable);
  if (!isGiven && settings.spacing != std::array<double, 3>{ 0.0, 0.0, 0.0 })
  {
    throw Failure(FailureKind::Usage,
                  "The lattice's spacing must be a positive number along each axis; give it in mm, for example 1.5.");
  }
  CheckDenoising(settings.denoising);
}

FCCVolume
ScanToLattice(const Scan & scan, const LatticeSettings & settings, const Events & events, LatticeStream * stream)
{
  CheckLatticeSettings(settings);
  if (!scan.furtherLayers.empty())
  {
    throw Failure(FailureKind::Usage,
                  "The labels of this segmentation overlap, so that its voxels have no single value to resample; leave "
                  "out thresholds to have the surfaces of its labels.");
  }
  if (IsSlanted(scan))
  {
    CheckSlantedScan(settings);
  }
  const bool isMade = stream == nullptr || !stream->onlyPlans;
  const ScanImage image =
    isMade ? DenoiseScan(scan.image, settings.denoising, settings.maximumMemory, events) : scan.image;
  const DeepImage deep = IsSlanted(scan) ? DeepImage{ image, nullptr } : MakeDeep(image);
  return std::visit(
    [&](const auto & input) { return ResampleImage(*input, deep.source, scan, settings, events, stream); }, deep.image);
}

unsigned int
FindDivisions(const FCCVolume & lattice)
{
  const auto find = [](const auto & image) {
    const itk::SizeValueType depth = image->GetLargestPossibleRegion().GetSize(2);
    const itk::SizeValueType planes = std::max<itk::SizeValueType>(1, image->GetBufferedRegion().GetSize(2));
    return static_cast<unsigned int>((depth + planes - 1) / planes);
  };
  return std::visit(find, lattice);
}

ScanImage
LatticeToScan(const FCCVolume & volume, const std::array<double, 3> & spacing, const Events & events)
{
  return std::visit(
    [&](const auto & input) -> ScanImage {
      using InputType = typename std::decay_t<decltype(*input)>;
      const auto filter = itk::FCCToCartesianImageFilter<InputType>::New();
      filter->SetOutputSpacing(spacing.data());
      ObserveProgress(*filter, "resampling", events);
      filter->SetInput(input);
      CheckSize(*filter);
      filter->Update();
      return TakeOutput(*filter);
    },
    volume);
}

} // namespace rhombic
