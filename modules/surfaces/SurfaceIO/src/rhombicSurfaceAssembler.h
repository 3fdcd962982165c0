#ifndef rhombicSurfaceAssembler_h
#define rhombicSurfaceAssembler_h

#include "rhombicInputFile.h"
#include "rhombicSurfaceIO.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** A surface's name, colour and opacity, and the number of its points and faces in a file. */
struct SurfacePart
{
  SceneSurface look; ///< name, colour and opacity; its surface is null
  std::uintmax_t points = 0;
  std::uintmax_t faces = 0;
};

/** \class SurfaceAssembler
 * \brief Distributes the points and faces of a file to its surfaces, which follow each other in the file. */
class SurfaceAssembler
{
public:
  /** \a points and \a faces are the totals of the file, which the caller has compared with the file's size; a point
   * takes 24 bytes, a face 12. If \a parts do not add up to these totals, another program has changed the file, and
   * everything becomes one surface named after the file. Throws Failure(Memory), Failure(Unreadable). */
  SurfaceAssembler(const InputFile & file,
                   std::vector<SurfacePart> parts,
                   std::uintmax_t points,
                   std::uintmax_t faces,
                   bool haveNormals);

  void
  AddPoint(const itk::TriangleSurface::PointType & point);

  void
  AddNormal(const itk::TriangleSurface::NormalType & normal);

  /** Adds a face by its points' indices in the file; more than three corners make a fan. Throws Failure(Unreadable) for
   * fewer, and for a point that does not belong to the face's surface. */
  void
  AddFace(const std::vector<std::uint64_t> & corners);

  /** Sets colour and opacity, if the file has a single surface without a description. */
  void
  SetLook(const Colour & colour, double opacity);

  std::vector<SceneSurface>
  Take(SurfaceFileSpace space);

private:
  struct Assembled
  {
    SurfacePart part;
    itk::TriangleSurface::Pointer surface;
    std::uintmax_t firstPoint = 0;
  };

  const InputFile & m_File;
  std::vector<Assembled> m_Surfaces;
  bool m_IsDivided;
  std::size_t m_PointSurface = 0;  ///< index of the surface that gets the next point
  std::size_t m_NormalSurface = 0; ///< index of the surface that gets the next normal
  std::size_t m_FaceSurface = 0;   ///< index of the surface that gets the next face
  std::uintmax_t m_Faces = 0;      ///< number of faces this surface has
};

/** The name of a surface that has none in the file: the file's name without extension. */
std::string
NameFromFile(const InputFile & file);

} // namespace rhombic

#endif
