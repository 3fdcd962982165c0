#include "rhombicMeshEstimate.h"

#include "itkFCCLattice.h"
#include "rhombicForEachBlock.h"
#include "rhombicMemoryBudget.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>

namespace rhombic
{
namespace
{

/** How many triangles a surface of area 1, in faces of voxels, has on the default lattice. Measured on CTs, MRs, the
 * phantom and random fields.
 * \param roughness share of the crossed edges that follow another one along an axis: 0 for a large ball, 1/2 for noise
 */
double
TrianglesPerFace(itk::FCCIsosurfaceMode mode, double roughness)
{
  using Mode = itk::FCCIsosurfaceMode;
  if (mode == Mode::Lean)
  {
    return 2.0 + 2.6 * roughness; // fewer edges of its triangles are short where a surface is smooth
  }
  const double ofQuarters = 7.35 - 4.6 * roughness; // what is smaller than the lattice's cells is lost
  return ofQuarters * (mode == Mode::Octahedra ? 0.82 : mode == Mode::Parallelepipeds ? 0.405 : 1.0);
}

/** What a pair of slices tells of an isosurface. */
struct PairCounts
{
  double edges = 0.0;    ///< edges of voxels in the first slice that the surface crosses, with those across its border
  double repeated = 0.0; ///< of them, those that follow another one along their axis
  double between = 0.0;  ///< edges from the first slice to the second
  double pages = 0.0;    ///< groups of rows of the first slice with a sample that is inside
  double insideFirst = 0.0;
  double insideSecond = 0.0;

