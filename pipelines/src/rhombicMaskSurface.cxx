#include "rhombicMaskSurface.h"

#include "rhombicMemoryBudget.h"

#include "itkAntiAliasMaskImageFilter.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkTriangleSurfaceComponents.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using FieldImage = itk::Image<float, 3>;
using FieldLattice = itk::FCCImage<float>;

constexpr double FinestFactor = 8.0;
constexpr double LargestDifference = 0.01; // of the volume, relative
constexpr double GoodDifference = 0.002;
constexpr unsigned int MostLevels = 6;
constexpr double FarthestLevel = 0.4; // voxels; beyond 0.5, parts would vanish or grow by themselves

/** The smooth field of a mask, in voxels, cut off at the outer faces of the scan's voxels. */
struct MaskField
{
  FieldImage::Pointer image;
  std::size_t protectedVoxels = 0;
};

void
CutAtScanBorder(FieldImage & field, const itk::ImageRegion<3> & scanRegion)
{
  for (itk::ImageRegionIteratorWithIndex<FieldImage> it(&field, field.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    float depth = it.Get();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto before = static_cast<float>(it.GetIndex()[axis] - scanRegion.GetIndex(axis)) + 0.5f;
      const auto behind = static_cast<float>(scanRegion.GetUpperIndex()[axis] - it.GetIndex()[axis]) + 0.5f;
      depth = std::min({ depth, before, behind });
    }
    it.Set(depth);
  }
}

MaskField
MakeField(const MaskPiece & piece)
{
  const auto filter = itk::AntiAliasMaskImageFilter::New();
  filter->SetInput(piece.mask);
  filter->Update();
  MaskField field;
  field.image = filter->GetOutput();
  field.image->DisconnectPipeline();
  field.protectedVoxels = filter->GetNumberOfProtectedVoxels();
  if (!piece.scanRegion.IsInside(field.image->GetBufferedRegion()))
  {
    CutAtScanBorder(*field.image, piece.scanRegion);
  }
  return field;
}

FieldLattice::Pointer
MakeLattice(FieldImage & field, const MaskPiece & piece, double density)
{
  const auto filter = itk::CartesianToFCCImageFilter<FieldImage>::New();
  filter->SetInput(&field);
  filter->SetDensity(density);
  filter->SetSliceOrigins(piece.sliceOrigins);
  filter->SetOutsideValue(-static_cast<float>(MaskMargin));
  filter->Update();
  FieldLattice::Pointer lattice = filter->GetOutput();
  lattice->DisconnectPipeline();
  return lattice;
}

itk::TriangleSurface::Pointer
Extract(const FieldLattice & lattice, double level, itk::FCCIsosurfaceMode mode)
{
  const auto filter = itk::FCCIsosurfaceFilter<FieldLattice>::New();
  filter->SetInput(&lattice);
  filter->SetIsovalue(level);
  filter->SetMode(mode);
  filter->Update();
  itk::TriangleSurface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

double
DifferenceOf(const MaskSurface & made, const MaskPiece & piece)
{
  return std::abs(made.volume / piece.volume - 1.0);
}

bool
IsGood(const MaskSurface & made, const MaskPiece & piece)
{
  return made.shells == 1 && DifferenceOf(made, piece) <= LargestDifference;
}

/** Extracts the surface at the level at which it has the piece's volume: Newton's method with the surface's area as the
 * first slope, secants from then on. */
MaskSurface
ExtractVolume(const FieldLattice & lattice, const MaskPiece & piece, double firstLevel, itk::FCCIsosurfaceMode mode)
{
  const auto & spacing = piece.mask->GetSpacing();
  const double voxelEdge = std::cbrt(spacing[0] * spacing[1] * spacing[2]);
  MaskSurface best;
  double level = firstLevel;
  double lastLevel = 0.0;
  double lastVolume = 0.0;
  for (unsigned int n = 0; n < MostLevels; ++n)
  {
    MaskSurface made;
    made.level = level;
    made.surface = Extract(lattice, level, mode);
    made.volume = itk::ComputeVolume(*made.surface);
    if (n == 0 || DifferenceOf(made, piece) < DifferenceOf(best, piece))
    {
      best = made;
    }
    if (DifferenceOf(best, piece) <= GoodDifference)
    {
      break;
    }
    const double slope =
      n == 0 || made.volume == lastVolume
        ? -std::max(itk::ComputeArea(*made.surface), std::cbrt(piece.volume * piece.volume)) * voxelEdge
        : (made.volume - lastVolume) / (level - lastLevel);
    lastLevel = level;
    lastVolume = made.volume;
    level = std::clamp(level + (piece.volume - made.volume) / slope, -FarthestLevel, FarthestLevel);
    if (level == lastLevel)
    {
      break;
    }
  }
  const auto components = itk::FindComponents(*best.surface);
  const auto volumes = itk::ComputeComponentVolumes(*best.surface, components);
  best.shells =
    static_cast<std::size_t>(std::count_if(volumes.begin(), volumes.end(), [](double volume) { return volume > 0.0; }));
  return best;
}

/** Bytes that the work on a piece takes: mask, field and what makes it, lattice, and surfaces. */
std::uintmax_t
MemoryFor(const MaskPiece & piece, double density)
{
  const auto voxels = static_cast<double>(piece.mask->GetBufferedRegion().GetNumberOfPixels());
  constexpr double bytesPerVoxel = 15.0;
  constexpr double bytesPerSite = 8.0;
  return static_cast<std::uintmax_t>(voxels * (bytesPerVoxel + bytesPerSite * density));
}

} // namespace

MaskSurface
MaskToSurface(const MaskPiece & piece, const MaskSurfaceSettings & settings)
{
  RequireMemory(MemoryFor(piece, settings.density),
                settings.maximumMemory,
                "The surface of " + settings.name,
                "use a coarser lattice, or crop the label map");
  const MaskField field = MakeField(piece);
  const auto rank = [&piece](const MaskSurface & made) {
    constexpr std::size_t worseThanTwo = 3;
    return std::make_pair(made.shells == 0 ? worseThanTwo : made.shells, DifferenceOf(made, piece));
  };
  const auto make = [&](double density, double firstLevel) {
    MaskSurface made = ExtractVolume(*MakeLattice(*field.image, piece, density), piece, firstLevel, settings.mode);
    made.isFiner = density > settings.density;
    made.protectedVoxels = field.protectedVoxels;
    return made;
  };
  MaskSurface best = make(settings.density, 0.0);
  for (double factor = 2.0; factor <= FinestFactor && !IsGood(best, piece); factor *= 2.0)
  {
    const double density = settings.density * factor;
    if (MemoryFor(piece, density) > MemoryAllowance(settings.maximumMemory))
    {
      break;
    }
    MaskSurface finer = make(density, best.level);
    if (!(rank(finer) < rank(best)))
    {
      break;
    }
    best = std::move(finer);
  }
  return best;
}

} // namespace rhombic
