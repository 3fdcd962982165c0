#include "rhombicLabelNumbers.h"
#include "rhombicLabelSurfaces.h"

#include "itkBulkAllocator.h"
#include "itkLabelsOnLattice.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

namespace rhombic
{

namespace
{

/** What some slices of a map hold. */
struct SliceCounts
{
  std::array<std::uint64_t, 3> faces{}; ///< across each axis: between voxels of different labels, or of one and none
  itk::Index<3> lowest{ { itk::NumericTraits<itk::IndexValueType>::max(),
                          itk::NumericTraits<itk::IndexValueType>::max(),
                          itk::NumericTraits<itk::IndexValueType>::max() } };
  itk::Index<3> highest{ { -1, -1, -1 } }; ///< of the voxels of labels

  void
  Add(const SliceCounts & other)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      faces[axis] += other.faces[axis];
      lowest[axis] = std::min(lowest[axis], other.lowest[axis]);
      highest[axis] = std::max(highest[axis], other.highest[axis]);
    }
  }
};

using Slice = itk::BulkVector<std::uint16_t>;

bool
IsLabel(std::uint16_t number)
{
  return number != 0;
}

std::uint64_t
CountDifferent(const std::uint16_t * one, const std::uint16_t * other, std::size_t count)
{
  return std::inner_product(one, one + count, other, std::uint64_t{ 0 }, std::plus<>(), std::not_equal_to<>());
}

std::uint64_t
CountLabels(const std::uint16_t * numbers, std::size_t count)
{
  return static_cast<std::uint64_t>(std::count_if(numbers, numbers + count, IsLabel));
}

/** Counts a slice. \param before the slice before it; 0 before the first */
SliceCounts
CountSlice(const Slice & slice, const Slice & before, std::size_t width, itk::IndexValueType z)
{
  SliceCounts counts;
  const std::size_t height = slice.size() / width;
  for (std::size_t y = 0; y < height; ++y)
  {
    const std::uint16_t * const row = slice.data() + y * width;
    counts.faces[0] += CountDifferent(row, row + 1, width - 1);
    counts.faces[0] += (IsLabel(row[0]) ? 1 : 0) + (IsLabel(row[width - 1]) ? 1 : 0); // at the border of the map
    counts.faces[1] += y > 0 ? CountDifferent(row, row - width, width) : CountLabels(row, width);
    counts.faces[1] += y + 1 == height ? CountLabels(row, width) : 0;
    counts.faces[2] += CountDifferent(row, before.data() + y * width, width);
    const auto * const first = std::find_if(row, row + width, IsLabel);
    if (first != row + width)
    {
      const auto last = std::find_if(std::make_reverse_iterator(row + width), std::make_reverse_iterator(row), IsLabel);
      const auto inY = static_cast<itk::IndexValueType>(y);
      counts.Add({ {}, { { first - row, inY, z } }, { { last.base() - row - 1, inY, z } } });
    }
  }
  return counts;
}

/** Counts the voxels of a region of a layer. */
SliceCounts
CountLayer(const ScanImage & layer, const std::vector<LabelSummary> & labels, const itk::ImageRegion<3> & region)
{
  constexpr std::size_t block = 16; // slices
  const auto & size = region.GetSize();
  std::vector<SliceCounts> counts((size[2] + block - 1) / block);
  const auto number = [&](std::size_t z, Slice & slice) {
    slice.resize(size[0] * size[1]);
    itk::ImageRegion<3> one = region;
    one.SetIndex(2, region.GetIndex(2) + static_cast<itk::IndexValueType>(z));
    one.SetSize(2, 1);
    NumberRows(layer, labels, one, slice.data());
  };
  ForEachBlock(size[2], block, [&](std::size_t begin, std::size_t end) {
    Slice before(size[0] * size[1], 0);
    Slice slice;
    begin > 0 ? number(begin - 1, before) : void();
    for (std::size_t z = begin; z < end; ++z)
    {
      number(z, slice);
      counts[begin / block].Add(CountSlice(slice, before, size[0], static_cast<itk::IndexValueType>(z)));
      slice.swap(before);
    }
    counts[begin / block].faces[2] += end == size[2] ? CountLabels(before.data(), before.size()) : 0;
  });
  return std::accumulate(counts.begin(), counts.end(), SliceCounts(), [](SliceCounts sum, const SliceCounts & some) {
    sum.Add(some);
    return sum;
  });
}

