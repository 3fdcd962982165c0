#include "rhombicSurfaceIO.h"

#include "rhombicFailure.h"
#include "rhombicInputFile.h"
#include "rhombicOutputFile.h"
#include "rhombicSandbox.h"
#include "rhombicSurfaceFormats.h"

#include "detail/itkPositionArithmetic.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** VTK makes a PLY file of it in a child process, which is checked as any PLY file. */
std::vector<SceneSurface>
ReadVTP(const InputFile & file)
{
  file.RequireMemoryToRead(6 * file.GetSize()); // for VTK, which copies the file twice, and whose indices have 64 bits
  constexpr std::size_t smallest = 64 << 20;
  constexpr std::size_t ratio = 16; // larger than that of a polygon's corners stored as bytes
  SandboxRun run({ "rhombic-unpack-vtp", file.GetPath(), {}, smallest + ratio * file.GetSize() });
  const auto ply = run.Next();
  return ReadPLY(InputFile(file.GetPath(), ply.value().data, ply.value().size));
}

struct SurfaceFormat
{
  const char * extension;
  bool holdsSeveral; ///< can hold several surfaces
  bool hasMaterials; ///< has materials in a second file
  bool hasNormals;
  bool hasPointColours;
  void (*write)(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
  std::vector<SceneSurface> (*read)(const InputFile & file);
};

constexpr std::array<SurfaceFormat, 6> SurfaceFormats{ { { ".stl", false, false, false, false, WriteSTL, ReadSTL },
                                                         { ".ply", true, false, true, true, WritePLY, ReadPLY },
                                                         { ".obj", true, true, true, false, WriteOBJ, ReadOBJ },
                                                         { ".vtp", true, false, true, true, WriteVTP, ReadVTP },
                                                         { ".glb", true, false, true, true, WriteGLB, ReadGLB },
                                                         { ".3mf", true, false, false, false, Write3MF, Read3MF } } };

template <typename TPredicate>
std::string
ListExtensions(const TPredicate & isListed)
{
  std::string list;
  for (const SurfaceFormat & format : SurfaceFormats)
  {
    if (isListed(format))
    {
      list += (list.empty() ? "" : ", ") + std::string(format.extension);
    }
  }
  return list;
}

const SurfaceFormat &
FormatOf(const fs::path & path, const char * verb)
{
  const std::string extension = LowerCase(path.extension().string());
  for (const SurfaceFormat & format : SurfaceFormats)
  {
    if (extension == format.extension)
    {
      return format;
    }
  }
  throw Failure(FailureKind::Usage,
                std::string("Cannot ") + verb + " " + path.string() +
                  ": its extension names no surface format; use one of " + GetSurfaceFileExtensions() + ".");
}

[[noreturn]] void
FailToWrite(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Output, "Cannot write " + path.string() + ": " + why + ".");
}

bool
IsFinite(const itk::TriangleSurface & surface)
{
  return std::all_of(
    surface.GetPoints().begin(), surface.GetPoints().end(), [](const auto & point) { return itk::IsFinite(point); });
}

void
CheckSurfaces(const std::vector<SceneSurface> & surfaces, const fs::path & path)
{
  std::uint64_t points = 0, triangles = 0;
  for (const SceneSurface & item : surfaces)
  {
    if (item.surface->GetNumberOfTriangles() == 0)
    {
      throw Failure(FailureKind::Empty,
                    "Nothing to write to " + path.string() + ": the surface " + item.name +
                      " has no triangles; try another isovalue.");
    }
    if (!IsFinite(*item.surface))
    {
      FailToWrite(path, "the surface " + item.name + " has positions that are no numbers; check where it comes from");
    }
    points += item.surface->GetNumberOfPoints();
    triangles += item.surface->GetNumberOfTriangles();
  }
  if (triangles == 0)
  {
    throw Failure(FailureKind::Empty, "Nothing to write to " + path.string() + ": there is no surface.");
  }
  if (std::max(points, triangles) >= std::numeric_limits<std::uint32_t>::max())
  {
    FailToWrite(path,
                std::to_string(triangles) + " triangles are more than 32-bit numbers reach; choose a lower density");
  }
}

bool
IsControl(unsigned char letter)
{
  return letter < ' ' || letter == 0x7f;
}

/** The name in a form that every format can hold: UTF-8 on one line. */
std::string
FileName(std::string name)
{
  std::replace_if(name.begin(), name.end(), IsControl, ' ');
  const nlohmann::json json(name);
  return nlohmann::json::parse(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)).get<std::string>();
}

