#ifndef itkFCCIsosurfaceMode_h
#define itkFCCIsosurfaceMode_h

#include <ostream>

namespace itk
{

/** \class FCCIsosurfaceMode
 * \brief The cells that FCCIsosurfaceFilter marches, and what it makes of their triangles.
 *
 * Triangles per unit of area at one sample per unit of volume are means over directions; marching cubes on a Cartesian
 * grid makes 3.
 *
 * \ingroup FCCIsosurface
 */
enum class FCCIsosurfaceMode : unsigned char
{
  Tetrahedra,      ///< six tetrahedra a parallelepiped: 8.32 triangles
  Octahedra,       ///< regular tetrahedra and whole octahedra: 6.74 triangles
  Parallelepipeds, ///< whole parallelepipeds: 3.37 triangles
  Fine,
  Lean
};

inline std::ostream &
operator<<(std::ostream & os, FCCIsosurfaceMode mode)
{
  switch (mode)
  {
    case FCCIsosurfaceMode::Tetrahedra:
      return os << "Tetrahedra";
    case FCCIsosurfaceMode::Octahedra:
      return os << "Octahedra";
    case FCCIsosurfaceMode::Parallelepipeds:
      return os << "Parallelepipeds";
    case FCCIsosurfaceMode::Fine:
      return os << "Fine";
    case FCCIsosurfaceMode::Lean:
      return os << "Lean";
  }
  return os << "unknown";
}

} // namespace itk

#endif
