#include "rhombicVoxelSurface.h"

#include "rhombicSliceOrigins.h"
#include "rhombicVoxelGrid.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace rhombic
{
namespace
{

using PointType = itk::Point<double, 3>;
using VectorType = itk::Vector<double, 3>;

/** The position of the first voxel's centre on each plane between slices, the outer planes included. */
std::vector<PointType>
FindPlanes(const Scan & map)
{
  const auto & grid = GeometryOf(map.image);
  const std::vector<PointType> slices = SliceOriginsOf(map);
  const std::size_t count = slices.size();
  const VectorType firstStep = count > 1 ? slices[1] - slices[0] : StepAlong(grid, 2);
  const VectorType lastStep = count > 1 ? slices[count - 1] - slices[count - 2] : firstStep;
  std::vector<PointType> planes{ slices.front() - firstStep * 0.5 };
  for (std::size_t slice = 1; slice < count; ++slice)
  {
    planes.push_back(slices[slice - 1] + (slices[slice] - slices[slice - 1]) * 0.5);
  }
  planes.push_back(slices.back() + lastStep * 0.5);
  return planes;
}

/** \class VoxelFaces
 * \brief Adds the faces of a label's voxels to a surface, slice by slice. */
class VoxelFaces
{
public:
  VoxelFaces(const ScanImage & layer, std::int32_t label, const itk::ImageRegion<3> & region)
    : m_Layer(layer)
    , m_Label(label)
    , m_Region(region)
    , m_Size(region.GetSize())
  {}

  /** \param planes as FindPlanes() gives them */
  void
  AddTo(itk::TriangleSurface & surface, const std::vector<PointType> & planes)
  {
    const auto & grid = GeometryOf(m_Layer);
    m_AlongRow = StepAlong(grid, 0);
    m_AlongColumn = StepAlong(grid, 1);
    m_IsMirrored = itk::CrossProduct(m_AlongRow, m_AlongColumn) * (planes.back() - planes.front()) < 0.0;
    const auto & whole = grid.GetLargestPossibleRegion();
    const VectorType toRegion = m_AlongRow * static_cast<double>(m_Region.GetIndex(0) - whole.GetIndex(0)) +
                                m_AlongColumn * static_cast<double>(m_Region.GetIndex(1) - whole.GetIndex(1));
    const auto firstPlane = static_cast<std::size_t>(m_Region.GetIndex(2) - whole.GetIndex(2));
    Mask below(m_Size[0] * m_Size[1]);
    Mask here = this->ReadSlice(0);
    Corners lower((m_Size[0] + 1) * (m_Size[1] + 1), None);
    for (std::size_t slice = 0; slice < m_Size[2]; ++slice)
    {
      const Mask above = this->ReadSlice(slice + 1);
      Corners upper(lower.size(), None);
      const Plane bottom{ lower, planes[firstPlane + slice] + toRegion };
      const Plane top{ upper, planes[firstPlane + slice + 1] + toRegion };
      this->AddSlice(below, here, above, bottom, top, surface);
      below = here;
      here = above;
      lower.swap(upper);
    }
  }

private:
  using Mask = std::vector<char>;
  using Corners = std::vector<std::uint32_t>; ///< numbers of points, where there are points yet
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  struct Plane
  {
    Corners & corners;
    PointType origin; ///< at the centre of the region's first voxel
  };

  /** Which voxels of a slice of the region have the label; none beyond the last slice. */
  Mask
  ReadSlice(std::size_t slice) const
  {
    Mask mask(m_Size[0] * m_Size[1]);
    if (slice < m_Size[2])
    {
      std::visit(
        [&](const auto & image) {
          for (std::size_t row = 0; row < m_Size[1]; ++row)
          {
            itk::Index<3> index = m_Region.GetIndex();
            index[1] += static_cast<itk::IndexValueType>(row);
            index[2] += static_cast<itk::IndexValueType>(slice);
            const auto * const begin = image->GetBufferPointer() + image->ComputeOffset(index);
            std::transform(begin,
                           begin + m_Size[0],
                           mask.begin() + static_cast<std::ptrdiff_t>(row * m_Size[0]),
                           [&](auto value) { return static_cast<std::int32_t>(value) == m_Label; });
          }
        },
        m_Layer);
    }
    return mask;
  }

  std::uint32_t
  PointAt(std::size_t column, std::size_t row, const Plane & plane, itk::TriangleSurface & surface) const
  {
    std::uint32_t & number = plane.corners[row * (m_Size[0] + 1) + column];
    if (number == None)
    {
      number = static_cast<std::uint32_t>(surface.GetNumberOfPoints());
      const PointType point = plane.origin + m_AlongRow * (static_cast<double>(column) - 0.5) +
                              m_AlongColumn * (static_cast<double>(row) - 0.5);
      surface.GetPoints().push_back(
        { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
    }
    return number;
  }

  /** A face by its corners, counter-clockwise seen from outside in a grid that is not mirrored. */
  void
  AddFace(const std::array<std::uint32_t, 4> & corners, itk::TriangleSurface & surface) const
  {
    const auto [a, b, c, d] = corners;
    auto & triangles = surface.GetTriangles();
    triangles.push_back(m_IsMirrored ? itk::TriangleSurface::TriangleType{ a, c, b }
                                     : itk::TriangleSurface::TriangleType{ a, b, c });
    triangles.push_back(m_IsMirrored ? itk::TriangleSurface::TriangleType{ a, d, c }
                                     : itk::TriangleSurface::TriangleType{ a, c, d });
  }

  void
  AddSlice(const Mask & below,
           const Mask & here,
           const Mask & above,
           const Plane & bottom,
           const Plane & top,
           itk::TriangleSurface & surface) const
  {
    for (std::size_t row = 0; row < m_Size[1]; ++row)
    {
      for (std::size_t column = 0; column < m_Size[0]; ++column)
      {
        const std::size_t voxel = row * m_Size[0] + column;
        if (here[voxel] == 0)
        {
          continue;
        }
        const auto at = [&](std::size_t right, std::size_t up, const Plane & plane) {
          return this->PointAt(column + right, row + up, plane, surface);
        };
        if (below[voxel] == 0)
        {
          this->AddFace({ at(0, 0, bottom), at(0, 1, bottom), at(1, 1, bottom), at(1, 0, bottom) }, surface);
        }
        if (above[voxel] == 0)
        {
          this->AddFace({ at(0, 0, top), at(1, 0, top), at(1, 1, top), at(0, 1, top) }, surface);
        }
        if (column == 0 || here[voxel - 1] == 0)
        {
          this->AddFace({ at(0, 0, bottom), at(0, 0, top), at(0, 1, top), at(0, 1, bottom) }, surface);
        }
        if (column + 1 == m_Size[0] || here[voxel + 1] == 0)
        {
          this->AddFace({ at(1, 0, bottom), at(1, 1, bottom), at(1, 1, top), at(1, 0, top) }, surface);
        }
        if (row == 0 || here[voxel - m_Size[0]] == 0)
        {
          this->AddFace({ at(0, 0, bottom), at(1, 0, bottom), at(1, 0, top), at(0, 0, top) }, surface);
        }
        if (row + 1 == m_Size[1] || here[voxel + m_Size[0]] == 0)
        {
          this->AddFace({ at(0, 1, bottom), at(0, 1, top), at(1, 1, top), at(1, 1, bottom) }, surface);
        }
      }
    }
  }

  const ScanImage & m_Layer;
  std::int32_t m_Label;
  itk::ImageRegion<3> m_Region;
  itk::Size<3> m_Size;
  VectorType m_AlongRow{};
  VectorType m_AlongColumn{};
  bool m_IsMirrored = false;
};

} // namespace

itk::TriangleSurface::Pointer
ExtractVoxelSurface(const Scan & map, std::int32_t label, const itk::ImageRegion<3> & region)
{
  const auto surface = itk::TriangleSurface::New();
  if (region.GetNumberOfPixels() > 0)
  {
    const std::vector<PointType> planes = FindPlanes(map);
    for (const ScanImage & layer : LayersOf(map))
    {
      VoxelFaces(layer, label, region).AddTo(*surface, planes);
    }
  }
  return surface;
}

} // namespace rhombic