std::vector<SceneSurface>
WithFileNames(std::vector<SceneSurface> surfaces)
{
  for (SceneSurface & item : surfaces)
  {
    item.name = FileName(item.name);
  }
  return surfaces;
}

/** Stages a file that \a write fills. Throws Failure(Output) if the file does not hold the appended bytes. */
template <typename TWrite>
void
StageFile(const fs::path & path, StagedFiles & staged, const TWrite & write)
{
  AtomicFile & file = staged.Begin(path);
  OutputFile output(file.GetTemporaryPath(), path);
  write(output);
  output.Close();
  if (!output.HoldsAppendedBytes())
  {
    FailToWrite(path, "it is not the same when it is read back; check the disk");
  }
  file.Flush(1);
}

fs::path
MaterialsOf(const fs::path & path)
{
  return fs::path(path).replace_extension(".mtl");
}

} // namespace

std::string
GetSurfaceFileExtensions()
{
  return ListExtensions([](const SurfaceFormat &) { return true; });
}

bool
IsSurfacePath(const fs::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  const std::vector<std::string> known = Split(GetSurfaceFileExtensions(), ", ");
  return !extension.empty() && std::find(known.begin(), known.end(), extension) != known.end();
}

void
CheckSurfacePath(const fs::path & path, std::size_t numberOfSurfaces)
{
  const SurfaceFormat & format = FormatOf(path, "write");
  if (numberOfSurfaces > 1 && !format.holdsSeveral)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write " + path.string() + ": an STL file holds one surface, and there are " +
                    std::to_string(numberOfSurfaces) + "; use one of " +
                    ListExtensions([](const SurfaceFormat & other) { return other.holdsSeveral; }) +
                    ", or a file for each.");
  }
  const std::string name = path.filename().string();
  if (format.hasMaterials && std::any_of(name.begin(), name.end(), IsControl))
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write an OBJ file whose name holds line breaks or other control characters, as it must name "
                  "its materials on one line; give it another name.");
  }
}

bool
StoresNormals(const fs::path & path)
{
  return FormatOf(path, "write").hasNormals;
}

void
CheckPointColours(const fs::path & path)
{
  if (!FormatOf(path, "write").hasPointColours)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write " + path.string() + ": a file of this format holds no colours of points; use one of " +
                    ListExtensions([](const SurfaceFormat & other) { return other.hasPointColours; }) + ".");
  }
}

std::vector<fs::path>
SurfaceFilesOf(const fs::path & path)
{
  std::vector<fs::path> files{ path };
  if (FormatOf(path, "write").hasMaterials)
  {
    files.push_back(MaterialsOf(path));
  }
  return files;
}

itk::TriangleSurface::ConstPointer
SurfaceAsStored(const itk::TriangleSurface & surface, const fs::path & path)
{
  return FormatOf(path, "write").holdsSeveral ? itk::TriangleSurface::ConstPointer(&surface) : JoinEqualPoints(surface);
}

void
StageSurfaces(const std::vector<SceneSurface> & surfaces,
              const fs::path & path,
              StagedFiles & staged,
              const SurfaceFileSettings & settings)
{
  CheckSurfacePath(path, surfaces.size());
  CheckSurfaces(surfaces, path);
  const std::vector<SceneSurface> named = WithFileNames(surfaces);
  const SurfaceFormat & format = FormatOf(path, "write");
  if (format.hasMaterials) // before the OBJ file that names them
  {
    StageFile(MaterialsOf(path), staged, [&named](OutputFile & file) { WriteMTL(named, file); });
  }
  StageFile(path, staged, [&](OutputFile & file) { format.write(named, settings.space, file); });
}

void
WriteSurfaces(const std::vector<SceneSurface> & surfaces, const fs::path & path, const SurfaceFileSettings & settings)
{
  StagedFiles staged;
  StageSurfaces(surfaces, path, staged, settings);
  staged.Commit();
}

std::vector<SceneSurface>
ReadSurfaces(const fs::path & path)
{
  const SurfaceFormat & format = FormatOf(path, "read");
  const InputFile file(path);
  std::vector<SceneSurface> surfaces = format.read(file);
  const auto isEmpty = [](const SceneSurface & item) { return item.surface->GetNumberOfTriangles() == 0; };
  surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isEmpty), surfaces.end());
  if (surfaces.empty())
  {
    file.Refuse("it holds no triangles; export it as a surface");
  }
  return surfaces;
}

} // namespace rhombic
