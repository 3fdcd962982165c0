#include "rhombicMaskSurface.h"

#include "rhombicMemoryBudget.h"

#include "itkAntiAliasMaskImageFilter.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkTriangleSurfaceComponents.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace rhombic
{
namespace
{

using FieldImage = itk::Image<float, 3>;
using FieldLattice = itk::FCCImage<float>;

constexpr double FinestFactor = 8.0;       // greatest multiple of the density asked for
constexpr double FinestSmallFactor = 64.0; // greatest multiple for small lattices
constexpr double SmallLattice = 1 << 24;   // sites
constexpr double LargestLattice = 1 << 26; // sites; larger ones take seconds for little gain
constexpr double LargestDifference = 0.01; // between the volumes of surface and voxels, relative
constexpr double GoodDifference = 0.002;   // the search for the level ends here
constexpr unsigned int MostLevels = 6;     // tried in one search
constexpr double FarthestLevel = 0.4;      // voxels; beyond 0.5, parts would vanish or appear
constexpr std::size_t ThinShare = 4;       // a piece is thin when a quarter of its voxels is narrow

/** The smooth field of a mask. */
struct MaskField
{
  FieldImage::Pointer image; ///< depth below the surface in voxels, positive inside
  std::size_t narrowVoxels = 0;
  std::size_t protectedVoxels = 0;
};

/** Limits the field to the depth below the outer faces of the scan's voxels. */
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

/** The Euler characteristic of the surface of the piece's voxels. It is twice that of the solid, which is the number of
 * vertices minus edges plus faces minus voxels. */
std::ptrdiff_t
EulerCharacteristicOf(const MaskPiece & piece)
{
  const MaskImage & mask = *piece.mask;
  const itk::ImageRegion<3> & region = mask.GetBufferedRegion();
  const auto isInside = [&](const itk::Index<3> & index) {
    return region.IsInside(index) && piece.scanRegion.IsInside(index) && mask.GetPixel(index) != 0;
  };
  // Each voxel counts its lowest corner, and the three edges and three faces at that corner.
  std::ptrdiff_t number = 0;
  for (itk::ImageRegionConstIteratorWithIndex<MaskImage> it(&mask, region); !it.IsAtEnd(); ++it)
  {
    std::array<bool, 8> corner{};
    for (unsigned int n = 0; n < 8; ++n)
    {
      auto index = it.GetIndex();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        index[axis] -= n >> axis & 1;
      }
      corner[n] = isInside(index);
    }
    const auto any = [&corner](unsigned int axes) {
      for (unsigned int n = 0; n < 8; ++n)
      {
        if (corner[n] && (n & ~axes) == 0)
        {
          return 1;
        }
      }
      return 0;
    };
    number += any(7) - any(3) - any(5) - any(6) + any(1) + any(2) + any(4) - any(0);
  }
  return 2 * number;
}

/** The Euler characteristic of a closed surface, which has three edges for two triangles. */
std::ptrdiff_t
EulerCharacteristicOf(const itk::TriangleSurface & surface)
{
  return static_cast<std::ptrdiff_t>(surface.GetNumberOfPoints()) -
         static_cast<std::ptrdiff_t>(surface.GetNumberOfTriangles() / 2);
}

template <typename TFilter>
auto
MakeFilter(const MaskSurfaceSettings & settings)
{
  const auto filter = TFilter::New();
  if (settings.onOneThread)
  {
    filter->SetNumberOfWorkUnits(1);
  }
  return filter;
}

MaskField
MakeField(const MaskPiece & piece, bool protectsAll, const MaskSurfaceSettings & settings)
{
  const auto filter = MakeFilter<itk::AntiAliasMaskImageFilter>(settings);
  filter->SetInput(piece.mask);
  filter->SetProtectAllThinParts(protectsAll);
  filter->Update();
  MaskField field;
  field.image = filter->GetOutput();
  field.image->DisconnectPipeline();
  field.narrowVoxels = filter->GetNumberOfNarrowVoxels();
  field.protectedVoxels = filter->GetNumberOfProtectedVoxels();
  if (!piece.scanRegion.IsInside(field.image->GetBufferedRegion()))
  {
    CutAtScanBorder(*field.image, piece.scanRegion);
  }
  return field;
}

FieldLattice::Pointer
MakeLattice(FieldImage & field, const MaskPiece & piece, double factor, const MaskSurfaceSettings & settings)
{
  const auto filter = MakeFilter<itk::CartesianToFCCImageFilter<FieldImage>>(settings);
  filter->SetInput(&field);
  filter->SetDensity(settings.density * factor);
  filter->SetSliceOrigins(piece.sliceOrigins);
  filter->SetOutsideValue(-static_cast<float>(MaskMargin));
  filter->Update();
  FieldLattice::Pointer lattice = filter->GetOutput();
  lattice->DisconnectPipeline();
  return lattice;
}

itk::TriangleSurface::Pointer
Extract(const FieldLattice & lattice, double level, const MaskSurfaceSettings & settings)
{
  const auto filter = MakeFilter<itk::FCCIsosurfaceFilter<FieldLattice>>(settings);
  filter->SetInput(&lattice);
  filter->SetIsovalue(level);
  filter->SetMode(settings.mode);
  filter->Update();
  itk::TriangleSurface::Pointer surface = filter->GetOutput();
  surface->DisconnectPipeline();
  return surface;
}

/** The relative difference between the volumes. */
double
DifferenceOf(const MaskSurface & made, const MaskPiece & piece)
{
  return std::abs(made.volume / piece.volume - 1.0);
}

/** Extracts the surface at the level at which it has the piece's volume. The level is found by the secant method; the
 * first slope is the surface's area. */
MaskSurface
ExtractVolume(const FieldLattice & lattice,
              const MaskPiece & piece,
              double firstLevel,
              const MaskSurfaceSettings & settings)
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
    made.surface = Extract(lattice, level, settings);
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

/** Bytes for the work on a piece: mask, field, buffers, lattice and surfaces. */
std::uintmax_t
MemoryFor(const MaskPiece & piece, double density)
{
  const auto voxels = static_cast<double>(piece.mask->GetBufferedRegion().GetNumberOfPixels());
  constexpr double bytesPerVoxel = 16.0;
  constexpr double bytesPerSite = 8.0;
  return static_cast<std::uintmax_t>(voxels * (bytesPerVoxel + bytesPerSite * density));
}

/** \class SurfaceSearch
 * \brief Looks for the best surface of a piece. */
class SurfaceSearch
{
public:
  SurfaceSearch(const MaskPiece & piece, const MaskSurfaceSettings & settings)
    : m_Piece(piece)
    , m_Settings(settings)
  {}

  /** Protects all thin parts if a thin piece does not come out whole otherwise. */
  MaskSurface
  Run()
  {
    const MaskField field = MakeField(m_Piece, false, m_Settings);
    const std::uint8_t * const mask = m_Piece.mask->GetBufferPointer();
    const auto voxels = std::count(mask, mask + m_Piece.mask->GetBufferedRegion().GetNumberOfPixels(), 1);
    const bool isThin = ThinShare * field.narrowVoxels >= static_cast<std::size_t>(voxels);
    if (isThin)
    {
      m_EulerCharacteristic = EulerCharacteristicOf(m_Piece);
    }
    const MaskSurface best = this->Refine(field);
    if (!isThin || best.shells == 1)
    {
      return best;
    }
    const MaskSurface whole = this->Refine(MakeField(m_Piece, true, m_Settings));
    return this->RankOf(whole) < this->RankOf(best) ? whole : best;
  }

private:
  /** Number of parts; holes of thin pieces that their voxels don't have; difference of the volumes. Less is better. */
  using Rank = std::tuple<std::size_t, std::ptrdiff_t, double>;

  Rank
  RankOf(const MaskSurface & made) const
  {
    const std::size_t parts = made.shells == 0 ? std::numeric_limits<std::size_t>::max() : made.shells;
    const std::ptrdiff_t holes =
      m_EulerCharacteristic ? std::max<std::ptrdiff_t>(0, *m_EulerCharacteristic - EulerCharacteristicOf(*made.surface))
                            : 0;
    const double difference = DifferenceOf(made, m_Piece);
    return { parts, holes, difference <= LargestDifference ? 0.0 : difference };
  }

  bool
  IsAffordable(double factor) const
  {
    const double density = m_Settings.density * factor;
    const auto voxels = static_cast<double>(m_Piece.mask->GetBufferedRegion().GetNumberOfPixels());
    const double sites = density * voxels;
    const bool isSmall = sites <= SmallLattice && factor <= FinestSmallFactor;
    return (isSmall || (sites <= LargestLattice && factor <= FinestFactor)) &&
           MemoryFor(m_Piece, density) <= MemoryAllowance(m_Settings.maximumMemory);
  }

  MaskSurface
  MakeOn(const MaskField & field, double factor, double firstLevel) const
  {
    const auto lattice = MakeLattice(*field.image, m_Piece, factor, m_Settings);
    MaskSurface made = ExtractVolume(*lattice, m_Piece, firstLevel, m_Settings);
    made.isFiner = factor > 1.0;
    made.protectedVoxels = field.protectedVoxels;
    return made;
  }

  /** The best surface of a field, on finer and finer lattices until two in turn are no better or one is too large. */
  MaskSurface
  Refine(const MaskField & field) const
  {
    const Rank perfect{ 1, 0, 0.0 };
    MaskSurface best = this->MakeOn(field, 1.0, 0.0);
    unsigned int failures = 0;
    for (double factor = 2.0; RankOf(best) != perfect && failures < 2 && this->IsAffordable(factor); factor *= 2.0)
    {
      MaskSurface finer = this->MakeOn(field, factor, best.level);
      if (RankOf(finer) < RankOf(best))
      {
        best = std::move(finer);
        failures = 0;
      }
      else
      {
        ++failures;
      }
    }
    return best;
  }

  const MaskPiece & m_Piece;
  const MaskSurfaceSettings & m_Settings;
  std::optional<std::ptrdiff_t> m_EulerCharacteristic; ///< that a thin piece's surface should have
};

} // namespace

MaskSurface
MaskToSurface(const MaskPiece & piece, const MaskSurfaceSettings & settings)
{
  RequireMemory(MemoryFor(piece, settings.density),
                settings.maximumMemory,
                "The surface of " + settings.name,
                "use a coarser lattice, or crop the label map");
  return SurfaceSearch(piece, settings).Run();
}

} // namespace rhombic
