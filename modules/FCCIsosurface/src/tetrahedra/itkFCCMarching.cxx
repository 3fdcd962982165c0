#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCMarching.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCMarching.h"
#include "itkFCCMarchingCases.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

using WordType = FCCSigns::WordType;
using Cases = FCCMarchingCases;

HWY_INLINE SizeValueType
CountBits(WordType word)
{
  return static_cast<SizeValueType>(__builtin_popcountll(word));
}

/** The bits i + 1 of a row, for the bits i of one word. */
HWY_INLINE WordType
Next(const WordType * row, SizeValueType word)
{
  return row[word] >> 1 | row[word + 1] << (FCCSigns::WordBits - 1);
}

/** The bits i - 1 of a row, for the bits i of one word. */
HWY_INLINE WordType
Previous(const WordType * row, SizeValueType word)
{
  return row[word] << 1 | (word > 0 ? row[word - 1] >> (FCCSigns::WordBits - 1) : 0);
}

/** The bits of one word that stand for sites below \a count. */
HWY_INLINE WordType
Below(SizeValueType count, SizeValueType word)
{
  const SizeValueType first = word * FCCSigns::WordBits;
  if (count <= first)
  {
    return 0;
  }
  const SizeValueType bits = count - first;
  return bits >= FCCSigns::WordBits ? ~WordType{ 0 } : (WordType{ 1 } << bits) - 1;
}

/** Calls \a use(word number, mask of cut edges) for the edges of one type that a row owns. */
template <typename TUse>
void
ForEachCutWord(const FCCSigns & signs, std::uint8_t type, SizeValueType j, SizeValueType k, const TUse & use)
{
  const auto & step = FCCLattice::OwnedEdges[type];
  const auto otherJ = static_cast<IndexValueType>(j) + step[1];
  const auto otherK = static_cast<IndexValueType>(k) + step[2];
  if (otherJ < 0 || otherJ >= static_cast<IndexValueType>(signs.GetHeight()) ||
      otherK >= static_cast<IndexValueType>(signs.GetDepth()))
  {
    return;
  }
  const WordType * const row = signs.GetRow(j, k);
  const WordType * const other = signs.GetRow(static_cast<SizeValueType>(otherJ), static_cast<SizeValueType>(otherK));
  const auto shift = FCCLattice::OffsetOf(step, signs.GetParity(j, k))[0];
  for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
  {
    switch (shift)
    {
      case 0:
        use(word, row[word] ^ other[word]);
        break;
      case 1:
        use(word, (row[word] ^ Next(other, word)) & Below(signs.GetWidth() - 1, word));
        break;
      default:
        use(word,
            (row[word] ^ Previous(other, word)) & Below(signs.GetWidth(), word) &
              (word == 0 ? ~WordType{ 1 } : ~WordType{ 0 }));
    }
  }
}

/** The rows of a column, and the way from a pair to the next. */
struct Column
{
  const WordType * rows[4];
  IndexValueType shift[Cases::Kinds]; ///< 1 when the next pair's index is one more than this pair's

  Column(const FCCSigns & signs, SizeValueType j, SizeValueType k)
    : rows{ signs.GetRow(j, k), signs.GetRow(j + 1, k), signs.GetRow(j, k + 1), signs.GetRow(j + 1, k + 1) }
    , shift{ signs.GetParity(j, k), 1 - signs.GetParity(j, k) }
  {}
};

/** The steps of one kind in one word of a column: the sites' signs, and which of the steps exist. */
struct Steps
{
  WordType sites[Cases::Sites];
  WordType regular;  ///< the next pair exists
  WordType quarters; ///< the pair after the next exists, too

  HWY_INLINE
  Steps(const FCCSigns & signs, const Column & column, unsigned int kind, SizeValueType word)
    : regular(Below(signs.GetWidth() - static_cast<SizeValueType>(column.shift[kind]), word))
    , quarters(Below(signs.GetWidth() - 1, word))
  {
    for (unsigned int place = 0; place < 2; ++place)
    {
      const WordType * const row = column.rows[Cases::PairRows[kind][place]];
      const WordType * const next = column.rows[Cases::PairRows[1 - kind][place]];
      sites[place] = row[word];
      sites[2 + place] = column.shift[kind] == 0 ? next[word] : Next(next, word);
      sites[4 + place] = Next(row, word);
    }
  }

