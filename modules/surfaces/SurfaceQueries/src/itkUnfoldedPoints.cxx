#include "detail/itkTrianglesOfPoints.h"

#include "rhombicForEachBlock.h"
#include "detail/itkPositionArithmetic.h"

#include <algorithm>

namespace itk
{
namespace
{

constexpr std::size_t MostInFan = 24; // points with more triangles count as folded

/** The triangles at a point in their order around it. */
class Fan
{
public:
  Fan(const TriangleSurface & surface, const TrianglesOfPoints & triangles, std::uint32_t point)
  {
    if (triangles.GetNumberOfTriangles(point) > MostInFan)
    {
      return;
    }
    std::array<std::array<std::uint32_t, 2>, MostInFan> sides; // of each triangle: its other corners
    std::size_t count = 0;
    triangles.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t last) { sides[count++] = { next, last }; });
    const PositionType centre = ToPosition(surface.GetPoints()[point]);
    for (std::size_t n = 0, current = 0; n < count; ++n)
    {
      m_Spokes[n] = Subtract(ToPosition(surface.GetPoints()[sides[current][0]]), centre);
      const auto following = std::find_if(
        sides.begin(), sides.begin() + count, [&](const auto & side) { return side[0] == sides[current][1]; });
      current = static_cast<std::size_t>(following - sides.begin());
      const bool isLast = n + 1 == count;
      if (current == count || (current == 0) != isLast)
      {
        return; // open, or several fans
      }
    }
    m_Size = count;
  }

  bool
  IsUnfolded() const
  {
    PositionType normal{};
    for (std::size_t n = 0; n < m_Size; ++n)
    {
      normal = itk::Add(normal, Cross(m_Spokes[n], m_Spokes[this->Next(n)]));
    }
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
    {
      axis = std::abs(normal[other]) > std::abs(normal[axis]) ? other : axis;
    }
    // Moved along the normal into the plane across the axis, a spoke keeps its length within a factor of 2.
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double perU = normal[u] / normal[axis], perV = normal[v] / normal[axis];
    std::array<double, MostInFan> us, vs, lengths;
    for (std::size_t n = 0; n < m_Size; ++n)
    {
      const PositionType & spoke = m_Spokes[n];
      us[n] = spoke[u] - perU * spoke[axis];
      vs[n] = spoke[v] - perV * spoke[axis];
      lengths[n] = std::abs(spoke[0]) + std::abs(spoke[1]) + std::abs(spoke[2]);
    }
    constexpr double rounding = 1e-14; // of a product of two coordinates, over that of the spokes' lengths; generous
    const double sense = normal[axis] > 0.0 ? 1.0 : -1.0;
    int turns = 0;
    bool areSameSide = m_Size > 2;
    for (std::size_t n = 0; n < m_Size; ++n)
    {
      const std::size_t next = this->Next(n);
      areSameSide &= sense * (us[n] * vs[next] - vs[n] * us[next]) > rounding * lengths[n] * lengths[next];
      turns += vs[n] < 0.0 && vs[next] >= 0.0 ? 1 : 0;
    }
    return areSameSide && turns == 1;
  }

private:
  std::size_t
  Next(std::size_t n) const
  {
    return n + 1 < m_Size ? n + 1 : 0;
  }

  std::array<PositionType, MostInFan> m_Spokes; ///< from the point to those around it
  std::size_t m_Size = 0;                       ///< 0 if the triangles do not form one closed fan
};

} // namespace

std::vector<std::uint8_t>
FindUnfoldedPoints(const TriangleSurface & surface, const TrianglesOfPoints & triangles)
{
  std::vector<std::uint8_t> areUnfolded(surface.GetNumberOfPoints());
  constexpr std::size_t pointsOfBlock = 16384;
  rhombic::ForEachInBlocks(areUnfolded.size(), pointsOfBlock, [&](std::size_t point) {
    areUnfolded[point] = Fan(surface, triangles, static_cast<std::uint32_t>(point)).IsUnfolded();
  });
  return areUnfolded;
}

} // namespace itk
