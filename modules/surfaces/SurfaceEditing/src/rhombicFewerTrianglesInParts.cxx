#include "rhombicFewerTrianglesInParts.h"

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleSurfaceForRendering.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace rhombic
{
namespace
{

constexpr itk::SizeValueType PlanesAround =
  8; // SmoothTriangleSurfaceNormals() takes sums over 7 neighbours of neighbours

/** Appends the elements from \a begin to \a end - 1. */
template <typename TContainer>
void
Append(const TContainer & from, std::size_t begin, std::size_t end, TContainer & to)
{
  to.insert(
    to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end));
}

/** Fewer triangles of a sheet, but for those whose corners have normals that differ so much that they would be seen to
 * be larger. \param sheets into which the sheet is divided, to work on at the same time; the points between stay */
itk::TriangleSurface::TrianglesContainer
SimplifyShaded(const itk::TriangleSurface & surface,
               const itk::TriangleSurface::TrianglesContainer & triangles,
               double distance,
               std::size_t sheets)
{
  constexpr float leastCosine = 0.97f; // of 14 degrees
  itk::TriangleSurface::TrianglesContainer bent;
  itk::TriangleSurface::TrianglesContainer others;
  for (const auto & triangle : triangles)
  {
    bool isBent = false;
    for (std::size_t corner = 0; surface.HasNormals() && corner < 3; ++corner)
    {
      const auto & one = surface.GetNormals()[triangle[corner]];
      const auto & next = surface.GetNormals()[triangle[(corner + 1) % 3]];
      isBent = isBent || one[0] * next[0] + one[1] * next[1] + one[2] * next[2] < leastCosine;
    }
    (isBent ? bent : others).push_back(triangle);
  }
  std::vector<itk::TriangleSurface::TrianglesContainer> fewer(sheets);
  ForEachOnThreads(sheets, [&](std::size_t n) {
    Append(others, n * others.size() / sheets, (n + 1) * others.size() / sheets, fewer[n]);
    fewer[n] = itk::SimplifySheetForRendering(surface.GetPoints(), fewer[n], distance);
  });
  for (const auto & sheet : fewer)
  {
    Append(sheet, 0, sheet.size(), bent);
  }
  return bent;
}

/** Erases the first elements, and the room for them. */
template <typename TContainer>
void
DropFirst(std::size_t count, TContainer & container)
{
  container.erase(container.begin(), container.begin() + static_cast<std::ptrdiff_t>(count));
}

} // namespace

struct FewerTrianglesInParts::Window
{
  itk::SizeValueType firstPoint = 0; ///< the number in the whole surface of the first point here
  itk::TriangleSurface::Pointer surface = itk::TriangleSurface::New();
  Triangles ofBlock; ///< the triangles whose first point is one of the block's
};

FewerTrianglesInParts::FewerTrianglesInParts(std::vector<itk::SizeValueType> firstPoints,
                                             double distance,
                                             itk::SizeValueType pointsOfBlock)
  : m_FirstPoints(std::move(firstPoints))
  , m_Planes{ 0 }
  , m_Distance(distance)
  , m_Pending(itk::TriangleSurface::New())
  , m_Joined(itk::TriangleSurface::New())
{
  for (itk::SizeValueType plane = 1; plane < m_FirstPoints.size(); ++plane)
  {
    const bool isFull = m_FirstPoints[plane] - m_FirstPoints[m_Planes.back()] >= pointsOfBlock;
    if (isFull || plane + 1 == m_FirstPoints.size())
    {
      m_Planes.push_back(plane);
    }
  }
  constexpr double largest = std::numeric_limits<double>::max();
  m_Whole.bounds = { largest, -largest, largest, -largest, largest, -largest };
}

