#ifndef itkTriangleSurfaceSolids_h
#define itkTriangleSurfaceSolids_h

#include "itkTriangleTree.h"

namespace itk
{

/** A closed surface bounds solids. Each has one outer shell, a component that faces outwards and whose volume counts as
 * the solid's, and maybe cavities: components that face inwards and whose innermost outward-facing enclosure it is. A
 * component that faces inwards with nothing around it is taken as an outer shell of its volume's magnitude.
 *
 * One point of each component, exactly located, says what encloses it, so components must neither be open nor cross
 * each other. Time nearly linear in the triangles, even of very many components; several threads, the same result for
 * any number; memory about 60 bytes a triangle.
 *
 * The functions remove triangles and the points that were only theirs, keep the order of the others, and return the
 * number of components that were removed. Thread safe for different surfaces. */
///@{

/** Removes all solids but the one of the greatest volume, the first of several. */
SizeValueType
KeepLargestSolid(TriangleSurface & surface);

/** Removes the solids of a volume below \a minimumVolume (in mm^3). Cavities are removed with their solid only, however
 * small they are. */
SizeValueType
RemoveSmallSolids(TriangleSurface & surface, double minimumVolume);

/** Removes every component that lies inside another one: cavities and all that is in them. */
SizeValueType
FillCavities(TriangleSurface & surface);

///@}

/** How many components of a closed surface do not face the way they should: an outer shell outwards with as many shells
 * as cavities around it, a cavity inwards with one more shell. A program that fills the surface by its winding number
 * finds a solid as thick as two where they do not, or one that is less than nothing. Where components cross each
 * other or touch, that depends on the place; this looks at the two ends of each along x, and one that is as it should
 * be is enough. Thread safe. */
SizeValueType
CountMisfacingShells(const TriangleTree & surface);

/** Turns the components that CountMisfacingShells() counts, with their normals; returns how many. Right for specks that
 * extraction or smoothing has turned inside out. Thread safe for different surfaces. */
SizeValueType
TurnMisfacingShells(TriangleSurface & surface);

} // namespace itk

#endif
