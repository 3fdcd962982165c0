#include "rhombicFileSpace.h"
#include "rhombicSurfaceFormats.h"
#include "rhombicWords.h"

#include <algorithm>
#include <set>

namespace rhombic
{
namespace
{

/** The names of groups and materials: one word each, all different. */
std::vector<std::string>
MakeIdentifiers(const std::vector<SceneSurface> & surfaces)
{
  std::vector<std::string> identifiers;
  std::set<std::string> used;
  for (const SceneSurface & scene : surfaces)
  {
    std::string base = scene.name.empty() ? "surface" : scene.name;
    std::replace_if(
      base.begin(), base.end(), [](char letter) { return letter == ' ' || letter == '#' || letter == '\\'; }, '_');
    std::string identifier = base;
    for (int number = 2; !used.insert(identifier).second; ++number)
    {
      identifier = base + "_" + std::to_string(number);
    }
    identifiers.push_back(identifier);
  }
  return identifiers;
}

/** The name of an object, without a backslash at the end, which would join the next line. */
std::string
ObjectName(const SceneSurface & scene)
{
  std::string name(Trimmed(scene.name));
  if (!name.empty() && name.back() == '\\')
  {
    name.back() = '_';
  }
  return name.empty() ? "surface" : name;
}

template <typename TNumbers>
void
AppendLine(const char * keyword, const TNumbers & numbers, OutputFile & file)
{
  std::string line(keyword);
  for (const auto number : numbers)
  {
    AppendNumber(number, line += ' ');
  }
  file.Append(line += '\n');
}

/** "f 1 2 3", or "f 1//1 2//2 3//3" with normals, which have indices of their own. */
void
AppendFace(const itk::TriangleSurface::TriangleType & triangle,
           std::uint64_t firstPoint,
           std::optional<std::uint64_t> firstNormal,
           OutputFile & file)
{
  std::string line("f");
  for (const std::uint32_t corner : triangle)
  {
    AppendNumber(firstPoint + corner, line += ' ');
    if (firstNormal)
    {
      AppendNumber(*firstNormal + corner, line += "//");
    }
  }
  file.Append(line += '\n');
}

} // namespace

void
WriteOBJ(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  const std::vector<std::string> identifiers = MakeIdentifiers(surfaces);
  const std::string materials = file.GetTarget().filename().replace_extension(".mtl").string();
  file.Append(std::string("# Rhombic\n# SPACE=") + NameOf(space) + "\n# UNIT=mm\nmtllib " + materials + "\n");
  std::uint64_t firstPoint = 1;
  std::uint64_t firstNormal = 1;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const itk::TriangleSurface & surface = *surfaces[n].surface;
    file.Append("o " + ObjectName(surfaces[n]) + "\ng " + identifiers[n] + "\nusemtl " + identifiers[n] + "\n");
    for (const auto & point : surface.GetPoints())
    {
      AppendLine("v", Turned(point, space), file);
    }
    const bool hasNormals = surface.HasNormals();
    if (hasNormals)
    {
      for (const auto & normal : surface.GetNormals())
      {
        AppendLine("vn", Turned(normal, space), file);
      }
    }
    for (const auto & triangle : surface.GetTriangles())
    {
      AppendFace(triangle, firstPoint, hasNormals ? std::optional<std::uint64_t>(firstNormal) : std::nullopt, file);
    }
    firstPoint += surface.GetNumberOfPoints();
    firstNormal += hasNormals ? surface.GetNumberOfPoints() : 0;
  }
}

void
WriteMTL(const std::vector<SceneSurface> & surfaces, OutputFile & file)
{
  const std::vector<std::string> identifiers = MakeIdentifiers(surfaces);
  file.Append("# Rhombic: colours as sRGB encodes them\n");
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const std::array<double, 1> opacity{ surfaces[n].opacity };
    file.Append("newmtl " + identifiers[n] + "\n");
    AppendLine("Kd", surfaces[n].colour, file);
    AppendLine("d", opacity, file);
    file.Append("illum 1\n");
  }
}

} // namespace rhombic
