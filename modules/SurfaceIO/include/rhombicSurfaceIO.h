#ifndef rhombicSurfaceIO_h
#define rhombicSurfaceIO_h

#include "rhombicAtomicFile.h"
#include "rhombicSceneSurface.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** The axes of a file's coordinates: to the patient's left, back and head (ITK, DICOM), or right, front and head. */
enum class SurfaceFileSpace
{
  LPS,
  RAS
};

/** How surfaces are written. Thread safety: a value, but for what the function in it shares. */
struct SurfaceFileSettings
{
  SurfaceFileSpace space = SurfaceFileSpace::LPS;

  /** Gets the surfaces as they were read back, before the file appears; what it throws leaves the target as it was. */
  std::function<void(const std::vector<SceneSurface> & read)> inspect{};
};

/** The extensions of the formats below, for help texts: ".stl, .ply, .obj, .vtp, .glb". */
std::string
GetSurfaceFileExtensions();

/** Throws Failure(Usage) when WriteSurfaces() would because of the extension: for asking before long work. */
void
CheckSurfacePath(const std::filesystem::path & path, std::size_t numberOfSurfaces = 1);

/** The files that WriteSurfaces() makes: the path, and for OBJ the materials beside it. */
std::vector<std::filesystem::path>
SurfaceFilesOf(const std::filesystem::path & path);

/** Writes surfaces in LPS millimetres to one file whose extension, in any case, says the format:
 *
 * - `.stl`: binary STL; one surface only, its positions only, three of its own for each triangle
 * - `.ply`: binary PLY; shared points, normals, a colour a point; comments keep the surfaces apart
 * - `.obj`: Wavefront OBJ; an object, group and material a surface; colours and opacities in a second file, `.mtl`
 * - `.vtp`: VTK's XML; a colour and the surface's number a triangle; names, colours and opacities as field data
 * - `.glb`: binary glTF 2.0; a node, mesh and material a surface; a root node turns millimetres into the metres, and
 *   the patient's axes into the y-up, of glTF
 *
 * Each but GLB is in millimetres along the axes of the settings' space, and says so: `SPACE=LPS`, as 3D Slicer expects
 * it. GLB stores them likewise, below its root node. Normals are written if a surface has them (PLY and VTP: if all
 * have), names with control characters and what is not UTF-8 replaced. Positions come back exactly as they were from
 * all formats; colours with 8 bits. The same surfaces give the same bytes, in every locale.
 *
 * The file is read back and compared before it appears, complete or not at all; one that existed is replaced. An OBJ's
 * materials appear just before it. Memory: a copy of the surfaces, two for STL, three for OBJ. Throws Failure(Usage)
 * for another extension or several surfaces in an STL, Failure(Empty) for a surface without triangles or no surface,
 * Failure(Output) when the file can't be written, the surfaces are too large for the format or a position is not
 * finite. Thread safe for different files. */
void
WriteSurfaces(const std::vector<SceneSurface> & surfaces,
              const std::filesystem::path & path,
              const SurfaceFileSettings & settings = {});

/** As WriteSurfaces(), but the files appear with all others of \a staged. */
void
StageSurfaces(const std::vector<SceneSurface> & surfaces,
              const std::filesystem::path & path,
              StagedFiles & staged,
              const SurfaceFileSettings & settings = {});

/** Reads surfaces in LPS millimetres from a file of the formats above, by this or other programs, binary or text. What
 * says SPACE=RAS is turned to LPS; GLB's nodes are applied, its metres and y-up undone. Other formats' numbers are
 * taken for millimetres.
 *
 * An STL's points are welded where they are the same; polygons become fans of triangles; points of no triangle stay,
 * except in OBJ. Names are the file's own, else its stem; colour and opacity the defaults if there are none. Normals
 * are left out where a point has several. Textures, lines, animations and the like are ignored.
 *
 * Throws Failure(NotFound), Failure(Usage) for another extension, Failure(Unreadable) for damaged files, those without
 * triangles and parts of the formats that are not supported, Failure(Memory) before they need more than half of what is
 * free. Thread safe. */
std::vector<SceneSurface>
ReadSurfaces(const std::filesystem::path & path);

} // namespace rhombic

#endif
