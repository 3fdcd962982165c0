#ifndef itkFCCExtent_h
#define itkFCCExtent_h

#include "itkFCCLattice.h"
#include "itkImageRegion.h"

#include <algorithm>

namespace itk
{

/** \class FCCExtent
 * \brief The faces on which a closed surface ends at the border of an image: half a lattice unit beyond its samples.
 */
class FCCExtent
{
public:
  using SiteType = FCCLattice::SiteType;

  explicit FCCExtent(const ImageRegion<3> & region)
    : m_Region(region)
  {}

  const ImageRegion<3> &
  GetRegion() const
  {
    return m_Region;
  }

  /** The fraction of a step from a sample out of the image at which the step crosses the extent. */
  double
  FractionToBorder(const SiteType & site, const SiteType & step) const
  {
    constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };
    double nearest = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double begin = unitsPerIndex[axis] * static_cast<double>(m_Region.GetIndex(axis)) - 0.5;
      const double end = begin + unitsPerIndex[axis] * static_cast<double>(m_Region.GetSize(axis));
      const double border = step[axis] > 0 ? end : begin;
      if (step[axis] != 0)
      {
        nearest = std::min(nearest, (border - static_cast<double>(site[axis])) / static_cast<double>(step[axis]));
      }
    }
    return nearest;
  }

  /** The outward direction of the faces beyond which a site outside the image lies, in lattice coordinates: -1, 0 or 1
   * along each axis. */
  std::array<double, 3>
  DirectionTo(const SiteType & outside) const
  {
    const Index<3> index = FCCLattice::IndexOf(outside);
    std::array<double, 3> direction{};
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
};

} // namespace itk

#endif
