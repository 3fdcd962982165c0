#include "itkCurveOrder.h"

#include "rhombicForEachBlock.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <utility>

namespace itk
{
namespace
{

using Box = TriangleTree::Box;

constexpr unsigned int BitsOfAxis = 21; // of a cell's number along one axis
constexpr unsigned int BitsOfBucket = 15;
constexpr std::size_t NumberOfBuckets = std::size_t{ 1 } << BitsOfBucket;
constexpr std::size_t FewestForBuckets = 50000;
constexpr std::size_t TrianglesOfBlock = 65536;

/** Moves each bit of a number below 2^21 to three times its place. */
std::uint64_t
SpreadBits(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x001f00000000ffffU;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

/** The centre of a triangle's box. */
TriangleSurface::PointType
CentreOf(const TriangleSurface & surface, std::uint32_t triangle)
{
  const Box box = TriangleTree::BoxOf(surface.GetPoints(), surface.GetTriangles()[triangle]);
  return { 0.5f * box.lowest[0] + 0.5f * box.highest[0],
           0.5f * box.lowest[1] + 0.5f * box.highest[1],
           0.5f * box.lowest[2] + 0.5f * box.highest[2] };
}

/** The box around the centres of triangles. */
Box
FindBox(const TriangleSurface & surface, const std::vector<std::uint32_t> & triangles)
{
  std::vector<Box> ofBlocks((triangles.size() + TrianglesOfBlock - 1) / TrianglesOfBlock);
  rhombic::ForEachBlock(triangles.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    const auto first = CentreOf(surface, triangles[begin]);
    Box box{ first, first };
    for (std::size_t n = begin + 1; n < end; ++n)
    {
      box.Add(CentreOf(surface, triangles[n]));
    }
    ofBlocks[begin / TrianglesOfBlock] = box;
  });
  Box box = ofBlocks.front();
  for (const Box & other : ofBlocks)
  {
    box = TriangleTree::Union(box, other);
  }
  return box;
}

CurvePlaces
FindPlaces(const TriangleSurface & surface, const std::vector<std::uint32_t> & triangles)
{
  const Box box = FindBox(surface, triangles);
  double longest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, double(box.highest[axis]) - box.lowest[axis]);
  }
  constexpr double last = (1U << BitsOfAxis) - 1;
  const double cellsPerMillimetre = longest > 0.0 ? last / longest : 0.0;
  CurvePlaces places(triangles.size());
  rhombic::ForEachInBlocks(triangles.size(), TrianglesOfBlock, [&](std::size_t n) {
    const auto centre = CentreOf(surface, triangles[n]);
    std::uint64_t cell = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double number = std::min(last, (double(centre[axis]) - box.lowest[axis]) * cellsPerMillimetre);
      cell |= SpreadBits(static_cast<std::uint64_t>(number)) << axis;
    }
    places[n] = { cell, triangles[n] };
  });
  return places;
}

std::size_t
BucketOf(const CurvePlace & place)
{
  return place.cell >> (3 * BitsOfAxis - BitsOfBucket);
}

/** Moves places into buckets by the highest bits of their cells, and sorts each bucket. */
void
SortByBuckets(CurvePlaces & places)
{
  const std::size_t blocks = (places.size() + TrianglesOfBlock - 1) / TrianglesOfBlock;
  std::vector<std::array<std::uint32_t, NumberOfBuckets>> next(blocks); // counts, then where the next one goes
  rhombic::ForEachBlock(places.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    auto & counts = next[begin / TrianglesOfBlock];
    for (std::size_t n = begin; n < end; ++n)
    {
      ++counts[BucketOf(places[n])];
    }
  });
  std::vector<std::size_t> ends(NumberOfBuckets);
  std::uint32_t sum = 0;
  for (std::size_t bucket = 0; bucket < NumberOfBuckets; ++bucket)
  {
    for (auto & ofBlock : next)
    {
      sum += std::exchange(ofBlock[bucket], sum);
    }
    ends[bucket] = sum;
  }
  CurvePlaces sorted(places.size());
  rhombic::ForEachBlock(places.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    auto & ofBlock = next[begin / TrianglesOfBlock];
    for (std::size_t n = begin; n < end; ++n)
    {
      sorted[ofBlock[BucketOf(places[n])]++] = places[n];
    }
  });
  places.swap(sorted);
  constexpr std::size_t bucketsOfBlock = 256;
  rhombic::ForEachInBlocks(NumberOfBuckets, bucketsOfBlock, [&](std::size_t bucket) {
    const std::size_t begin = bucket > 0 ? ends[bucket - 1] : 0;
    std::sort(places.data() + begin, places.data() + ends[bucket]);
  });
}

} // namespace

CurvePlaces
SortAlongCurve(const TriangleSurface & surface, const std::vector<std::uint32_t> & triangles)
{
  if (triangles.empty())
  {
    return {};
  }
  CurvePlaces places = FindPlaces(surface, triangles);
  if (places.size() < FewestForBuckets)
  {
    std::sort(places.begin(), places.end());
  }
  else
  {
    SortByBuckets(places);
  }
  return places;
}

} // namespace itk
