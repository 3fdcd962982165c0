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

/** \class FCCSiteParts
 * \brief What the crossings that a split site owns make vertices of: some are alone, the others gather in connected
 * parts. Sets of crossings are bits of their directions.
 *
 * Thread safety: a value.
 *
 * \ingroup FCCIsosurface
 */
struct FCCSiteParts
{
  unsigned int owned = 0;
  unsigned int lone = 0;
  std::uint64_t lowest = 0; ///< four bits a direction: the lowest direction of the vertex that its crossing belongs to

  FCCSiteParts() = default;
  FCCSiteParts(unsigned int allOwned, unsigned int allLone);

  /** Calls use(directions) for each connected part of the crossings that are not alone. */
  template <typename TUse>
  void
  ForEachPart(const TUse & use) const
  {
    const unsigned int gathered = owned & ~lone;
    for (unsigned int left = gathered; left != 0;)
    {
      const unsigned int part = FCCSiteStar::PartOf(gathered, static_cast<unsigned int>(__builtin_ctz(left)));
      left &= ~part;
      use(part);
    }
  }

  unsigned int
  LowestOf(unsigned int direction) const
  {
    return static_cast<unsigned int>(lowest >> (4 * direction) & 15);
  }
};

/** \class FCCSplitRows
 * \brief The split sites of a box and their parts: a row without any takes no more than a pointer.
 *
 * Thread safety: that of a container, for each row.
 *
 * \ingroup FCCIsosurface
 */
class FCCSplitRows
{
public:
  using WordType = FCCSigns::WordType;

  /** For the sites of \a signs. */
  explicit FCCSplitRows(const FCCSigns & signs)
    : m_Height(signs.GetHeight())
    , m_Rows(signs.GetHeight() * signs.GetDepth())
    , m_Zeros(signs.GetNumberOfWords() + 1)
  {}

  /** One bit for each site of a row, in words as FCCSigns has them, with a spare zero word. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    const auto & row = m_Rows[k * m_Height + j];
    return row ? row->bits.data() : m_Zeros.data();
  }

  /** The parts of all split sites of a row, ascending. */
  const std::vector<FCCSiteParts> &
  GetParts(SizeValueType j, SizeValueType k) const;

  /** The parts of a split site. */
  const FCCSiteParts &
  GetParts(SizeValueType i, SizeValueType j, SizeValueType k) const;

  /** Splits a site, or divides it anew. Returns whether it had not been split. */
  bool
  Set(SizeValueType i, SizeValueType j, SizeValueType k, const FCCSiteParts & parts);

private:
  struct Row
  {
    std::vector<WordType> bits;
    std::vector<FCCSiteParts> parts; ///< of the sites of the bits, ascending
  };

  SizeValueType m_Height;
  std::vector<std::unique_ptr<Row>> m_Rows;
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

  /** Says that sites of a plane may break a condition; of the two ends of an edge that breaks 2, one will do. Sites are
   * numbered along x, then y, in the plane. Thread safe for different planes. */
  void
  Suspect(SizeValueType k, std::vector<std::uint32_t> && sites)
  {
    m_Suspects[k] = std::move(sites);
  }

  /** Divides what has to be. The numbers of points of each plane and of triangles above it are those of whole sites
   * before; afterwards, points are right, and triangles at least as many as there will be. */
  void
  Resolve(const OwnersReader & ownersAround,
          const FCCSurfaceExtraction::Crew & crew,
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
  GetLone(SizeValueType i, SizeValueType j, SizeValueType k) const
  {
    return m_Split.GetParts(i, j, k).lone;
  }

private:
  struct SuspectsOfPlane;

  /** Sites of a plane that no other of them is a neighbour of are of one color: they can be divided at once. */
  static constexpr unsigned int ColorsOfPlane = 4;

  bool
  HasSuspects() const;

  /** The suspects of a plane by their colors, which are then no longer any. */
  void
  TakeSuspects(SizeValueType k,
               const OwnersReader & ownersAround,
               const FCCSurfaceExtraction::Crew & crew,
               SuspectsOfPlane & suspects);

  /** Divides the suspects of a color, suspecting others, but does not tell yet. */
  void
  DivideSuspects(SizeValueType k,
                 unsigned int colorInPlane,
                 const FCCSurfaceExtraction::Crew & crew,
                 SuspectsOfPlane & suspects);

  /** Tells what was divided. */
  void
  SetDivided(SizeValueType k, SuspectsOfPlane & suspects, std::vector<SizeValueType> & triangles);

  const FCCSigns & m_Signs;
  FCCSplitRows m_Split;
  std::vector<std::vector<std::uint32_t>> m_Suspects; ///< of each plane; in any order, and maybe several times
  std::mutex m_Mutex;                                 ///< for those that are added to other planes
};

} // namespace itk

#endif
