#include "rhombicFileColours.h"
#include "rhombicFileSpace.h"
#include "rhombicSurfaceFormats.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rhombic
{
namespace
{

/** The comment by which ReadPLY() divides the file into surfaces: name, colour, opacity and numbers of points and
 * triangles, as one line of JSON in ASCII. */
std::string
DescribeSurface(const SceneSurface & scene)
{
  const nlohmann::json description{ { "name", scene.name },
                                    { "colour", ToBytes(scene.colour) },
                                    { "opacity", scene.opacity },
                                    { "points", scene.surface->GetNumberOfPoints() },
                                    { "triangles", scene.surface->GetNumberOfTriangles() } };
  return "comment SURFACE " + description.dump(-1, ' ', true) + "\n";
}

std::string
MakeHeader(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, bool haveNormals)
{
  std::string header = std::string("ply\nformat binary_little_endian 1.0\ncomment Rhombic\ncomment SPACE=") +
                       NameOf(space) + "\ncomment UNIT=mm\n";
  itk::SizeValueType points = 0, triangles = 0;
  for (const SceneSurface & scene : surfaces)
  {
    header += DescribeSurface(scene);
    points += scene.surface->GetNumberOfPoints();
    triangles += scene.surface->GetNumberOfTriangles();
  }
  header += "element vertex " + std::to_string(points) + "\nproperty float x\nproperty float y\nproperty float z\n";
  header += haveNormals ? "property float nx\nproperty float ny\nproperty float nz\n" : "";
  header += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  return header + "element face " + std::to_string(triangles) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
}

} // namespace

void
WritePLY(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  const bool haveNormals = std::all_of(
    surfaces.begin(), surfaces.end(), [](const SceneSurface & scene) { return scene.surface->HasNormals(); });
  file.Append(MakeHeader(surfaces, space, haveNormals));
  for (const SceneSurface & scene : surfaces)
  {
    const auto & points = scene.surface->GetPoints();
    const auto colour = ToBytes(scene.colour);
    const std::array<std::uint8_t, 4> look{ colour[0], colour[1], colour[2], ToByte(scene.opacity) };
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      file.AppendBinary(Turned(points[n], space));
      if (haveNormals)
      {
        file.AppendBinary(Turned(scene.surface->GetNormals()[n], space));
      }
      file.AppendBinary(look);
    }
  }
  std::uint32_t firstPoint = 0;
  for (const SceneSurface & scene : surfaces)
  {
    for (const auto & [a, b, c] : scene.surface->GetTriangles())
    {
      file.AppendBinary(std::uint8_t{ 3 });
      file.AppendBinary(itk::TriangleSurface::TriangleType{ firstPoint + a, firstPoint + b, firstPoint + c });
    }
    firstPoint += static_cast<std::uint32_t>(scene.surface->GetNumberOfPoints());
  }
}

} // namespace rhombic
