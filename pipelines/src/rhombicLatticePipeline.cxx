#include "rhombicLatticePipeline.h"

#include "rhombicFailure.h"
#include "rhombicIntensities.h"
#include "rhombicMemoryBudget.h"
#include "rhombicObserveProgress.h"
#include "rhombicScanBorder.h"
#include "rhombicWording.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCResamplingChecks.h"
#include "itkFCCToCartesianImageFilter.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace rhombic
{
namespace
{

/** Refuses a lattice that would not fit, naming a density that would. */
template <typename TPixel>
void
RequireLatticeMemory(const itk::FCCImage<TPixel> & lattice, const Scan & scan, const LatticeSettings & settings)
{
  const bool isSmoothed = settings.denoising.kind == Denoising::Kind::Gaussian; // into a second one
  const std::uintmax_t bytes =
    lattice.GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(TPixel) * (isSmoothed ? 2 : 1);
  const bool isGiven = settings.maximumMemory > 0;
  const std::uintmax_t scanBytes =
    isGiven ? GeometryOf(scan.image).GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(TPixel) : 0;
  const std::uintmax_t allowed = MemoryAllowance(settings.maximumMemory);
  const double fitting = allowed > scanBytes ? 0.95 * settings.density * static_cast<double>(allowed - scanBytes) /
                                                 static_cast<double>(bytes)
                                             : 0.0;
  std::ostringstream advice;
  advice.imbue(std::locale::classic());
  advice << std::setprecision(2) << "use a coarser lattice with --density " << fitting;
  RequireMemory(
    bytes + scanBytes, settings.maximumMemory, "The lattice", fitting >= 0.001 ? advice.str() : "crop the scan");
}

/** What the extents of an FCC image come to, in a few words. */
template <typename TPixel>
std::string
Describe(const itk::FCCImage<TPixel> & image)
{
  const auto & size = image.GetLargestPossibleRegion().GetSize();
  const auto & spacing = image.GetSpacing();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << size[0] << " x " << size[1] << " x " << size[2] << " sites, spacing " << spacing[0] << " x " << spacing[1]
       << " x " << spacing[2] << " mm";
  return text.str();
}

/** Turns a lattice or grid that is too large to be made, which a filter finds out first, into words for the user. */
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

/** Volumes in ml, as people read them. */
std::string
Millilitres(double volume)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << volume << " ml";
  return text.str();
}

/** Throws Failure(Empty) when there is no triangle. */
void
CheckSurface(const ExtractedSurface & surface, const SurfaceRequest & request)
{
  if (surface.scene.surface->GetNumberOfTriangles() == 0)
  {
    std::ostringstream sentence;
    sentence.imbue(std::locale::classic());
    sentence << "Nothing can be extracted for " << request.name << " at " << *request.isovalue;
    if (surface.enclosed)
    {
      sentence << " that lies in the body (" << Millilitres(surface.enclosed->aroundBody) << " around it are left out)";
    }
    sentence << "; try another threshold (rhombic info suggests some).";
    throw Failure(FailureKind::Empty, sentence.str());
  }
}

void
NoteParts(const std::string & name, const EnclosedParts & parts, const Events & events)
{
  std::vector<std::string> leftOut;
  if (parts.aroundBody > 0.0)
  {
    leftOut.push_back(Millilitres(parts.aroundBody) + " around the body");
  }
  if (parts.numberOfSmall > 0)
  {
    leftOut.push_back(Count(parts.numberOfSmall, "small part") + " of " + Millilitres(parts.small));
  }
  if (!leftOut.empty())
  {
    events.Note(name + ": left out " + Enumerate(leftOut, "and"));
  }
  if (parts.numberCutBySides > 0)
  {
    events.Note(name + ": the sides of the scan cut " + Count(parts.numberCutBySides, "part") +
                "; the volume is that within the scan");
  }
}

/** Extracts the surfaces of those requests that are on one side of their isovalues. Returns how many samples are not a
 * number. */
template <typename TPixel>
itk::SizeValueType
ExtractSide(const itk::FCCImage<TPixel> & image,
            const std::vector<SurfaceRequest> & requests,
            SurfaceRequest::Side side,
            itk::FCCIsosurfaceMode mode,
            const Events & events,
            std::vector<itk::TriangleSurface::Pointer> & surfaces)
{
  std::vector<std::size_t> places;
  std::vector<double> isovalues;
  std::string names;
  for (std::size_t n = 0; n < requests.size(); ++n)
  {
    if (requests[n].side == side)
    {
      places.push_back(n);
      isovalues.push_back(requests[n].isovalue.value());
      names += (names.empty() ? "" : ", ") + requests[n].name;
    }
  }
  if (places.empty())
  {
    return 0;
  }
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  ObserveProgress(*filter, "extracting " + names, events);
  filter->SetInput(&image);
  filter->SetIsovalues(isovalues);
  filter->SetMode(mode);
  filter->SetInsideIsBelow(side == SurfaceRequest::Side::Below);
  filter->Update();
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    surfaces[places[n]] = filter->GetOutput(n);
    surfaces[places[n]]->DisconnectPipeline();
  }
  return filter->GetNumberOfUndefinedSamples();
}

