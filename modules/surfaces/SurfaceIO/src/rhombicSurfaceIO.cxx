#include "rhombicSurfaceIO.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicInProcessDecoder.h"
#include "rhombicInputFile.h"
#include "rhombicOutputFile.h"
#include "rhombicSurfaceFormats.h"
#include "rhombicWords.h"

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

struct SurfaceFormat
{
  const char * extension;
  bool holdsScenes;  ///< can hold several surfaces
  bool hasMaterials; ///< has materials in a second file
  void (*write)(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file);
  std::vector<SceneSurface> (*read)(const InputFile & file); ///< null: VTK reads it
};

constexpr std::array<SurfaceFormat, 5> SurfaceFormats{ { { ".stl", false, false, WriteSTL, ReadSTL },
                                                         { ".ply", true, false, WritePLY, ReadPLY },
                                                         { ".obj", true, true, WriteOBJ, ReadOBJ },
                                                         { ".vtp", true, false, WriteVTP, nullptr },
                                                         { ".glb", true, false, WriteGLB, ReadGLB } } };

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
  for (const SceneSurface & scene : surfaces)
  {
    if (scene.surface->GetNumberOfTriangles() == 0)
    {
      throw Failure(FailureKind::Empty,
                    "Nothing to write to " + path.string() + ": the surface " + scene.name +
                      " has no triangles; try another isovalue.");
    }
    if (!IsFinite(*scene.surface))
    {
      FailToWrite(path, "the surface " + scene.name + " has positions that are no numbers; check where it comes from");
    }
    points += scene.surface->GetNumberOfPoints();
    triangles += scene.surface->GetNumberOfTriangles();
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
  for (SceneSurface & scene : surfaces)
  {
    scene.name = FileName(scene.name);
  }
  return surfaces;
}

/** Closes a written file, and throws Failure(Output) if it does not hold what was appended. */
void
CloseAndProve(OutputFile & file)
{
  file.Close();
  if (!file.HoldsWhatWasAppended())
  {
    FailToWrite(file.GetTarget(), "it is not the same when it is read back; check the disk");
  }
}

fs::path
MaterialsOf(const fs::path & path)
{
  return fs::path(path).replace_extension(".mtl");
}

void
StageMaterials(const std::vector<SceneSurface> & surfaces, const fs::path & path, StagedFiles & staged)
{
  AtomicFile & file = staged.Begin(path);
  OutputFile output(file.GetTemporaryPath(), path);
  WriteMTL(surfaces, output);
  CloseAndProve(output);
  file.Flush(1);
}

void
Stage(const std::vector<SceneSurface> & surfaces,
      const SurfaceFormat & format,
      const fs::path & path,
      const SurfaceFileSettings & settings,
      StagedFiles & staged)
{
  if (format.hasMaterials)
  {
    StageMaterials(surfaces, MaterialsOf(path), staged); // before the OBJ file that names them
  }
  AtomicFile & file = staged.Begin(path);
  OutputFile output(file.GetTemporaryPath(), path);
  format.write(surfaces, settings.space, output);
  CloseAndProve(output);
  file.Flush(1);
}

/** VTK makes a PLY file of it in memory, which is checked as any PLY file. */
std::vector<SceneSurface>
ReadVTP(const InputFile & file, const VTPReading & vtp)
{
  if (vtp.convert == nullptr)
  {
    file.Refuse("this program has no reader of VTP files; export it as PLY");
  }
  file.RequireMemoryToRead(4 * file.GetSize()); // for VTK, whose indices have 64 bits
  constexpr std::size_t smallest = 64 << 20;
  constexpr std::size_t ratio = 16; // larger than that of a polygon's corners stored as bytes
  InProcessDecoder inProcess;
  VoxelDecoder & decoder = vtp.decoder == nullptr ? inProcess : *vtp.decoder;
  const auto ply = decoder.Decode({ vtp.convert, file.GetPath(), smallest + ratio * file.GetSize() });
  return ReadPLY(InputFile(file.GetPath(), ply->GetData(), ply->GetSize()));
}

} // namespace

std::string
GetSurfaceFileExtensions()
{
  return ListExtensions([](const SurfaceFormat &) { return true; });
}

void
CheckSurfacePath(const fs::path & path, std::size_t numberOfSurfaces)
{
  const SurfaceFormat & format = FormatOf(path, "write");
  if (numberOfSurfaces > 1 && !format.holdsScenes)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write " + path.string() + ": an STL file holds one surface, and there are " +
                    std::to_string(numberOfSurfaces) + "; use one of " +
                    ListExtensions([](const SurfaceFormat & other) { return other.holdsScenes; }) +
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
  return FormatOf(path, "write").holdsScenes;
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
  return FormatOf(path, "write").holdsScenes ? itk::TriangleSurface::ConstPointer(&surface) : JoinEqualPoints(surface);
}

void
StageSurfaces(const std::vector<SceneSurface> & surfaces,
              const fs::path & path,
              StagedFiles & staged,
              const SurfaceFileSettings & settings)
{
  CheckSurfacePath(path, surfaces.size());
  CheckSurfaces(surfaces, path);
  Stage(WithFileNames(surfaces), FormatOf(path, "write"), path, settings, staged);
}

void
WriteSurfaces(const std::vector<SceneSurface> & surfaces, const fs::path & path, const SurfaceFileSettings & settings)
{
  StagedFiles staged;
  StageSurfaces(surfaces, path, staged, settings);
  staged.Commit();
}

std::vector<SceneSurface>
ReadSurfaces(const fs::path & path, const VTPReading & vtp)
{
  const SurfaceFormat & format = FormatOf(path, "read");
  const InputFile file(path);
  std::vector<SceneSurface> surfaces = format.read == nullptr ? ReadVTP(file, vtp) : format.read(file);
  const auto isEmpty = [](const SceneSurface & scene) { return scene.surface->GetNumberOfTriangles() == 0; };
  surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isEmpty), surfaces.end());
  if (surfaces.empty())
  {
    file.Refuse("it holds no triangles; export it as a surface");
  }
  return surfaces;
}

} // namespace rhombic
