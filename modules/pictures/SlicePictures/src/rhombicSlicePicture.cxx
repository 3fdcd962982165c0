#include "rhombicSlicePicture.h"

#include "rhombicForEachBlock.h"
#include "itkSliceStack.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

using FrameVector = itk::SliceStack::VectorType;

/** Values of an image at positions in the frame of its slice stack. */
template <typename TPixel>
class StackValues
{
public:
  StackValues(const itk::Image<TPixel, 3> & image, const std::vector<itk::Point<double, 3>> & sliceOrigins)
    : m_Stack(image, sliceOrigins)
    , m_Samples(image.GetBufferPointer())
  {
    const auto & region = image.GetLargestPossibleRegion();
    const auto & size = region.GetSize();
    m_Columns = size[0];
    m_Rows = size[1];
    for (itk::SizeValueType n = 0; n < size[2]; ++n)
    {
      itk::Point<double, 3> origin;
      auto index = region.GetIndex();
      index[2] += static_cast<itk::IndexValueType>(n);
      image.TransformIndexToPhysicalPoint(index, origin);
      m_Origins.push_back(m_Stack.TransformPointToFrame(sliceOrigins.empty() ? origin : sliceOrigins[n]));
    }
  }

  const itk::SliceStack &
  GetStack() const
  {
    return m_Stack;
  }

  /** Not a number outside the scan.
   * \param slice where the search for the slice below the point begins, and ends */
  double
  ValueAt(const FrameVector & point, std::size_t & slice) const
  {
    constexpr double outside = std::numeric_limits<double>::quiet_NaN();
    const double z = point[2];
    if (!(z >= m_Stack.GetLowest()[2] - Rounding && z <= m_Stack.GetHighest()[2] + Rounding))
    {
      return outside;
    }
    while (slice > 0 && z < m_Origins[slice][2])
    {
      --slice;
    }
    while (slice + 2 < m_Origins.size() && z >= m_Origins[slice + 1][2])
    {
      ++slice;
    }
    const FrameVector & below = m_Origins[slice];
    const std::size_t next = std::min(slice + 1, m_Origins.size() - 1);
    const FrameVector & above = m_Origins[next];
    const double height = next > slice ? (z - below[2]) / (above[2] - below[2]) : 0.0;
    const std::array<double, 2> origin{ below[0] + height * (above[0] - below[0]),
                                        below[1] + height * (above[1] - below[1]) };
    const double row = m_Stack.GetRow(point[1], origin);
    const double column = m_Stack.GetColumn(point[0], row, origin);
    if (!IsOnAxis(row, m_Rows) || !IsOnAxis(column, m_Columns))
    {
      return outside;
    }
    return Mix(
      this->ValueInSlice(slice, row, column), this->ValueInSlice(next, row, column), std::clamp(height, 0.0, 1.0));
  }

private:
  static constexpr double Rounding = 1e-6; // planes in the outer faces of voxels are in them

  static bool
  IsOnAxis(double position, std::size_t size)
  {
    return position >= -0.5 - Rounding && position <= static_cast<double>(size) - 0.5 + Rounding;
  }

  static double
  Mix(double a, double b, double share)
  {
    return a + share * (b - a);
  }

  double
  ValueInSlice(std::size_t slice, double row, double column) const
  {
    const double y = std::clamp(row, 0.0, static_cast<double>(m_Rows - 1));
    const double x = std::clamp(column, 0.0, static_cast<double>(m_Columns - 1));
    const auto firstRow = static_cast<std::size_t>(y);
    const auto left = static_cast<std::size_t>(x);
    const std::size_t right = std::min(left + 1, m_Columns - 1);
    const TPixel * const first = m_Samples + (slice * m_Rows + firstRow) * m_Columns;
    const TPixel * const second = firstRow + 1 < m_Rows ? first + m_Columns : first;
    const double across = x - static_cast<double>(left);
    return Mix(Mix(first[left], first[right], across),
               Mix(second[left], second[right], across),
               y - static_cast<double>(firstRow));
  }

  itk::SliceStack m_Stack;
  const TPixel * m_Samples;
  std::size_t m_Columns;
  std::size_t m_Rows;
  std::vector<FrameVector> m_Origins; ///< of the slices
};

template <typename TPixel>
void
DrawRow(const StackValues<TPixel> & values,
        const Projection & plane,
        int row,
        const GreyWindow & window,
        const SliceBackground & background,
        Picture & picture)
{
  const auto pointAt = [&](double x) {
    const Vector3 point = plane.PointAt({ x, row + 0.5 });
    return values.GetStack().TransformPointToFrame(point.data());
  };
  const FrameVector first = pointAt(0.5);
  const FrameVector step = pointAt(1.5) - first;
  std::uint8_t * pixel =
    picture.pixels.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width * picture.channels);
  std::size_t slice = 0;
  for (int x = 0; x < picture.width; ++x, pixel += picture.channels)
  {
    const double value = values.ValueAt(first + step * x, slice);
    SliceBackground colour = background;
    if (!std::isnan(value))
    {
      const std::uint8_t grey = window.GreyOf(value);
      colour = { grey, grey, grey, 255 };
    }
    std::copy_n(colour.begin(), picture.channels, pixel);
  }
}

} // namespace

Picture
DrawSlice(const Scan & scan, const Projection & plane, const GreyWindow & window, const SliceBackground & background)
{
  Picture picture(plane.width, plane.height, background[3] == 255 ? 3 : 4);
  std::visit(
    [&](const auto & image) {
      const StackValues values(*image, scan.sliceOrigins);
      constexpr std::size_t rowsOfBlock = 8;
      ForEachInBlocks(static_cast<std::size_t>(plane.height), rowsOfBlock, [&](std::size_t row) {
        DrawRow(values, plane, static_cast<int>(row), window, background, picture);
      });
    },
    scan.image);
  return picture;
}

} // namespace rhombic
