#ifndef itkLocalIds_h
#define itkLocalIds_h

#include "itkTriangleSurface.h"

#include <algorithm>

namespace itk
{

/** \class LocalIds
 * \brief Numbers from 0 for the points of some triangles, in the order of their ids. */
class LocalIds
{
public:
  using PointId = std::uint32_t;
  using TriangleType = TriangleSurface::TriangleType;

  explicit LocalIds(const std::vector<TriangleType> & triangles)
  {
    m_Ids.reserve(3 * triangles.size());
    for (const TriangleType & triangle : triangles)
    {
      m_Ids.insert(m_Ids.end(), triangle.begin(), triangle.end());
    }
    std::sort(m_Ids.begin(), m_Ids.end());
    m_Ids.erase(std::unique(m_Ids.begin(), m_Ids.end()), m_Ids.end());
  }

  const std::vector<PointId> &
  GetIds() const
  {
    return m_Ids;
  }

  bool
  Has(PointId id) const
  {
    return std::binary_search(m_Ids.begin(), m_Ids.end(), id);
  }

  std::vector<TriangleType>
  ToLocal(std::vector<TriangleType> triangles) const
  {
    for (TriangleType & triangle : triangles)
    {
      for (PointId & point : triangle)
      {
        point = static_cast<PointId>(std::lower_bound(m_Ids.begin(), m_Ids.end(), point) - m_Ids.begin());
      }
    }
    return triangles;
  }

private:
  std::vector<PointId> m_Ids;
};

} // namespace itk

#endif
