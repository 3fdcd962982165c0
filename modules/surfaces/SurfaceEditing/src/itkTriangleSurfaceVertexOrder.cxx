#include "itkTriangleSurfaceVertexOrder.h"

#include <meshoptimizer.h>

namespace itk
{
namespace
{

template <typename TContainer>
void
Reorder(TContainer & container, const std::vector<unsigned int> & newIds, std::size_t newSize)
{
  TContainer ordered(newSize);
  meshopt_remapVertexBuffer(
    ordered.data(), container.data(), container.size(), sizeof(typename TContainer::value_type), newIds.data());
  container.swap(ordered);
}

} // namespace

void
OptimizeTriangleSurfaceForRendering(TriangleSurface & surface)
{
  if (surface.GetTriangles().empty())
  {
    surface.RemoveUnusedPoints();
    return;
  }
  const std::size_t numberOfPoints = surface.GetNumberOfPoints();
  const std::size_t numberOfIndices = 3 * surface.GetNumberOfTriangles();
  TriangleSurface::TrianglesContainer triangles(surface.GetNumberOfTriangles());
  unsigned int * const indices = triangles.front().data();
  meshopt_optimizeVertexCache(indices, surface.GetTriangles().front().data(), numberOfIndices, numberOfPoints);

  std::vector<unsigned int> newIds(numberOfPoints);
  const std::size_t used = meshopt_optimizeVertexFetchRemap(newIds.data(), indices, numberOfIndices, numberOfPoints);
  meshopt_remapIndexBuffer(indices, indices, numberOfIndices, newIds.data());
  if (surface.HasNormals())
  {
    Reorder(surface.GetNormals(), newIds, used);
  }
  Reorder(surface.GetPoints(), newIds, used);
  surface.GetTriangles().swap(triangles);
  surface.Modified();
}

} // namespace itk
