#ifndef itkFanDistances_h
#define itkFanDistances_h

#include "detail/itkPositionArithmetic.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class FanDistances
 * \brief The nearest triangle of a fan for each of some positions, the witnesses.
 *
 * All positions are relative to the point that the triangles have in common. */
class FanDistances
{
public:
  /** Forgets all triangles and witnesses. \param witnesses how many SetWitness() will set */
  void
  Begin(std::size_t witnesses)
  {
    m_Size = witnesses;
    m_Stride = (witnesses + MostLanes - 1) / MostLanes * MostLanes;
    m_Values.assign(4 * m_Stride, 0.0);
    m_Triangles.clear();
  }

  /** \param sheet the witness is covered by triangles of this sheet only */
  void
  SetWitness(std::size_t n, const PositionType & position, std::uint32_t sheet)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Values[axis * m_Stride + n] = position[axis];
    }
    m_Values[3 * m_Stride + n] = sheet;
  }

  /** Adds a triangle of the common point and two others. */
  void
  AddTriangle(const PositionType & b, const PositionType & c, std::uint32_t sheet);

  /** Finds for each witness the number of the nearest triangle, the first of several. Returns whether all are within a
   * distance. */
  bool
  FindNearest(double squaredDistance, std::vector<std::uint16_t> & numbers);

  /** A triangle of the point 0, b and c. */
  struct Triangle
  {
    PositionType b, c;
    double bb, bc, cc, ss;                   ///< products of b, c and the side s = c - b
    double overBB, overCC, overSS, overArea; ///< reciprocals; of the area, four times squared
    double area;                             ///< below 0 if the triangle is flat and only its sides count
    double sheet;
  };

private:
  static constexpr std::size_t MostLanes = 8; ///< of vectors of doubles

  std::size_t m_Size = 0;
  std::size_t m_Stride = 0;     ///< size, rounded up to whole vectors
  std::vector<double> m_Values; ///< x, y, z and sheets of the witnesses
  std::vector<Triangle> m_Triangles;
  std::vector<double> m_Nearest; ///< for each witness, the number of a triangle, and its squared distance
};

} // namespace itk

#endif