  /** Bits of the steps through which the surface passes. */
  WordType
  Active() const
  {
    const WordType any = sites[0] | sites[1] | sites[2] | sites[3];
    const WordType all = sites[0] & sites[1] & sites[2] & sites[3];
    return ((any & ~all) & regular) | (((any | sites[4] | sites[5]) & ~(all & sites[4] & sites[5])) & quarters);
  }

  /** One triangle for each tetrahedron with an odd number of sites inside, two for each with two. */
  SizeValueType
  CountTriangles() const
  {
    SizeValueType triangles = 0;
    for (unsigned int tetrahedron = 0; tetrahedron < Cases::Tetrahedra; ++tetrahedron)
    {
      const auto & corners = Cases::TetrahedronSites[tetrahedron];
      const WordType a = sites[corners[0]];
      const WordType b = sites[corners[1]];
      const WordType c = sites[corners[2]];
      const WordType d = sites[corners[3]];
      const WordType exists = tetrahedron == 0 ? regular : quarters;
      const WordType odd = a ^ b ^ c ^ d;
      const WordType two = (a | b | c | d) & ~(a & b & c & d) & ~odd;
      triangles += CountBits(odd & exists) + 2 * CountBits(two & exists);
    }
    return triangles;
  }

  unsigned int
  PatternOf(unsigned int bit) const
  {
    unsigned int pattern = 0;
    for (unsigned int site = 0; site < Cases::Sites; ++site)
    {
      pattern |= static_cast<unsigned int>(sites[site] >> bit & 1) << site;
    }
    return pattern;
  }
};

/** Finds the vertex ids of a column's steps. */
class ColumnIds
{
public:
  ColumnIds(const Column & column,
            SizeValueType j,
            const FCCCutEdges & lower,
            const FCCCutEdges & upper,
            const FCCCutEdges & between)
  {
#pragma GCC unroll 2
    for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
    {
      const SizeValueType shiftOfPair[3] = { 0, static_cast<SizeValueType>(column.shift[kind]), 1 };
#pragma GCC unroll 12
      for (unsigned int edge = 0; edge < Cases::Edges; ++edge)
      {
        const Cases::EdgeOwner & owner = FCCMarchingTables.owners[kind][edge];
        const bool isBetween = FCCCutEdges::IsBetween(owner.type);
        const FCCCutEdges & edges = isBetween ? between : (owner.row & 2) != 0 ? upper : lower;
        m_Rows[kind][edge] = edges.GetRow(j + (owner.row & 1), owner.type);
        m_Shift[kind][edge] = shiftOfPair[owner.pair];
      }
    }
  }

  std::uint32_t
  GetId(unsigned int kind, unsigned int edge, SizeValueType i) const
  {
    return m_Rows[kind][edge].GetId(i + m_Shift[kind][edge]);
  }

private:
  FCCCutEdges::Row m_Rows[Cases::Kinds][Cases::Edges];
  SizeValueType m_Shift[Cases::Kinds][Cases::Edges];
};

