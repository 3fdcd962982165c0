#ifndef itkTriangleCells_h
#define itkTriangleCells_h

#include "itkPointBox.h"
#include "itkTriangleSurface.h"

#include <optional>

namespace itk
{

/** \class TriangleSizes
 * \brief How long the boxes of triangles are along each axis, which are of about the same size. */
struct TriangleSizes
{
  /** Of the triangles [begin, end) of a surface. Nothing if there are none, some are far larger than others, or
   * positions are not finite. */
  static std::optional<TriangleSizes>
  Find(const TriangleSurface & surface, std::size_t begin, std::size_t end);

  static std::optional<TriangleSizes>
  Find(const TriangleSurface & surface)
  {
    return Find(surface, 0, surface.GetNumberOfTriangles());
  }

  std::size_t count = 0; ///< of triangles
  PointBox box{};        ///< around them
  std::array<double, 3> longest{};
  std::array<double, 3> mean{};
};

/** \class TriangleCells
 * \brief The cells of a grid around triangles, none of which is longer than a cell along any axis. The outermost cells
 * are empty. */
class TriangleCells
{
public:
  using PointType = TriangleSurface::PointType;

  /** \param cellOverMean length of a cell, over that of the triangles' boxes; more if some are long */
  TriangleCells(const TriangleSizes & sizes, double cellOverMean);

  /** The box around a triangle. */
  static PointBox
  BoxOf(const TriangleSurface & surface, std::size_t triangle)
  {
    const auto & [a, b, c] = surface.GetTriangles()[triangle];
    const auto & points = surface.GetPoints();
    PointBox box{ points[a], points[a] };
    box.Add(points[b]);
    box.Add(points[c]);
    return box;
  }

  /** The box around all triangles. */
  const PointBox &
  GetBox() const
  {
    return m_Box;
  }

  std::size_t
  GetSize(unsigned int axis) const
  {
    return m_Sizes[axis];
  }

  /** The difference of the numbers of cells that follow each other along an axis. */
  std::size_t
  GetStride(unsigned int axis) const
  {
    return axis == 0 ? 1 : axis == 1 ? m_Sizes[0] : m_Sizes[0] * m_Sizes[1];
  }

  std::size_t
  GetNumberOfCells() const
  {
    return m_Sizes[0] * m_Sizes[1] * m_Sizes[2];
  }

  /** The number of the cell along an axis; it does not fall where the coordinate grows. */
  std::size_t
  Find(float coordinate, unsigned int axis) const
  {
    return this->ToNumber((coordinate - m_Box.lowest[axis]) * m_CellsPerMillimetre[axis], axis);
  }

  std::size_t
  Find(const PointType & point) const
  {
    return this->Find(point[0], 0) + m_Sizes[0] * (this->Find(point[1], 1) + m_Sizes[1] * this->Find(point[2], 2));
  }

  /** The number of the cell of a box's centre along an axis. */
  std::size_t
  FindCentre(const PointBox & box, unsigned int axis) const
  {
    const float low = box.lowest[axis] - m_Box.lowest[axis], high = box.highest[axis] - m_Box.lowest[axis];
    return this->ToNumber(0.5f * (low + high) * m_CellsPerMillimetre[axis], axis);
  }

  /** The middle of a cell along an axis, about. */
  float
  GetMiddle(std::size_t cell, unsigned int axis) const
  {
    return m_Box.lowest[axis] + (static_cast<float>(cell) - 0.5f) / std::max(m_CellsPerMillimetre[axis], 1e-30f);
  }

  /** The cells that a box meets, from the first to the last along each axis. */
  std::array<std::array<std::size_t, 3>, 2>
  FindEnds(const PointBox & box) const
  {
    std::array<std::array<std::size_t, 3>, 2> ends;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      ends[0][axis] = this->Find(box.lowest[axis], axis);
      ends[1][axis] = this->Find(box.highest[axis], axis);
    }
    return ends;
  }

  /** Whether \a visit(cell) is true for all cells that the box meets. */
  template <typename TVisitor>
  bool
  AllOf(const PointBox & box, const TVisitor & visit) const
  {
    const auto [first, last] = this->FindEnds(box);
    for (std::size_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::size_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::size_t x = first[0]; x <= last[0]; ++x)
        {
          if (!visit((z * m_Sizes[1] + y) * m_Sizes[0] + x))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

private:
  std::size_t
  ToNumber(float cells, unsigned int axis) const
  {
    return static_cast<std::uint32_t>(
      static_cast<int>(std::min(static_cast<float>(m_Sizes[axis] - 1), std::max(0.0f, 1.0f + cells))));
  }

  PointBox m_Box;
  std::array<float, 3> m_CellsPerMillimetre{};
  std::array<std::size_t, 3> m_Sizes{}; ///< number of cells along each axis
};

/** \class TriangleRegion
 * \brief Some cells, and the triangles that meet them. */
class TriangleRegion
{
public:
  explicit TriangleRegion(const TriangleCells & cells)
    : m_Cells(cells)
    , m_IsIn(cells.GetNumberOfCells(), 0)
  {}

  /** Adds the cells that a box meets. */
  void
  Add(const PointBox & box);

  /** Whether all cells that the box meets are in the region. */
  bool
  Holds(const PointBox & box) const
  {
    return m_Cells.AllOf(box, [this](std::size_t cell) { return m_IsIn[cell] != 0; });
  }

  /** The ids of the triangles whose boxes meet the region's cells, in any order. */
  BulkVector<std::uint32_t>
  FindTriangles(const TriangleSurface & surface) const;

private:
  const TriangleCells & m_Cells;
  BulkVector<std::uint8_t> m_IsIn;
};

} // namespace itk

#endif
