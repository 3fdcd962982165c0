#ifndef itkFCCStep_h
#define itkFCCStep_h

#include "itkFCCLattice.h"

namespace itk
{

/** \class FCCStep
 * \brief Arithmetic of steps between sites, at compile time.
 */
struct FCCStep
{
  using SiteType = FCCLattice::SiteType;

  static constexpr SiteType
  Subtract(const SiteType & a, const SiteType & b)
  {
    return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  }

  static constexpr bool
  AreEqual(const SiteType & a, const SiteType & b)
  {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }

  static constexpr IndexValueType
  SquaredLength(const SiteType & step)
  {
    return step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
  }

  static constexpr SiteType
  Cross(const SiteType & a, const SiteType & b)
  {
    return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
  }

  /** Six times the signed volume of the tetrahedron of four sites: negative when \a d lies below the plane of the
   * others, which are counter-clockwise seen from above. */
  static constexpr IndexValueType
  Orientation(const SiteType & a, const SiteType & b, const SiteType & c, const SiteType & d)
  {
    const SiteType normal = Cross(Subtract(b, a), Subtract(c, a));
    const SiteType step = Subtract(d, a);
    return normal[0] * step[0] + normal[1] * step[1] + normal[2] * step[2];
  }

  /** Whether a site comes before another by z, then y, then x. */
  static constexpr bool
  IsLower(const SiteType & a, const SiteType & b)
  {
    return a[2] != b[2] ? a[2] < b[2] : a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
  }
};

} // namespace itk

#endif
