#ifndef rhombicLatticeDrawings_h
#define rhombicLatticeDrawings_h

#include "rhombicDrawing.h"

namespace rhombic
{

constexpr int LatticeDrawingWidth = 1040;
constexpr int LatticeDrawingHeight = 550;

/** The paper's Figures 3 to 7: nested lattices, how a rhombic dodecahedron is made and tiles space, its
 * parallelepipeds, their six tetrahedra, and how tetrahedra of neighbours meet. */
void
DrawLattices(Drawing & drawing);

} // namespace rhombic

#endif