/** Bits of the sites of a row that have a neighbour on the other side of the surface. */
void
FindBorderSites(const FCCSigns & signs, SizeValueType j, SizeValueType k, WordType * border)
{
  const SizeValueType words = signs.GetNumberOfWords();
  const WordType * const row = signs.GetRow(j, k);
  std::fill(border, border + words, 0);
  for (unsigned int direction = 0; direction < 2 * FCCLattice::OwnedEdges.size(); ++direction)
  {
    const auto & edge = FCCLattice::OwnedEdges[direction % FCCLattice::OwnedEdges.size()];
    const IndexValueType sign = direction < FCCLattice::OwnedEdges.size() ? 1 : -1;
    const SizeValueType otherJ = j + static_cast<SizeValueType>(sign * edge[1]);
    const SizeValueType otherK = k + static_cast<SizeValueType>(sign * edge[2]);
    if (otherJ >= signs.GetHeight() || otherK >= signs.GetDepth())
    {
      continue;
    }
    const WordType * const other = signs.GetRow(otherJ, otherK);
    const auto shift =
      FCCLattice::OffsetOf({ sign * edge[0], sign * edge[1], sign * edge[2] }, signs.GetParity(j, k))[0];
    if (shift == 0)
    {
      for (SizeValueType word = 0; word < words; ++word)
      {
        border[word] |= row[word] ^ other[word];
      }
    }
    else if (shift == 1)
    {
      for (SizeValueType word = 0; word < words; ++word)
      {
        border[word] |= row[word] ^ Next(other, word);
      }
    }
    else
    {
      border[0] |= row[0] ^ other[0] << 1;
      for (SizeValueType word = 1; word < words; ++word)
      {
        border[word] |= row[word] ^ (other[word] << 1 | other[word - 1] >> (FCCSigns::WordBits - 1));
      }
    }
  }
}

/** Masks of the cut edges of some types that plane \a k owns, row by row, within a row type by type. */
void
FindCutEdges(const FCCSigns & signs, unsigned int types, SizeValueType k, WordType * masks)
{
  const SizeValueType words = signs.GetNumberOfWords();
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    for (unsigned int left = types; left != 0; left &= left - 1, masks += words)
    {
      std::fill(masks, masks + words, 0);
      ForEachCutWord(
        signs, static_cast<std::uint8_t>(__builtin_ctz(left)), j, k, [masks](SizeValueType word, WordType mask) {
          masks[word] = mask;
        });
    }
  }
}

/** Id of the first bit of each mask. */
void
NumberBits(const WordType * masks, SizeValueType count, std::uint32_t firstId, std::uint32_t * before)
{
  std::uint32_t id = firstId;
  for (SizeValueType word = 0; word < count; ++word)
  {
    before[word] = id;
    id += static_cast<std::uint32_t>(CountBits(masks[word]));
  }
}

SizeValueType
CountCutEdges(const FCCSigns & signs, unsigned int types, SizeValueType k)
{
  SizeValueType count = 0;
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    for (unsigned int left = types; left != 0; left &= left - 1)
    {
      const auto type = static_cast<std::uint8_t>(__builtin_ctz(left));
      ForEachCutWord(signs, type, j, k, [&count](SizeValueType, WordType mask) { count += CountBits(mask); });
    }
  }
  return count;
}

SizeValueType
CountTriangles(const FCCSigns & signs, SizeValueType k)
{
  SizeValueType triangles = 0;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    const Column column(signs, j, k);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
#pragma GCC unroll 2
      for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
      {
        triangles += Steps(signs, column, kind, word).CountTriangles();
      }
    }
  }
  return triangles;
}

