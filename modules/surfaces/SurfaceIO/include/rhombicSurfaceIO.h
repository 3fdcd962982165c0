#ifndef rhombicSurfaceIO_h
#define rhombicSurfaceIO_h

#include "rhombicAtomicFile.h"
#include "rhombicSceneSurface.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** The axes of a file's coordinates: to the patient's left, back and head (LPS, as in ITK and DICOM), or to the right,
 * front and head (RAS). */
enum class SurfaceFileSpace
{
  LPS,
  RAS
};

/** How surfaces are written. */
struct SurfaceFileSettings
{
  SurfaceFileSpace space = SurfaceFileSpace::LPS;
};

/** The extensions of all formats, for help texts: ".stl, .ply, .obj, .vtp, .glb, .3mf". */
std::string
GetSurfaceFileExtensions();

/** Whether a path has one of these extensions, in upper or lower case. */
bool
IsSurfacePath(const std::filesystem::path & path);

/** Throws Failure(Usage) for a path to which WriteSurfaces() can't write this number of surfaces. Call it before long
 * work. */
void
CheckSurfacePath(const std::filesystem::path & path, std::size_t numberOfSurfaces = 1);

/** Whether files of this format hold the normals of points: all but STL and 3MF. Throws Failure(Usage) for another
 * extension.
 */
bool
StoresNormals(const std::filesystem::path & path);

/** Throws Failure(Usage) for a path whose format holds no colours or values of points: other than PLY, VTP and GLB. */
void
CheckPointColours(const std::filesystem::path & path);

/** The files that WriteSurfaces() makes: the path, and for OBJ the file of materials. */
std::vector<std::filesystem::path>
SurfaceFilesOf(const std::filesystem::path & path);

/** The surface that ReadSurfaces() gets from the file: equal points of an STL file are one point; other formats keep
 * the surface as it is. */
itk::TriangleSurface::ConstPointer
SurfaceAsStored(const itk::TriangleSurface & surface, const std::filesystem::path & path);

/** Writes surfaces in LPS millimetres to one file. The extension, in upper or lower case, decides the format:
 *
 * - `.stl`: binary STL; one surface without normals, three points per triangle
 * - `.ply`: binary PLY; shared points, normals, a colour per point, which is that of SceneSurface::pointColours if
 * there are any; comments describe the surfaces
 * - `.obj`: Wavefront OBJ; an object, group and material per surface; colours and opacities in a second file, `.mtl`
 * - `.vtp`: VTK's XML; a colour and the surface's number per triangle; names, colours and opacities as field data. If
 *   all surfaces are of labels, their walls, each once and without normals, with two labels per triangle in the cell
 *   array BoundaryLabels as vtkSurfaceNets3D orders them: the smaller first, 0 for outside last. Triangles are
 *   counter-clockwise seen from outside of the first. Where all surfaces have SceneSurface::pointValues, the values are
 *   an array of the points, NaN where unknown, and walls are written for each surface
 * - `.glb`: binary glTF 2.0; a node, mesh and material per surface; the matrix of a root node converts millimetres and
 *   the patient's axes to glTF's metres with y up. SceneSurface::pointColours are COLOR_0, linear in 16 bits, on a
 * white material that is seen without lights (KHR_materials_unlit)
 * - `.3mf`: 3D Manufacturing Format, for printers; an object and material per surface, in millimetres, without normals.
 *   Opacities have 8 bits
 *
 * Coordinates are stored in millimetres along the axes of the settings' space, which the file names: `SPACE=LPS`, as
 * 3D Slicer expects it. Normals are written if a surface has them (PLY and VTP: if all have). Control characters and
 * invalid UTF-8 in names are replaced. All formats keep positions exactly, and colours with 8 bits; STL, OBJ and 3MF
 * files hold no colours of points. The same surfaces give the same bytes, in every locale.
 *
 * The bytes of the file are read back and compared, by their CRC-32, before it appears, complete or not at all; an
 * existing file is replaced. The materials of an OBJ file appear just before it. Throws
 * Failure(Usage) for another extension or several surfaces in an STL file, Failure(Empty) for a surface without
 * triangles or no surface, and Failure(Output) if the file can't be written, the surfaces are too large for the format,
 * a position is not finite, or a triangle has one point at two corners in a 3MF file. */
void
WriteSurfaces(const std::vector<SceneSurface> & surfaces,
              const std::filesystem::path & path,
              const SurfaceFileSettings & settings = {});

/** As WriteSurfaces(), but the files appear together with the other files of \a staged. */
void
StageSurfaces(const std::vector<SceneSurface> & surfaces,
              const std::filesystem::path & path,
              StagedFiles & staged,
              const SurfaceFileSettings & settings = {});

/** Reads surfaces in LPS millimetres from a file of one of these formats, written by this or other programs, binary or
 * text. Coordinates of files that declare RAS are converted. The transforms of a GLB's nodes are applied, and its
 * metres and y-up undone; of a 3MF, what is to be built is read where it is to be built, in its unit. Numbers in other
 * formats are taken for millimetres.
 *
 * VTP files with the cell array BoundaryLabels give the closed surface of each label. Equal points of an STL file
 * become one point; polygons become fans of triangles; points of no triangle are kept, except in OBJ. A surface without
 * a name gets the file's stem, a surface without colour or opacity the defaults. A surface has no normals if one of its
 * points has several. Textures, lines, animations and the like are ignored.
 *
 * Throws Failure(NotFound), Failure(Usage) for another extension, Failure(Unreadable) for damaged files, files without
 * triangles and unsupported parts of the formats, Failure(Memory) before it needs more than half of the free memory,
 * and Failure(Internal) when the program is not installed that reads VTP files (SandboxRun). */
std::vector<SceneSurface>
ReadSurfaces(const std::filesystem::path & path);

} // namespace rhombic

#endif
