#include "rhombicFileSpace.h"
#include "rhombicSurfaceFormats.h"

#include <cmath>

namespace rhombic
{
namespace
{

using PointType = itk::TriangleSurface::PointType;

/** Of length 1, or 0 for a triangle without area. */
PointType
FacetNormal(const PointType & a, const PointType & b, const PointType & c)
{
  double u[3], v[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = static_cast<double>(b[axis]) - a[axis];
    v[axis] = static_cast<double>(c[axis]) - a[axis];
  }
  const double normal[]{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  const double scale = length > 0 && std::isfinite(length) ? 1 / length : 0;
  return { static_cast<float>(scale * normal[0]),
           static_cast<float>(scale * normal[1]),
           static_cast<float>(scale * normal[2]) };
}

} // namespace

void
WriteSTL(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  const itk::TriangleSurface & surface = *surfaces.front().surface;
  // Must not begin with "solid", which announces a text file.
  std::string header = std::string("Rhombic SPACE=") + NameOf(space) + " UNIT=mm";
  header.resize(80, ' ');
  file.Append(header);
  file.AppendBinary(static_cast<std::uint32_t>(surface.GetNumberOfTriangles()));
  for (const auto & triangle : surface.GetTriangles())
  {
    const PointType a = Turned(surface.GetPoints()[triangle[0]], space);
    const PointType b = Turned(surface.GetPoints()[triangle[1]], space);
    const PointType c = Turned(surface.GetPoints()[triangle[2]], space);
    file.AppendBinary(FacetNormal(a, b, c));
    file.AppendBinary(a);
    file.AppendBinary(b);
    file.AppendBinary(c);
    file.AppendBinary(std::uint16_t{ 0 });
  }
}

} // namespace rhombic