void
FillTriangles(const FCCSigns & signs,
              SizeValueType k,
              const FCCCutEdges & lower,
              const FCCCutEdges & upper,
              const FCCCutEdges & between,
              bool reversed,
              TriangleSurface::TriangleType * triangles)
{
  const unsigned int second = reversed ? 2 : 1;
  const unsigned int third = reversed ? 1 : 2;
  for (SizeValueType j = 0; j + 1 < signs.GetHeight(); ++j)
  {
    const Column column(signs, j, k);
    const ColumnIds ids(column, j, lower, upper, between);
    for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
    {
#pragma GCC unroll 2
      for (unsigned int kind = 0; kind < Cases::Kinds; ++kind)
      {
        const Steps steps(signs, column, kind, word);
        for (WordType active = steps.Active(); active != 0; active &= active - 1)
        {
          const auto bit = static_cast<unsigned int>(__builtin_ctzll(active));
          const SizeValueType i = word * FCCSigns::WordBits + bit;
          const Cases::Case & found = FCCMarchingTables.cases[kind][steps.PatternOf(bit)];
          const bool hasQuarters = (steps.quarters >> bit & 1) != 0;
          const unsigned int count = hasQuarters ? found.triangles : found.regularTriangles;
          for (unsigned int n = 0; n < count; ++n)
          {
            const auto & edges = found.edges[n];
            *triangles++ = { ids.GetId(kind, edges[0], i),
                             ids.GetId(kind, edges[second], i),
                             ids.GetId(kind, edges[third], i) };
          }
        }
      }
    }
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{
HWY_EXPORT(FindBorderSites);
HWY_EXPORT(FindCutEdges);
HWY_EXPORT(NumberBits);
HWY_EXPORT(CountCutEdges);
HWY_EXPORT(CountTriangles);
HWY_EXPORT(FillTriangles);
} // namespace

namespace
{

/** Of some types, those within a plane (0 to 2) or between it and the next (3 to 6). */
std::uint8_t
TypesOfGroup(FCCCutEdges::Group group, std::uint8_t types)
{
  return types & (group == FCCCutEdges::Group::InPlane ? 0x07 : 0x78);
}

} // namespace

FCCCutEdges::FCCCutEdges(const FCCSigns & signs, Group group, std::uint8_t types, std::pmr::memory_resource * scratch)
  : m_Signs(&signs)
  , m_Types(TypesOfGroup(group, types))
  , m_NumberOfTypes(static_cast<SizeValueType>(__builtin_popcount(m_Types)))
  , m_Masks(signs.GetHeight() * m_NumberOfTypes * signs.GetNumberOfWords(), scratch)
  , m_Before(m_Masks.size(), scratch)
{}

void
FCCCutEdges::Find(SizeValueType k, std::uint32_t firstId)
{
  m_FirstId = firstId;
  if (k < m_Signs->GetDepth())
  {
    HWY_DYNAMIC_DISPATCH(FindCutEdges)(*m_Signs, m_Types, k, m_Masks.data());
  }
  else
  {
    std::fill(m_Masks.begin(), m_Masks.end(), 0);
  }
  HWY_DYNAMIC_DISPATCH(NumberBits)(m_Masks.data(), m_Masks.size(), firstId, m_Before.data());
}

SizeValueType
FCCCutEdges::Count(const FCCSigns & signs, Group group, SizeValueType k, std::uint8_t types)
{
  return HWY_DYNAMIC_DISPATCH(CountCutEdges)(signs, TypesOfGroup(group, types), k);
}

void
FindBorderBlocks(const FCCSigns & signs,
                 SizeValueType k,
                 SizeValueType block,
                 SizeValueType blocksOfRow,
                 SizeValueType offset,
                 std::vector<std::uint8_t> & blocks)
{
  blocks.assign((signs.GetHeight() + 2 * offset) * blocksOfRow, 0);
  std::vector<FCCSigns::WordType> border(signs.GetNumberOfWords());
  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    HWY_DYNAMIC_DISPATCH(FindBorderSites)(signs, j, k, border.data());
    std::uint8_t * const row = blocks.data() + (j + offset) * blocksOfRow;
    for (SizeValueType i = 0; i < signs.GetWidth(); i += block)
    {
      const SizeValueType bit = i % FCCSigns::WordBits;
      if ((border[i / FCCSigns::WordBits] >> bit & ((FCCSigns::WordType{ 1 } << block) - 1)) != 0)
      {
        row[i / block] = 1;
        if (offset > 0 && i / block + 1 < blocksOfRow)
        {
          row[i / block + 1] = 1;
        }
      }
    }
  }
}

SizeValueType
CountTriangles(const FCCSigns & signs, SizeValueType k)
{
  return HWY_DYNAMIC_DISPATCH(CountTriangles)(signs, k);
}

void
FillTriangles(const FCCSigns & signs,
              SizeValueType k,
              const FCCCutEdges & lower,
              const FCCCutEdges & upper,
              const FCCCutEdges & between,
              bool reversed,
              TriangleSurface::TriangleType * triangles)
{
  HWY_DYNAMIC_DISPATCH(FillTriangles)(signs, k, lower, upper, between, reversed, triangles);
}

} // namespace itk
#endif
