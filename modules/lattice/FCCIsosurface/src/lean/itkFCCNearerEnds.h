#ifndef itkFCCNearerEnds_h
#define itkFCCNearerEnds_h

#include "itkFCCCutEdges.h"
#include "itkFCCFieldPlanes.h"

namespace itk
{

/** The rule of the nearer end: whether the crossing on a cut edge is nearer to the end inside. Halfway between, and
 * where a value is not a number, the end outside counts as nearer; so does a site outside the image.
 * \param sum of the values at both ends, less the isovalue */
[[gnu::always_inline]] inline bool
IsNearerToInside(float sum, bool insideIsBelow)
{
  return (insideIsBelow ? -sum : sum) < 0.0f;
}

/** \class FCCNearerEnds
 * \brief To which end each crossing of the surface with the edges that one plane's sites store is nearer: the *start*,
 * which is the site that stores the edge, or the *end*.
 */
class FCCNearerEnds
{
public:
  using WordType = FCCSigns::WordType;
  static constexpr std::uint8_t Types = FCCCells::Edges;

  FCCNearerEnds(const FCCSigns & signs, std::pmr::memory_resource * scratch);

  /** Finds the crossings of plane \a k. The field must have loaded the values of planes \a k and \a k + 1. */
  void
  Find(SizeValueType k, const FCCFieldPlanes & field, bool insideIsBelow);

  /** The nearer ends without the cut edges, which the signs tell: a byte for each eight edges of which any is cut. */
  using Packed = std::vector<std::uint8_t>;

  Packed
  Pack() const;

  /** Finds the crossings of plane \a k again. */
  void
  Unpack(SizeValueType k, const Packed & packed);

  /** Bit i: the edge of this type that site i stores is cut, and its start is nearer to the crossing. */
  const WordType *
  GetStarts(SizeValueType j, std::uint8_t type) const
  {
    return m_Starts.GetRow(j * Types + type);
  }

  /** Bit i: the edge of this type that site i stores is cut, and its end is nearer to the crossing. */
  const WordType *
  GetEnds(SizeValueType j, std::uint8_t type) const
  {
    return m_Ends.GetRow(j * Types + type);
  }

  /** Words from a type's row to the next type's. */
  SizeValueType
  GetStride() const
  {
    return m_Starts.GetStride();
  }

private:
  void
  FindRow(SizeValueType j, SizeValueType k, std::uint8_t type, const FCCFieldPlanes & field, bool insideIsBelow);

  const FCCSigns * m_Signs;
  FCCBitRows m_Starts;
  FCCBitRows m_Ends;
};

} // namespace itk

#endif
