#include "detail/itkSliceStackPlanes.h"

#include <algorithm>

namespace itk
{
namespace
{

/** z of a region's planes in the stack's frame, in mm. */
std::vector<double>
HeightsOf(const ImageRegion<3> & region, double origin, double spacing)
{
  std::vector<double> heights(region.GetSize(2));
  for (std::size_t k = 0; k < heights.size(); ++k)
  {
    heights[k] = origin + spacing * static_cast<double>(region.GetIndex(2) + static_cast<IndexValueType>(k));
  }
  return heights;
}

/** Whether a position along an axis, in samples from the first one, lies in one of the axis' \a length voxels. */
bool
IsInsideVoxels(double position, SizeValueType length)
{
  constexpr double tolerance = 1e-6; // against rounding
  return position >= -0.5 - tolerance && position <= static_cast<double>(length) - 0.5 + tolerance;
}

/** Sets index and size of an axis to the samples that taps need. */
void
SetRange(const SeparableTaps & taps, SizeValueType numberOfPositions, unsigned int axis, ImageRegion<3> & range)
{
  SizeValueType first = taps.GetFirst(0);
  SizeValueType last = first;
  for (SizeValueType n = 1; n < numberOfPositions; ++n)
  {
    first = std::min(first, taps.GetFirst(n));
    last = std::max(last, taps.GetFirst(n));
  }
  range.SetIndex(axis, static_cast<IndexValueType>(first));
  range.SetSize(axis, last - first + taps.GetNumberOfTaps());
}

} // namespace

SliceStackPlanes::SliceStackPlanes(const SliceStack & stack,
                                   SeparableKernel kernel,
                                   const Size<3> & size,
                                   const VectorType & origin,
                                   const VectorType & spacing,
                                   const RegionType & region)
  : m_Stack(stack)
  , m_Kernel(kernel)
  , m_Size(size)
  , m_Origin(origin)
  , m_Spacing(spacing)
  , m_Region(region)
  , m_Heights(HeightsOf(region, origin[2], spacing[2]))
  , m_SliceTaps(stack.MakeSliceTaps(kernel, m_Heights))
{
  for (SizeValueType k = 0; k < m_Heights.size(); ++k)
  {
    m_PlaneOrigins.push_back(stack.GetOriginAt(m_Heights[k], m_SliceTaps, k));
  }
}

std::vector<double>
SliceStackPlanes::GetRows(SizeValueType k) const
{
  std::vector<double> rows(m_Region.GetSize(1));
  for (std::size_t j = 0; j < rows.size(); ++j)
  {
    const auto y = static_cast<double>(m_Region.GetIndex(1) + static_cast<IndexValueType>(j));
    rows[j] = m_Stack.GetRow(m_Origin[1] + m_Spacing[1] * y, m_PlaneOrigins[k]);
  }
  return rows;
}

std::vector<double>
SliceStackPlanes::GetColumns(SizeValueType k, double row, IndexValueType parity) const
{
  std::vector<double> columns(m_Region.GetSize(0));
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const auto x = static_cast<double>(2 * (m_Region.GetIndex(0) + static_cast<IndexValueType>(i)) + parity);
    columns[i] = m_Stack.GetColumn(m_Origin[0] + m_Spacing[0] * x, row, m_PlaneOrigins[k]);
  }
  return columns;
}

bool
SliceStackPlanes::HasRow(double row) const
{
  return IsInsideVoxels(row, m_Size[1]);
}

SliceStackPlanes::SiteRow
SliceStackPlanes::MakeSiteRow(SizeValueType k, double row, IndexValueType parity, SizeValueType xFirst) const
{
  const std::vector<double> columns = this->GetColumns(k, row, parity);
  const auto isInside = [this](double column) { return IsInsideVoxels(column, m_Size[0]); };
  const auto begin = std::find_if(columns.begin(), columns.end(), isInside);
  const auto end = std::find_if_not(begin, columns.end(), isInside);
  return { static_cast<SizeValueType>(begin - columns.begin()),
           static_cast<SizeValueType>(end - columns.begin()),
           { this->MakeColumnTaps(columns), columns.size(), xFirst } };
}

SliceStackPlanes::RegionType
SliceStackPlanes::FindNeededSamples() const
{
  // Positions are linear in a plane's x and y, so its corners are the farthest.
  std::vector<double> rows;
  std::vector<double> columns;
  for (SizeValueType k = 0; k < m_Heights.size(); ++k)
  {
    const std::vector<double> planeRows = this->GetRows(k);
    for (const double row : { planeRows.front(), planeRows.back() })
    {
      rows.push_back(row);
      columns.push_back(this->GetColumns(k, row, 0).front());
      columns.push_back(this->GetColumns(k, row, 1).back());
    }
  }
  RegionType needed;
  SetRange(this->MakeColumnTaps(columns), columns.size(), 0, needed);
  SetRange(this->MakeRowTaps(rows), rows.size(), 1, needed);
  SetRange(m_SliceTaps, m_Heights.size(), 2, needed);
  return needed;
}

} // namespace itk
