#include "itkFCCClusterPoints.h"

#include <cmath>

namespace itk
{
namespace
{

constexpr unsigned int Directions = FCCSiteStar::Directions;
static_assert(Directions == FCCClusterBlock::Directions, "one edge to each neighbour");
constexpr SizeValueType Lanes = FCCClusterBlock::Lanes;

} // namespace

struct FCCClusterPoints::Rows
{
  const float * values;
  const float * neighbors[Directions];
  const float * gradient[3];

  Rows(const FCCFieldPlanes & field, SizeValueType j, SizeValueType k)
    : values(field.GetValues(j, k))
  {
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      const auto offset = FCCLattice::OffsetOf(FCCSiteStar::StepOf(direction), field.GetParity(j, k));
      neighbors[direction] =
        field.GetValues(j + static_cast<SizeValueType>(offset[1]), k + static_cast<SizeValueType>(offset[2])) +
        offset[0];
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] = field.GetGradients(axis, j, k);
    }
  }

  /** The block of sites from \a i on; what they own is left open. */
  FCCClusterBlock
  GetBlock(SizeValueType i, const SiteType & firstSite) const
  {
    FCCClusterBlock block{};
    block.values = values + i;
    for (unsigned int direction = 0; direction < Directions; ++direction)
    {
      block.neighbors[direction] = neighbors[direction] + i;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      block.gradient[axis] = gradient[axis] + i;
      block.site[axis] = static_cast<double>(firstSite[axis]);
    }
    block.site[0] += 2.0 * static_cast<double>(i);
    return block;
  }
};

void
FCCClusterPoints::Place(const FCCSigns & signs,
                        const FCCClusterPlane & plane,
                        SizeValueType k,
                        const FCCFieldPlanes & field,
                        TriangleSurface::PointType * points,
                        TriangleSurface::NormalType * normals) const
{
  TriangleSurface::PointType * const parts = this->PlaceWholes(signs, plane, k, field, points, normals);
  this->PlaceParts(plane, k, field, parts, normals != nullptr ? normals + (parts - points) : nullptr);
}

TriangleSurface::PointType *
FCCClusterPoints::PlaceWholes(const FCCSigns & signs,
                              const FCCClusterPlane & plane,
                              SizeValueType k,
                              const FCCFieldPlanes & field,
                              TriangleSurface::PointType * points,
                              TriangleSurface::NormalType * normals) const
{
  constexpr SizeValueType blocksPerWord = FCCSigns::WordBits / Lanes;
  constexpr FCCSigns::WordType lanesOfBlock = (FCCSigns::WordType{ 1 } << Lanes) - 1;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    const FCCSigns::WordType * const wholes = plane.GetWholes().GetRow(j);
    const bool isRealRow = field.IsReal(1, j) && field.IsReal(2, k);
    const SiteType firstSite = this->SiteOf(0, j, k);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
      if (wholes[word] == 0)
      {
        continue;
      }
      for (SizeValueType block = word * blocksPerWord; block < (word + 1) * blocksPerWord; ++block)
      {
        const SizeValueType shift = block % blocksPerWord * Lanes;
        FCCSigns::WordType mask = wholes[word] >> shift & lanesOfBlock;
        if (mask == 0)
        {
          continue;
        }
        TriangleSurface::PointType blockPoints[Lanes];
        TriangleSurface::NormalType blockNormals[Lanes];
        if (isRealRow)
        {
          FCCClusterBlock sites = Rows(field, j, k).GetBlock(block * Lanes, firstSite);
          sites.farthest = FarthestOfWhole;
          for (unsigned int direction = 0; direction < Directions; ++direction)
          {
            sites.owned[direction] =
              static_cast<std::uint32_t>(plane.GetOwnedRow(j, direction)[word] >> shift & lanesOfBlock);
          }
          FCCPointKernels::PlaceClusters(sites, m_Frame, blockPoints, blockNormals);
        }
        for (; mask != 0; mask &= mask - 1)
        {
          const auto lane = static_cast<SizeValueType>(__builtin_ctzll(mask));
          const SizeValueType i = block * Lanes + lane;
          if (!isRealRow || !field.IsReal(0, i))
          {
            this->PlaceOnBorder(this->SiteOf(i, j, k), plane.GetOwned(j, i), blockPoints[lane], blockNormals[lane]);
          }
          *points++ = blockPoints[lane];
          if (normals != nullptr)
          {
            *normals++ = blockNormals[lane];
          }
        }
      }
    }
  }
  return points;
}

