#ifndef itkFCCSiteParts_h
#define itkFCCSiteParts_h

#include "itkFCCSigns.h"
#include "itkFCCCells.h"

#include <memory>

namespace itk
{

/** \class FCCSiteParts
 * \brief The vertices that the crossings of a split site make: *single* crossings are vertices by themselves, the
 * others gather in connected parts, each of which is one vertex.
 *
 * The crossings of a site are the crossings that the site is nearer to. Sets of crossings are bits of their directions.
 * Vertices are numbered by the lowest directions of their crossings.
 */
class FCCSiteParts
{
public:
  FCCSiteParts() = default;
  FCCSiteParts(unsigned int crossings, unsigned int single)
    : m_Crossings(static_cast<std::uint16_t>(crossings))
    , m_Single(static_cast<std::uint16_t>(single))
  {
    this->ForEachVertex([this](unsigned int directions) {
      for (; directions != 0; directions &= directions - 1)
      {
        m_Vertices |= std::uint64_t{ m_NumberOfVertices } << (BitsOfVertex * __builtin_ctz(directions));
      }
      ++m_NumberOfVertices;
    });
  }

  unsigned int
  GetSingle() const
  {
    return m_Single;
  }
  unsigned int
  GetNumberOfVertices() const
  {
    return m_NumberOfVertices;
  }

  /** The number of the vertex of a crossing. */
  [[gnu::always_inline]] unsigned int
  GetVertex(unsigned int direction) const
  {
    return static_cast<unsigned int>(m_Vertices >> (BitsOfVertex * direction) & ((1U << BitsOfVertex) - 1));
  }

  /** Calls use(directions of its crossings) for each vertex, in their order. */
  template <typename TUse>
  void
  ForEachVertex(const TUse & use) const
  {
    const unsigned int gathered = m_Crossings & ~unsigned{ m_Single };
    for (unsigned int remaining = m_Crossings; remaining != 0;)
    {
      const auto lowest = static_cast<unsigned int>(__builtin_ctz(remaining));
      const bool isGathered = (gathered >> lowest & 1) != 0;
      const unsigned int directions = isGathered ? FCCCells::PartOf(gathered, lowest) : 1U << lowest;
      remaining &= ~directions;
      use(directions);
    }
  }

private:
  static constexpr unsigned int BitsOfVertex = 4;
  static_assert(FCCCells::Directions <= 1U << BitsOfVertex && BitsOfVertex * FCCCells::Directions <= 64,
                "the vertices of all directions fit into one word");

  std::uint16_t m_Crossings = 0;
  std::uint16_t m_Single = 0;
  std::uint16_t m_NumberOfVertices = 0;
  std::uint64_t m_Vertices = 0; ///< BitsOfVertex bits for each direction
};

/** \class FCCSplitRows
 * \brief The split sites of a box and their parts. A row without any takes no more than a pointer.
 *
 * Different rows can be written at once.
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

  bool
  HasSplitSites(SizeValueType j, SizeValueType k) const
  {
    return m_Rows[k * m_Height + j] != nullptr;
  }

  /** One bit for each site of a row, in words as FCCSigns has them, with a spare zero word. */
  const WordType *
  GetRow(SizeValueType j, SizeValueType k) const
  {
    const auto & row = m_Rows[k * m_Height + j];
    return row ? row->bits.data() : m_Zeros.data();
  }

  /** The parts of all split sites of a row, ascending. */
  const std::vector<FCCSiteParts> &
  GetParts(SizeValueType j, SizeValueType k) const
  {
    static const std::vector<FCCSiteParts> none;
    const auto & row = m_Rows[k * m_Height + j];
    return row ? row->parts : none;
  }

  /** The parts of a split site. */
  const FCCSiteParts &
  GetParts(SizeValueType i, SizeValueType j, SizeValueType k) const
  {
    const Row & row = *m_Rows[k * m_Height + j];
    return row.parts[CountBefore(row.bits, i)];
  }

  /** Splits a site, or divides it anew. */
  void
  Set(SizeValueType i, SizeValueType j, SizeValueType k, const FCCSiteParts & parts)
  {
    auto & row = m_Rows[k * m_Height + j];
    if (!row)
    {
      row = std::make_unique<Row>();
      row->bits.resize(m_Zeros.size());
    }
    const auto place = row->parts.begin() + static_cast<std::ptrdiff_t>(CountBefore(row->bits, i));
    if (FCCBits::Test(row->bits.data(), i))
    {
      *place = parts;
      return;
    }
    row->parts.insert(place, parts);
    row->bits[i / FCCBits::WordBits] |= WordType{ 1 } << (i % FCCBits::WordBits);
  }

private:
  struct Row
  {
    std::vector<WordType> bits;
    std::vector<FCCSiteParts> parts; ///< by set bit, ascending
  };

  /** How many bits are set before bit \a i. */
  static SizeValueType
  CountBefore(const std::vector<WordType> & bits, SizeValueType i)
  {
    const SizeValueType last = i / FCCBits::WordBits;
    SizeValueType count = FCCBits::CountBefore(bits[last], i);
    for (SizeValueType word = 0; word < last; ++word)
    {
      count += FCCBits::Count(bits[word]);
    }
    return count;
  }

  SizeValueType m_Height;
  std::vector<std::unique_ptr<Row>> m_Rows;
  std::vector<WordType> m_Zeros;
};

} // namespace itk

#endif
