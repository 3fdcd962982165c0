#ifndef rhombicSurfaceAssembler_h
#define rhombicSurfaceAssembler_h

#include "rhombicInputFile.h"
#include "rhombicSurfaceIO.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** How a surface looks, and how many of a file's points and faces are its own. */
struct SurfacePart
{
  SceneSurface look; ///< without surface
  std::uintmax_t points = 0;
  std::uintmax_t faces = 0;
};

/** \class SurfaceAssembler
 * \brief Deals the points and faces of a file out to the surfaces that follow each other in it. */
class SurfaceAssembler
{
public:
  /** \a points, 24 bytes each, and \a faces, 12 bytes each, are what the file holds altogether; the caller has compared
   * them with the file's size. When \a parts do not add up to that, the file has changed since it was divided, and its
   * surface is one, named after it. Throws Failure(Memory), Failure(Unreadable). */
  SurfaceAssembler(const InputFile & file,
                   std::vector<SurfacePart> parts,
                   std::uintmax_t points,
                   std::uintmax_t faces,
                   bool haveNormals);

  void
  AddPoint(const itk::TriangleSurface::PointType & point);

  void
  AddNormal(const itk::TriangleSurface::NormalType & normal);

  /** A face with corners numbered from 0 in the whole file; more than three make a fan. Throws Failure(Unreadable) for
   * fewer, and for points that the file or the face's surface does not have. */
  void
  AddFace(const std::vector<std::uint64_t> & corners);

  /** Sets the look of the one surface of a file that has no parts of its own. */
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
  std::size_t m_PointSurface = 0;  ///< that the next point goes to
  std::size_t m_NormalSurface = 0; ///< that the next normal goes to
  std::size_t m_FaceSurface = 0;   ///< that the next face goes to
  std::uintmax_t m_Faces = 0;      ///< that it has
};

/** What a surface without a name is called: the file's name without extension. */
std::string
NameFromFile(const InputFile & file);

} // namespace rhombic

#endif