void
FCCClusterPoints::PlaceParts(const FCCClusterPlane & plane,
                             SizeValueType k,
                             const FCCFieldPlanes & field,
                             TriangleSurface::PointType * points,
                             TriangleSurface::NormalType * normals) const
{
  for (const FCCClusterPlane::Parts & parts : plane.GetParts())
  {
    const bool isReal = field.IsReal(0, parts.i) && field.IsReal(1, parts.j) && field.IsReal(2, k);
    for (unsigned int left = parts.lowest; left != 0; left &= left - 1)
    {
      const auto lowest = static_cast<unsigned int>(__builtin_ctz(left));
      const unsigned int part =
        (parts.lone >> lowest & 1) != 0 ? 1U << lowest : FCCSiteStar::PartOf(parts.owned & ~parts.lone, lowest);
      TriangleSurface::PointType blockPoints[Lanes];
      TriangleSurface::NormalType blockNormals[Lanes];
      if ((part & (part - 1)) == 0)
      {
        FCCEdgeBatch batch{};
        m_EdgePoints.Gather(
          { parts.i, parts.j, k }, FCCSiteStar::StepOf(lowest), field, normals != nullptr, batch);
        m_EdgePoints.PlaceBatch(batch, blockPoints, normals != nullptr ? blockNormals : nullptr);
      }
      else if (isReal)
      {
        FCCClusterBlock site = Rows(field, parts.j, k).GetBlock(parts.i, this->SiteOf(0, parts.j, k));
        site.farthest = FarthestOfPart;
        site.minimumFraction = static_cast<float>(m_MinimumFraction);
        for (unsigned int direction = 0; direction < Directions; ++direction)
        {
          site.owned[direction] = part >> direction & 1;
        }
        FCCPointKernels::PlaceClusters(site, m_Frame, blockPoints, blockNormals);
      }
      else
      {
        this->PlaceOnBorder(this->SiteOf(parts.i, parts.j, k), part, blockPoints[0], blockNormals[0]);
      }
      *points++ = blockPoints[0];
      if (normals != nullptr)
      {
        *normals++ = blockNormals[0];
      }
    }
  }
}

FCCLattice::SiteType
FCCClusterPoints::SiteOf(SizeValueType i, SizeValueType j, SizeValueType k) const
{
  const auto & first = m_Extent.GetRegion().GetIndex();
  const SiteType firstSite = FCCLattice::SiteOf({ { first[0] - 1,
                                                    first[1] + static_cast<IndexValueType>(j) - 1,
                                                    first[2] + static_cast<IndexValueType>(k) - 1 } });
  return { firstSite[0] + 2 * static_cast<IndexValueType>(i), firstSite[1], firstSite[2] };
}

void
FCCClusterPoints::PlaceOnBorder(const SiteType & site,
                                unsigned int owned,
                                TriangleSurface::PointType & point,
                                TriangleSurface::NormalType & normal) const
{
  std::array<double, 3> sum{};
  double count = 0.0;
  for (unsigned int left = owned; left != 0; left &= left - 1)
  {
    const SiteType step = FCCSiteStar::StepOf(static_cast<unsigned int>(__builtin_ctz(left)));
    const SiteType end{ site[0] + step[0], site[1] + step[1], site[2] + step[2] };
    const double fraction = m_Extent.FractionToBorder(end, { -step[0], -step[1], -step[2] });
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sum[axis] += static_cast<double>(end[axis]) - fraction * static_cast<double>(step[axis]);
    }
    count += 1.0;
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
