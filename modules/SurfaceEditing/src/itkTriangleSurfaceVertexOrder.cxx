#include "itkTriangleSurfaceVertexOrder.h"

#include <meshoptimizer.h>

namespace itk
{
namespace
{

constexpr unsigned int CacheSize = 16;

const unsigned int *
Indices(const TriangleSurface & surface)
{
  return surface.GetTriangles().front().data();
}

std::size_t
NumberOfIndices(const TriangleSurface & surface)
{
  return 3 * surface.GetNumberOfTriangles();
}

template <typename TContainer>
void
Reorder(TContainer & container, const std::vector<unsigned int> & newId, std::size_t newSize)
{
  TContainer ordered(newSize);
  meshopt_remapVertexBuffer(
    ordered.data(), container.data(), container.size(), sizeof(typename TContainer::value_type), newId.data());
  container.swap(ordered);
}

} // namespace

TriangleSurfaceVertexOrder
AnalyzeVertexOrder(const TriangleSurface & surface)
{
  if (surface.GetTriangles().empty())
  {
    return {};
  }
  const std::size_t bytesPerPoint =
    sizeof(TriangleSurface::PointType) + (surface.HasNormals() ? sizeof(TriangleSurface::NormalType) : 0);
  const auto cache = meshopt_analyzeVertexCache(
    Indices(surface), NumberOfIndices(surface), surface.GetNumberOfPoints(), CacheSize, 0, 0);
  const auto fetch =
    meshopt_analyzeVertexFetch(Indices(surface), NumberOfIndices(surface), surface.GetNumberOfPoints(), bytesPerPoint);
  return { cache.acmr, fetch.overfetch };
}

void
OptimizeForRendering(TriangleSurface & surface)
{
  if (surface.GetTriangles().empty())
  {
    surface.RemoveUnusedPoints();
    return;
  }
  const std::size_t numberOfIndices = NumberOfIndices(surface);
  const std::size_t numberOfPoints = surface.GetNumberOfPoints();
  TriangleSurface::TrianglesContainer triangles(surface.GetNumberOfTriangles());
  meshopt_optimizeVertexCache(triangles.front().data(), Indices(surface), numberOfIndices, numberOfPoints);

  std::vector<unsigned int> newId(numberOfPoints);
  const std::size_t used =
    meshopt_optimizeVertexFetchRemap(newId.data(), triangles.front().data(), numberOfIndices, numberOfPoints);
  meshopt_remapIndexBuffer(triangles.front().data(), triangles.front().data(), numberOfIndices, newId.data());
  if (surface.HasNormals())
  {
    Reorder(surface.GetNormals(), newId, used);
  }
  Reorder(surface.GetPoints(), newId, used);
  surface.GetTriangles().swap(triangles);
  surface.Modified();
}

} // namespace itk
