#include "rhombicScanField.h"


#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rhombic
{

namespace
{
constexpr itk::SizeValueType MostTaps = 10; // of one axis, see itk::SeparableTaps
}

/** Weights of the samples around each point of a list. */
struct ScanField::Taps
{
  /** The value at point \a n. The columns' sums of all rows come first, eight columns at once. */
  template <typename TPixel>
  float
  Blend(const TPixel * samples, const itk::Size<3> & size, std::size_t n) const
  {
    constexpr itk::SizeValueType lanes = 8;
    const itk::SizeValueType count = columns.GetNumberOfTaps();
    const itk::SizeValueType inLanes = count / lanes * lanes;
    float sums[MostTaps] = {};
    for (itk::SizeValueType z = 0; z < slices.GetNumberOfTaps(); ++z)
    {
      for (itk::SizeValueType y = 0; y < rows.GetNumberOfTaps(); ++y)
      {
        const float weight = slices.GetWeights(n)[z] * rows.GetWeights(n)[y];
        const auto offset = ((slices.GetFirst(n) + z) * size[1] + rows.GetFirst(n) + y) * size[0];
        const TPixel * const row = samples + offset + columns.GetFirst(n);
        for (itk::SizeValueType x = 0; x < inLanes; x += lanes)
        {
          for (itk::SizeValueType lane = x; lane < x + lanes; ++lane)
          {
            sums[lane] += weight * static_cast<float>(row[lane]);
          }
        }
        for (itk::SizeValueType x = inLanes; x < count; ++x)
        {
          sums[x] += weight * static_cast<float>(row[x]);
        }
      }
    }
    float value = 0.0f;
    for (itk::SizeValueType x = 0; x < count; ++x)
    {
      value += columns.GetWeights(n)[x] * sums[x];
    }
    return value;
  }

  itk::SeparableTaps columns;
  itk::SeparableTaps rows;
  itk::SeparableTaps slices;
  std::vector<bool> areKnown; ///< false outside the scan and next to its border
};

namespace
{

/** Whether a position in samples is at least half a sample inside the outermost ones. */
bool
IsWellInside(double position, itk::SizeValueType length)
{
  constexpr double margin = 0.5;
  return position >= margin && position <= static_cast<double>(length) - 1.0 - margin;
}

} // namespace

ScanField::ScanField(const Scan & scan, itk::SeparableKernel kernel)
  : m_Scan(scan)
  , m_Kernel(kernel)
{
  if (IsSlanted(scan))
  {
    m_Stack.emplace(GeometryOf(scan.image), scan.sliceOrigins);
  }
}

double
ScanField::GetPitch() const
{
  const auto & pitch = m_Stack ? m_Stack->GetPitch() : GeometryOf(m_Scan.image).GetSpacing();
  return *std::min_element(pitch.Begin(), pitch.End());
}

ScanField::Taps
ScanField::MakeGridTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const
{
  const auto & geometry = GeometryOf(m_Scan.image);
  const auto & region = geometry.GetLargestPossibleRegion();
  std::array<std::vector<double>, 3> positions;
  std::vector<bool> areKnown(points.size(), true);
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const auto index = geometry.TransformPhysicalPointToContinuousIndex<double>(points[n]);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      positions[axis].push_back(index[axis] - static_cast<double>(region.GetIndex(axis)));
      areKnown[n] = areKnown[n] && IsWellInside(positions[axis].back(), region.GetSize(axis));
    }
  }
  return { itk::SeparableTaps(kernel, region.GetSize(0), positions[0]),
           itk::SeparableTaps(kernel, region.GetSize(1), positions[1]),
           itk::SeparableTaps(kernel, region.GetSize(2), positions[2]),
           areKnown };
}

ScanField::Taps
ScanField::MakeStackTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const
{
  const auto & region = GeometryOf(m_Scan.image).GetLargestPossibleRegion();
  std::array<std::vector<double>, 3> positions;
  std::vector<bool> areKnown(points.size());
  std::vector<itk::SliceStack::VectorType> frames;
  for (const PointType & point : points)
  {
    frames.push_back(m_Stack->TransformPointToFrame(point));
    positions[2].push_back(frames.back()[2]);
  }
  itk::SeparableTaps slices = m_Stack->MakeSliceTaps(kernel, positions[2]);
  const double margin = 0.5 * m_Stack->GetPitch()[2];
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const double z = frames[n][2];
    const auto origin = m_Stack->GetOriginAt(z, slices, n);
    const double row = m_Stack->GetRow(frames[n][1], origin);
    const double column = m_Stack->GetColumn(frames[n][0], row, origin);
    positions[0].push_back(column);
    positions[1].push_back(row);
    // The first slice is at height 0, and voxels reach half a pitch beyond the last one.
    areKnown[n] = IsWellInside(column, region.GetSize(0)) && IsWellInside(row, region.GetSize(1)) && z >= margin &&
                  z <= m_Stack->GetHighest()[2] - 2.0 * margin;
  }
  return { itk::SeparableTaps(kernel, region.GetSize(0), positions[0]),
           itk::SeparableTaps(kernel, region.GetSize(1), positions[1]),
           std::move(slices),
           areKnown };
}

std::vector<float>
ScanField::Evaluate(const std::vector<PointType> & points, itk::SeparableKernel kernel) const
{
  const Taps taps = m_Stack ? this->MakeStackTaps(points, kernel) : this->MakeGridTaps(points, kernel);
  std::vector<float> values(points.size(), std::numeric_limits<float>::quiet_NaN());
  std::visit(
    [&](const auto & image) {
      const auto & size = image->GetLargestPossibleRegion().GetSize();
      const auto * const samples = image->GetBufferPointer();
      for (std::size_t n = 0; n < points.size(); ++n)
      {
        if (taps.areKnown[n])
        {
          values[n] = taps.Blend(samples, size, n);
        }
      }
    },
    m_Scan.image);
  return values;
}

} // namespace rhombic
