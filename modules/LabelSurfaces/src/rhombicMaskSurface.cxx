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

constexpr double FinestFactor = 8.0;       // of the density
constexpr double FinestSmallFactor = 64.0; // the same of small lattices
constexpr double SmallLattice = 1 << 24;   // sites
constexpr double LargestLattice = 1 << 26; // sites; it would take seconds for little
constexpr double LargestDifference = 0.01; // of the volume, relative
constexpr double GoodDifference = 0.002;
constexpr unsigned int MostLevels = 6;
constexpr double FarthestLevel = 0.4; // voxels; beyond 0.5, parts would vanish or grow by themselves

/** The smooth field of a mask, in voxels, cut off at the outer faces of the scan's voxels. */
struct MaskField
{
  FieldImage::Pointer image;
  std::size_t narrowVoxels = 0;
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

/** Twice the Euler number of the piece's voxels as a solid, whose surface has that Euler characteristic: vertices less
 * edges plus faces less voxels of all that the voxels touch. */
std::ptrdiff_t
EulerCharacteristicOf(const MaskPiece & piece)
{
  const MaskImage & mask = *piece.mask;
  const itk::ImageRegion<3> & region = mask.GetBufferedRegion();
  const auto isInside = [&](const itk::Index<3> & index) {
    return region.IsInside(index) && piece.scanRegion.IsInside(index) && mask.GetPixel(index) != 0;
  };
  // Each voxel stands for the vertex, the edges and the faces at its lower end.
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

/** Of a closed surface. */
std::ptrdiff_t
EulerCharacteristicOf(const itk::TriangleSurface & surface)
{
  return static_cast<std::ptrdiff_t>(surface.GetNumberOfPoints()) -
         static_cast<std::ptrdiff_t>(surface.GetNumberOfTriangles() / 2);
}

MaskField
MakeField(const MaskPiece & piece, bool protectsAll)
{
  const auto filter = itk::AntiAliasMaskImageFilter::New();
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
  constexpr double bytesPerVoxel = 16.0;
  constexpr double bytesPerSite = 8.0;
  return static_cast<std::uintmax_t>(voxels * (bytesPerVoxel + bytesPerSite * density));
}

/** \class PieceSurfaces
 * \brief Attempts at the surface of a piece. */
class PieceSurfaces
{
public:
  PieceSurfaces(const MaskPiece & piece, const MaskSurfaceSettings & settings)
    : m_Piece(piece)
    , m_Settings(settings)
  {}

  /** The best one, on finer lattices as long as that helps and there is memory for them. */
  MaskSurface
  Make()
  {
    MaskField field = MakeField(m_Piece, false);
    const std::size_t numberOfVoxels = static_cast<std::size_t>(
      std::count_if(m_Piece.mask->GetBufferPointer(),
                    m_Piece.mask->GetBufferPointer() + m_Piece.mask->GetBufferedRegion().GetNumberOfPixels(),
                    [](std::uint8_t value) { return value != 0; }));
    constexpr std::size_t thinShare = 4;
    const bool isThin = thinShare * field.narrowVoxels >= numberOfVoxels;
    if (isThin)
    {
      m_EulerCharacteristic = EulerCharacteristicOf(m_Piece);
    }
    MaskSurface best = this->Refine(field);
    if (isThin && best.shells != 1)
    {
      field = MakeField(m_Piece, true);
      MaskSurface whole = this->Refine(field);
      best = this->RankOf(whole) < this->RankOf(best) ? whole : best;
    }
    return best;
  }

private:
  /** Less is better: parts, holes of thin pieces that their voxels don't have, volume. */
  std::tuple<std::size_t, std::ptrdiff_t, double>
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
    const auto lattice = MakeLattice(*field.image, m_Piece, m_Settings.density * factor);
    MaskSurface made = ExtractVolume(*lattice, m_Piece, firstLevel, m_Settings.mode);
    made.isFiner = factor > 1.0;
    made.protectedVoxels = field.protectedVoxels;
    return made;
  }

  MaskSurface
  Refine(const MaskField & field) const
  {
    const std::tuple<std::size_t, std::ptrdiff_t, double> perfect{ 1, 0, 0.0 };
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
  std::optional<std::ptrdiff_t> m_EulerCharacteristic; // wanted of the surface; of thin pieces
};

} // namespace

MaskSurface
MaskToSurface(const MaskPiece & piece, const MaskSurfaceSettings & settings)
{
  RequireMemory(MemoryFor(piece, settings.density),
                settings.maximumMemory,
                "The surface of " + settings.name,
                "use a coarser lattice, or crop the label map");
  return PieceSurfaces(piece, settings).Make();
}

} // namespace rhombic