  void
  Add(const PairCounts & other, double weight)
  {
    edges += weight * other.edges;
    repeated += weight * other.repeated;
    between += weight * other.between;
    pages += weight * other.pages;
  }
};

/** Samples of a row that are inside, or edges that are crossed: 0 or 1 for each. */
using Row = std::vector<std::uint8_t>;

std::uint32_t
CountOnes(const Row & row)
{
  return std::accumulate(row.begin(), row.end(), std::uint32_t{ 0 });
}

/** How many are 1 in both rows, of which one is shifted against the other. */
std::uint32_t
CountInBoth(const Row & one, const Row & other, std::ptrdiff_t shift)
{
  return std::inner_product(one.begin() + shift, one.end(), other.begin(), std::uint32_t{ 0 });
}

void
FindDifferent(const Row & one, const Row & other, std::ptrdiff_t shift, Row & different)
{
  std::transform(one.begin() + shift, one.end(), other.begin(), different.begin(), std::bit_xor<std::uint8_t>());
}

template <typename TPixel>
void
FindInside(const TPixel * values, const Threshold & threshold, Row & row)
{
  std::transform(values, values + row.size(), row.begin(), [threshold](TPixel value) -> std::uint8_t {
    return threshold.IsInside(static_cast<double>(value)) ? 1 : 0;
  });
}

/** Counts a pair. \param rowsOfPage rows of a group */
template <typename TPixel>
PairCounts
CountPair(const TPixel * first,
          const TPixel * second,
          const itk::Size<3> & size,
          const Threshold & threshold,
          std::size_t rowsOfPage)
{
  const std::size_t columns = size[0];
  Row row(columns), above(columns), below(columns), along(columns), across(columns), acrossAbove(columns);
  PairCounts counts;
  bool isUsed = false; // the group so far
  for (std::size_t n = 0; n < size[1]; ++n)
  {
    FindInside(first + n * columns, threshold, row);
    FindInside(second + n * columns, threshold, below);
    counts.insideSecond += CountOnes(below);
    FindDifferent(row, below, 0, below);
    FindDifferent(row, above, 0, across);
    FindDifferent(row, row, 1, along);
    along.back() = row.back(); // across the border
    const std::uint32_t inside = CountOnes(row);
    counts.edges += row.front() + CountOnes(along) + CountOnes(across) + (n + 1 == size[1] ? inside : 0);
    counts.repeated += CountInBoth(along, along, 1) + CountInBoth(across, acrossAbove, 0);
    counts.between += CountOnes(below);
    counts.insideFirst += inside;
    across.swap(acrossAbove);
    row.swap(above);
    isUsed = isUsed || inside > 0;
    if ((n + 1) % rowsOfPage == 0 || n + 1 == size[1])
    {
      counts.pages += isUsed ? 1.0 : 0.0;
      isUsed = false;
    }
  }
  return counts;
}

/** Sites of the lattice per sample of a scan. */
double
DensityOf(const LatticeSettings & lattice, const itk::ImageBase<3>::SpacingType & voxel)
{
  const auto & [x, y, z] = lattice.spacing;
  return lattice.nested ? 0.5 : x > 0.0 ? voxel[0] * voxel[1] * voxel[2] / (2.0 * x * y * z) : lattice.density;
}

constexpr double BytesOfExtracted = 24.0; // of a triangle with its share of the points and their normals

/** The memory of surfaces of which large ones are made in fewer triangles. */
SurfaceBytes
BytesForViews(const MeshEstimate & mesh)
{
  constexpr double bytesWhileSmoothed = 120.0; // of a triangle of a surface that keeps all
  constexpr double bytesOfBlocks = 500e6;      // where triangles are made fewer
  const bool isLarge = mesh.triangles > mesh.kept;
  return { mesh.bits + static_cast<std::uintmax_t>(mesh.kept * BytesOfExtracted + (isLarge ? bytesOfBlocks : 0.0)),
           static_cast<std::uintmax_t>(mesh.kept * bytesWhileSmoothed) };
}

} // namespace

std::vector<std::size_t>
FindSlicePairs(const itk::Size<3> & size)
{
  constexpr std::size_t voxels = std::size_t{ 1 } << 24, fewest = 6;
  const std::size_t last = std::max<std::size_t>(size[2], 2) - 2; // the first slice of the last pair
  const std::size_t pairs = std::min(std::max(voxels / (2 * size[0] * size[1]), fewest), last + 1);
  std::vector<std::size_t> first(pairs, 0);
  for (std::size_t n = 1; n < pairs; ++n)
  {
    first[n] = n * last / (pairs - 1);
  }
  return first;
}

MeshEstimate
EstimateMesh(const SampledSlices & sample,
             const std::vector<SurfaceRequest> & requests,
             itk::FCCIsosurfaceMode mode,
             const LatticeSettings & lattice,
             double mostTriangles)
{
  constexpr double bytesWithSearch = 75.0;      // while crossings are searched for; measured: 41 to 74
  constexpr std::size_t samplesOfPage = 50'000; // samples of the scan whose bits share a page of memory
  const auto & size = GeometryOf(sample.image).GetLargestPossibleRegion().GetSize();
  const std::size_t samples = size[0] * size[1];
  const std::size_t rowsOfPage = std::min<std::size_t>(1 + samplesOfPage / size[0], size[1]);
  const double density = DensityOf(lattice, GeometryOf(sample.image).GetSpacing());
  const double relativeDensity = density / itk::FCCLattice::DefaultDensity;
  const auto depth = static_cast<double>(sample.depth);
  MeshEstimate estimate;
  double bits = 0.0; // two for each site, but for pages in which none is inside
  const auto count = [&](const auto & image, const Threshold & threshold) {
    std::vector<PairCounts> pairs(sample.pairs.size());
    ForEachInBlocks(pairs.size(), 1, [&](std::size_t n) {
      const auto * const first = image->GetBufferPointer() + sample.pairs[n] * samples;
      pairs[n] = CountPair(first, sample.depth > 1 ? first + samples : first, size, threshold, rowsOfPage);
    });
    PairCounts sum;
    double weights = 0.0; // a pair at an end stands for the slices on one side of it
    for (std::size_t n = 0; n < pairs.size(); ++n)
    {
      const double weight = pairs.size() > 1 && (n == 0 || n + 1 == pairs.size()) ? 0.5 : 1.0;
      sum.Add(pairs[n], weight);
      weights += weight;
    }
    const double ends = pairs.front().insideFirst + pairs.back().insideSecond;
    // A surface that no axis is special to cuts 3/2 as many edges along the axes as it has faces of voxels.
    const double faces = (sum.edges / weights * depth + sum.between / weights * (depth - 1.0) + ends) / 1.5;
    estimate.triangles += faces * TrianglesPerFace(mode, sum.edges > 0.0 ? sum.repeated / sum.edges : 0.0);
    bits += 0.25 * density * sum.pages / weights * depth * static_cast<double>(rowsOfPage * size[0]);
  };
  for (const SurfaceRequest & request : requests)
  {
    std::visit([&](const auto & image) { count(image, request.GetThreshold()); }, sample.image);
  }
  estimate.triangles *= std::pow(relativeDensity, 2.0 / 3.0);
  estimate.bits = static_cast<std::uintmax_t>(bits);
  estimate.bytes = { estimate.bits + static_cast<std::uintmax_t>(estimate.triangles * BytesOfExtracted),
                     static_cast<std::uintmax_t>(estimate.triangles * bytesWithSearch) };
  estimate.kept = estimate.triangles;
  if (mostTriangles > 0.0)
  {
    estimate.kept = std::min(estimate.triangles, mostTriangles * static_cast<double>(requests.size()));
    estimate.bytes = BytesForViews(estimate);
  }
  return estimate;
}

std::string
DescribeTriangles(double triangles)
{
  return "some " + FormatFixed(triangles / 1e6, triangles < 1e7 ? 2 : 0) + " million triangles";
}

void
CountSteps(const MeshSteps & steps, MeshEstimate & mesh)
{
  constexpr double whileSmoothed = 130.0;                       // bytes of a triangle
  const double whileSimplified = steps.ofWalls ? 430.0 : 320.0; // of those before
  constexpr double whileColoured = 130.0;
  constexpr double whileAudited = 140.0; // measured: up to 131
  const double most = std::max({ steps.smooths ? whileSmoothed : 0.0,
                                 steps.simplifies ? whileSimplified : 0.0,
                                 steps.colours ? whileColoured : 0.0,
                                 steps.audits ? whileAudited : 0.0 });
  mesh.bytes.afterwards = std::max(mesh.bytes.afterwards, static_cast<std::uintmax_t>(mesh.triangles * most));
}

void
PutIntoTemporaryFiles(MeshEstimate & mesh)
{
  constexpr double bytesOfRest = 2.0; // of a triangle, while its file is written; measured: 1
  mesh.temporaryBytes = std::max(mesh.bytes.afterwards, mesh.bytes.besideSlab - mesh.bits);
  mesh.bytes.besideSlab = mesh.bits;
  mesh.bytes.afterwards = static_cast<std::uintmax_t>(mesh.triangles * bytesOfRest);
}

} // namespace rhombic
