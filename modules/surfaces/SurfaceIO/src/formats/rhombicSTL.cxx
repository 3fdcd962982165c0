#include "detail/rhombicPointWelder.h"
#include "rhombicSurfaceFormats.h"
#include "detail/itkPositionArithmetic.h"

#include <algorithm>
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
  return itk::ToPoint(itk::Scaled(normal, scale));
}

constexpr std::uintmax_t HeaderSize = 84;
constexpr std::uintmax_t TriangleSize = 50;

/** The size that a binary file has by its number of triangles. */
std::uintmax_t
BinarySize(const InputFile & file)
{
  std::uint32_t triangles = 0;
  file.Read(HeaderSize - sizeof(triangles), &triangles, sizeof(triangles));
  return HeaderSize + TriangleSize * triangles;
}

std::vector<SceneSurface>
ReadBinary(const InputFile & file)
{
  const std::uintmax_t triangles = (file.GetSize() - HeaderSize) / TriangleSize;
  // A closed surface has half as many points as triangles; the welder's table has up to four slots for each point.
  file.RequireMemoryToRead(12 * triangles + (12 + 16) * triangles / 2);
  InputStream stream(file);
  std::string header(HeaderSize - sizeof(std::uint32_t), '\0');
  stream.Take(header.data(), header.size());
  stream.Take<std::uint32_t>();

  const auto surface = itk::TriangleSurface::New();
  surface->GetTriangles().reserve(triangles);
  surface->GetPoints().reserve(triangles / 2 + 2);
  PointWelder welder(surface->GetPoints());
  struct
  {
    PointType normal, corners[3];
  } facet;
  for (std::uintmax_t n = 0; n < triangles; ++n)
  {
    stream.Take(&facet, sizeof(facet));
    stream.Take<std::uint16_t>();
    const std::uint32_t a = welder.Add(facet.corners[0]), b = welder.Add(facet.corners[1]);
    surface->GetTriangles().push_back({ a, b, welder.Add(facet.corners[2]) });
  }
  TurnFrom(SaysRAS(header) ? SurfaceFileSpace::RAS : SurfaceFileSpace::LPS, *surface);
  SceneSurface read;
  read.name = file.GetStem();
  read.surface = surface;
  return { read };
}

/** A solid of a text file that is being read. */
struct Solid
{
  explicit Solid(const std::string & solidName)
    : name(solidName)
  {}

  const std::string name;
  const itk::TriangleSurface::Pointer surface = itk::TriangleSurface::New();
  PointWelder welder{ surface->GetPoints() };
};

/** Whether a line that begins with these words tells nothing that is read: normals follow from the corners. */
bool
IsSkipped(const std::string & keyword, const std::string & next)
{
  return keyword == "endfacet" || (keyword == "facet" && (next.empty() || next == "normal")) ||
         (keyword == "outer" && next == "loop");
}

std::vector<SceneSurface>
ReadText(const InputFile & file)
{
  file.RequireMemoryToRead(file.GetSize());
  InputStream stream(file);
  std::vector<SceneSurface> surfaces;
  std::unique_ptr<Solid> solid;
  std::vector<std::uint32_t> corners;
  SurfaceFileSpace space = SurfaceFileSpace::LPS;
  std::string_view line;
  while (stream.TakeLine(line))
  {
    const std::string keyword = LowerCase(TakeWord(line));
    if (keyword == "solid" && solid == nullptr)
    {
      space = SaysRAS(line) ? SurfaceFileSpace::RAS : SurfaceFileSpace::LPS;
      solid = std::make_unique<Solid>(std::string(Trim(line)));
    }
    else if (keyword == "vertex" && solid != nullptr)
    {
      corners.push_back(solid->welder.Add(ParseTriple(line, stream, "a vertex needs three numbers")));
    }
    else if (keyword == "endloop" && solid != nullptr && corners.size() == 3)
    {
      solid->surface->GetTriangles().push_back({ corners[0], corners[1], corners[2] });
      corners.clear();
    }
    else if (keyword == "endsolid" && solid != nullptr && corners.empty())
    {
      TurnFrom(space, *solid->surface);
      SceneSurface & read = surfaces.emplace_back();
      read.name = solid->name.empty() ? file.GetStem() : solid->name;
      read.surface = solid->surface;
      solid.reset();
    }
    else if (!keyword.empty() && (solid == nullptr || !IsSkipped(keyword, LowerCase(TakeWord(line)))))
    {
      stream.RefuseLine("this is not how a text STL goes on; the file is damaged, so export it again");
    }
  }
  if (solid != nullptr)
  {
    file.Refuse("it ends early, without \"endsolid\"; copy or export it again");
  }
  return surfaces;
}

bool
BeginsLikeText(const InputFile & file)
{
  std::string begin(std::min<std::uintmax_t>(file.GetSize(), 512), '\0');
  file.Read(0, begin.data(), begin.size());
  return LowerCase(Trim(WithoutMark(begin)).substr(0, 5)) == "solid";
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

itk::TriangleSurface::ConstPointer
JoinEqualPoints(const itk::TriangleSurface & surface)
{
  const auto joined = itk::TriangleSurface::New();
  joined->GetTriangles().reserve(surface.GetNumberOfTriangles());
  joined->GetPoints().reserve(surface.GetNumberOfPoints());
  PointWelder welder(joined->GetPoints());
  for (const auto & [a, b, c] : surface.GetTriangles())
  {
    const auto & points = surface.GetPoints();
    const std::uint32_t first = welder.Add(points[a]), second = welder.Add(points[b]);
    joined->GetTriangles().push_back({ first, second, welder.Add(points[c]) });
  }
  return joined.GetPointer();
}

std::vector<SceneSurface>
ReadSTL(const InputFile & file)
{
  // Some binary files begin with "solid", too, so the size is checked first.
  if (file.GetSize() >= HeaderSize && file.GetSize() == BinarySize(file))
  {
    return ReadBinary(file);
  }
  if (BeginsLikeText(file))
  {
    return ReadText(file);
  }
  file.Refuse(file.GetSize() < HeaderSize
                ? "it is too short for an STL file"
                : "its " + std::to_string(file.GetSize()) + " bytes are not the " + std::to_string(BinarySize(file)) +
                    " that its number of triangles needs; it is a part of a file, or no STL");
}

} // namespace rhombic
