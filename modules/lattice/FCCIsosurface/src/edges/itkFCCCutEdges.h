#ifndef itkFCCCutEdges_h
#define itkFCCCutEdges_h

#include "itkFCCCells.h"
#include "itkFCCSigns.h"

namespace itk
{

/** \class FCCStoredEdges
 * \brief The edges of the lattice, each of which is *stored* by one of its ends: by type and in two groups.
 *
 * Types of edges are those of FCCCells. Sets of types are bits.
 */
struct FCCStoredEdges
{
  static constexpr std::uint8_t AllTypes = (1u << FCCCells::Edges) - 1;

  /** Edges within a plane of constant z, and between it and the next. */
  enum class Group : unsigned char
  {
    InPlane,
    Between
  };

  static constexpr Group
  GroupOf(std::uint8_t type)
  {
    return FCCLattice::OwnedEdges[type][2] == 0 ? Group::InPlane : Group::Between;
  }

  static constexpr std::uint8_t
  TypesOf(Group group)
  {
    unsigned int types = 0;
    for (std::uint8_t type = 0; type < FCCCells::Edges; ++type)
    {
      types |= GroupOf(type) == group ? 1u << type : 0;
    }
    return static_cast<std::uint8_t>(types);
  }

  /** Calls use(type) for the types of a set. */
  template <typename TUse>
  static void
  ForEachType(unsigned int types, const TUse & use)
  {
    for (; types != 0; types &= types - 1)
    {
      use(static_cast<std::uint8_t>(__builtin_ctz(types)));
    }
  }
};

/** \class FCCCutEdges
 * \brief The edges that the surface cuts, among some types of edges that the sites of one plane store, and the ids of
 * the points on them.
 *
 * Ids count the cut edges row by row, within a row type by type, within a type along x.
 */
class FCCCutEdges
{
public:
  using WordType = FCCSigns::WordType;
  using Group = FCCStoredEdges::Group;
  using Row = FCCNumberedBits::Row;

  /** \param types of the edges of the cells; the types of the group are taken */
  FCCCutEdges(const FCCSigns & signs, Group group, std::uint8_t types, std::pmr::memory_resource * scratch);

  /** Finds the cut edges that plane \a k stores and numbers them from \a firstId. Planes past the last have none. */
  void
  Find(SizeValueType k, std::uint32_t firstId);

  /** Number of cut edges that plane \a k stores, without finding their ids. */
  static SizeValueType
  Count(const FCCSigns & signs, Group group, SizeValueType k, std::uint8_t types);

  std::uint32_t
  GetFirstId() const
  {
    return m_FirstId;
  }
  std::uint8_t
  GetTypes() const
  {
    return m_Types;
  }

  /** Bit i: the edge of this type that site i stores is cut. */
  Row
  GetRow(SizeValueType j, std::uint8_t type) const
  {
    return m_Cut.GetNumberedRow(j * m_NumberOfTypes + FCCBits::CountBefore(m_Types, type));
  }

private:
  const FCCSigns * m_Signs;
  std::uint8_t m_Types;
  SizeValueType m_NumberOfTypes;
  std::uint32_t m_FirstId{ 0 };
  FCCNumberedBits m_Cut;
};

} // namespace itk

#endif
