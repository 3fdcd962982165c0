#include "itkLabelWalls.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <limits>

namespace itk
{

std::vector<LabelWalls::Measures>
LabelWalls::ComputeMeasures() const
{
  std::vector<Measures> measures(1);
  for (std::size_t n = 0; n < m_TriangleLabels.size(); ++n)
  {
    const auto & [front, back] = m_TriangleLabels[n];
    measures.resize(std::max(measures.size(), std::size_t{ back } + 1));
    CornersType corners = CornersOf(*this, this->GetTriangles()[n]);
    for (PositionType & corner : corners)
    {
      corner = Subtract(corner, ToPosition(this->GetPoints().front())); // which keeps digits
    }
    const PositionType normal = AreaVector(corners);
    const double volume = Dot(corners[0], normal) / 6.0;
    measures[front].volume -= volume;
    measures[back].volume += volume;
    measures[front].area += 0.5 * Length(normal);
    measures[back].area += 0.5 * Length(normal);
  }
  return measures;
}

std::vector<LabelWalls::LabelType>
LabelWalls::FindLabels() const
{
  std::vector<bool> isFound(std::size_t{ 1 } + std::numeric_limits<LabelType>::max());
  for (const LabelPairType & pair : m_TriangleLabels)
  {
    isFound[pair[0]] = true;
    isFound[pair[1]] = true;
  }
  std::vector<LabelType> labels;
  for (std::size_t label = 1; label < isFound.size(); ++label)
  {
    if (isFound[label])
    {
      labels.push_back(static_cast<LabelType>(label));
    }
  }
  return labels;
}

TriangleSurface::Pointer
LabelWalls::ExtractLabel(LabelType label) const
{
  const auto surface = TriangleSurface::New();
  TrianglesContainer & triangles = surface->GetTriangles();
  for (std::size_t n = 0; n < m_TriangleLabels.size(); ++n)
  {
    const LabelPairType & pair = m_TriangleLabels[n];
    if (pair[0] == label || pair[1] == label)
    {
      const TriangleType & triangle = this->GetTriangles()[n];
      triangles.push_back(pair[1] == label ? triangle : TriangleType{ triangle[0], triangle[2], triangle[1] });
    }
  }
  // The points in use, in their order.
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> numbers(this->GetNumberOfPoints(), unused);
  for (const TriangleType & triangle : triangles)
  {
    for (const std::uint32_t point : triangle)
    {
      numbers[point] = 0;
    }
  }
  PointsContainer & points = surface->GetPoints();
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    if (numbers[n] != unused)
    {
      numbers[n] = static_cast<std::uint32_t>(points.size());
      points.push_back(this->GetPoints()[n]);
    }
  }
  for (TriangleType & triangle : triangles)
  {
    for (std::uint32_t & point : triangle)
    {
      point = numbers[point];
    }
  }
  return surface;
}

void
LabelWalls::Initialize()
{
  Superclass::Initialize();
  LabelPairsContainer().swap(m_TriangleLabels);
}

void
LabelWalls::Graft(const DataObject * data)
{
  const auto * const walls = dynamic_cast<const Self *>(data);
  if (data != nullptr && walls == nullptr)
  {
    itkExceptionMacro("Graft: the data are no LabelWalls.");
  }
  Superclass::Graft(data);
  if (walls != nullptr)
  {
    m_TriangleLabels = walls->m_TriangleLabels;
  }
}

void
LabelWalls::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Triangles with labels: " << m_TriangleLabels.size() << std::endl;
}

} // namespace itk
