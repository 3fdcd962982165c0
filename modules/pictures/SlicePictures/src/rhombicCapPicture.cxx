#include "rhombicSlicePicture.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

/** The share of each pixel's area inside curves, for the rows of a picture that the curves reach.
 *
 * A side of a curve adds its height within a row, with the sign of its direction, to all pixels of the row on the
 * side's right, and a part of the height to the pixel that the side crosses. The sum over all sides is the winding
 * number, averaged over the pixel. Sums are stored as differences to the pixel on the left. */
class Coverage
{
public:
  Coverage(const std::vector<Outline> & outlines, int width, int height)
    : m_Width(width)
  {
    double top = height;
    double bottom = 0.0;
    for (const Outline & outline : outlines)
    {
      for (const PicturePosition & point : outline.points)
      {
        top = std::min(top, point.y);
        bottom = std::max(bottom, point.y);
      }
    }
    m_FirstRow = static_cast<int>(std::clamp(std::floor(top), 0.0, static_cast<double>(height)));
    m_EndRow =
      static_cast<int>(std::clamp(std::ceil(bottom), static_cast<double>(m_FirstRow), static_cast<double>(height)));
    m_Differences.resize(this->RowBegin(m_EndRow));
    for (const Outline & outline : outlines)
    {
      for (std::size_t n = 0; outline.isClosed && n < outline.points.size(); ++n)
      {
        this->AddSide(outline.points[n], outline.points[(n + 1) % outline.points.size()]);
      }
    }
  }

  /** Calls visit(column, row, share) for all pixels of the rows, on several threads. */
  template <typename TVisit>
  void
  VisitPixels(const TVisit & visit) const
  {
    constexpr std::size_t rowsOfBlock = 32;
    ForEachInBlocks(static_cast<std::size_t>(m_EndRow - m_FirstRow), rowsOfBlock, [&](std::size_t n) {
      const int row = m_FirstRow + static_cast<int>(n);
      const float * const differences = m_Differences.data() + this->RowBegin(row);
      float winding = 0.0f;
      for (int column = 0; column < m_Width; ++column)
      {
        winding += differences[column];
        visit(column, row, std::min(1.0f, std::abs(winding)));
      }
    });
  }

private:
  /** Of a row in the differences: two more than the width, for what is on the right of the picture. */
  std::size_t
  RowBegin(int row) const
  {
    return static_cast<std::size_t>(row - m_FirstRow) * (static_cast<std::size_t>(m_Width) + 2);
  }

  void
  AddSide(const PicturePosition & from, const PicturePosition & to)
  {
    const bool isDownward = from.y < to.y;
    const PicturePosition & top = isDownward ? from : to;
    const PicturePosition & bottom = isDownward ? to : from;
    const double slope = (bottom.x - top.x) / (bottom.y - top.y); // unused for level sides
    const double end = std::min(bottom.y, static_cast<double>(m_EndRow));
    for (double y = std::max(top.y, static_cast<double>(m_FirstRow)); y < end;)
    {
      const double row = std::floor(y);
      const double next = std::min(row + 1.0, end);
      const double x[2] = { top.x + (y - top.y) * slope, top.x + (next - top.y) * slope };
      this->AddPiece(
        static_cast<int>(row), std::min(x[0], x[1]), std::max(x[0], x[1]), isDownward ? y - next : next - y);
      y = next;
    }
  }

  /** Adds a piece of a side within a row, from \a left to \a right. Column -1 is all that is on the left of the
   * picture, the column after the last column is all on its right. */
  void
  AddPiece(int row, double left, double right, double signedHeight)
  {
    float * const differences = m_Differences.data() + this->RowBegin(row);
    const auto columnOf = [this](double x) { return static_cast<int>(std::clamp(std::floor(x), -1.0, m_Width + 0.0)); };
    const int last = columnOf(right);
    for (int column = columnOf(left); column <= last; ++column)
    {
      const double begin = column < 0 ? left : std::max(left, static_cast<double>(column));
      const double end = column < m_Width ? std::min(right, column + 1.0) : right;
      const double part = right > left ? signedHeight * (end - begin) / (right - left) : signedHeight;
      const double onLeft = column < 0 ? 0.0 : 0.5 * (begin + end) - column; // share of the pixel on the piece's left
      const int pixel = std::max(column, 0);
      differences[pixel] += static_cast<float>(part * (1.0 - onLeft));
      differences[pixel + 1] += static_cast<float>(part * onLeft);
    }
  }

  int m_Width;
  int m_FirstRow;
  int m_EndRow;
  std::vector<float> m_Differences;
};

std::uint8_t
RoundToByte(float value)
{
  return static_cast<std::uint8_t>(value + 0.5f);
}

/** Adds a surface's share of a pixel to the cap. */
void
AddToPixel(const std::uint8_t * slice, const CapSurface & surface, float share, std::uint8_t * cap)
{
  constexpr float smallest = 0.5f / 255.0f; // smaller shares are not seen
  if (share < smallest)
  {
    return;
  }
  const float alpha = std::min(255.0f, cap[3] + 255.0f * share);
  const float weight = std::min(1.0f, 255.0f * share / alpha);
  const auto tint = static_cast<float>(surface.tint);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const float tinted =
      slice[channel] + tint * (255.0f * static_cast<float>(surface.colour[channel]) - slice[channel]);
    cap[channel] = RoundToByte(cap[channel] + weight * (tinted - cap[channel]));
  }
  cap[3] = RoundToByte(alpha);
}

} // namespace

Picture
DrawCap(const Picture & slice, const std::vector<CapSurface> & surfaces)
{
  Picture cap(slice.width, slice.height, 4);
  for (const CapSurface & surface : surfaces)
  {
    const Coverage coverage(surface.outlines, slice.width, slice.height);
    coverage.VisitPixels([&](int column, int row, float share) {
      const std::ptrdiff_t pixel = cap.At(column, row) - cap.pixels.data();
      AddToPixel(slice.At(column, row), surface, share, cap.pixels.data() + pixel);
    });
  }
  return cap;
}

} // namespace rhombic
