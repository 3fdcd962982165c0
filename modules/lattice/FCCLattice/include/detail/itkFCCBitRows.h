#ifndef itkFCCBitRows_h
#define itkFCCBitRows_h

#include "itkIntTypes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <vector>

namespace itk
{

/** \class FCCBits
 * \brief A row of bits, one for each site, in words: tested, shifted, counted and visited. Bit i of a row is that of
 * site i; bits past the last site are zero.
 *
 * The functions are always inlined, so that they are compiled for the instruction set of the kernels that call them.
 */
struct FCCBits
{
  using WordType = std::uint64_t;
  static constexpr SizeValueType WordBits = 64;

  /** The words of a row of some bits. */
  static constexpr SizeValueType
  WordsOf(SizeValueType bits)
  {
    return (bits + WordBits - 1) / WordBits;
  }

  [[gnu::always_inline]] static inline bool
  Test(const WordType * row, SizeValueType i)
  {
    return (row[i / WordBits] >> (i % WordBits) & 1) != 0;
  }

  /** The bits i + \a shift of a row, for the bits i of one word. The shift is -1, 0 or 1; for 1 the row must have a
   * spare zero word at its end. */
  [[gnu::always_inline]] static inline WordType
  Shifted(const WordType * row, SizeValueType word, IndexValueType shift)
  {
    switch (shift)
    {
      case 0:
        return row[word];
      case 1:
        return row[word] >> 1 | row[word + 1] << (WordBits - 1);
      default:
        return row[word] << 1 | (word > 0 ? row[word - 1] >> (WordBits - 1) : 0);
    }
  }

  /** Calls use(word, Shifted()) for all words of a row, ascending. It may overwrite the words that it has been given.
   */
  template <typename TUse>
  [[gnu::always_inline]] static inline void
  ForEachShifted(const WordType * row, SizeValueType words, IndexValueType shift, const TUse & use)
  {
    if (shift == 0)
    {
      for (SizeValueType word = 0; word < words; ++word)
      {
        use(word, row[word]);
      }
    }
    else if (shift > 0)
    {
      for (SizeValueType word = 0; word < words; ++word)
      {
        use(word, Shifted(row, word, 1));
      }
    }
    else
    {
      WordType before = 0;
      for (SizeValueType word = 0; word < words; ++word)
      {
        const WordType bits = row[word];
        use(word, bits << 1 | before >> (WordBits - 1));
        before = bits;
      }
    }
  }

  /** Moves the bits of a row one site up; there must be room. */
  [[gnu::always_inline]] static inline void
  MoveUp(WordType * row, SizeValueType words)
  {
    ForEachShifted(row, words, -1, [row](SizeValueType word, WordType bits) { row[word] = bits; });
  }

  /** The bits of one word that stand for sites below \a count. */
  [[gnu::always_inline]] static inline WordType
  Below(SizeValueType count, SizeValueType word)
  {
    const SizeValueType first = word * WordBits;
    if (count <= first)
    {
      return 0;
    }
    return count - first >= WordBits ? ~WordType{ 0 } : (WordType{ 1 } << (count - first)) - 1;
  }

  /** The number of set bits. Arithmetic, as not every processor has an instruction for it; compilers recognize it. */
  [[gnu::always_inline]] static inline SizeValueType
  Count(WordType word)
  {
    word -= word >> 1 & 0x5555555555555555;
    word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
    word = (word + (word >> 4)) & 0x0F0F0F0F0F0F0F0F;
    return word * 0x0101010101010101 >> 56;
  }

  /** The number of set bits of a word before the bit of site \a i. */
  [[gnu::always_inline]] static inline SizeValueType
  CountBefore(WordType word, SizeValueType i)
  {
    return Count(word & ((WordType{ 1 } << (i % WordBits)) - 1));
  }

