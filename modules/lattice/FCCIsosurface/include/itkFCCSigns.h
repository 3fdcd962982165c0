#ifndef itkFCCSigns_h
#define itkFCCSigns_h

#include "detail/itkFCCBitRows.h"
#include "itkFCCLattice.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <new>
#include <optional>

namespace itk
{

/** \class FCCSigns
 * \brief One bit for each site of a box of the lattice: whether it is inside the surface.
 *
 * Rows are stored as FCCBitRows has them. Rows are counted from (0, 0) whatever the image's start index, so the parity
 * of that row is stored, too. Different rows can be written at once. Where the C library takes zeroed memory from the
 * system, pages of memory in which no site is inside take none.
 *
 * \ingroup FCCIsosurface
 */
class FCCSigns
{
public:
  using WordType = FCCBits::WordType;

  FCCSigns(SizeValueType width, SizeValueType height, SizeValueType depth, IndexValueType parityOfFirstRow)
    : m_Width(width)
    , m_Height(height)
    , m_Depth(depth)
    , m_ParityOfFirstRow(parityOfFirstRow)
    , m_NumberOfWords(FCCBits::WordsOf(width))
    , m_Words(static_cast<WordType *>(
        std::calloc(height * depth * (m_NumberOfWords + 1) + FCCBitRows::WordsBeyond, sizeof(WordType))))
  {
    if (m_Words == nullptr)
    {
      throw std::bad_alloc();
    }
  }

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
    return m_NumberOfWords;
  }

  /** 0 for a row whose sites have an even x, else 1: FCCLattice::Parity(). */
  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_ParityOfFirstRow + static_cast<IndexValueType>(j + k)) & 1;
  }

  /** The words of a row. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    return m_Words.get() + (k * m_Height + j) * (m_NumberOfWords + 1);
  }

  /** Sets a row that was not set before. \param words as many as GetNumberOfWords() */
  void
  SetRow(SizeValueType j, SizeValueType k, const WordType * words)
  {
    if (std::any_of(words, words + m_NumberOfWords, [](WordType word) { return word != 0; }))
    {
      std::copy_n(words, m_NumberOfWords, m_Words.get() + (k * m_Height + j) * (m_NumberOfWords + 1));
    }
  }

  /** The first and the last column, row and plane with a site inside; nothing where no site is. */
  std::optional<std::array<SizeValueType, 6>>
  FindBounds() const
  {
    std::array<SizeValueType, 6> bounds{ m_Width, 0, m_Height, 0, m_Depth, 0 };
    for (SizeValueType n = 0; n < m_Height * m_Depth; ++n)
    {
      const WordType * const words = this->GetRow(n % m_Height, n / m_Height);
      const auto isUsed = [](WordType word) { return word != 0; };
      const WordType * const end = words + m_NumberOfWords;
      const WordType * const first = std::find_if(words, end, isUsed);
      if (first != end)
      {
        const WordType * const last =
          std::find_if(std::reverse_iterator(end), std::reverse_iterator(first), isUsed).base();
        const auto lowest = static_cast<SizeValueType>(first - words) * FCCBits::WordBits;
        const auto beyond = static_cast<SizeValueType>(last - words) * FCCBits::WordBits;
        bounds = { std::min(bounds[0], lowest + static_cast<SizeValueType>(__builtin_ctzll(*first))),
                   std::max(bounds[1], beyond - 1 - static_cast<SizeValueType>(__builtin_clzll(last[-1]))),
                   std::min(bounds[2], n % m_Height),
                   std::max(bounds[3], n % m_Height),
                   std::min(bounds[4], n / m_Height),
                   n / m_Height };
      }
    }
    return bounds[0] < m_Width ? std::optional(bounds) : std::nullopt;
  }

private:
  struct Free
  {
    void
    operator()(WordType * words) const
    {
      std::free(words);
    }
  };

  SizeValueType m_Width;
  SizeValueType m_Height;
  SizeValueType m_Depth;
  IndexValueType m_ParityOfFirstRow;
  SizeValueType m_NumberOfWords;
  std::unique_ptr<WordType[], Free> m_Words;
};

/** \class FCCStepTarget
 * \brief The sites at one step from those of a row of the signs: their row, and how far their indices are from those of
 * the row.
 *
 * \ingroup FCCIsosurface
 */
struct FCCStepTarget
{
  SizeValueType j;
  SizeValueType k;
  IndexValueType shift;
  bool isInBox; ///< whether the row is one of the signs

  FCCStepTarget(const FCCSigns & signs, SizeValueType fromJ, SizeValueType fromK, const FCCLattice::SiteType & step)
    : j(fromJ + static_cast<SizeValueType>(step[1])) // below 0 wraps around
    , k(fromK + static_cast<SizeValueType>(step[2]))
    , shift(FCCLattice::OffsetOf(step, signs.GetParity(fromJ, fromK))[0])
    , isInBox(j < signs.GetHeight() && k < signs.GetDepth())
  {}
};

} // namespace itk

#endif
