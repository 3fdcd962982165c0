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

constexpr int PlotWidth = 1150;
constexpr int PlotHeight = 470;

/** Mean distance against samples, and against triangles, with a line for each method. */
void
DrawPlots(const ExperimentResult & result, Drawing & drawing);

} // namespace rhombic

#endif
