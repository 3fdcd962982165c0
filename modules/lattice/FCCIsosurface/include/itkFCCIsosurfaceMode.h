#ifndef itkFCCIsosurfaceMode_h
#define itkFCCIsosurfaceMode_h

#include <ostream>

namespace itk
{

/** \brief How FCCIsosurfaceFilter puts triangles through the lattice's cells.
 *
 * All modes give a closed (with Closed on), oriented manifold for any input. Triangles per unit of area at one sample
 * per unit of volume are means over directions; marching cubes on a Cartesian grid makes 3, and the lattice needs 0.77
 * samples for one of the grid.
 *
 * \ingroup FCCIsosurface
 */
enum class FCCIsosurfaceMode : unsigned char
{
  Tetrahedra,      ///< six tetrahedra in each parallelepiped, linear points: the paper's text. 8.32 triangles
  Octahedra,       ///< regular tetrahedra and whole octahedra, linear points. 6.74 triangles
  Parallelepipeds, ///< whole parallelepipeds as marching cubes has cubes, linear points: the paper's counts. 3.37
  Fine,            ///< as Tetrahedra, with points on the reconstructed field: the most accurate. 8.32 triangles
  Lean             ///< as Fine, with points gathered at sites: the fewest and best-shaped triangles. About 2.3
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
