#include "itkLabelsOnLattice.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace itk
{
namespace
{

using Sites = BulkVector<FCCLattice::SiteType>;

constexpr double Inside = 1.0 + 1e-9; // of d p for the Voronoi cell's faces, d being the nearest neighbours

PositionType
PositionOf(const FCCLattice::SiteType & site)
{
  return { static_cast<double>(site[0]), static_cast<double>(site[1]), static_cast<double>(site[2]) };
}

/** The normals of the faces of the Voronoi cell of the site 0, in the order of the bits of FacesBefore(): opposite
 * faces have the sums and the differences of two axes. */
const auto FaceNormals = [] {
  std::array<PositionType, FCCLattice::NearestNeighbors.size()> normals{};
  for (unsigned int face = 0; face < normals.size(); ++face)
  {
    const double side = face % 2 == 0 ? 1.0 : -1.0;
    normals[face][face / 4] = side;
    normals[face][(face / 4 + 1) % 3] = face % 4 < 2 ? side : -side;
  }
  return normals;
}();

/** A convex polygon: a triangle, or what planes leave of it. */
struct Polygon
{
  std::array<PositionType, 3 + FaceNormals.size()> corners;
  std::size_t size = 0;

  void
  Add(const PositionType & corner)
  {
    corners[size++] = corner;
  }
};

void
SortUniqueSites(Sites & sites)
{
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
}

/** Whether a convex polygon meets the Voronoi cell of the site 0: whether a part of it is within all of the cell's
 * faces.
 * \param faces those beyond which corners are */
bool
MeetsCell(Polygon polygon, unsigned int faces)
{
  for (unsigned int face = 0; face < FaceNormals.size(); ++face)
  {
    if ((faces >> face & 1) == 0)
    {
      continue;
    }
    Polygon rest;
    for (std::size_t n = 0; n < polygon.size; ++n)
    {
      const PositionType & here = polygon.corners[n];
      const PositionType & there = polygon.corners[n + 1 < polygon.size ? n + 1 : 0];
      const double from = Dot(FaceNormals[face], here) - Inside;
      const double to = Dot(FaceNormals[face], there) - Inside;
      if (from <= 0.0)
      {
        rest.Add(here);
      }
      if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0))
      {
        rest.Add(Mix(here, there, from / (from - to)));
      }
    }
    if (rest.size == 0)
    {
      return false;
    }
    polygon = rest;
  }
  return true;
}

/** The faces of the Voronoi cell of the site 0 beyond which a point is, a bit for each. */
unsigned int
FacesBefore(const PositionType & point)
{
  unsigned int faces = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double sum = point[axis] + point[(axis + 1) % 3];
    const double difference = point[axis] - point[(axis + 1) % 3];
    faces |= ((sum > Inside ? 1u : 0u) | (sum < -Inside ? 2u : 0u) | (difference > Inside ? 4u : 0u) |
              (difference < -Inside ? 8u : 0u))
             << 4 * axis;
  }
  return faces;
}

/** Whether the convex hull of a few points meets the Voronoi cell of the site 0: one of the points' triangles does. */
bool
HullMeetsCell(const std::vector<PositionType> & points)
{
  std::array<unsigned int, 8> faces;
  std::transform(points.begin(), points.end(), faces.begin(), FacesBefore);
  const auto end = faces.begin() + static_cast<std::ptrdiff_t>(points.size());
  if (std::accumulate(faces.begin(), end, ~0u, std::bit_and<>()) != 0)
  {
    return false;
  }
  if (std::find(faces.begin(), end, 0u) != end)
  {
    return true;
  }
  const auto meetsCell = [&](std::initializer_list<std::size_t> corners) {
    Polygon polygon;
    unsigned int beyond = 0;
    for (const std::size_t corner : corners)
    {
      polygon.Add(points[corner]);
      beyond |= faces[corner];
    }
    return MeetsCell(polygon, beyond);
  };
  for (std::size_t a = 0; a < points.size(); ++a)
  {
    for (std::size_t b = a + 1; b < points.size(); ++b)
    {
      if (points.size() == 2 && meetsCell({ a, b }))
      {
        return true;
      }
      for (std::size_t c = b + 1; c < points.size(); ++c)
      {
        if ((faces[a] & faces[b] & faces[c]) == 0 && meetsCell({ a, b, c }))
        {
          return true;
        }
      }
    }
  }
  return false;
}

