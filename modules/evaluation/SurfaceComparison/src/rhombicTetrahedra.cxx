#include "rhombicCartesianSurfaces.h"

#include "rhombicForEachBlock.h"
#include "rhombicGridSurface.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using IntegerPoint = std::array<int, 3>;

/** A corner of a tetrahedron: the cell's first site, and which of the three steps lead from there to the corner. */
struct Corner
{
  GridSurface::Corner site;
  unsigned int steps; ///< a bit for each
};

class TetrahedraMarcher
{
public:
  explicit TetrahedraMarcher(const TetrahedraGrid & grid)
    : m_Grid(grid)
    , m_Surface(grid)
  {}

  itk::TriangleSurface::Pointer
  Run()
  {
    const auto & [a, b, c] = m_Grid.steps;
    const int volume =
      a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    IntegerPoint p;
    for (p[2] = 0; p[2] < m_Grid.size[2]; ++p[2])
    {
      for (p[1] = 0; p[1] < m_Grid.size[1]; ++p[1])
      {
        for (p[0] = 0; p[0] < m_Grid.size[0]; ++p[0])
        {
          this->MarchCell(p, volume > 0);
        }
      }
    }
    return m_Surface.GetSurface();
  }

private:
  Corner
  CornerOf(const IntegerPoint & first, unsigned int steps) const
  {
    Corner corner{ { first, TetrahedraGrid::NoSite }, steps };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (unsigned int step = 0; step < 3; ++step)
      {
        corner.site.point[axis] += (steps >> step & 1U) * m_Grid.steps[step][axis];
      }
    }
    corner.site.value = m_Surface.ValueAt(corner.site.point);
    return corner;
  }

  void
  MarchCell(const IntegerPoint & first, bool isRightHanded)
  {
    std::array<Corner, 8> corners;
    for (unsigned int steps = 0; steps < 8; ++steps)
    {
      corners[steps] = this->CornerOf(first, steps);
    }
    std::array<unsigned int, 3> order{ 0, 1, 2 };
    do
    {
      const unsigned int one = 1U << order[0];
      const unsigned int two = one | 1U << order[1];
      const bool isEven = (order[1] + 3 - order[0]) % 3 == 1;
      this->MarchTetrahedron({ corners[0], corners[one], corners[two], corners[7] }, isEven == isRightHanded);
    } while (std::next_permutation(order.begin(), order.end()));
  }

  /** Corners inside are put first, by exchanges that each turn the tetrahedron's orientation. */
  void
  MarchTetrahedron(std::array<Corner, 4> corners, bool isRightHanded)
  {
    unsigned int inside = 0;
    for (unsigned int n = 0; n < 4; ++n)
    {
      if (std::isnan(corners[n].site.value))
      {
        return;
      }
      if (corners[n].site.value >= 0.0F)
      {
        isRightHanded = isRightHanded != (n != inside);
        std::swap(corners[n], corners[inside++]);
      }
    }
    const auto & [a, b, c, d] = corners;
    if (inside == 1)
    {
      this->AddTriangle(this->PointOn(a, b), this->PointOn(a, c), this->PointOn(a, d), isRightHanded);
    }
    else if (inside == 2)
    {
      const std::uint32_t first = this->PointOn(a, c);
      const std::uint32_t last = this->PointOn(b, d);
      this->AddTriangle(first, this->PointOn(a, d), last, isRightHanded);
      this->AddTriangle(first, last, this->PointOn(b, c), isRightHanded);
    }
    else if (inside == 3)
    {
      this->AddTriangle(this->PointOn(a, d), this->PointOn(b, d), this->PointOn(c, d), isRightHanded);
    }
  }

  void
  AddTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool isRightHanded)
  {
    m_Surface.AddTriangle(a, isRightHanded ? b : c, isRightHanded ? c : b);
  }

  std::uint32_t
  PointOn(const Corner & a, const Corner & b)
  {
    const bool isForwards = a.steps < b.steps; // steps of one corner of an edge contain those of the other
    const Corner & begin = isForwards ? a : b;
    const Corner & end = isForwards ? b : a;
    return m_Surface.PointBetween(begin.site, end.site, (begin.steps ^ end.steps) - 1);
  }

  const TetrahedraGrid & m_Grid;
  GridSurface m_Surface;
};

} // namespace

TetrahedraGrid
CartesianTetrahedra(const itk::Image<float, 3> * volume)
{
  const auto & size = volume->GetBufferedRegion().GetSize();
  const auto & origin = volume->GetOrigin();
  const auto & spacing = volume->GetSpacing();
  const float * const values = volume->GetBufferPointer();
  return { { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
           { static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]) },
           { origin[0], origin[1], origin[2] },
           { spacing[0], spacing[1], spacing[2] },
           { values, values + volume->GetBufferedRegion().GetNumberOfPixels() } };
}

TetrahedraGrid
SampleOnBCC(const ReferenceField & field, const Vector3 & origin, const std::array<int, 3> & size, double spacing)
{
  TetrahedraGrid grid{
    { { { -1, 1, 1 }, { 1, -1, 1 }, { 1, 1, -1 } } }, size, origin, { spacing, spacing, spacing }, {}
  };
  grid.values.assign(static_cast<std::size_t>(size[0] * size[1] * size[2]), TetrahedraGrid::NoSite);
  ForEachInBlocks(static_cast<itk::SizeValueType>(size[2]), 1, [&](itk::SizeValueType plane) {
    const int z = static_cast<int>(plane);
    for (int y = z % 2; y < size[1]; y += 2)
    {
      for (int x = z % 2; x < size[0]; x += 2)
      {
        grid.values[grid.GetOffset({ x, y, z })] = static_cast<float>(field.Evaluate(grid.GetPosition({ x, y, z })));
      }
    }
  });
  return grid;
}

itk::TriangleSurface::Pointer
MarchTetrahedra(const TetrahedraGrid & grid)
{
  return TetrahedraMarcher(grid).Run();
}

} // namespace rhombic
