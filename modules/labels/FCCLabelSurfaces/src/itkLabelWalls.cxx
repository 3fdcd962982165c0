#include "itkLabelWalls.h"

#include "itkSumInOrder.h"

#include <algorithm>
#include <limits>

namespace itk
{

namespace
{

/** The points that triangles use, in their order; numbers these in the triangles. */
TriangleSurface::PointsContainer
TakeUsedPoints(const TriangleSurface::PointsContainer & points, TriangleSurface::TrianglesContainer & triangles)
{
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t first = unused;
  std::uint32_t last = 0;
  for (const auto & [a, b, c] : triangles)
  {
    first = std::min({ first, a, b, c });
    last = std::max({ last, a, b, c });
  }
  BulkVector<std::uint32_t> numbers(triangles.empty() ? 0 : last - first + std::size_t{ 1 }, unused);
  for (auto & triangle : triangles)
  {
    for (std::uint32_t & point : triangle)
    {
      point -= first;
      numbers[point] = 0;
    }
  }
  TriangleSurface::PointsContainer used;
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    if (numbers[n] != unused)
    {
      numbers[n] = static_cast<std::uint32_t>(used.size());
      used.push_back(points[first + n]);
    }
  }
  for (auto & triangle : triangles)
  {
    for (std::uint32_t & point : triangle)
    {
      point = numbers[point];
    }
  }
  return used;
}

} // namespace

std::vector<double>
LabelWalls::ComputeVolumes() const
{
  std::vector<double> volumes(1);
  SumInOrder(
    this->GetTriangleLabels().size(),
    [this, origin = FindOrigin(*this)](std::size_t n) { return FindVolumeOfTriangle(*this, n, origin); },
    [&](std::size_t n, double volume) {
      const auto & [front, back] = this->GetTriangleLabels()[n];
      volumes.resize(std::max(volumes.size(), std::size_t{ back } + 1));
      volumes[front] -= volume;
      volumes[back] += volume;
    });
  return volumes;
}

std::vector<LabelWalls::LabelType>
LabelWalls::FindLabels() const
{
  std::vector<bool> isFound(std::size_t{ 1 } + std::numeric_limits<LabelType>::max());
  for (const LabelPairType & pair : this->GetTriangleLabels())
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
  for (std::size_t n = 0; n < this->GetTriangleLabels().size(); ++n)
  {
    const LabelPairType & pair = this->GetTriangleLabels()[n];
    if (pair[0] == label || pair[1] == label)
    {
      const TriangleType & triangle = this->GetTriangles()[n];
      triangles.push_back(pair[1] == label ? triangle : TriangleType{ triangle[0], triangle[2], triangle[1] });
    }
  }
  surface->GetPoints() = TakeUsedPoints(this->GetPoints(), triangles);
  return surface;
}

void
LabelWalls::MergeLabels(const std::vector<LabelType> & labels)
{
  TrianglesContainer & triangles = this->GetTriangles();
  LabelPairsContainer & pairs = this->GetTriangleLabels();
  std::size_t kept = 0;
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    const LabelType front = labels[pairs[n][0]];
    const LabelType back = labels[pairs[n][1]];
    if (front != back)
    {
      const TriangleType triangle = triangles[n];
      triangles[kept] = front < back ? triangle : TriangleType{ triangle[0], triangle[2], triangle[1] };
      pairs[kept] = { std::min(front, back), std::max(front, back) };
      ++kept;
    }
  }
  triangles.resize(kept);
  pairs.resize(kept);
  this->GetPoints() = TakeUsedPoints(this->GetPoints(), triangles);
  this->Modified();
}

void
LabelWalls::Initialize()
{
  Superclass::Initialize();
  m_TriangleLabels = {};
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
  os << indent << "Triangles with labels: " << this->GetTriangleLabels().size() << std::endl;
}

} // namespace itk