  /** A word of bits: isSet(n) for n from 0 to 63. The compiler makes SIMD code of it. */
  template <typename TIsSet>
  [[gnu::always_inline]] static inline WordType
  Pack(const TIsSet & isSet)
  {
    alignas(64) std::uint8_t bytes[WordBits];
    for (SizeValueType n = 0; n < WordBits; ++n)
    {
      bytes[n] = isSet(n) ? 1 : 0;
    }
    WordType word = 0;
    for (SizeValueType n = 0; n < WordBits; n += 8)
    {
      WordType eight;
      std::memcpy(&eight, bytes + n, sizeof eight);
      constexpr WordType gather = 0x0102040810204080; // moves the lowest bit of byte b to bit 56 + b
      word |= (eight * gather >> 56) << n;
    }
    return word;
  }

  /** Calls use(i) for each set bit of a word whose first bit is that of site \a first. */
  template <typename TUse>
  [[gnu::always_inline]] static inline void
  ForEach(WordType word, SizeValueType first, const TUse & use)
  {
    for (; word != 0; word &= word - 1)
    {
      use(first + static_cast<SizeValueType>(__builtin_ctzll(word)));
    }
  }

  /** Calls use(i) for each set bit of a row. */
  template <typename TUse>
  [[gnu::always_inline]] static inline void
  ForEach(const WordType * row, SizeValueType words, const TUse & use)
  {
    for (SizeValueType word = 0; word < words; ++word)
    {
      ForEach(row[word], word * WordBits, use);
    }
  }
};

/** \class FCCBitRows
 * \brief Rows of bits, each with a spare zero word at its end.
 */
class FCCBitRows
{
public:
  using WordType = FCCBits::WordType;

  /** Words that may be read beyond the last row, so that rows can be read by whole vectors. */
  static constexpr SizeValueType WordsBeyond = 8;

  /** \param words of a row that hold sites */
  FCCBitRows(SizeValueType rows, SizeValueType words, std::pmr::memory_resource * scratch)
    : m_Stride(words + 1)
    , m_Words(rows * m_Stride + WordsBeyond, scratch)
  {}

  /** Words from a row to the next. */
  SizeValueType
  GetStride() const
  {
    return m_Stride;
  }

  WordType *
  GetRow(SizeValueType row)
  {
    return m_Words.data() + row * m_Stride;
  }
  const WordType *
  GetRow(SizeValueType row) const
  {
    return m_Words.data() + row * m_Stride;
  }

  void
  Clear()
  {
    std::fill(m_Words.begin(), m_Words.end(), 0);
  }
  void
  ClearRow(SizeValueType row)
  {
    std::fill_n(this->GetRow(row), m_Stride, 0);
  }

  SizeValueType
  Count() const
  {
    SizeValueType count = 0;
    for (const WordType word : m_Words)
    {
      count += FCCBits::Count(word);
    }
    return count;
  }

protected:
  SizeValueType m_Stride;
  std::pmr::vector<WordType> m_Words;
};

/** \class FCCNumberedBits
 * \brief Rows of bits whose set bits are numbered row by row: no table of numbers, no search.
 */
class FCCNumberedBits : public FCCBitRows
{
public:
  FCCNumberedBits(SizeValueType rows, SizeValueType words, std::pmr::memory_resource * scratch)
    : FCCBitRows(rows, words, scratch)
    , m_NumberOfWord(m_Words.size(), scratch)
  {}

  /** Numbers the set bits from \a first on. Returns the number after the last. */
  std::uint32_t
  Number(std::uint32_t first)
  {
    for (SizeValueType word = 0; word < m_Words.size(); ++word)
    {
      m_NumberOfWord[word] = first;
      first += static_cast<std::uint32_t>(FCCBits::Count(m_Words[word]));
    }
    return first;
  }

  /** A row with its numbers. */
  struct Row
  {
    const WordType * bits;
    const std::uint32_t * numberOfWord; ///< number of the first set bit of each word, or of later words

    [[gnu::always_inline]] std::uint32_t
    GetNumber(SizeValueType i) const
    {
      const SizeValueType word = i / FCCBits::WordBits;
      return numberOfWord[word] + static_cast<std::uint32_t>(FCCBits::CountBefore(bits[word], i));
    }
  };

  Row
  GetNumberedRow(SizeValueType row) const
  {
    return { this->GetRow(row), m_NumberOfWord.data() + row * m_Stride };
  }

private:
  std::pmr::vector<std::uint32_t> m_NumberOfWord;
};

} // namespace itk

#endif
