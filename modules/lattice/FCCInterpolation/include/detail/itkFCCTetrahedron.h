#ifndef itkFCCTetrahedron_h
#define itkFCCTetrahedron_h

#include "itkFCCLattice.h"

namespace itk
{

/** \class FCCUnitCube
 * \brief The unit cube around a point, with a site as its first corner: the lowest, or the next along x.
 *
 * \ingroup FCCInterpolation
 */
struct FCCUnitCube
{
  FCCLattice::SiteType corner;
  IndexValueType xStep;        ///< from the corner into the cube: 1 or -1
  std::array<double, 3> local; ///< distances of the point from the corner along the axes, 0 to 1

  /** \param point in finite lattice coordinates */
  explicit FCCUnitCube(const std::array<double, 3> & point)
    : xStep(1)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double lower = std::floor(point[axis]);
      corner[axis] = static_cast<IndexValueType>(lower);
      local[axis] = point[axis] - lower;
    }
    if (!FCCLattice::IsSite(corner))
    {
      corner[0] += 1;
      local[0] = 1.0 - local[0];
      xStep = -1;
    }
  }
};

/** \class FCCTetrahedron
 * \brief The four sites around a point and their barycentric weights.
 *
 * The tetrahedra are those of FCCCells. FCCIsosurfaceFilter marches the same tetrahedra, so that its points lie on the
 * level set of this interpolant, except for points that it moves away from a sample.
 *
 * \ingroup FCCInterpolation
 */
struct FCCTetrahedron
{
  std::array<FCCLattice::SiteType, 4> sites;
  std::array<double, 4> weights; ///< not negative, and their sum is 1
};

/** The tetrahedron around a point in finite lattice coordinates. On a face shared by several, any of them. */
inline FCCTetrahedron
LocateFCCTetrahedron(const std::array<double, 3> & point)
{
  const FCCUnitCube cube(point);
  const auto [a, b, c] = cube.local;
  const auto at = [&cube](IndexValueType x, IndexValueType y, IndexValueType z) {
    return FCCLattice::SiteType{ cube.corner[0] + cube.xStep * x, cube.corner[1] + y, cube.corner[2] + z };
  };

  const std::array<double, 4> regular{
    1.0 - (a + b + c) / 2.0, (a + b - c) / 2.0, (a + c - b) / 2.0, (b + c - a) / 2.0
  };
  // A negative weight means that the point lies in the octahedron around one of the cube's four odd corners. The
  // tetrahedron's sites in this cube are the corner's neighbours along x, y and z; its fourth site is the neighbour on
  // the other side along x.
  const auto octant =
    [&at](IndexValueType x, IndexValueType y, IndexValueType z, double alongX, double alongY, double alongZ) {
      const IndexValueType inward = 1 - 2 * x;
      const double rest = 1.0 - alongY - alongZ;
      return FCCTetrahedron{ { at(x + inward, y, z), at(x - inward, y, z), at(x, 1 - y, z), at(x, y, 1 - z) },
                             { (rest + alongX) / 2.0, (rest - alongX) / 2.0, alongY, alongZ } };
    };
  if (regular[0] < 0.0)
  {
    return octant(1, 1, 1, 1.0 - a, 1.0 - b, 1.0 - c);
  }
  if (regular[1] < 0.0)
  {
    return octant(0, 0, 1, a, b, 1.0 - c);
  }
  if (regular[2] < 0.0)
  {
    return octant(0, 1, 0, a, 1.0 - b, c);
  }
  if (regular[3] < 0.0)
  {
    return octant(1, 0, 0, 1.0 - a, b, c);
  }
  return { { at(0, 0, 0), at(1, 1, 0), at(1, 0, 1), at(0, 1, 1) }, regular };
}

} // namespace itk

#endif
