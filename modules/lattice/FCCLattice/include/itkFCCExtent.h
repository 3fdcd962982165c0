#ifndef itkFCCExtent_h
#define itkFCCExtent_h

#include "itkFCCLattice.h"
#include "itkImageRegion.h"

#include <algorithm>

namespace itk
{

/** \class FCCExtent
 * \brief The extent of a region of an FCC image, in lattice coordinates: the box from half a unit before its first
 * sites to half a unit after its last ones along each axis.
 *
 * \ingroup FCCLattice
 */
class FCCExtent
{
public:
  using SiteType = FCCLattice::SiteType;
  using CoordinatesType = std::array<double, 3>;

  explicit FCCExtent(const ImageRegion<3> & region)
    : m_Region(region)
  {
    constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Lowest[axis] = unitsPerIndex[axis] * static_cast<double>(region.GetIndex(axis)) - 0.5;
      m_Highest[axis] = m_Lowest[axis] + unitsPerIndex[axis] * static_cast<double>(region.GetSize(axis));
    }
  }

  const ImageRegion<3> &
  GetRegion() const
  {
    return m_Region;
  }

  /** The corners of the box. */
  const CoordinatesType &
  GetLowest() const
  {
    return m_Lowest;
  }
  const CoordinatesType &
  GetHighest() const
  {
    return m_Highest;
  }

  /** Whether lattice coordinates lie in the box, its highest faces excluded; false for NaN. */
  bool
  IsInside(const CoordinatesType & coordinates) const
  {
    bool isInside = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isInside = isInside && coordinates[axis] >= m_Lowest[axis] && coordinates[axis] < m_Highest[axis];
    }
    return isInside;
  }

  /** The fraction of a step from a site of the region out of the region at which the step leaves the box. */
  double
  FractionToBorder(const SiteType & site, const SiteType & step) const
  {
    double nearest = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double border = step[axis] > 0 ? m_Highest[axis] : m_Lowest[axis];
      if (step[axis] != 0)
      {
        nearest = std::min(nearest, (border - static_cast<double>(site[axis])) / static_cast<double>(step[axis]));
      }
    }
    return nearest;
  }

  /** The outward direction of the faces beyond which a site outside the region lies: -1, 0 or 1 along each axis. */
  CoordinatesType
  DirectionTo(const SiteType & outside) const
  {
    const Index<3> index = FCCLattice::IndexOf(outside);
    CoordinatesType direction{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[axis] = index[axis] < m_Region.GetIndex(axis)          ? -1.0
                        : index[axis] > m_Region.GetUpperIndex()[axis] ? 1.0
                                                                       : 0.0;
    }
    return direction;
  }

private:
  ImageRegion<3> m_Region;
  CoordinatesType m_Lowest;
  CoordinatesType m_Highest;
};

} // namespace itk

#endif
