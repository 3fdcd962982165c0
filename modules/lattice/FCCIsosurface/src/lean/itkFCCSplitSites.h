#ifndef itkFCCSplitSites_h
#define itkFCCSplitSites_h

#include "itkFCCNearerEnds.h"
#include "itkFCCSiteParts.h"
#include "itkFCCSiteStar.h"

#include <array>
#include <mutex>

namespace itk
{

/** \class FCCSplitSites
 * \brief Which sites must not gather all their crossings in one vertex, so that the surface stays a manifold.
 *
 * The surface before clustering, the tetrahedra's, is a manifold mesh. Gathering disjoint sets of its points, each into
 * one vertex, leaves a manifold of the same topology when
 *  1. the points of each set, with the edges and triangles between them, form a disk,
 *  2. no two vertices afterwards have an edge between them that is used by more than two triangles,
 *  3. each vertex of a set is used by at least three triangles afterwards.
 * All sites begin with one set each: all the crossings that they are nearer to. A set that breaks a condition is
 * divided: first into the parts that are connected; a part that breaks a condition still gives up one point, if that
 * helps, or else all. This ends, at the latest with the mesh of the tetrahedra. Whether an edge breaks 2 depends on
 * nothing but the sets of its two ends, so only the surroundings of divided sites need to be looked at again.
 */
class FCCSplitSites
{
public:
  /** \param signs with a layer of sites around the image; must outlive this */
  FCCSplitSites(const FCCSigns & signs, std::pmr::memory_resource * scratch);

  /** Numbers of triangles between the plane below a site and its own, and between its own and the plane above. */
  using LayerCounts = std::array<SizeValueType, 2>;

  /** Nearer ends of the planes below, at and above another. */
  using NearerEndsAround = std::array<const FCCNearerEnds *, 3>;

  /** Adds sites of a plane that may break a condition, ascending; for an edge that breaks 2, one of its ends is enough.
   * Sites are numbered along x, then y, in the plane. Sites of different planes may be added at once. */
  void
  Suspect(SizeValueType k, const std::vector<std::uint32_t> & numbers, const NearerEndsAround & nearerEnds);

  /** Divides sites until no vertex breaks a condition. Before, \a points and \a triangles are the numbers of points of
   * each plane and of triangles between it and the next when all sites are whole. Afterwards, they are
   * the numbers with the sites divided. \param nearerEnds of all planes */
  void
  Resolve(const std::vector<FCCNearerEnds::Packed> & nearerEnds,
          const FCCSurfaceExtractor::Workers & workers,
          std::vector<SizeValueType> & points,
          std::vector<SizeValueType> & triangles);

  /** The split sites, once resolved. */
  const FCCSplitRows &
  GetRows() const
  {
    return m_Split;
  }

private:
  /** Sites of one color in a plane have no neighbours of that color in the plane: they can be divided at once. */
  static constexpr unsigned int ColorsOfPlane = 4;

  /** Planes whose suspects are taken together, as the nearer ends of the planes next to them are needed. */
  static constexpr SizeValueType PlanesOfSlab = 8;

  /** A site that may break a condition. */
  struct SuspectedSite
  {
    std::uint32_t number; ///< in the plane
    FCCSiteStar::Pattern star;
  };

  struct DividedSite
  {
    std::uint32_t number;
    FCCSiteParts parts;
    LayerCounts added; ///< triangles
  };

  struct Plane
  {
    std::array<std::vector<SuspectedSite>, ColorsOfPlane> suspects;
    std::vector<DividedSite> divided;  ///< whose parts are not written yet
    std::vector<std::uint32_t> broken; ///< to be suspected in the next round; in any order, and maybe several times
  };

  bool
  HasSuspects() const;

  /** Suspects the broken sites of a few planes. */
  void
  SuspectBroken(SizeValueType begin,
                SizeValueType end,
                const std::vector<FCCNearerEnds::Packed> & nearerEnds,
                const FCCSurfaceExtractor::Workers & workers);

  /** Divides the suspects of a color and finds others that break a condition then, but does not write the parts. */
  void
  DivideSuspects(SizeValueType k, unsigned int color, const FCCSurfaceExtractor::Workers & workers);

  /** Writes the parts of divided sites. */
  void
  SetDivided(SizeValueType k, std::vector<SizeValueType> & triangles);

  const FCCSigns & m_Signs;
  std::pmr::memory_resource * m_Scratch;
  FCCSplitRows m_Split;
  std::vector<Plane> m_Planes;
  std::mutex m_Mutex; ///< for broken sites of other planes
};

} // namespace itk

#endif
