#ifndef itkTriangleSurfaceSolids_h
#define itkTriangleSurfaceSolids_h

#include "itkTriangleTree.h"

namespace itk
{

/** What was removed from a surface. Thread safety: a value. */
struct RemovedShells
{
  SizeValueType solids = 0;   ///< outer shells
  SizeValueType cavities = 0; ///< shells inside others that face inwards
  double volume = 0.0;        ///< in mm^3, what the surface lost; negative where filled cavities made it larger

  /** Adds what was removed in a further step. */
  RemovedShells &
  operator+=(const RemovedShells & other)
  {
    solids += other.solids;
    cavities += other.cavities;
    volume += other.volume;
    return *this;
  }
};

/** The shells of a closed surface. Thread safety: a value. */
struct ShellCounts
{
  SizeValueType solids = 0;    ///< outer shells, misfacing ones included
  SizeValueType cavities = 0;  ///< shells inside a solid that face inwards
  SizeValueType misfacing = 0; ///< shells that face the wrong way
};

/** A closed surface bounds solids. Each has one outer shell, a component that faces outwards and whose volume counts as
 * the solid's, and maybe cavities: components that face inwards and whose innermost outward-facing enclosure it is. A
 * component that faces inwards with nothing around it is taken as an outer shell of its volume's magnitude.
 *
 * One point of each component, exactly located, says what encloses it, so components must neither be open nor cross
 * each other. Time nearly linear in the triangles, even of very many components; several threads, the same result for
 * any number; memory about 60 bytes a triangle.
 *
 * The functions remove triangles and the points that were only theirs, and keep the order of the others. Thread safe
 * for different surfaces. */
///@{

/** Removes all solids but the one of the greatest volume, the first of several. */
RemovedShells
KeepLargestSolid(TriangleSurface & surface);

/** Removes the solids of a volume below \a minimumVolume (in mm^3). Cavities are removed with their solid only, however
 * small they are. */
RemovedShells
RemoveSmallSolids(TriangleSurface & surface, double minimumVolume);

/** Removes every component that lies inside another one: cavities and all that is in them. */
RemovedShells
FillCavities(TriangleSurface & surface);

///@}

/** Counts the shells of a closed surface. An outer shell should face outwards with as many shells as cavities around
 * it, a cavity inwards with one more shell; a shell that does not is misfacing, and a program that fills the surface by
 * its winding number counts what it encloses twice or negatively. Where components cross each other or touch, that
 * depends on the place; this looks at the two ends of each along x, and one that is as it should be is enough. Thread
 * safe. */
ShellCounts
CountShells(const TriangleTree & surface);

/** Turns the components that CountShells() counts as misfacing, with their normals; returns how many. Right for specks
 * that extraction or smoothing has turned inside out. Thread safe for different surfaces. */
SizeValueType
TurnMisfacingShells(TriangleSurface & surface);

} // namespace itk

#endif