void
MoveWalls(itk::TriangleSurface & surface, const itk::ImageBase<3> * grid, const FCCVolume & volume)
{
  if (grid != nullptr)
  {
    MoveWallsToBorder(surface, *grid, volume);
  }
}

/** Leaves out of a request's surface what is around the body. */
EnclosedParts
LeaveOutSurroundings(const FCCVolume & volume,
                     const SurfaceRequest & request,
                     itk::FCCIsosurfaceMode mode,
                     const Events & events,
                     const itk::ImageBase<3> * grid,
                     itk::TriangleSurface::Pointer & surface)
{
  events.Progress("telling " + request.name + " from what is around the body", 0.0);
  const Threshold threshold{ request.isovalue.value(), request.side == SurfaceRequest::Side::Below };
  return KeepEnclosedParts(surface, volume, threshold, [&](const FCCVolume & cut) {
    std::vector<itk::TriangleSurface::Pointer> extracted(1);
    std::visit([&](const auto & image) { ExtractSide(*image, { request }, request.side, mode, events, extracted); },
               cut);
    MoveWalls(*extracted.front(), grid, cut);
    return extracted.front();
  });
}

} // namespace

double
MeanSpacingOf(const itk::ImageBase<3> & image)
{
  const auto & spacing = image.GetSpacing();
  return std::cbrt(spacing[0] * spacing[1] * spacing[2]);
}

bool
IsSlanted(const Scan & scan)
{
  return !scan.sliceOrigins.empty() || !itk::AreAxesPerpendicular(GeometryOf(scan.image).GetDirection());
}

