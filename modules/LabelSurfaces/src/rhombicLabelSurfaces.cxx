#include "rhombicLabelSurfaces.h"

#include "rhombicLabelChoice.h"
#include "rhombicLabelPieces.h"
#include "rhombicMaskSurface.h"

#include "itkForEachBlock.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>

namespace rhombic
{
namespace
{

constexpr double CubicMillimetresPerMillilitre = 1000.0;
constexpr std::size_t SmallPiece = 1 << 15; // voxels of its box; threads make such pieces side by side
constexpr std::size_t PiecesAtOnce = 32;    // between two calls of progress

/** The slice origins of a region of the scan's grid. Beyond the scan they go on with the first or the last step. */
std::vector<itk::Point<double, 3>>
CutSliceOrigins(const Scan & scan, const itk::ImageRegion<3> & region)
{
  const auto & origins = scan.sliceOrigins;
  if (origins.size() < 2)
  {
    return {};
  }
  const auto & grid = GeometryOf(scan.image);
  const auto begin = grid.GetLargestPossibleRegion().GetIndex();
  itk::Index<3> inPlane = region.GetIndex();
  inPlane[2] = begin[2];
  const auto shift =
    grid.TransformIndexToPhysicalPoint<double>(inPlane) - grid.TransformIndexToPhysicalPoint<double>(begin);
  const auto last = static_cast<itk::IndexValueType>(origins.size()) - 1;
  std::vector<itk::Point<double, 3>> cut;
  for (itk::IndexValueType slice = region.GetIndex(2) - begin[2]; cut.size() < region.GetSize(2); ++slice)
  {
    const auto nearest = static_cast<std::size_t>(std::clamp<itk::IndexValueType>(slice, 0, last));
    const auto step = slice < 0 ? origins[1] - origins[0] : origins[origins.size() - 1] - origins[origins.size() - 2];
    const auto beyond = static_cast<double>(slice - static_cast<itk::IndexValueType>(nearest));
    cut.push_back(origins[nearest] + shift + step * beyond);
  }
  return cut;
}

MaskPiece
CutPiece(const Scan & scan, const LabelPieces & pieces, std::size_t piece, const std::vector<double> & voxelVolumes)
{
  MaskPiece cut;
  cut.mask = pieces.MakeMask(piece, MaskMargin);
  cut.scanRegion = GeometryOf(scan.image).GetLargestPossibleRegion();
  cut.sliceOrigins = CutSliceOrigins(scan, cut.mask->GetBufferedRegion());
  const auto firstSlice = static_cast<std::size_t>(pieces.GetBox(piece).GetIndex(2) - cut.scanRegion.GetIndex(2));
  const auto counts = pieces.CountVoxels(piece);
  for (std::size_t slice = 0; slice < counts.size(); ++slice)
  {
    cut.volume += static_cast<double>(counts[slice]) * voxelVolumes[firstSlice + slice];
  }
  return cut;
}

/** All surfaces as one. */
itk::TriangleSurface::Pointer
Join(const std::vector<itk::TriangleSurface::Pointer> & surfaces)
{
  if (surfaces.size() == 1)
  {
    return surfaces.front();
  }
  const auto joined = itk::TriangleSurface::New();
  for (const auto & surface : surfaces)
  {
    const auto first = static_cast<std::uint32_t>(joined->GetNumberOfPoints());
    const auto append = [](auto & to, const auto & from) { to.insert(to.end(), from.begin(), from.end()); };
    append(joined->GetPoints(), surface->GetPoints());
    append(joined->GetNormals(), surface->GetNormals());
    for (auto triangle : surface->GetTriangles())
    {
      for (auto & point : triangle)
      {
        point += first;
      }
      joined->GetTriangles().push_back(triangle);
    }
  }
  return joined;
}

/** The surface of each piece. Threads share the work on large pieces, and the small pieces among themselves. */
std::vector<MaskSurface>
MakePieces(const Scan & scan,
           const LabelSummary & summary,
           const LabelPieces & pieces,
           const LabelSurfaceSettings & settings,
           const std::function<void(double)> & progress)
{
  const std::vector<double> voxelVolumes = VoxelVolumes(scan);
  std::vector<MaskSurface> made(pieces.GetNumberOfPieces());
  const auto make = [&](std::size_t piece, bool onOneThread) {
    made[piece] =
      MaskToSurface(CutPiece(scan, pieces, piece, voxelVolumes),
                    { settings.density, settings.mode, settings.maximumMemory, summary.label.name, onOneThread });
  };
  std::vector<std::size_t> small;
  for (std::size_t piece = 0; piece < made.size(); ++piece)
  {
    if (pieces.GetBox(piece).GetNumberOfPixels() <= SmallPiece)
    {
      small.push_back(piece);
      continue;
    }
    make(piece, false);
    progress(static_cast<double>(piece + 1 - small.size()) / static_cast<double>(made.size()));
  }
  for (std::size_t first = 0; first < small.size(); first += PiecesAtOnce)
  {
    progress(static_cast<double>(made.size() - small.size() + first) / static_cast<double>(made.size()));
    itk::ForEachOnThreads(std::min(PiecesAtOnce, small.size() - first),
                          [&](std::size_t n) { make(small[first + n], true); });
  }
  return made;
}

LabelSurface
MakeSurface(const Scan & scan,
            const LabelSummary & summary,
            const LabelPieces & pieces,
            const LabelSurfaceSettings & settings,
            const std::function<void(double)> & progress)
{
  LabelSurface made = DescribeLabel(summary);
  made.pieces = pieces.GetNumberOfPieces();
  std::vector<itk::TriangleSurface::Pointer> surfaces;
  for (const MaskSurface & surface : MakePieces(scan, summary, pieces, settings, progress))
  {
    made.surfaceMillilitres += surface.volume / CubicMillimetresPerMillilitre;
    made.surfacePieces += surface.shells;
    made.finerPieces += surface.isFiner ? 1 : 0;
    made.protectedVoxels += surface.protectedVoxels;
    surfaces.push_back(surface.surface);
  }
  made.isTorn = made.surfacePieces > made.pieces && made.surfacePieces > pieces.CountFaceConnectedPieces();
  made.scene.surface = Join(surfaces);
  return made;
}

} // namespace

std::vector<LabelSurface>
LabelsToSurfaces(const LabelMap & map, const LabelSurfaceSettings & settings, const Events & events)
{
  CheckLabelDensity(settings.density);
  const std::vector<LabelSummary> labels = ChooseLabels(map, settings.labels);
  const auto boxes = FindLabelBoxes(map.scan.image);
  double allVoxels = 0.0;
  for (const LabelSummary & summary : labels)
  {
    allVoxels += static_cast<double>(boxes.at(summary.label.value).GetNumberOfPixels());
  }
  std::vector<LabelSurface> surfaces;
  double doneVoxels = 0.0;
  for (const LabelSummary & summary : labels)
  {
    const itk::ImageRegion<3> & box = boxes.at(summary.label.value);
    const auto boxVoxels = static_cast<double>(box.GetNumberOfPixels());
    const LabelPieces pieces(map.scan.image, summary.label.value, box);
    surfaces.push_back(MakeSurface(map.scan, summary, pieces, settings, [&](double fraction) {
      events.Progress("extracting labels", (doneVoxels + fraction * boxVoxels) / allVoxels);
    }));
    NoteShortcomings(surfaces.back(), events);
    doneVoxels += boxVoxels;
  }
  events.Progress("extracting labels", 1.0);
  return surfaces;
}

} // namespace rhombic
