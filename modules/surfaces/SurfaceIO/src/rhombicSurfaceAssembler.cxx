#include "rhombicSurfaceAssembler.h"

#include "rhombicSurfaceFormats.h"

#include <limits>

namespace rhombic
{
namespace
{

/** Whether the parts add up to all points and faces; written so that nothing overflows. */
bool
AddUp(const std::vector<SurfacePart> & parts, std::uintmax_t points, std::uintmax_t faces)
{
  for (const SurfacePart & part : parts)
  {
    if (part.points > points || part.faces > faces)
    {
      return false;
    }
    points -= part.points;
    faces -= part.faces;
  }
  return points == 0 && faces == 0;
}

} // namespace

SurfaceAssembler::SurfaceAssembler(const InputFile & file,
                                   std::vector<SurfacePart> parts,
                                   std::uintmax_t points,
                                   std::uintmax_t faces,
                                   bool haveNormals)
  : m_File(file)
  , m_IsDivided(!parts.empty() && AddUp(parts, points, faces))
{
  if (points >= std::numeric_limits<std::uint32_t>::max())
  {
    file.Refuse("it has more points than 32-bit indices reach; divide it");
  }
  file.RequireMemoryToRead(24 * points + 12 * faces);
  if (!m_IsDivided)
  {
    parts.assign(1, SurfacePart{});
    parts[0].look.name = NameFromFile(file);
    parts[0].points = points;
    parts[0].faces = faces;
  }
  std::uintmax_t firstPoint = 0;
  for (SurfacePart & part : parts)
  {
    auto surface = itk::TriangleSurface::New();
    surface->GetPoints().reserve(part.points);
    surface->GetNormals().reserve(haveNormals ? part.points : 0);
    surface->GetTriangles().reserve(part.faces);
    firstPoint += part.points;
    m_Surfaces.push_back({ std::move(part), surface, firstPoint - part.points });
  }
}

void
SurfaceAssembler::AddPoint(const itk::TriangleSurface::PointType & point)
{
  while (m_Surfaces[m_PointSurface].surface->GetPoints().size() == m_Surfaces[m_PointSurface].part.points)
  {
    ++m_PointSurface;
  }
  m_Surfaces[m_PointSurface].surface->GetPoints().push_back(point);
}

void
SurfaceAssembler::AddNormal(const itk::TriangleSurface::NormalType & normal)
{
  while (m_Surfaces[m_NormalSurface].surface->GetNormals().size() == m_Surfaces[m_NormalSurface].part.points)
  {
    ++m_NormalSurface;
  }
  m_Surfaces[m_NormalSurface].surface->GetNormals().push_back(normal);
}

void
SurfaceAssembler::AddFace(const std::vector<std::uint64_t> & corners)
{
  while (m_Faces == m_Surfaces[m_FaceSurface].part.faces)
  {
    ++m_FaceSurface;
    m_Faces = 0;
  }
  ++m_Faces;
  const Assembled & assembled = m_Surfaces[m_FaceSurface];
  if (corners.size() < 3)
  {
    m_File.Refuse("a face has fewer than three corners; export triangles");
  }
  for (const std::uint64_t corner : corners)
  {
    if (corner < assembled.firstPoint || corner - assembled.firstPoint >= assembled.part.points)
    {
      m_File.RefuseDamaged("a face has a corner at point " + std::to_string(corner) +
                           ", which its surface does not have");
    }
  }
  const auto local = [&](std::size_t n) { return static_cast<std::uint32_t>(corners[n] - assembled.firstPoint); };
  for (std::size_t n = 2; n < corners.size(); ++n)
  {
    assembled.surface->GetTriangles().push_back({ local(0), local(n - 1), local(n) });
  }
}

void
SurfaceAssembler::SetLook(const Colour & colour, double opacity)
{
  if (!m_IsDivided)
  {
    m_Surfaces[0].part.look.colour = colour;
    m_Surfaces[0].part.look.opacity = opacity;
  }
}

std::vector<SceneSurface>
SurfaceAssembler::Take(SurfaceFileSpace space)
{
  std::vector<SceneSurface> surfaces;
  for (Assembled & assembled : m_Surfaces)
  {
    TurnFrom(space, *assembled.surface);
    surfaces.push_back(std::move(assembled.part.look));
    surfaces.back().surface = assembled.surface;
  }
  return surfaces;
}

std::string
NameFromFile(const InputFile & file)
{
  return file.GetPath().stem().string();
}

} // namespace rhombic
