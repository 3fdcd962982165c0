#ifndef itkTriangleNeighborhood_h
#define itkTriangleNeighborhood_h

#include "itkTriangleSurface.h"

#include <utility>

namespace itk
{

/** \class TriangleNeighborhood
 * \brief Some triangles of a surface in rows, so that one is compared with many at once. */
class TriangleNeighborhood
{
public:
  using TriangleType = TriangleSurface::TriangleType;

  /** The box of a triangle in steps of some grid that keep the order of coordinates, so that boxes that overlap still
   * do: least x, y, z, greatest x, y, z. */
  using StepBox = std::array<std::int16_t, 6>;

  explicit TriangleNeighborhood(const TriangleSurface & surface)
    : m_Points(surface.GetPoints())
    , m_Triangles(surface.GetTriangles())
  {}

  void
  Clear()
  {
    m_Size = 0;
  }

  std::size_t
  GetSize() const
  {
    return m_Size;
  }

  /** \param unfolded corners at which no pairs are looked for; the largest number in place of others */
  void
  Add(std::uint32_t triangle, const StepBox & box, const TriangleType & unfolded);

  /** Calls \a visit(a, b) for pairs of different triangles whose boxes overlap, which have no unfolded corner in
   * common, and whose first is among the first \a count that were added. Pairs may be left out of which one triangle is
   * certain to lie on one side of the other's plane, but for corners in common. */
  template <typename TVisitor>
  void
  VisitPairs(std::size_t count, const TVisitor & visit)
  {
    m_Others.resize(m_Size);
    m_Pairs.clear();
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::size_t others = this->FindOthers(n);
      for (std::size_t k = 0; k < others; ++k)
      {
        if (m_Ids[n] != m_Ids[m_Others[k]])
        {
          m_Pairs.emplace_back(m_Ids[n], m_Ids[m_Others[k]]);
        }
      }
    }
    this->KeepMeetingPairs();
    for (const auto & [a, b] : m_Pairs)
    {
      visit(a, b);
    }
  }

private:
  /** Writes to m_Others which triangles behind number n may meet it; returns how many. */
  std::size_t
  FindOthers(std::size_t n);

  /** Removes the pairs of m_Pairs that a plane of either triangle is certain to part. */
  void
  KeepMeetingPairs();

  const TriangleSurface::PointsContainer & m_Points;
  const TriangleSurface::TrianglesContainer & m_Triangles;
  std::size_t m_Size = 0;
  std::vector<std::uint32_t> m_Ids;
  std::array<std::vector<std::int16_t>, 6> m_Sides;    ///< of the boxes
  std::array<std::vector<std::uint32_t>, 3> m_Corners; ///< see Add()
  std::vector<std::uint32_t> m_Others;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> m_Pairs;
};

} // namespace itk

#endif
