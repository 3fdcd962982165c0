#ifndef rhombicCartesianSurfaces_h
#define rhombicCartesianSurfaces_h

#include "rhombicReferenceField.h"

#include "itkImage.h"
#include "itkTriangleSurface.h"

#include <array>
#include <limits>
#include <vector>

namespace rhombic
{

/** \file
 * Surfaces at 0 by methods that VTK lacks. Samples that are not below 0 are inside; surfaces end at the border. */

/** The faces between voxels inside and outside, two triangles each: G. Herman, H. Liu, "Three-dimensional display of
 * human organs from computed tomograms" (1979). Voxels that touch in an edge or a corner share its points. */
itk::TriangleSurface::Pointer
ExtractCuberille(const itk::Image<float, 3> * volume);

/** Moves each point of marching cubes or marching tetrahedra to where the cubic through four samples on its edge's line
 * is 0, as mode Fine does on the lattice; where the line has fewer samples, points stay. Normals are those of the cubic
 * B-spline through the samples. */
void
MovePointsToCubics(const itk::Image<float, 3> * volume, itk::TriangleSurface & surface);

/** \class TetrahedraGrid
 * \brief Sites of a lattice in a box of integer points, whose cells are sheared cubes of six tetrahedra about a common
 * diagonal. */
struct TetrahedraGrid
{
  static constexpr float NoSite = std::numeric_limits<float>::quiet_NaN();

  std::array<std::array<int, 3>, 3> steps; ///< edges of a cell
  std::array<int, 3> size;                 ///< of the box
  Vector3 origin;
  Vector3 spacing;
  std::vector<float> values; ///< of the integer points, x fastest

  std::size_t
  GetOffset(const std::array<int, 3> & p) const
  {
    return static_cast<std::size_t>(p[0] + size[0] * (p[1] + size[1] * p[2]));
  }
  Vector3
  GetPosition(const std::array<int, 3> & p) const
  {
    return { origin[0] + p[0] * spacing[0], origin[1] + p[1] * spacing[1], origin[2] + p[2] * spacing[2] };
  }
};

/** The grid of a Cartesian volume. */
TetrahedraGrid
CartesianTetrahedra(const itk::Image<float, 3> * volume);

/** A field on the body-centered cubic lattice, the integer points whose coordinates are all even or all odd, \a spacing
 * apart. The tetrahedra are those of the lattice's Delaunay tessellation. */
TetrahedraGrid
SampleOnBCC(const ReferenceField & field, const Vector3 & origin, const std::array<int, 3> & size, double spacing);

/** Marching tetrahedra: A. Doi, A. Koide, "An efficient method of triangulating equi-valued surfaces by using
 * tetrahedral cells" (1991). Points are at least 1e-4 of an edge away from its ends. */
itk::TriangleSurface::Pointer
MarchTetrahedra(const TetrahedraGrid & grid);

/** The octahedra of four tetrahedra of a grid of SampleOnBCC() about each long edge of its even sites, marched as
 * wholes; cells that stick out of the box are left out. Points are those that MarchTetrahedra() has on the cells'
 * edges. The clusters of H. Carr, T. Theussl, T. Moeller, "Isosurfaces on optimal regular samples" (2003), as we read
 * them. */
itk::TriangleSurface::Pointer
MarchBCCOctahedra(const TetrahedraGrid & grid);

/** As MarchBCCOctahedra(), with the hexahedra of six tetrahedra about each short edge along (1, 1, 1). */
itk::TriangleSurface::Pointer
MarchBCCHexahedra(const TetrahedraGrid & grid);

} // namespace rhombic

#endif
