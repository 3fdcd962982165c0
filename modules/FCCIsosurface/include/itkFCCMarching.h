#ifndef itkFCCMarching_h
#define itkFCCMarching_h

#include "itkFCCMarchingCases.h"
#include "itkTriangleSurface.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class FCCSigns
 * \brief One bit for each site of a box of the lattice: is it inside?
 *
 * Rows are stored as 64-bit words, bit i of a row being site i, followed by a spare zero word; bits past the last site
 * are zero. Rows are counted from (0, 0) whatever the image's start index, so the parity of that row is stored, too.
 *
 * Thread safety: different rows can be written at once.
 *
 * \ingroup FCCIsosurface
 */
class FCCSigns
{
public:
  using WordType = std::uint64_t;
  static constexpr SizeValueType WordBits = 64;

  /** Words that may be read beyond the last row, so that rows can be read by whole vectors. */
  static constexpr SizeValueType WordsBeyond = 8;

  FCCSigns(SizeValueType width, SizeValueType height, SizeValueType depth, IndexValueType parityOfFirstRow);

  SizeValueType
  GetWidth() const
  {
    return m_Width;
  }
  SizeValueType
  GetHeight() const
  {
    return m_Height;
  }
  SizeValueType
  GetDepth() const
  {
    return m_Depth;
  }
  /** Words of a row that hold sites, without the spare one. */
  SizeValueType
  GetNumberOfWords() const
  {
    return m_Stride - 1;
  }

  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_ParityOfFirstRow + static_cast<IndexValueType>(j + k)) & 1;
  }

  WordType *
  GetRow(SizeValueType j, SizeValueType k)
  {
    return m_Words.data() + (k * m_Height + j) * m_Stride;
  }
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    return m_Words.data() + (k * m_Height + j) * m_Stride;
  }

  /** Moves the bits of a row one site up; there must be room. */
  void
  ShiftRow(SizeValueType j, SizeValueType k);

private:
  SizeValueType m_Width;
  SizeValueType m_Height;
  SizeValueType m_Depth;
  SizeValueType m_Stride;
  IndexValueType m_ParityOfFirstRow;
  std::vector<WordType> m_Words;
};

/** \class FCCCutEdges
 * \brief The edges that the surface cuts, among some types of owned edges of the rows of one plane, and their vertex
 * ids.
 *
 * Ids count the cut edges row by row, within a row type by type, within a type along x. An id is found from the mask of
 * cut edges by counting bits: no table of vertices, no search.
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

  FCCCutEdges(const FCCSigns & signs, Group group, std::uint8_t types = AllTypes);

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
  std::vector<WordType> m_Masks;
  std::vector<std::uint32_t> m_Before;
};

/** For each block of \a block sites of plane \a k, row by row: is there one in it with a neighbour on the other side of
 * the surface? Sites are counted from \a offset on within the blocks. */
void
FindBorderBlocks(const FCCSigns & signs,
                 SizeValueType k,
                 SizeValueType block,
                 SizeValueType blocksOfRow,
                 SizeValueType offset,
                 std::vector<std::uint8_t> & blocks);

/** Number of triangles between the planes \a k and \a k + 1. */
SizeValueType
CountTriangles(const FCCSigns & signs, SizeValueType k);

/** The triangles between the planes \a k and \a k + 1, from the cut edges of plane \a k within it, of plane \a k + 1
 * within it, and between the two. Writes as many as CountTriangles() says; \a reversed turns them all over. */
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