void
FewerTrianglesInParts::Add(const itk::TriangleSurface & part, itk::SizeValueType end)
{
  Append(part.GetPoints(), 0, part.GetNumberOfPoints(), m_Pending->GetPoints());
  Append(part.GetNormals(), 0, part.GetNormals().size(), m_Pending->GetNormals());
  Append(part.GetTriangles(), 0, part.GetNumberOfTriangles(), m_Pending->GetTriangles());
  while (m_Block + 1 < m_Planes.size() && this->EndOfWindow(m_Block) <= end)
  {
    const itk::SizeValueType endOfBlock = m_Planes[m_Block + 1];
    const Window window = this->MakeWindow(m_Block);
    SmoothTriangleSurfaceNormals(*window.surface);
    this->Measure(window, m_Block);
    this->DropPlanes(endOfBlock);
    this->Join(window, SimplifyShaded(*window.surface, window.ofBlock, m_Distance, 4), endOfBlock);
    ++m_Block;
    const bool isLast = m_Block + 1 == m_Planes.size();
    if (isLast || m_Joined->GetNumberOfTriangles() - m_TrianglesBefore > MostTrianglesTogether)
    {
      this->SimplifyTogether();
    }
  }
}

itk::SizeValueType
FewerTrianglesInParts::EndOfWindow(itk::SizeValueType block) const
{
  return std::min(m_Planes[block + 1] + PlanesAround, m_Planes.back());
}

FewerTrianglesInParts::Window
FewerTrianglesInParts::MakeWindow(itk::SizeValueType block) const
{
  const itk::SizeValueType begin = m_Planes[block];
  const itk::SizeValueType first = m_FirstPoints[begin - std::min(begin, PlanesAround)];
  const itk::SizeValueType end = m_FirstPoints[this->EndOfWindow(block)];
  const itk::SizeValueType firstOfBlock = m_FirstPoints[begin];
  const itk::SizeValueType endOfBlock = m_FirstPoints[m_Planes[block + 1]];
  Window window;
  window.firstPoint = first;
  const itk::TriangleSurface & pending = *m_Pending;
  Append(pending.GetPoints(), first - m_FirstPending, end - m_FirstPending, window.surface->GetPoints());
  if (!pending.GetNormals().empty())
  {
    Append(pending.GetNormals(), first - m_FirstPending, end - m_FirstPending, window.surface->GetNormals());
  }
  Triangles & triangles = window.surface->GetTriangles();
  for (const auto & [a, b, c] : pending.GetTriangles())
  {
    const auto [lowest, highest] = std::minmax({ a, b, c });
    if (lowest >= first && highest < end)
    {
      const auto numberOf = [first](std::uint32_t point) { return static_cast<std::uint32_t>(point - first); };
      triangles.push_back({ numberOf(a), numberOf(b), numberOf(c) });
      if (lowest >= firstOfBlock && lowest < endOfBlock)
      {
        window.ofBlock.push_back(triangles.back());
      }
    }
  }
  return window;
}

void
FewerTrianglesInParts::Measure(const Window & window, itk::SizeValueType block)
{
  const itk::TriangleSurface & surface = *window.surface;
  const auto begin = m_FirstPoints[m_Planes[block]];
  const auto end = m_FirstPoints[m_Planes[block + 1]];
  if (m_Whole.points == 0 && end > begin)
  {
    m_Origin = itk::ToPosition(surface.GetPoints()[begin - window.firstPoint]);
  }
  for (auto point = begin; point < end; ++point)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double coordinate = surface.GetPoints()[point - window.firstPoint][axis];
      m_Whole.bounds[2 * axis] = std::min(m_Whole.bounds[2 * axis], coordinate);
      m_Whole.bounds[2 * axis + 1] = std::max(m_Whole.bounds[2 * axis + 1], coordinate);
    }
  }
  m_Whole.points += end - begin;
  m_Whole.triangles += window.ofBlock.size();
  for (const auto & triangle : window.ofBlock)
  {
    std::array<itk::PositionType, 3> corners = CornersOf(surface, triangle);
    m_Whole.area += Length(itk::AreaVector(corners)) / 2.0;
    for (itk::PositionType & corner : corners)
    {
      corner = itk::Subtract(corner, m_Origin);
    }
    const double volume = itk::Dot(corners[0], itk::Cross(corners[1], corners[2])) / 6.0;
    m_Whole.volume += volume;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Moment[axis] += volume * (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 4.0; // 4th: the origin
    }
  }
}

