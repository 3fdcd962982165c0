#ifndef itkFCCMarching_h
#define itkFCCMarching_h

#include "itkFCCSigns.h"
#include "itkTriangleSurface.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace itk
{

/** \class FCCCutEdges
 * \brief The edges that the surface cuts, among some types of owned edges of the rows of one plane, and their vertex
 * ids.
 *
 * Ids count the cut edges row by row, within a row type by type, within a type along x. An id is found from the mask of
 * cut edges by counting bits: no table of vertices, no search.
 *
 * Thread safety: each thread uses its own; all may share the signs, which must outlive them.
 *
 * \ingroup FCCIsosurface
 */
class FCCCutEdges
{
public:
  using WordType = FCCSigns::WordType;

  /** Types of FCCLattice::OwnedEdges within a plane of constant z, and between it and the next. */
  enum class Group : unsigned char
  {
    InPlane,
    Between
  };

  /** Bits of the types of FCCLattice::OwnedEdges that a decomposition of space into cells has. */
  static constexpr std::uint8_t AllTypes = 0x7f;

  FCCCutEdges(const FCCSigns & signs, Group group, std::uint8_t types, std::pmr::memory_resource * scratch);

  /** Finds the cut edges owned by plane \a k and numbers them from \a firstId. Planes past the last own none. */
  void
  Find(SizeValueType k, std::uint32_t firstId);

  /** Number of cut edges owned by plane \a k, without finding their ids. */
  static SizeValueType
  Count(const FCCSigns & signs, Group group, SizeValueType k, std::uint8_t types = AllTypes);

  std::uint32_t
  GetFirstId() const
  {
    return m_FirstId;
  }
  /** Bits of the types with points, of those in the group. */
  std::uint8_t
  GetTypes() const
  {
    return m_Types;
  }

  static bool
  IsBetween(std::uint8_t type)
  {
    return type >= 3;
  }

  /** The cut edges of one type and row. */
  struct Row
  {
    const WordType * mask;        ///< bit i: the edge owned by site i is cut
    const std::uint32_t * before; ///< id of the first cut edge of each word

    std::uint32_t
    GetId(SizeValueType i) const
    {
      const SizeValueType word = i / FCCSigns::WordBits;
      const WordType below = mask[word] & ((WordType{ 1 } << (i % FCCSigns::WordBits)) - 1);
      return before[word] + static_cast<std::uint32_t>(__builtin_popcountll(below));
    }
  };

  Row
  GetRow(SizeValueType j, std::uint8_t type) const
  {
    const SizeValueType row = this->FirstWordOf(j, type);
    return { m_Masks.data() + row, m_Before.data() + row };
  }

private:
  SizeValueType
  FirstWordOf(SizeValueType j, std::uint8_t type) const
  {
    const auto typesBefore = static_cast<SizeValueType>(__builtin_popcount(m_Types & ((1u << type) - 1)));
    return (j * m_NumberOfTypes + typesBefore) * m_Signs->GetNumberOfWords();
  }

  const FCCSigns * m_Signs;
  std::uint8_t m_Types;
  SizeValueType m_NumberOfTypes;
  std::uint32_t m_FirstId{ 0 };
  std::pmr::vector<WordType> m_Masks;
  std::pmr::vector<std::uint32_t> m_Before;
};

/** For each block of \a block sites of plane \a k, row by row: is there one in it with a neighbour on the other side of
 * the surface? Sites are counted from \a offset on within the blocks. Thread safe. */
void
FindBorderBlocks(const FCCSigns & signs,
                 SizeValueType k,
                 SizeValueType block,
                 SizeValueType blocksOfRow,
                 SizeValueType offset,
                 std::vector<std::uint8_t> & blocks);

/** Number of triangles between the planes \a k and \a k + 1. Thread safe. */
SizeValueType
CountTriangles(const FCCSigns & signs, SizeValueType k);

/** The triangles between the planes \a k and \a k + 1, from the cut edges of plane \a k within it, of plane \a k + 1
 * within it, and between the two. Writes as many as CountTriangles() says; \a reversed turns them all over. Thread
 * safe. */
void
FillTriangles(const FCCSigns & signs,
              SizeValueType k,
              const FCCCutEdges & lower,
              const FCCCutEdges & upper,
              const FCCCutEdges & between,
              bool reversed,
              TriangleSurface::TriangleType * triangles);

} // namespace itk

#endif