/** Sizes of a layer's work. */
struct LayerWork
{
  double voxels = 1.0; ///< of the box around labels
  double parts = 1.0;  ///< of these voxels, nearly cubes
  double sites = 1.0;
  double faces = 0.0; ///< as many as there would be if sites were as far apart along all axes
};

LayerWork
FindWork(const SliceCounts & counts, const itk::ImageBase<3> & grid, double density)
{
  const auto period = itk::DivideVoxels(grid.GetSpacing());
  LayerWork work;
  work.sites = density;
  std::array<double, 3> steps{}; // of sites, along a voxel
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto divided = static_cast<double>(period[axis]);
    steps[axis] = divided / std::clamp(0.5 * divided, 1.0, 2.0);
    const double length = std::min(static_cast<double>(counts.highest[axis] - counts.lowest[axis] + 1 + 2 * BoxMargin),
                                   static_cast<double>(grid.GetLargestPossibleRegion().GetSize(axis)));
    work.voxels *= length;
    work.parts *= divided * length;
    work.sites *= steps[axis] * length;
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    work.faces += static_cast<double>(counts.faces[axis]) * steps[(axis + 1) % 3] * steps[(axis + 2) % 3];
  }
  work.faces *= std::pow(density / itk::FCCLattice::DefaultDensity, 2.0 / 3.0);
  return work;
}

/** The bytes of the volumes of labels, and of a lattice and its weights near borders. Measured. */
double
BytesOfVolumes(const LayerWork & work, double density)
{
  constexpr double bytesOfVoxel = 2.0;  // its number
  constexpr double bytesOfPart = 15.0;  // the mask, field and forms of the label with the largest box
  constexpr double bytesOfSite = 6.0;   // its label and largest weight
  constexpr double bytesOfFace = 250.0; // weights
  constexpr double share = 1.08;        // with memory that is free in pieces
  const double deeper = std::cbrt(density / itk::FCCLattice::DefaultDensity); // sites along a face's normal
  return share * (work.voxels * bytesOfVoxel + work.parts * bytesOfPart + work.sites * bytesOfSite +
                  work.faces * bytesOfFace * deeper);
}

/** Bytes besides those of a map of labels. */
double
BytesOfProbabilities(const LabelMap & map, double density)
{
  constexpr double bytesOfVoxel = 16.0;
  constexpr double bytesOfSite = 14.0;
  constexpr double bytesOfWeight = 17.0;
  double voxels = 0.0;
  double uncertain = 0.0; // values between 0 and 1
  for (const auto & volume : map.probabilities)
  {
    const float * const begin = volume->GetBufferPointer();
    const std::size_t count = volume->GetBufferedRegion().GetNumberOfPixels();
    voxels = static_cast<double>(count);
    uncertain += static_cast<double>(
      std::count_if(begin, begin + count, [](float value) { return value > 0.0f && value < 1.0f; }));
  }
  return voxels * (bytesOfVoxel + density * bytesOfSite) + density * uncertain * bytesOfWeight;
}

} // namespace

LabelWork
EstimateLabelWork(const LabelMap & map, const LabelSurfaceSettings & settings)
{
  constexpr double trianglesOfFace = 4.4;
  constexpr double bytesOfTriangle = 250.0; // of walls, when each label has a surface
  const std::vector<LabelSummary> labels = ChooseLabels(map, settings.labels);
  const itk::ImageBase<3> & grid = GeometryOf(map.scan.image);
  itk::ImageRegion<3> region = grid.GetLargestPossibleRegion();
  if (settings.part)
  {
    itk::ImageRegion<3> part = *settings.part;
    part.PadByRadius(MarginOfPart(grid));
    if (!part.Crop(region))
    {
      return {};
    }
    region = part;
  }
  LabelWork work;
  double bytes = 0.0;
  for (const ScanImage & layer : LayersOf(map.scan))
  {
    const SliceCounts counts = CountLayer(layer, labels, region);
    if (counts.highest[2] >= 0)
    {
      const LayerWork ofLayer = FindWork(counts, grid, settings.density);
      bytes = std::max(bytes, BytesOfVolumes(ofLayer, settings.density));
      work.triangles += trianglesOfFace * ofLayer.faces;
    }
  }
  work.isOfProbabilities = !map.probabilities.empty();
  bytes += work.isOfProbabilities ? BytesOfProbabilities(map, settings.density) : 0.0;
  work.bytes = static_cast<std::uintmax_t>(std::max(bytes, work.triangles * bytesOfTriangle));
  return work;
}

} // namespace rhombic