void
FewerTrianglesInParts::Join(const Window & window, const Triangles & fewer, itk::SizeValueType end)
{
  const itk::TriangleSurface & surface = *window.surface;
  std::vector<std::uint32_t> used;
  for (const auto & triangle : fewer)
  {
    used.insert(used.end(), triangle.begin(), triangle.end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::map<itk::SizeValueType, std::uint32_t> shared;
  std::vector<std::uint32_t> numbers(surface.GetNumberOfPoints());
  for (const std::uint32_t point : used)
  {
    const itk::SizeValueType ofWhole = window.firstPoint + point;
    const auto known = m_Shared.find(ofWhole);
    numbers[point] =
      known != m_Shared.end() ? known->second : static_cast<std::uint32_t>(m_Joined->GetNumberOfPoints());
    if (known == m_Shared.end())
    {
      m_Joined->GetPoints().push_back(surface.GetPoints()[point]);
      if (surface.HasNormals())
      {
        m_Joined->GetNormals().push_back(surface.GetNormals()[point]);
      }
    }
    if (ofWhole >= m_FirstPoints[end])
    {
      shared.emplace_hint(shared.end(), ofWhole, numbers[point]);
    }
  }
  for (const auto & [a, b, c] : fewer)
  {
    m_Joined->GetTriangles().push_back({ numbers[a], numbers[b], numbers[c] });
  }
  m_Shared.swap(shared);
}

void
FewerTrianglesInParts::SimplifyTogether()
{
  auto & points = m_Joined->GetPoints();
  auto & normals = m_Joined->GetNormals();
  auto & triangles = m_Joined->GetTriangles();
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  Triangles together;
  Append(triangles, m_TrianglesBefore, triangles.size(), together);
  triangles.resize(m_TrianglesBefore);
  together = SimplifyShaded(*m_Joined, together, m_Distance, 3);
  std::vector<std::uint32_t> numbers(points.size() - m_PointsBefore, unused);
  const auto forEachPoint = [&](const auto & use) {
    for (auto & triangle : together)
    {
      for (std::uint32_t & point : triangle)
      {
        point >= m_PointsBefore ? use(point, numbers[point - m_PointsBefore]) : void();
      }
    }
  };
  forEachPoint([](std::uint32_t, std::uint32_t & number) { number = 0; });
  auto kept = static_cast<std::uint32_t>(m_PointsBefore);
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    if (numbers[n] != unused)
    {
      points[kept] = points[m_PointsBefore + n];
      normals.empty() ? void() : void(normals[kept] = normals[m_PointsBefore + n]);
      numbers[n] = kept++;
    }
  }
  forEachPoint([](std::uint32_t & point, std::uint32_t number) { point = number; });
  points.resize(kept);
  normals.resize(normals.empty() ? 0 : kept);
  for (auto shared = m_Shared.begin(); shared != m_Shared.end();)
  {
    std::uint32_t & point = shared->second;
    point = point >= m_PointsBefore ? numbers[point - m_PointsBefore] : point;
    shared = point == unused ? m_Shared.erase(shared) : std::next(shared);
  }
  Append(together, 0, together.size(), triangles);
  m_PointsBefore = points.size();
  m_TrianglesBefore = triangles.size();
}

void
FewerTrianglesInParts::DropPlanes(itk::SizeValueType end)
{
  const itk::SizeValueType first = m_FirstPoints[end - std::min(end, PlanesAround)];
  const std::size_t count = first - m_FirstPending;
  DropFirst(count, m_Pending->GetPoints());
  DropFirst(std::min(count, m_Pending->GetNormals().size()), m_Pending->GetNormals());
  auto & triangles = m_Pending->GetTriangles();
  triangles.erase(std::remove_if(triangles.begin(),
                                 triangles.end(),
                                 [first](const auto & triangle) {
                                   return *std::min_element(triangle.begin(), triangle.end()) < first;
                                 }),
                  triangles.end());
  m_FirstPending = first;
}

WholeSurface
FewerTrianglesInParts::GetWhole() const
{
  WholeSurface whole = m_Whole;
  for (std::size_t axis = 0; axis < 3 && whole.volume != 0.0; ++axis)
  {
    whole.centroid[axis] = m_Origin[axis] + m_Moment[axis] / whole.volume;
  }
  return whole;
}

} // namespace rhombic
