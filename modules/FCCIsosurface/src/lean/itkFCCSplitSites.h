#ifndef itkFCCSplitSites_h
#define itkFCCSplitSites_h

#include "itkFCCLattice.h"
#include "itkFCCMarching.h"
#include "itkFCCSurfaceExtraction.h"

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace itk
{

/** For each site of a plane: how many triangles between clusters use it and the edges that it stores, one byte each.
 * Bytes 0 to 6 are FCCLattice::OwnedEdges, byte 7 is the site. */
struct FCCTriangleUse
{
  SizeValueType stride; ///< sites from a row to the next
  std::pmr::vector<std::uint64_t> counts;

  std::uint64_t *
  GetRow(SizeValueType j)
  {
    return counts.data() + j * stride;
  }
};

/** \class FCCSiteStar
 * \brief The edges at a site, and what sets of their crossings look like.
 *
 * Directions 0 to 6 are FCCLattice::OwnedEdges, which the site stores, 7 to 13 their opposites, which its neighbours
 * do. The crossings of two edges are *adjacent* when the edges' far ends are.
 *
 * \ingroup FCCIsosurface
 */
struct FCCSiteStar
{
  static constexpr unsigned int Directions = 2 * FCCLattice::OwnedEdges.size();

  static constexpr FCCLattice::SiteType
  StepOf(unsigned int direction)
  {
    const auto & step = FCCLattice::OwnedEdges[direction % FCCLattice::OwnedEdges.size()];
    const IndexValueType sign = direction < FCCLattice::OwnedEdges.size() ? 1 : -1;
    return { sign * step[0], sign * step[1], sign * step[2] };
  }

  /** Whether the crossings of a set of directions form a disk with the edges and triangles between them: they are
   * connected, and points - edges + triangles = 1. Thread safe. */
  static bool
  IsDisk(unsigned int set);

  /** The directions of a set that are connected with one of them. Thread safe. */
  static unsigned int
  PartOf(unsigned int set, unsigned int direction);

  /** How many vertices the crossings in the directions \a owned make when each of \a lone is one by itself and the
   * others gather in connected parts. Thread safe. */
  static SizeValueType
  CountParts(unsigned int owned, unsigned int lone);
};

/** \class FCCRareBits
 * \brief One bit for each site of a box, few of which are set: a row without any takes no more than a pointer.
 *
 * Thread safety: that of a container.
 *
 * \ingroup FCCIsosurface
 */
class FCCRareBits
{
public:
  using WordType = FCCSigns::WordType;

  /** For the sites of \a signs. */
  explicit FCCRareBits(const FCCSigns & signs)
    : m_Height(signs.GetHeight())
    , m_Rows(signs.GetHeight() * signs.GetDepth())
    , m_Zeros(signs.GetNumberOfWords() + 1)
  {}

  /** The words of a row as FCCSigns has them, with a spare zero word. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    const auto & row = m_Rows[k * m_Height + j];
    return row ? row.get() : m_Zeros.data();
  }

  void
  Set(SizeValueType i, SizeValueType j, SizeValueType k)
  {
    auto & row = m_Rows[k * m_Height + j];
    if (!row)
    {
      row = std::make_unique<WordType[]>(m_Zeros.size());
    }
    row[i / FCCSigns::WordBits] |= WordType{ 1 } << (i % FCCSigns::WordBits);
  }

private:
  SizeValueType m_Height;
  std::vector<std::unique_ptr<WordType[]>> m_Rows;
  std::vector<WordType> m_Zeros;
};

/** \class FCCSplitSites
 * \brief Which sites must not gather all the crossings they own, so that the surface stays a manifold.
 *
 * The surface before clustering, the tetrahedra's, is a manifold mesh. Gathering disjoint sets of its points, each into
 * one vertex, leaves a manifold of the same topology when
 *  1. the points of each set, with the edges and triangles between them, form a disk,
 *  2. no two vertices afterwards have an edge between them that is used by more than two triangles,
 *  3. each vertex of a set is used by at least three triangles afterwards.
 * All sites begin with one set each: all the crossings they own. A set that breaks a condition is divided: first into
 * the parts that are connected; a part that breaks a condition still gives up one point, if that helps, or else all.
 * This ends, at the latest with the mesh of the tetrahedra. Whether an edge breaks 2 depends on nothing but the sets of
 * its two ends, so only the surroundings of what was divided need to be looked at again.
 *
 * \ingroup FCCIsosurface
 */
class FCCSplitSites
{
public:
  using WordType = FCCSigns::WordType;

  /** What the values around a site say of the edges there that are cut: which of their ends own the crossings. */
  using OwnersType = std::uint64_t;

  using ValueReader = FCCScalarField::ValueReader;

  /** The owners around each of some sites. Thread safe. */
  static void
  FindOwners(const FCCSigns & signs,
             const ValueReader & readValues,
             bool insideIsBelow,
             const SizeValueType * sites,
             SizeValueType count,
             OwnersType * owners);

  /** Says what FindOwners() does, of sites that own crossings. Called by several threads. */
  using OwnersReader = std::function<void(const SizeValueType * sites, SizeValueType count, OwnersType * owners)>;

  /** \param signs with a layer of sites around the image; must outlive this */
  explicit FCCSplitSites(const FCCSigns & signs);

  using ParallelFor = FCCSurfaceExtraction::ParallelFor;

  /** Says that sites may break a condition; of the two ends of an edge that breaks 2, one will do. Sites are numbered
   * along x, then y, then z. Thread safe. */
  void
  Suspect(const std::vector<SizeValueType> & sites);

  /** Divides what has to be. The numbers of points of each plane and of triangles above it are those of whole sites
   * before; afterwards, points are right, and triangles at least as many as there will be. */
  void
  Resolve(const OwnersReader & ownersAround,
          const ParallelFor & parallelFor,
          std::vector<SizeValueType> & points,
          std::vector<SizeValueType> & triangles);

  /** One bit for each site: it is split. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    return m_Split.GetRow(j, k);
  }

  /** The directions of a split site whose crossings are points of their own; the others gather in connected parts. */
  unsigned int
  GetLone(SizeValueType i, SizeValueType j, SizeValueType k) const;

private:
  const FCCSigns & m_Signs;
  FCCRareBits m_Split;
  std::vector<SizeValueType> m_Suspects;
  std::mutex m_Mutex;
  std::vector<std::pair<SizeValueType, std::uint16_t>> m_Lone; ///< by the number of the site, ascending
};

} // namespace itk

#endif
