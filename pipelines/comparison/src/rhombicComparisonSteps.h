#ifndef rhombicComparisonSteps_h
#define rhombicComparisonSteps_h

#include "rhombicComparedMethod.h"
#include "rhombicComparison.h"
#include "rhombicDrawing.h"
#include "rhombicShapeFields.h"

#include "itkTriangleSurface.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * The steps of RunComparison(): fields are made, experiments run, tables written and pictures drawn. */

/** A field, where it is sampled, and its true surface. */
struct FieldCase
{
  ReferenceField field;
  FieldBox box{};
  double spacing = 1.0;                ///< h, or an estimate of it
  bool isClosed = true;                ///< whether the surface lies within the box
  itk::TriangleSurface::Pointer truth; ///< if a better surface than MakeTrueSurface() is known
  std::vector<GapPoint> gap;           ///< points between close parts of an object
  bool isObject = false;               ///< whether it counts in place of the field's surface
};

/** The field of a request, at the position or with the values of a seed. Throws Failure. */
FieldCase
MakeFieldCase(const FieldRequest & request, std::uint64_t seed);

/** The figures of an experiment, and the surfaces of its first field. */
struct ExperimentRun
{
  ExperimentResult result;
  itk::TriangleSurface::Pointer truth;
  std::vector<itk::TriangleSurface::Pointer> surfaces; ///< of the rows
  std::vector<itk::SizeValueType> samples;
};

ExperimentRun
RunExperiment(const Experiment & experiment, unsigned int repeats, const Events & events);

/** A name for a row: its method, its share of the reference's samples, and whether these are resampled. */
std::string
LabelOf(const ExperimentResult & result, std::size_t row);

/** A picture on the page. */
struct PagePicture
{
  std::string file;
  std::string caption;
};

/** A text with figures in place of ${...}. Throws Failure(Unreadable) for a figure that is not there. */
std::string
FillIn(const std::string & text, const std::vector<ExperimentResult> & all);

/** The section of one experiment: table, text and pictures. */
std::string
MarkdownOf(const ExperimentResult & result,
           const std::vector<ExperimentResult> & all,
           const std::vector<PagePicture> & pictures);

/** The table of claims. */
std::string
MarkdownOf(const std::vector<Claim> & claims, const std::vector<ExperimentResult> & all);

/** All figures but times, a line for each row. */
std::string
FiguresAsCsv(const std::vector<ExperimentResult> & all);

/** Median times in ms on one thread, and their ratios to the reference's. */
std::string
TimesAsCsv(const std::vector<ExperimentResult> & all);

/** All figures. */
std::string
FiguresAsJson(const std::vector<ExperimentResult> & all);

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
