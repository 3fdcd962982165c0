#ifndef itkFCCCrossingOwners_h
#define itkFCCCrossingOwners_h

#include "itkFCCFieldPlanes.h"
#include "itkFCCMarching.h"

#include <vector>

namespace itk
{

/** \class FCCCrossingOwners
 * \brief Which end owns each crossing of the surface with the edges that one plane's sites store: the nearer one.
 *
 * A crossing nearer to the edge's first end, the site that stores the edge, belongs to it, otherwise to the other end.
 * Halfway between, it belongs to the end outside, as where a value is not a number. Crossings of edges that leave the
 * image belong to the site outside it.
 *
 * Thread safety: each thread uses its own.
 *
 * \ingroup FCCIsosurface
 */
class FCCCrossingOwners
{
public:
  using WordType = FCCSigns::WordType;
  static constexpr std::uint8_t Types = FCCLattice::OwnedEdges.size();

  FCCCrossingOwners(const FCCSigns & signs, std::pmr::memory_resource * scratch);

  /** Finds the crossings of plane \a k. The field must have loaded the values of planes \a k and \a k + 1. Planes past
   * the last have none. */
  void
  Find(SizeValueType k, const FCCFieldPlanes & field, bool insideIsBelow);

  /** Bit i: the crossing of the edge that site i stores belongs to site i. Rows end in a spare zero word. */
  const WordType *
  GetFirst(SizeValueType j, std::uint8_t type) const
  {
    return m_First.data() + this->OffsetOf(j, type);
  }

  /** Bit i: the crossing of the edge that site i stores belongs to the edge's other end. */
  const WordType *
  GetSecond(SizeValueType j, std::uint8_t type) const
  {
    return m_Second.data() + this->OffsetOf(j, type);
  }

  /** Words from a row to the next. */
  SizeValueType
  GetStride() const
  {
    return m_Signs->GetNumberOfWords() + 1;
  }

private:
  SizeValueType
  OffsetOf(SizeValueType j, std::uint8_t type) const
  {
    return (j * Types + type) * this->GetStride();
  }

  const FCCSigns * m_Signs;
  std::pmr::vector<WordType> m_First;
  std::pmr::vector<WordType> m_Second;
};

} // namespace itk

#endif
