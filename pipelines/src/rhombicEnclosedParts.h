#ifndef rhombicEnclosedParts_h
#define rhombicEnclosedParts_h

#include "rhombicImageAxes.h"

#include "itkFCCImage.h"
#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceComponents.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

/** Keeps the components that don't reach the sides of the scan and have at least a fiftieth of the volume of the
 * largest one of them, which leaves out specks and keeps two lungs and an airway that are not connected. The sides are
 * the extent's faces left, right, in front and at the back of the patient; at the top and the bottom organs are cut. */
template <typename TPixel>
void
KeepEnclosedParts(itk::TriangleSurface & surface, const itk::FCCImage<TPixel> & image)
{
  const auto components = itk::FindComponents(surface);
  const auto volumes = itk::ComputeComponentVolumes(surface, components);
  const unsigned int longAxis = NearestAxis(image.GetDirection(), 2);
  const auto & region = image.GetLargestPossibleRegion();
  constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };
  constexpr double near = 0.25; // of a lattice unit: closed surfaces end on the extent's faces exactly

  std::vector<bool> isEnclosed(components.count, true);
  for (std::size_t n = 0; n < components.ofPoint.size(); ++n)
  {
    const auto & p = surface.GetPoints()[n];
    itk::Point<double, 3> point;
    std::copy(p.begin(), p.end(), point.Begin());
    const auto coordinates = image.TransformPhysicalPointToLattice(point);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double begin = unitsPerIndex[axis] * static_cast<double>(region.GetIndex(axis)) - 0.5;
      const double end = begin + unitsPerIndex[axis] * static_cast<double>(region.GetSize(axis));
      if (axis != longAxis && (coordinates[axis] < begin + near || coordinates[axis] > end - near))
      {
        isEnclosed[components.ofPoint[n]] = false;
      }
    }
  }
  double largest = 0.0;
  for (std::size_t component = 0; component < components.count; ++component)
  {
    largest = isEnclosed[component] ? std::max(largest, volumes[component]) : largest;
  }
  constexpr double smallestShare = 1.0 / 50.0;
  std::vector<bool> keep(components.count);
  for (std::size_t component = 0; component < components.count; ++component)
  {
    keep[component] =
      isEnclosed[component] && volumes[component] > 0.0 && volumes[component] >= smallestShare * largest;
  }
  itk::KeepComponents(surface, components, keep);
}

} // namespace rhombic

#endif
