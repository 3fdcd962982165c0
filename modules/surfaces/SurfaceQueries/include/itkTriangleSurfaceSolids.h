#ifndef itkTriangleSurfaceSolids_h
#define itkTriangleSurfaceSolids_h

#include "itkTriangleSurface.h"

namespace itk
{

/** Shells that were removed from a surface. */
struct RemovedShells
{
  SizeValueType solids = 0;   ///< outer shells
  SizeValueType cavities = 0; ///< shells inside a solid that face inwards
  double volume = 0.0;        ///< lost by the surface, in mm^3; negative if filling cavities made it larger

  RemovedShells &
  operator+=(const RemovedShells & other)
  {
    solids += other.solids;
    cavities += other.cavities;
    volume += other.volume;
    return *this;
  }
};

/** The shells of a closed surface. */
struct ShellCounts
{
  SizeValueType solids = 0;    ///< outer shells, also those that face the wrong way
  SizeValueType cavities = 0;  ///< shells inside a solid that face inwards
  SizeValueType misfacing = 0; ///< shells that face the wrong way
};

/** A closed surface bounds solids. Each solid has one outer shell, a component that faces outwards, and any number of
 * cavities, components that face inwards; a cavity belongs to the smallest outer shell around it. The volume of a solid
 * is that of its outer shell. A component that faces inwards with nothing around it counts as an outer shell with the
 * magnitude of its volume.
 *
 * Which components enclose a component is found from one of its points, so components must be closed and must not cross
 * each other. Time nearly linear in the triangles, on several threads with the same result for any number of them;
 * memory about 60 bytes per triangle.
 *
 * The functions keep the order of the remaining triangles and points. */
///@{

/** Removes all solids but the largest solid, the first if several are equally large. */
RemovedShells
KeepLargestTriangleSurfaceSolid(TriangleSurface & surface);

/** Removes the solids with a volume below \a minimumVolume (in mm^3). Cavities, however small, are removed only with
 * their solid. */
RemovedShells
RemoveSmallTriangleSurfaceSolids(TriangleSurface & surface, double minimumVolume);

/** Removes every component that lies inside another component: cavities and all components in them. */
RemovedShells
FillTriangleSurfaceCavities(TriangleSurface & surface);

///@}

/** Counts the shells of a closed surface. The other shells should wind 0 times around an outer shell and once around a
 * cavity; a shell for which they do not is misfacing, and programs that fill the surface by its winding number count
 * its inside twice or negatively. Where components cross or touch, the winding number depends on the point; this looks
 * at the points of each shell with the least and the greatest x, and one correct winding number is enough. */
ShellCounts
CountTriangleSurfaceShells(const TriangleSurface & surface);

/** Reverses the triangles and normals of the components that CountTriangleSurfaceShells() counts as misfacing; returns
 * how many. Meant for specks that extraction or smoothing has turned inside out. */
SizeValueType
TurnMisfacingTriangleSurfaceShells(TriangleSurface & surface);

} // namespace itk

#endif
