#include "rhombicLatticePipeline.h"

#include "rhombicEnclosedParts.h"
#include "rhombicFailure.h"
#include "rhombicObserveProgress.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCToCartesianImageFilter.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rhombic
{
namespace
{

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

template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> & image, const SurfaceRequest & request, const Events & events)
{
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  ObserveProgress(*filter, "extracting " + request.name, events);
  filter->SetInput(&image);
  filter->SetIsovalue(request.isovalue.value());
  filter->SetInsideIsBelow(request.side == SurfaceRequest::Side::Below);
  filter->Update();
  itk::TriangleSurface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  if (request.parts == SurfaceRequest::Parts::Enclosed)
  {
    KeepEnclosedParts(*surface, image);
  }
  if (surface->GetNumberOfTriangles() == 0)
  {
    std::ostringstream sentence;
    sentence.imbue(std::locale::classic());
    sentence << "Nothing can be extracted for " << request.name << " at " << *request.isovalue
             << (request.parts == SurfaceRequest::Parts::Enclosed ? " that the scan encloses" : "")
             << "; try another threshold (rhombic info suggests some).";
    throw Failure(FailureKind::Empty, sentence.str());
  }
  return surface;
}

} // namespace

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
}

FCCVolume
ScanToLattice(const ScanImage & image, const LatticeSettings & settings, const Events & events)
{
  CheckLatticeSettings(settings);
  return std::visit(
    [&](const auto & input) -> FCCVolume {
      using InputType = typename std::decay_t<decltype(*input)>;
      const auto filter = itk::CartesianToFCCImageFilter<InputType>::New();
      filter->SetDensity(settings.density);
      filter->SetOutputSpacing(settings.spacing.data());
      filter->SetKernel(settings.kernel);
      ObserveProgress(*filter, "resampling", events);
      filter->SetInput(input);
      CheckSize(*filter);
      filter->Update();
      const auto output = TakeOutput(*filter);
      events.Note("lattice: " + Describe(*output));
      return output;
    },
    image);
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

std::vector<SceneSurface>
LatticeToSurfaces(const FCCVolume & volume, const std::vector<SurfaceRequest> & requests, const Events & events)
{
  std::vector<SceneSurface> surfaces;
  for (const SurfaceRequest & request : requests)
  {
    const auto surface =
      std::visit([&](const auto & image) { return ExtractSurface(*image, request, events); }, volume);
    events.Note(request.name + ": " + std::to_string(surface->GetNumberOfTriangles()) + " triangles");
    surfaces.push_back({ request.name, surface.GetPointer(), request.colour, request.opacity });
  }
  return surfaces;
}

} // namespace rhombic