/** Adds the sites whose cells meet the convex hull of a few points. */
void
AddSites(const std::vector<PositionType> & points, Sites & sites)
{
  FCCLattice::SiteType low;
  FCCLattice::SiteType high;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto [least, most] =
      std::minmax_element(points.begin(), points.end(), [axis](const PositionType & a, const PositionType & b) {
        return a[axis] < b[axis];
      });
    low[axis] = static_cast<IndexValueType>(std::ceil((*least)[axis] - Inside));
    high[axis] = static_cast<IndexValueType>(std::floor((*most)[axis] + Inside));
  }
  std::vector<PositionType> moved(points.size());
  FCCLattice::SiteType site;
  for (site[2] = low[2]; site[2] <= high[2]; ++site[2])
  {
    for (site[1] = low[1]; site[1] <= high[1]; ++site[1])
    {
      for (site[0] = low[0]; site[0] <= high[0]; ++site[0])
      {
        if (!FCCLattice::IsSite(site))
        {
          continue;
        }
        std::transform(points.begin(), points.end(), moved.begin(), [&site](const PositionType & point) {
          return Subtract(point, PositionOf(site));
        });
        if (HullMeetsCell(moved))
        {
          sites.push_back(site);
        }
      }
    }
  }
}

} // namespace

BulkVector<FCCLattice::SiteType>
FindThinPartSites(const Image<std::uint8_t, 3> & mask,
                  const ImageRegion<3> & region,
                  const BulkVector<SizeValueType> & thin,
                  const std::function<PositionType(const Index<3> &)> & placeVoxel)
{
  const auto isThin = [&](const Index<3> & voxel) {
    const auto offset = static_cast<SizeValueType>(mask.ComputeOffset(voxel));
    return std::binary_search(thin.begin(), thin.end(), offset);
  };
  ImageRegion<3> inside = mask.GetBufferedRegion();
  inside.Crop(region);
  const auto addAround = [&](SizeValueType offset, std::vector<PositionType> & points, Sites & sites) {
    const Index<3> voxel = mask.ComputeIndex(static_cast<OffsetValueType>(offset));
    for (unsigned int cube = 0; cube < 8 && inside.IsInside(voxel); ++cube)
    {
      // Each cube is handled at its first thin voxel.
      points.clear();
      bool isFirst = true;
      for (unsigned int corner = 0; corner < 8 && isFirst; ++corner)
      {
        Index<3> other = voxel;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          other[axis] +=
            static_cast<IndexValueType>(corner >> axis & 1) - static_cast<IndexValueType>(cube >> axis & 1);
        }
        if (inside.IsInside(other) && mask.GetPixel(other) != 0)
        {
          isFirst = isFirst && (static_cast<SizeValueType>(mask.ComputeOffset(other)) >= offset || !isThin(other));
          points.push_back(placeVoxel(other));
        }
      }
      if (isFirst && !points.empty())
      {
        AddSites(points, sites);
      }
    }
  };
  constexpr std::size_t block = 1024;
  constexpr std::size_t blocksAtOnce = 64;
  Sites sites;
  for (std::size_t first = 0; first < thin.size(); first += block * blocksAtOnce)
  {
    std::vector<Sites> sitesOfBlocks(blocksAtOnce);
    const std::size_t count = std::min(block * blocksAtOnce, thin.size() - first);
    rhombic::ForEachBlock(count, block, [&](std::size_t begin, std::size_t end) {
      std::vector<PositionType> points;
      Sites & ofBlock = sitesOfBlocks[begin / block];
      for (std::size_t n = begin; n < end; ++n)
      {
        addAround(thin[first + n], points, ofBlock);
      }
      SortUniqueSites(ofBlock);
    });
    for (const Sites & some : sitesOfBlocks)
    {
      sites.insert(sites.end(), some.begin(), some.end());
    }
  }
  SortUniqueSites(sites);
  return sites;
}

} // namespace itk
