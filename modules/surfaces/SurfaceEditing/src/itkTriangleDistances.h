#ifndef itkTriangleDistances_h
#define itkTriangleDistances_h

#include "detail/itkPositionArithmetic.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

namespace itk
{

/** What is computed once of a triangle of corners a, b and c for the distances of many positions. */
struct TriangleTerms
{
  /** Coordinates relative to a; products of b, c and the side s = c - b; reciprocals of products, and of the area, four
   * times squared, which is -1 for flat triangles: only their sides count. */
  enum Term
  {
    B,
    C = B + 3,
    BB = C + 3,
    BC,
    CC,
    SS,
    OverBB,
    OverCC,
    OverSS,
    OverArea,
    Area,
    Number
  };

  std::array<double, Number> values;

  /** \param b and \param c relative to a */
  TriangleTerms(const PositionType & b, const PositionType & c);
};

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
    m_Sheets.clear();
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
  AddTriangle(const PositionType & b, const PositionType & c, std::uint32_t sheet)
  {
    m_Triangles.emplace_back(b, c);
    m_Sheets.push_back(sheet);
  }

  /** Finds for each witness the number of the nearest triangle, the first of several. Returns whether all are within a
   * distance; false also for more triangles than MostTriangles, whose numbers have no room. */
  bool
  FindNearest(double squaredDistance, std::vector<std::uint16_t> & numbers);

  static constexpr std::size_t MostLanes = 8; ///< of vectors of doubles
  static constexpr std::size_t MostTriangles = 1U << 16U;

private:
  std::size_t m_Size = 0;
  std::size_t m_Stride = 0;     ///< size, rounded up to whole vectors
  std::vector<double> m_Values; ///< x, y, z and sheets of the witnesses
  std::vector<TriangleTerms> m_Triangles;
  std::vector<double> m_Sheets;  ///< of the triangles
  std::vector<double> m_Nearest; ///< for each witness, the number of a triangle, and then its squared distance
};

/** \class NearestPoints
 * \brief The nearest of some points for each of some samples. */
class NearestPoints
{
public:
  /** Forgets all points and samples. */
  void
  Clear()
  {
    m_Points.clear();
    for (auto & row : m_Samples)
    {
      row.clear();
    }
  }

  void
  AddPoint(const PositionType & position)
  {
    m_Points.push_back(position);
  }

  void
  AddSample(const PositionType & position)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Samples[axis].push_back(position[axis]);
    }
  }

  /** Finds the nearest point for each sample, the first of several. */
  void
  Find();

  /** The number of the nearest point of sample \a n, if there are points. */
  std::size_t
  GetPoint(std::size_t n) const
  {
    return static_cast<std::size_t>(m_Nearest[n]);
  }

  /** Of sample \a n from the nearest point; infinite if there are no points. */
  double
  GetSquaredDistance(std::size_t n) const
  {
    return m_Nearest[m_Samples[0].size() + n];
  }

private:
  std::vector<PositionType> m_Points;
  std::array<std::vector<double>, 3> m_Samples; ///< x, y and z
  std::vector<double> m_Nearest; ///< for each sample, the number of a point, and then its squared distance
};

/** \class NearbyTriangles
 * \brief The nearest of some triangles to a position. Makes no allocations. */
class NearbyTriangles
{
public:
  static constexpr std::size_t Capacity = 120; ///< rows that are not a multiple of 512 bytes apart

  struct Nearest
  {
    std::uint32_t triangle;
    double squaredDistance;
  };

  /** Bit n for the n-th triangle that was added. */
  using Some = std::bitset<Capacity>;

  bool
  IsEmpty() const
  {
    return m_Size == 0;
  }

  std::size_t
  GetSize() const
  {
    return m_Size;
  }

  /** Forgets all but the first \a size triangles. */
  void
  KeepFirst(std::size_t size)
  {
    m_Size = size;
  }

  /** Returns false if there is no room. */
  bool
  Add(std::uint32_t triangle, const CornersType & corners);

  /** Of at least one triangle; the first of several. */
  Nearest
  FindNearest(const PositionType & position) const;

  /** Those within a distance of a position. */
  Some
  FindWithin(double squaredDistance, const PositionType & position) const;

  /** The triangle that was added as the n-th. */
  std::uint32_t
  GetTriangle(std::size_t n) const
  {
    return m_Triangles[n];
  }

private:
  static constexpr std::size_t NumberOfRows = 3 + TriangleTerms::Number;

  std::size_t m_Size = 0;
  std::array<double, NumberOfRows * Capacity> m_Rows; ///< for each triangle, a corner's coordinates, then the terms
  std::array<std::uint32_t, Capacity> m_Triangles;
};

} // namespace itk

#endif
