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

/** The samples along an axis that a cubic curve between two of them follows, and their weights. */
struct CubicStencil
{
  std::array<std::size_t, 4> places;
  std::array<double, 4> weights;
};

/** The cubic Hermite curve from a sample to the next one, at a share of the way. Its slope at a sample is that of the
 * line through the two next to it (for even distances: Catmull and Rom's curve, the cubic one of vtkImageReslice); at
 * the ends of the axis it is that of the line to the next sample, so that linear fields are kept. \param size number of
 * samples along the axis \param before distance from the sample to the next, divided by that from the sample before it
 * to the next \param after the same for the sample behind the next */
CubicStencil
StencilAt(std::size_t sample, double share, std::size_t size, double before = 0.5, double after = 0.5)
{
  const double rest = 1.0 - share;
  const double atNext = share * share * (3.0 - 2.0 * share);
  const double slope = share * rest * rest;
  const double slopeAtNext = -share * share * rest;
  const std::size_t next = std::min(sample + 1, size - 1);
  CubicStencil stencil{ { sample, sample, next, next }, { 0.0, 1.0 - atNext, atNext, 0.0 } };
  auto & weights = stencil.weights;
  const bool hasBefore = sample > 0;
  const bool hasAfter = sample + 2 < size;
  stencil.places[0] -= hasBefore ? 1 : 0;
  stencil.places[3] += hasAfter ? 1 : 0;
  weights[hasBefore ? 0 : 1] -= slope * (hasBefore ? before : 1.0);
  weights[2] += slope * (hasBefore ? before : 1.0);
  weights[1] -= slopeAtNext * (hasAfter ? after : 1.0);
  weights[hasAfter ? 3 : 2] += slopeAtNext * (hasAfter ? after : 1.0);
  return stencil;
}

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
    return this->Interpolate(this->SlicesAt(slice, std::clamp(height, 0.0, 1.0)),
                             AcrossAt(std::clamp(row, 0.0, static_cast<double>(m_Rows - 1)), m_Rows),
                             AcrossAt(std::clamp(column, 0.0, static_cast<double>(m_Columns - 1)), m_Columns));
  }

private:
  static constexpr double Rounding = 1e-6; // planes in the outer faces of voxels are in them

  static bool
  IsOnAxis(double position, std::size_t size)
  {
    return position >= -0.5 - Rounding && position <= static_cast<double>(size) - 0.5 + Rounding;
  }

  static CubicStencil
  AcrossAt(double position, std::size_t size)
  {
    const auto sample = static_cast<std::size_t>(position);
    return StencilAt(sample, position - static_cast<double>(sample), size);
  }

  /** The slices about a height above a slice, a share of the way to the next. */
  CubicStencil
  SlicesAt(std::size_t slice, double height) const
  {
    const auto distance = [this](std::size_t from, std::size_t to) { return m_Origins[to][2] - m_Origins[from][2]; };
    const std::size_t count = m_Origins.size();
    const double step = slice + 1 < count ? distance(slice, slice + 1) : 1.0;
    const double before = slice > 0 && slice + 1 < count ? step / distance(slice - 1, slice + 1) : 1.0;
    const double after = slice + 2 < count ? step / distance(slice, slice + 2) : 1.0;
    return StencilAt(slice, height, count, before, after);
  }

  /** The weighted sum, limited to the range of its samples, so that edges have no bright or dark rims. */
  double
  Interpolate(const CubicStencil & slices, const CubicStencil & rows, const CubicStencil & columns) const
  {
    double sum = 0.0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (std::size_t k = 0; k < 4; ++k)
    {
      for (std::size_t j = 0; slices.weights[k] != 0.0 && j < 4; ++j)
      {
        const double weight = slices.weights[k] * rows.weights[j];
        const TPixel * const row = m_Samples + (slices.places[k] * m_Rows + rows.places[j]) * m_Columns;
        for (std::size_t i = 0; weight != 0.0 && i < 4; ++i)
        {
          if (columns.weights[i] != 0.0)
          {
            const auto sample = static_cast<double>(row[columns.places[i]]);
            sum += weight * columns.weights[i] * sample;
            lowest = std::min(lowest, sample);
            highest = std::max(highest, sample);
          }
        }
      }
    }
    return sum < lowest ? lowest : sum > highest ? highest : sum; // or not a number
  }

  itk::SliceStack m_Stack;
  const TPixel * m_Samples;
  std::size_t m_Columns;
  std::size_t m_Rows;
  std::vector<FrameVector> m_Origins; ///< of the slices
};

/** Calls \a use(x, value) for the pixels of a row of a plane, from the left. */
template <typename TPixel, typename TUse>
void
VisitRow(const StackValues<TPixel> & values, const Projection & plane, int row, const TUse & use)
{
  const auto pointAt = [&](double x) {
    const Vector3 point = plane.PointAt({ x, row + 0.5 });
    return values.GetStack().TransformPointToFrame(point.data());
  };
  const FrameVector first = pointAt(0.5);
  const FrameVector step = pointAt(1.5) - first;
  std::size_t slice = 0;
  for (int x = 0; x < plane.width; ++x)
  {
    use(x, values.ValueAt(first + step * x, slice));
  }
}

/** Calls \a use(x, y, value) for all pixels of a plane, rows on several threads. */
template <typename TUse>
void
VisitPlane(const Scan & scan, const Projection & plane, const TUse & use)
{
  std::visit(
    [&](const auto & image) {
      const StackValues values(*image, scan.sliceOrigins);
      constexpr std::size_t rowsOfBlock = 8;
      ForEachInBlocks(static_cast<std::size_t>(plane.height), rowsOfBlock, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        VisitRow(values, plane, y, [&use, y](int x, double value) { use(x, y, value); });
      });
    },
    scan.image);
}

} // namespace

Picture
DrawSlice(const Scan & scan, const Projection & plane, const GreyWindow & window, const SliceBackground & background)
{
  Picture picture(plane.width, plane.height, background[3] == 255 ? 3 : 4);
  VisitPlane(scan, plane, [&](int x, int y, double value) {
    SliceBackground colour = background;
    if (!std::isnan(value))
    {
      const std::uint8_t grey = window.GreyOf(value);
      colour = { grey, grey, grey, 255 };
    }
    const auto pixel = picture.At(x, y) - picture.pixels.data();
    std::copy_n(colour.begin(), picture.channels, picture.pixels.begin() + pixel);
  });
  return picture;
}

std::vector<float>
SliceValues(const Scan & scan, const Projection & plane)
{
  const auto width = static_cast<std::size_t>(plane.width);
  std::vector<float> values(width * static_cast<std::size_t>(plane.height));
  VisitPlane(scan, plane, [&](int x, int y, double value) {
    values[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = static_cast<float>(value);
  });
  return values;
}

} // namespace rhombic
