#include "itkTriangleSurfaceInterior.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace itk
{
namespace
{

using Vector3 = Vector<double, 3>;

constexpr std::size_t PointsOfBlock = 16384;

Vector3
ToVector(const TriangleSurface::PointType & point)
{
  Vector3 vector;
  std::copy(point.begin(), point.end(), vector.Begin());
  return vector;
}

/** The dual basis of column step, row step and normal: scalar products with it give column, row and height. */
struct PlaneFrame
{
  Vector3 column;
  Vector3 row;
  Vector3 normal;

  explicit PlaneFrame(const SamplePlanes & planes)
  {
    const Vector3 across = CrossProduct(planes.columnStep, planes.rowStep);
    const double squared = across.GetSquaredNorm();
    column = CrossProduct(planes.rowStep, across) / squared;
    row = CrossProduct(across, planes.columnStep) / squared;
    normal = across / std::sqrt(squared);
    if (planes.origins.size() > 1 && (planes.origins.back() - planes.origins.front()) * normal < 0.0)
    {
      normal *= -1.0;
    }
  }
};

/** The triangles that cross each plane: those of plane n are triangles[begin[n]] to triangles[begin[n + 1]]. */
struct TrianglesOfPlanes
{
  std::vector<std::uint64_t> begin;
  BulkVector<std::uint32_t> triangles;
};

TrianglesOfPlanes
FindTrianglesOfPlanes(const TriangleSurface & surface,
                      const BulkVector<double> & pointHeights,
                      const std::vector<double> & planeHeights)
{
  BulkVector<std::uint32_t> planesBelow(pointHeights.size()); // or at the point
  rhombic::ForEachInBlocks(pointHeights.size(), PointsOfBlock, [&](std::size_t point) {
    const auto above = std::upper_bound(planeHeights.begin(), planeHeights.end(), pointHeights[point]);
    planesBelow[point] = static_cast<std::uint32_t>(above - planeHeights.begin());
  });
  const auto planesOf = [&](const TriangleSurface::TriangleType & triangle) {
    return std::minmax({ planesBelow[triangle[0]], planesBelow[triangle[1]], planesBelow[triangle[2]] });
  };
  const auto & triangles = surface.GetTriangles();
  TrianglesOfPlanes found;
  found.begin.assign(planeHeights.size() + 1, 0);
  for (const auto & triangle : triangles)
  {
    const auto [first, last] = planesOf(triangle);
    for (std::size_t plane = first; plane < last; ++plane)
    {
      ++found.begin[plane + 1];
    }
  }
  std::partial_sum(found.begin.begin(), found.begin.end(), found.begin.begin());
  found.triangles.resize(found.begin.back());
  auto next = found.begin;
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    const auto [first, last] = planesOf(triangles[n]);
    for (std::size_t plane = first; plane < last; ++plane)
    {
      found.triangles[next[plane]++] = static_cast<std::uint32_t>(n);
    }
  }
  return found;
}

/** A position in a plane, in units of samples. */
struct PlanePoint
{
  double column;
  double row;
};

/** Cuts triangles by a plane. Triangles that share a side get exactly the same point on it, so that the outline in the
 * plane is closed. */
class PlaneCut
{
public:
  PlaneCut(const TriangleSurface & surface,
           const PlaneFrame & frame,
           const Point<double, 3> & origin,
           const BulkVector<double> & pointHeights,
           double height)
    : m_Surface(surface)
    , m_Frame(frame)
    , m_Column(frame.column * origin.GetVectorFromOrigin())
    , m_Row(frame.row * origin.GetVectorFromOrigin())
    , m_PointHeights(pointHeights)
    , m_Height(height)
  {}

  /** The two ends of the cut through a triangle that crosses the plane. */
  std::array<PlanePoint, 2>
  CutTriangle(const TriangleSurface::TriangleType & triangle) const
  {
    std::array<PlanePoint, 2> ends{};
    unsigned int found = 0;
    for (unsigned int corner = 0; corner < 3 && found < 2; ++corner)
    {
      const std::uint32_t a = triangle[corner];
      const std::uint32_t b = triangle[(corner + 1) % 3];
      if (this->IsAbove(a) != this->IsAbove(b))
      {
        ends[found++] = this->CutSide(std::min(a, b), std::max(a, b));
      }
    }
    return ends;
  }

private:
  bool
  IsAbove(std::uint32_t point) const
  {
    return m_PointHeights[point] >= m_Height;
  }

  PlanePoint
  CutSide(std::uint32_t a, std::uint32_t b) const
  {
    const double share = (m_Height - m_PointHeights[a]) / (m_PointHeights[b] - m_PointHeights[a]);
    const Vector3 from = ToVector(m_Surface.GetPoints()[a]);
    const Vector3 cut = from + (ToVector(m_Surface.GetPoints()[b]) - from) * share;
    return { m_Frame.column * cut - m_Column, m_Frame.row * cut - m_Row };
  }

  const TriangleSurface & m_Surface;
  const PlaneFrame & m_Frame;
  double m_Column; ///< column of the plane's origin
  double m_Row;    ///< row of the plane's origin
  const BulkVector<double> & m_PointHeights;
  double m_Height;
};

/** A crossing of a row of samples with the outline. */
struct Crossing
{
  SizeValueType row;
  double column;
};

/** Appends the crossings of rows with a segment of the outline. */
void
AppendCrossings(const std::array<PlanePoint, 2> & ends, SizeValueType numberOfRows, std::vector<Crossing> & crossings)
{
  // Always from the lower to the higher row, so that rounding does not depend on which way the triangle faces.
  const auto & [low, high] = ends[0].row < ends[1].row ? std::tie(ends[0], ends[1]) : std::tie(ends[1], ends[0]);
  // A row on the surface is taken to lie just above it: rows above the lower end, up to the higher end.
  const double first = std::max(0.0, std::floor(low.row) + 1.0);
  const double last = std::min(static_cast<double>(numberOfRows) - 1.0, std::floor(high.row));
  for (double row = first; row <= last; row += 1.0)
  {
    const double share = (row - low.row) / (high.row - low.row);
    crossings.push_back({ static_cast<SizeValueType>(row), low.column + share * (high.column - low.column) });
  }
}

SizeValueType
FirstColumnFrom(double position, SizeValueType numberOfColumns)
{
  return static_cast<SizeValueType>(std::clamp(std::ceil(position), 0.0, static_cast<double>(numberOfColumns)));
}

/** Visits the runs of samples between successive crossings of each row. */
void
VisitRuns(SizeValueType plane,
          std::vector<Crossing> & crossings,
          SizeValueType numberOfColumns,
          const VisitInteriorSamples & visit)
{
  std::sort(crossings.begin(), crossings.end(), [](const Crossing & a, const Crossing & b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
  for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
  {
    const SizeValueType begin = FirstColumnFrom(crossings[n].column, numberOfColumns);
    const SizeValueType end = FirstColumnFrom(crossings[n + 1].column, numberOfColumns);
    if (begin < end && crossings[n].row == crossings[n + 1].row)
    {
      visit(plane, crossings[n].row, begin, end);
    }
  }
}

} // namespace

void
FindTriangleSurfaceInteriorSamples(const TriangleSurface & surface,
                                   const SamplePlanes & planes,
                                   const VisitInteriorSamples & visit)
{
  if (planes.origins.empty() || planes.numberOfRows == 0 || planes.numberOfColumns == 0)
  {
    return;
  }
  const PlaneFrame frame(planes);
  BulkVector<double> pointHeights(surface.GetNumberOfPoints());
  rhombic::ForEachInBlocks(pointHeights.size(), PointsOfBlock, [&](std::size_t point) {
    pointHeights[point] = frame.normal * ToVector(surface.GetPoints()[point]);
  });
  std::vector<double> planeHeights(planes.origins.size());
  std::transform(planes.origins.begin(), planes.origins.end(), planeHeights.begin(), [&](const auto & origin) {
    return frame.normal * origin.GetVectorFromOrigin();
  });
  const TrianglesOfPlanes found = FindTrianglesOfPlanes(surface, pointHeights, planeHeights);

  rhombic::ForEachInBlocks(planes.origins.size(), 1, [&](SizeValueType plane) {
    const PlaneCut cut(surface, frame, planes.origins[plane], pointHeights, planeHeights[plane]);
    std::vector<Crossing> crossings;
    for (std::uint64_t n = found.begin[plane]; n < found.begin[plane + 1]; ++n)
    {
      AppendCrossings(cut.CutTriangle(surface.GetTriangles()[found.triangles[n]]), planes.numberOfRows, crossings);
    }
    VisitRuns(plane, crossings, planes.numberOfColumns, visit);
  });
}

} // namespace itk
