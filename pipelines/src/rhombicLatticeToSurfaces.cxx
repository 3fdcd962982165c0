#include "rhombicLatticeToSurfaces.h"

#include "rhombicEnclosedParts.h"
#include "rhombicFailure.h"
#include "rhombicEvents.h"
#include "rhombicMemoryBudget.h"
#include "rhombicScanToLattice.h"
#include "rhombicWording.h"

#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCScanBorder.h"
#include "itkTriangleSurfaceSolids.h"

#include <algorithm>
#include <map>

namespace rhombic
{
namespace
{

void
NoteParts(const std::string & name, const EnclosedParts & parts, const Events & events)
{
  std::vector<std::string> leftOut;
  if (parts.aroundBody > 0.0)
  {
    leftOut.push_back(DescribeVolume(parts.aroundBody) + " around the body");
  }
  if (parts.numberOfSmall > 0)
  {
    leftOut.push_back(Count(parts.numberOfSmall, "small part") + " of " + DescribeVolume(parts.small));
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

/** Large surfaces of one pass over a volume, in fewer triangles. */
class LargeSurfaces : public itk::FCCSurfaceParts
{
public:
  /** \param moveWalls MoveFCCWallsToBorder() of the volume */
  LargeSurfaces(const SurfaceViewing * viewing, const std::function<void(itk::TriangleSurface &)> & moveWalls)
    : m_Viewing(viewing)
    , m_MoveWalls(moveWalls)
  {}

  bool
  Begin(std::size_t surface, const std::vector<itk::SizeValueType> & firstPoints, const Bounds & bounds) override
  {
    const bool isLarge = firstPoints.back() > m_Viewing->mostPoints;
    if (isLarge)
    {
      m_Surfaces.try_emplace(surface, firstPoints, m_Viewing->findUnseen(bounds), 1 + m_Viewing->mostPoints / 4);
    }
    return isLarge;
  }

  void
  Take(std::size_t surface, itk::TriangleSurface & part, itk::SizeValueType end) override
  {
    FewerTrianglesInParts & fewer = m_Surfaces.at(surface);
    m_MoveWalls(part);
    fewer.Add(part, end);
    std::uintmax_t bytes = 0;
    for (const auto & [other, surfaceSoFar] : m_Surfaces)
    {
      bytes += surfaceSoFar.GetSurface().GetMemorySize();
    }
    RequireMemory(bytes,
                  m_Viewing->maximumMemory,
                  "A part of the surfaces, in the triangles that a picture of this size needs,",
                  "choose a smaller --size, or a coarser lattice with a smaller --density");
  }

  std::map<std::size_t, FewerTrianglesInParts> m_Surfaces; ///< by their numbers in the pass

private:
  const SurfaceViewing * m_Viewing;
  const std::function<void(itk::TriangleSurface &)> & m_MoveWalls;
};

/** Isosurfaces of a volume. */
struct Isosurfaces
{
  std::vector<itk::TriangleSurface::Pointer> surfaces;
  std::vector<std::optional<WholeSurface>> wholes; ///< of large surfaces
  itk::SizeValueType undefinedSamples = 0;         ///< samples of the volume that are not a number
};

/** Extracts isosurfaces of volumes that lie on the same lattice. */
struct IsosurfaceExtraction
{
  itk::FCCIsosurfaceMode mode;
  const Events & events;
  const itk::ImageBase<3> * grid;
  bool computesNormals;
  unsigned int divisions; ///< of the volume, see FindDivisions()
  const SurfaceViewing * viewing;

  /** One surface for each request, in their order; null for outermost parts. */
  Isosurfaces
  Extract(const FCCVolume & volume, const std::vector<SurfaceRequest> & requests) const
  {
    Isosurfaces extracted;
    extracted.surfaces.resize(requests.size());
    extracted.wholes.resize(requests.size());
    const std::function<void(itk::TriangleSurface &)> moveWalls = [&](itk::TriangleSurface & surface) {
      const auto cornerOf = [&volume](bool isHigh) {
        return std::visit([isHigh](const auto & image) { return FindFCCOuterCorner(*image, isHigh); }, volume);
      };
      grid != nullptr ? MoveFCCWallsToBorder(surface, *grid, cornerOf(false), cornerOf(true)) : void();
    };
    for (const bool insideIsBelow : { false, true })
    {
      std::visit([&](const auto & image) { this->ExtractSide(*image, requests, insideIsBelow, moveWalls, extracted); },
                 volume);
    }
    return extracted;
  }

  /** Removes the parts around the body from a request's surface. */
  EnclosedParts
  LeaveOutSurroundings(const FCCVolume & volume,
                       const SurfaceRequest & request,
                       itk::TriangleSurface::Pointer & surface) const
  {
    events.Progress("separating " + request.name + " from air around the body", 0.0);
    return KeepEnclosedParts(surface, volume, request.GetThreshold(), [&](const FCCVolume & cut) {
      return this->Extract(cut, { request }).surfaces.front();
    });
  }

  /** The outline of the body, with its cavities filled. */
  itk::TriangleSurface::Pointer
  ExtractOutline(const FCCVolume & volume, SurfaceRequest request) const
  {
    events.Progress("filling the body for " + request.name, 0.0);
    request.parts = SurfaceRequest::Parts::All;
    const auto surface = this->Extract(FillBody(volume, request.isovalue.value()), { request }).surfaces.front();
    FillTriangleSurfaceCavities(*surface);
    return surface;
  }

  /** Extracts the surfaces of those requests that are on one side of their isovalues, but for outermost parts. */
  template <typename TImage>
  void
  ExtractSide(const TImage & image,
              const std::vector<SurfaceRequest> & requests,
              bool insideIsBelow,
              const std::function<void(itk::TriangleSurface &)> & moveWalls,
              Isosurfaces & extracted) const
  {
    std::vector<std::size_t> chosen;
    std::vector<double> isovalues;
    std::string names;
    for (std::size_t n = 0; n < requests.size(); ++n)
    {
      if (requests[n].insideIsBelow == insideIsBelow && requests[n].parts != SurfaceRequest::Parts::Outermost)
      {
        chosen.push_back(n);
        isovalues.push_back(requests[n].isovalue.value());
        names += (names.empty() ? "" : ", ") + requests[n].name;
      }
    }
    if (chosen.empty())
    {
      return;
    }
    const auto filter = itk::FCCIsosurfaceFilter<TImage>::New();
    ObserveProgress(*filter, "extracting " + names, events);
    filter->SetInput(&image);
    filter->SetIsovalues(isovalues);
    filter->SetMode(mode);
    filter->SetInsideIsBelow(insideIsBelow);
    filter->SetComputeNormals(computesNormals);
    filter->SetNumberOfStreamDivisions(divisions);
    LargeSurfaces large(viewing, moveWalls);
    filter->SetParts(viewing != nullptr ? &large : nullptr);
    filter->Update();
    for (std::size_t n = 0; n < chosen.size(); ++n)
    {
      itk::TriangleSurface::Pointer & surface = extracted.surfaces[chosen[n]];
      const auto found = large.m_Surfaces.find(n);
      if (found != large.m_Surfaces.end())
      {
        surface = found->second.TakeSurface();
        extracted.wholes[chosen[n]] = found->second.GetWhole();
        continue;
      }
      surface = filter->GetOutput(n);
      surface->DisconnectPipeline();
      moveWalls(*surface);
    }
    extracted.undefinedSamples = std::max(extracted.undefinedSamples, filter->GetNumberOfUndefinedSamples());
  }
};

} // namespace

std::vector<ExtractedSurface>
LatticeToSurfaces(const FCCVolume & volume,
                  const std::vector<SurfaceRequest> & requests,
                  itk::FCCIsosurfaceMode mode,
                  const Events & events,
                  const itk::ImageBase<3> * grid,
                  bool computesNormals,
                  const SurfaceViewing * viewing)
{
  for (const SurfaceRequest & request : requests)
  {
    if (!request.isovalue)
    {
      throw Failure(FailureKind::Usage,
                    "The isovalue of " + request.name + " is not known; give a number, or call ResolveIsovalues().");
    }
    if (request.parts == SurfaceRequest::Parts::Outermost && request.insideIsBelow)
    {
      throw Failure(FailureKind::Usage,
                    "The outermost parts of " + request.name + " are of values above the threshold, not below it.");
    }
  }
  constexpr unsigned int divisionsOfViewed = 16; // so that parts of a lattice in memory are small, too
  const unsigned int divisions = std::max(FindDivisions(volume), viewing != nullptr ? divisionsOfViewed : 1);
  const IsosurfaceExtraction extraction{ mode, events, grid, computesNormals, divisions, viewing };
  Isosurfaces extracted = extraction.Extract(volume, requests);
  if (extracted.undefinedSamples > 0)
  {
    events.Note(
      Count(extracted.undefinedSamples, "sample is not a number and counts", "samples are not a number and count") +
      " as outside");
  }
  std::vector<ExtractedSurface> surfaces;
  for (std::size_t n = 0; n < requests.size(); ++n)
  {
    const SurfaceRequest & request = requests[n];
    itk::TriangleSurface::Pointer & surface = extracted.surfaces[n];
    std::optional<EnclosedParts> enclosed;
    if (request.parts == SurfaceRequest::Parts::Enclosed)
    {
      enclosed = extraction.LeaveOutSurroundings(volume, request, surface);
      NoteParts(request.name, *enclosed, events);
    }
    else if (request.parts == SurfaceRequest::Parts::Outermost)
    {
      surface = extraction.ExtractOutline(volume, request);
      events.Note(request.name + ": the outline of the body, with lungs and other air inside filled");
    }
    if (surface->GetNumberOfTriangles() == 0)
    {
      throw Failure(
        FailureKind::Empty,
        "Nothing can be extracted for " + request.name + " at " + FormatNumber(*request.isovalue) +
          (enclosed ? " that lies in the body (" + DescribeVolume(enclosed->aroundBody) + " around it are left out)"
                    : "") +
          "; try another threshold (rhombic info suggests some).");
    }
    const std::optional<WholeSurface> & whole = extracted.wholes[n];
    surfaces.push_back({ { request.name, surface.GetPointer(), request.colour, request.opacity }, enclosed, whole });
    const std::string triangles = Count(surface->GetNumberOfTriangles(), "triangle");
    events.Note(request.name + ": " +
                (whole ? Count(whole->triangles, "triangle") + ", drawn in " +
                           std::to_string(surface->GetNumberOfTriangles()) + ", which give the same picture"
                       : triangles));
  }
  return surfaces;
}

} // namespace rhombic
