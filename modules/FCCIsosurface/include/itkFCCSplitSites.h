#ifndef itkFCCSplitSites_h
#define itkFCCSplitSites_h

#include "itkFCCLeanMarching.h"

#include <functional>

namespace itk
{

/** \class FCCSplitSites
 * \brief Which sites must not gather the crossings they own, so that the surface stays a manifold.
 *
 * The surface before clustering, the tetrahedra's, is a manifold mesh. Gathering disjoint sets of its points leaves a
 * manifold of the same topology when
 *  1. the points of each set, with the edges and triangles between them, form a disk (a contractible patch),
 *  2. no two vertices afterwards have an edge between them that is used by more than two triangles,
 *  3. each vertex afterwards is used by at least three triangles.
 * A site is split if it breaks 1, or if it is an end of an edge that breaks 2 or breaks 3 itself, were all sites to
 * gather their crossings. Then the points of split sites are single, and the edges from them to the remaining sets may
 * break 2: such a set is split, too, until there are none. Whether an edge between a single point and a set breaks 2
 * does not depend on other sets, so the outcome does not depend on the order; and it ends, at the latest with the mesh
 * of the tetrahedra.
 *
 * \ingroup FCCIsosurface
 */
class FCCSplitSites
{
public:
  using WordType = FCCSigns::WordType;

  /** The value at a site, counted as signs are, less the isovalue, in float32. */
  using ValueReader = std::function<float(SizeValueType i, SizeValueType j, SizeValueType k)>;

  explicit FCCSplitSites(const FCCSigns & signs);

  /** Splits the sites of a plane that break a condition by themselves. \a use and \a useBelow are complete counts of
   * this plane's edges and the plane's below; they are cleared where they were looked at. Rows of other planes may be
   * found at the same time. */
  void
  FindSeeds(SizeValueType k,
            const FCCClusterPlane & plane,
            const FCCTriangleUse & use,
            const FCCTriangleUse * useBelow);

  /** Splits more sites until all conditions hold. */
  void
  Close(const ValueReader & valueAt, bool insideIsBelow);

  /** One bit for each site: it is split. */
  const FCCSigns &
  GetBits() const
  {
    return m_Split;
  }

private:
  const FCCSigns & m_Signs;
  FCCSigns m_Split;
};

} // namespace itk

#endif
