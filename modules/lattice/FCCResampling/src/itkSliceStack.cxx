#include "itkSliceStack.h"

#include "itkFCCResamplingChecks.h"
#include "itkMacro.h"
#include "rhombicVoxelGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

using VectorType = SliceStack::VectorType;

/** Whether the slices may be interpolated as samples at equal steps are, which is faster. Of slices that are even only
 * within EvenSliceTolerance(), all places are kept, so only rounding is tolerated here. */
bool
AreExactlyEven(const std::vector<SliceStack::PointType> & origins)
{
  constexpr double tolerance = 1e-6; // relative to a step
  const double meanStep = (origins.back() - origins.front()).GetNorm() / static_cast<double>(origins.size() - 1);
  return rhombic::DistanceFromEvenSlices(origins) <= tolerance * meanStep;
}

} // namespace

SliceStack::SliceStack(const ImageBase<3> & image, const std::vector<PointType> & sliceOrigins)
{
  const auto & region = image.GetLargestPossibleRegion();
  const SizeValueType count = region.GetSize(2);
  if (!sliceOrigins.empty() && sliceOrigins.size() != count)
  {
    itkGenericExceptionMacro("There are " << sliceOrigins.size() << " slice origins for " << count
                                          << " slices; give one for each slice, or none when they are evenly placed.");
  }
  image.TransformIndexToPhysicalPoint(region.GetIndex(), m_Origin);
  std::vector<PointType> origins = sliceOrigins;
  const VectorType imageStep = rhombic::StepAlong(image, 2);
  for (SizeValueType k = 0; origins.size() < count; ++k)
  {
    origins.push_back(m_Origin + imageStep * static_cast<double>(k));
  }
  m_Origin = origins.front();

  const VectorType columnStep = rhombic::StepAlong(image, 0);
  const VectorType rowStep = rhombic::StepAlong(image, 1);
  VectorType x = columnStep;
  m_Pitch[0] = x.Normalize();
  m_RowShift = rowStep * x;
  if (std::abs(m_RowShift) <= AxesTolerance * rowStep.GetNorm())
  {
    m_RowShift = 0.0;
  }
  VectorType y = rowStep - x * (rowStep * x);
  m_Pitch[1] = y.Normalize();
  VectorType z = CrossProduct(x, y);
  const VectorType towardsLast = count > 1 ? origins.back() - origins.front() : imageStep;
  z *= towardsLast * z < 0.0 ? -1.0 : 1.0;
  for (unsigned int row = 0; row < 3; ++row)
  {
    m_Direction[row][0] = x[row];
    m_Direction[row][1] = y[row];
    m_Direction[row][2] = z[row];
  }

  std::vector<double> steps;
  for (const PointType & origin : origins)
  {
    m_SliceOrigins.push_back(this->TransformPointToFrame(origin));
    m_Heights.push_back(m_SliceOrigins.back()[2]);
    if (m_Heights.size() > 1)
    {
      steps.push_back(m_Heights.back() - m_Heights[m_Heights.size() - 2]);
      if (!(steps.back() > 0.0) || !std::isfinite(steps.back()))
      {
        itkGenericExceptionMacro("Slice " << m_Heights.size() - 1 << " is " << steps.back()
                                          << " mm behind the one before it along the slices' normal; sort the slices "
                                             "and leave out those at the place of another.");
      }
    }
  }
  if (count > 1)
  {
    const VectorType meanStep = m_SliceOrigins.back() / static_cast<double>(count - 1);
    m_IsEven = AreExactlyEven(origins);
    m_FirstStep = m_IsEven ? meanStep : m_SliceOrigins[1];
    m_LastStep = m_IsEven ? meanStep : m_SliceOrigins[count - 1] - m_SliceOrigins[count - 2];
    const auto median = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), median, steps.end());
    m_Pitch[2] = m_IsEven ? meanStep[2] : *median;
  }
  else
  {
    m_FirstStep = this->TransformPointToFrame(m_Origin + imageStep);
    m_LastStep = m_FirstStep;
    m_Pitch[2] = m_FirstStep[2];
  }
  this->FindBounds(region.GetSize());
}

void
SliceStack::FindBounds(const Size<3> & size)
{
  std::vector<VectorType> planes = m_SliceOrigins; // the outer faces are added
  planes.push_back(m_SliceOrigins.front() - m_FirstStep * 0.5);
  planes.push_back(m_SliceOrigins.back() + m_LastStep * 0.5);
  m_Lowest.Fill(std::numeric_limits<double>::infinity());
  m_Highest.Fill(-std::numeric_limits<double>::infinity());
  for (const VectorType & plane : planes)
  {
    for (const double row : { -0.5, static_cast<double>(size[1]) - 0.5 })
    {
      for (const double column : { -0.5, static_cast<double>(size[0]) - 0.5 })
      {
        const double corner[3] = { plane[0] + m_Pitch[0] * column + m_RowShift * row,
                                   plane[1] + m_Pitch[1] * row,
                                   plane[2] };
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          m_Lowest[axis] = std::min(m_Lowest[axis], corner[axis]);
          m_Highest[axis] = std::max(m_Highest[axis], corner[axis]);
        }
      }
    }
  }
}

VectorType
SliceStack::TransformPointToFrame(const PointType & point) const
{
  const VectorType offset = point - m_Origin;
  VectorType frame(0.0);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (unsigned int row = 0; row < 3; ++row)
    {
      frame[axis] += m_Direction[row][axis] * offset[row];
    }
  }
  return frame;
}

SeparableTaps
SliceStack::MakeSliceTaps(SeparableKernel kernel, const std::vector<double> & heights) const
{
  if (!m_IsEven)
  {
    return SeparableTaps(kernel, m_Heights, heights);
  }
  std::vector<double> positions(heights.size());
  std::transform(heights.begin(), heights.end(), positions.begin(), [this](double z) { return z / m_Pitch[2]; });
  return SeparableTaps(kernel, m_Heights.size(), positions);
}

std::array<double, 2>
SliceStack::GetOriginAt(double z, const SeparableTaps & taps, SizeValueType n) const
{
  const VectorType & last = m_SliceOrigins.back();
  VectorType origin;
  if (m_IsEven || z <= 0.0)
  {
    origin = m_FirstStep * (z / m_FirstStep[2]);
  }
  else if (z >= last[2])
  {
    origin = last + m_LastStep * ((z - last[2]) / m_LastStep[2]);
  }
  else
  {
    origin.Fill(0.0);
    for (SizeValueType tap = 0; tap < taps.GetNumberOfTaps(); ++tap)
    {
      origin += m_SliceOrigins[taps.GetFirst(n) + tap] * static_cast<double>(taps.GetWeights(n)[tap]);
    }
  }
  return { origin[0], origin[1] };
}

} // namespace itk
