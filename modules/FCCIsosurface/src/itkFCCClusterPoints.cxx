#include "itkFCCClusterPoints.h"

#include <cmath>

namespace itk
{
namespace
{

constexpr unsigned int Directions = FCCClusterPlane::Directions;
static_assert(Directions == FCCClusterBlock::Directions, "one edge to each neighbour");

FCCLattice::SiteType
StepOf(unsigned int direction)
{
  const auto & step = FCCLattice::OwnedEdges[direction % FCCClusterPlane::Types];
  const IndexValueType sign = direction < FCCClusterPlane::Types ? 1 : -1;
  return { sign * step[0], sign * step[1], sign * step[2] };
}

} // namespace

void
FCCClusterPoints::Place(const FCCSigns & signs,
                        const FCCClusterPlane & plane,
                        SizeValueType k,
                        const FCCFieldPlanes & field,
                        TriangleSurface::PointType * points,
                        TriangleSurface::NormalType * normals) const
{
  constexpr SizeValueType lanes = FCCClusterBlock::Lanes;
  constexpr SizeValueType blocksPerWord = FCCSigns::WordBits / lanes;
  const ImageRegion<3> & region = m_Extent.GetRegion();
  const auto keep = [&](const TriangleSurface::PointType & point, const TriangleSurface::NormalType & normal) {
    *points++ = point;
    if (normals != nullptr)
    {
      *normals++ = normal;
    }
  };

  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    const bool isRealRow = field.IsReal(1, j) && field.IsReal(2, k);
    const SiteType firstSite = FCCLattice::SiteOf({ { region.GetIndex(0) - 1,
                                                      region.GetIndex(1) + static_cast<IndexValueType>(j) - 1,
                                                      region.GetIndex(2) + static_cast<IndexValueType>(k) - 1 } });
    const float * values = nullptr;
    const float * neighbors[Directions] = {};
    const float * gradient[3] = {};
    if (isRealRow)
    {
      values = field.GetValues(j, k);
      for (unsigned int direction = 0; direction < Directions; ++direction)
      {
        const auto offset = FCCLattice::OffsetOf(StepOf(direction), field.GetParity(j, k));
        neighbors[direction] =
          field.GetValues(j + static_cast<SizeValueType>(offset[1]), k + static_cast<SizeValueType>(offset[2])) +
          offset[0];
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] = field.GetGradients(axis, j, k);
      }
    }
    const FCCSigns::WordType * const clusters = plane.GetClusters().GetRow(j);
    for (SizeValueType block = 0; block < signs.GetNumberOfWords() * blocksPerWord; ++block)
    {
      const SizeValueType word = block / blocksPerWord;
      const SizeValueType shift = block % blocksPerWord * lanes;
      auto mask = clusters[word] >> shift & ((FCCSigns::WordType{ 1 } << lanes) - 1);
      if (mask == 0)
      {
        continue;
      }
      TriangleSurface::PointType blockPoints[lanes];
      TriangleSurface::NormalType blockNormals[lanes];
      if (isRealRow)
      {
        FCCClusterBlock sites;
        sites.values = values + block * lanes;
        for (unsigned int direction = 0; direction < Directions; ++direction)
        {
          sites.neighbors[direction] = neighbors[direction] + block * lanes;
          sites.owned[direction] =
            static_cast<std::uint32_t>(plane.GetOwnedRow(j, direction)[word] >> shift & ((1U << lanes) - 1));
        }
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          sites.gradient[axis] = gradient[axis] + block * lanes;
          sites.site[axis] = static_cast<double>(firstSite[axis]);
        }
        sites.site[0] += 2.0 * static_cast<double>(block * lanes);
        FCCPointKernels::PlaceClusters(sites, m_Frame, blockPoints, blockNormals);
      }
      for (; mask != 0; mask &= mask - 1)
      {
        const auto lane = static_cast<SizeValueType>(__builtin_ctzll(mask));
        const SizeValueType i = block * lanes + lane;
        if (!isRealRow || !field.IsReal(0, i))
        {
          const SiteType site{ firstSite[0] + 2 * static_cast<IndexValueType>(i), firstSite[1], firstSite[2] };
          this->PlaceOnBorder(site, plane.GetOwned(j, i), blockPoints[lane], blockNormals[lane]);
        }
        keep(blockPoints[lane], blockNormals[lane]);
      }
    }
  }
}

void
FCCClusterPoints::PlaceOnBorder(const SiteType & site,
                                unsigned int owned,
                                TriangleSurface::PointType & point,
                                TriangleSurface::NormalType & normal) const
{
  std::array<double, 3> sum{};
  double count = 0.0;
  for (unsigned int direction = 0; direction < Directions; ++direction)
  {
    if ((owned >> direction & 1) != 0)
    {
      const SiteType step = StepOf(direction);
      const SiteType end{ site[0] + step[0], site[1] + step[1], site[2] + step[2] };
      const double fraction = m_Extent.FractionToBorder(end, { -step[0], -step[1], -step[2] });
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += static_cast<double>(end[axis]) - fraction * static_cast<double>(step[axis]);
      }
      count += 1.0;
    }
  }
  const auto direction = m_Extent.DirectionTo(site);
  double squared = 0.0;
  std::array<double, 3> outwards{};
  for (unsigned int row = 0; row < 3; ++row)
  {
    double world = m_Frame.origin[row];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      world += m_Frame.matrix[row][axis] * sum[axis] / count;
      outwards[row] += m_Frame.gradientToWorld[row][axis] * direction[axis];
    }
    point[row] = static_cast<float>(world);
    squared += outwards[row] * outwards[row];
  }
  for (unsigned int row = 0; row < 3; ++row)
  {
    normal[row] = static_cast<float>(outwards[row] / std::sqrt(squared));
  }
}

} // namespace itk
