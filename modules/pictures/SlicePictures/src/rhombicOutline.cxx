#include "rhombicSlicePicture.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rhombic
{
namespace
{

using Surface = itk::TriangleSurface;

/** An edge that crosses the plane: the point behind it in the upper half, the point before it in the lower half. */
using CrossedEdge = std::uint64_t;

/** The line in which the plane cuts a triangle, with the inside of the surface on its right in the picture. It begins
 * on the edge that comes from behind the plane and ends on the edge that goes behind it, when the triangle's edges are
 * followed counter-clockwise as seen from outside. So it begins where the line of the next triangle ends. */
struct CutLine
{
  CrossedEdge begin;
  CrossedEdge end;
};

/** Depth behind the plane, in mm. */
double
DepthOf(const Surface::PointType & point, const Projection & plane)
{
  return Dot(Subtract({ point[0], point[1], point[2] }, plane.centre), plane.frame.look);
}

/** For each point of the surface 1 if it is in the plane or behind it, otherwise 0. */
itk::BulkVector<std::uint8_t>
FindPointsBehind(const Surface & surface, const Projection & plane)
{
  const auto & points = surface.GetPoints();
  itk::BulkVector<std::uint8_t> isBehind(points.size());
  constexpr std::size_t blockSize = std::size_t(1) << 16;
  ForEachInBlocks(
    points.size(), blockSize, [&](std::size_t n) { isBehind[n] = DepthOf(points[n], plane) >= 0.0 ? 1 : 0; });
  return isBehind;
}

/** The line of a triangle that has points on both sides. */
CutLine
CutTriangle(const Surface::TriangleType & triangle, const itk::BulkVector<std::uint8_t> & isBehind)
{
  CutLine line{};
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const std::uint32_t a = triangle[corner];
    const std::uint32_t b = triangle[(corner + 1) % 3];
    if (isBehind[a] != isBehind[b])
    {
      const auto edge = [](std::uint32_t behind, std::uint32_t before) { return CrossedEdge(behind) << 32 | before; };
      (isBehind[a] ? line.begin : line.end) = isBehind[a] ? edge(a, b) : edge(b, a);
    }
  }
  return line;
}

/** In the order of the triangles. */
std::vector<CutLine>
CutTriangles(const Surface & surface, const itk::BulkVector<std::uint8_t> & isBehind)
{
  const auto & triangles = surface.GetTriangles();
  constexpr std::size_t blockSize = std::size_t(1) << 16;
  std::vector<std::vector<CutLine>> linesOfBlocks((triangles.size() + blockSize - 1) / blockSize);
  ForEachBlock(triangles.size(), blockSize, [&](std::size_t first, std::size_t last) {
    std::vector<CutLine> & lines = linesOfBlocks[first / blockSize];
    for (std::size_t n = first; n < last; ++n)
    {
      const auto & triangle = triangles[n];
      const int behind = isBehind[triangle[0]] + isBehind[triangle[1]] + isBehind[triangle[2]];
      if (behind == 1 || behind == 2)
      {
        lines.push_back(CutTriangle(triangle, isBehind));
      }
    }
  });
  std::vector<CutLine> lines;
  for (const auto & block : linesOfBlocks)
  {
    lines.insert(lines.end(), block.begin(), block.end());
  }
  return lines;
}

constexpr std::size_t None = ~std::size_t(0);

/** The line that begins on the edge where each line ends, or None. Where several lines meet on an edge, they are joined
 * in the order of their triangles. */
std::vector<std::size_t>
FindNextLines(const std::vector<CutLine> & lines)
{
  using EdgeOfLine = std::pair<CrossedEdge, std::size_t>;
  std::vector<EdgeOfLine> begins;
  std::vector<EdgeOfLine> ends;
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    begins.emplace_back(lines[n].begin, n);
    ends.emplace_back(lines[n].end, n);
  }
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  std::vector<std::size_t> next(lines.size(), None);
  auto begin = begins.cbegin();
  for (auto end = ends.cbegin(); end != ends.cend() && begin != begins.cend();)
  {
    if (begin->first == end->first)
    {
      next[(end++)->second] = (begin++)->second;
    }
    else if (begin->first < end->first)
    {
      ++begin;
    }
    else
    {
      ++end;
    }
  }
  return next;
}

/** Where an edge crosses the plane. */
PicturePosition
PositionOn(CrossedEdge edge, const Surface & surface, const Projection & plane)
{
  const auto & behind = surface.GetPoints()[edge >> 32];
  const auto & before = surface.GetPoints()[edge & 0xffffffff];
  const double depth = DepthOf(behind, plane);
  const double share = depth / (depth - DepthOf(before, plane));
  const auto positionOf = [&plane](const Surface::PointType & p) { return plane.PositionOf({ p[0], p[1], p[2] }); };
  const PicturePosition a = positionOf(behind);
  const PicturePosition b = positionOf(before);
  return { a.x + share * (b.x - a.x), a.y + share * (b.y - a.y) };
}

/** Appends a position that differs from the last position. */
void
Append(const PicturePosition & position, std::vector<PicturePosition> & points)
{
  if (points.empty() || position.x != points.back().x || position.y != points.back().y)
  {
    points.push_back(position);
  }
}

/** Follows the lines from a first line on, until the curve ends or comes back to that line, and marks them. */
Outline
TraceCurve(std::size_t line,
           const std::vector<CutLine> & lines,
           const std::vector<std::size_t> & next,
           const Surface & surface,
           const Projection & plane,
           std::vector<bool> & isTraced)
{
  Outline outline;
  auto & points = outline.points;
  CrossedEdge end{};
  for (; line != None && !isTraced[line]; line = next[line])
  {
    isTraced[line] = true;
    Append(PositionOn(lines[line].begin, surface, plane), points);
    end = lines[line].end;
  }
  outline.isClosed = line != None;
  Append(PositionOn(end, surface, plane), points);
  if (outline.isClosed) // the end is the first point again
  {
    points.pop_back();
  }
  return outline;
}

} // namespace

std::vector<Outline>
CutSurface(const itk::TriangleSurface & surface, const Projection & plane)
{
  const std::vector<CutLine> lines = CutTriangles(surface, FindPointsBehind(surface, plane));
  const std::vector<std::size_t> next = FindNextLines(lines);
  std::vector<bool> hasPrevious(lines.size(), false);
  for (const std::size_t line : next)
  {
    if (line != None)
    {
      hasPrevious[line] = true;
    }
  }
  std::vector<bool> isTraced(lines.size(), false);
  std::vector<Outline> outlines;
  for (const bool isClosed : { false, true }) // curves that begin on an open edge first, then closed curves
  {
    for (std::size_t line = 0; line < lines.size(); ++line)
    {
      if (!isTraced[line] && (isClosed || !hasPrevious[line]))
      {
        Outline outline = TraceCurve(line, lines, next, surface, plane, isTraced);
        if (outline.points.size() >= (isClosed ? 3U : 2U))
        {
          outlines.push_back(std::move(outline));
        }
      }
    }
  }
  return outlines;
}

} // namespace rhombic