void
CheckLatticeSettings(const LatticeSettings & settings)
{
  if (!(settings.density > 0.0) || !(settings.density <= 64.0))
  {
    throw Failure(FailureKind::Usage,
                  "The lattice's density must be above 0 and at most 64 sites per sample of the scan, not " +
                    std::to_string(settings.density) + "; the default is 0.77.");
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
ScanToLattice(const Scan & scan, const LatticeSettings & settings, const Events & events)
{
  CheckLatticeSettings(settings);
  const bool isSlanted = IsSlanted(scan);
  if (isSlanted && settings.nested)
  {
    throw Failure(FailureKind::Usage,
                  "The scan's slices are tilted, sheared or unevenly spaced, so that no lattice is nested in it; "
                  "leave out --nested.");
  }
  if (isSlanted && settings.denoising.kind == Denoising::Kind::EdgePreserving)
  {
    throw Failure(FailureKind::Usage,
                  "The scan's slices are tilted, sheared or unevenly spaced, which edge-preserving smoothing does not "
                  "know of; use --denoise gaussian, which works on the lattice.");
  }
  const ScanImage image = DenoiseScan(scan.image, settings.denoising, settings.maximumMemory, events);
  const FCCVolume volume = std::visit(
    [&](const auto & input) -> FCCVolume {
      using InputType = typename std::decay_t<decltype(*input)>;
      const auto run = [&](auto & filter) -> FCCVolume {
        ObserveProgress(filter, "resampling", events);
        filter.SetInput(input);
        CheckSize(filter);
        RequireLatticeMemory(*filter.GetOutput(), scan, settings);
        filter.Update();
        const auto output = TakeOutput(filter);
        events.Note("lattice: " + Describe(*output));
        return output;
      };
      if (settings.nested)
      {
        return run(*itk::CartesianToNestedFCCImageFilter<InputType>::New());
      }
      const auto filter = itk::CartesianToFCCImageFilter<InputType>::New();
      filter->SetDensity(settings.density);
      filter->SetOutputSpacing(settings.spacing.data());
      filter->SetKernel(settings.kernel);
      if (isSlanted)
      {
        filter->SetSliceOrigins(scan.sliceOrigins);
        filter->SetOutsideValue(static_cast<typename InputType::PixelType>(ComputeIntensities(scan.image).lowest));
      }
      return run(*filter);
    },
    image);
  return settings.denoising.kind == Denoising::Kind::Gaussian
           ? DenoiseLattice(volume, settings.denoising, settings.maximumMemory, events)
           : volume;
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

std::vector<ExtractedSurface>
ExtractSurfaces(const FCCVolume & volume,
                const std::vector<SurfaceRequest> & requests,
                itk::FCCIsosurfaceMode mode,
                const Events & events,
                const itk::ImageBase<3> * grid)
{
  for (const SurfaceRequest & request : requests)
  {
    if (!request.isovalue)
    {
      throw Failure(FailureKind::Usage,
                    "The isovalue of " + request.name + " is not known; give a number, or call ResolveIsovalues().");
    }
  }
  std::vector<itk::TriangleSurface::Pointer> extracted(requests.size());
  itk::SizeValueType undefined = 0;
  for (const auto side : { SurfaceRequest::Side::Above, SurfaceRequest::Side::Below })
  {
    const auto extract = [&](const auto & image) {
      return ExtractSide(*image, requests, side, mode, events, extracted);
    };
    undefined = std::max(undefined, std::visit(extract, volume));
  }
  if (undefined > 0)
  {
    events.Note(Count(undefined, "sample is not a number and counts", "samples are not a number and count") +
                " as outside");
  }
  std::vector<ExtractedSurface> surfaces;
  for (std::size_t n = 0; n < requests.size(); ++n)
  {
    const SurfaceRequest & request = requests[n];
    std::optional<EnclosedParts> enclosed;
    MoveWalls(*extracted[n], grid, volume);
    if (request.parts == SurfaceRequest::Parts::Enclosed)
    {
      enclosed = LeaveOutSurroundings(volume, request, mode, events, grid, extracted[n]);
      NoteParts(request.name, *enclosed, events);
    }
    surfaces.push_back({ { request.name, extracted[n].GetPointer(), request.colour, request.opacity }, enclosed });
    CheckSurface(surfaces.back(), request);
    events.Note(request.name + ": " + Count(extracted[n]->GetNumberOfTriangles(), "triangle"));
  }
  return surfaces;
}

std::vector<SceneSurface>
LatticeToSurfaces(const FCCVolume & volume,
                  const std::vector<SurfaceRequest> & requests,
                  itk::FCCIsosurfaceMode mode,
                  const Events & events,
                  const itk::ImageBase<3> * grid)
{
  std::vector<SceneSurface> surfaces;
  for (const ExtractedSurface & surface : ExtractSurfaces(volume, requests, mode, events, grid))
  {
    surfaces.push_back(surface.scene);
  }
  return surfaces;
}

} // namespace rhombic
