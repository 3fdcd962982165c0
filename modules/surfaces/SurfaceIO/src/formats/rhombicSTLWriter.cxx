#include "rhombicFileSpace.h"
#include "rhombicSurfaceFormats.h"

#include "detail/itkPositionArithmetic.h"

#include <cmath>

namespace rhombic
{
namespace
{

using PointType = itk::TriangleSurface::PointType;

/** The unit normal, or 0 for a triangle without area. */
PointType
FacetNormal(const PointType & a, const PointType & b, const PointType & c)
{
  const itk::PositionType normal = itk::AreaVector({ itk::ToPosition(a), itk::ToPosition(b), itk::ToPosition(c) });
  const double length = itk::Length(normal);
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
