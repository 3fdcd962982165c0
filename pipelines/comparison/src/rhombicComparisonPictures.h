#ifndef rhombicComparisonPictures_h
#define rhombicComparisonPictures_h

#include "rhombicDrawing.h"
#include "rhombicExperimentRun.h"

namespace rhombic
{

/** The true surface and the rows that are shown, from up to two views; with \a showsErrors the rows from the first
 * view, coloured by the distance of each triangle's centroid from the true surface. */
Picture
DrawSurfaces(const ExperimentRun & run, bool showsErrors);

constexpr int PlotHeight = 470;

/** The width of a picture of some plots. */
constexpr int
PlotWidth(std::size_t plots)
{
  return 290 + 430 * static_cast<int>(plots);
}

/** A plot of the mean distance against each of some figures, with a line for each method. */
void
DrawPlots(const ExperimentResult & result, const std::vector<std::string> & figures, Drawing & drawing);

constexpr int LatticeDrawingWidth = 1040;
constexpr int LatticeDrawingHeight = 550;

/** The paper's Figures 3 to 7: nested lattices, how a rhombic dodecahedron is made and tiles space, its
 * parallelepipeds, their six tetrahedra, and how tetrahedra of neighbours meet. */
void
DrawLattices(Drawing & drawing);

} // namespace rhombic

#endif
