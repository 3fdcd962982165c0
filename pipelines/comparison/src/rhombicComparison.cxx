
#include "rhombicComparisonSteps.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicPictureIO.h"
#include "rhombicSidecar.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace rhombic
{
namespace
{

void
StagePng(Drawing & drawing, const std::filesystem::path & path, StagedFiles & staged)
{
  StagePicture(drawing.TakePictures({ { 1.0, 1.0, 1.0 } }).front(), path, staged, {});
}

/** Plots the mean distance against figures, as SVG and PNG. */
void
StagePlots(const ExperimentResult & result,
           const std::vector<std::string> & figures,
           const std::string & name,
           const std::filesystem::path & folder,
           StagedFiles & staged)
{
  Drawing svg = Drawing::ForSvg(PlotWidth(figures.size()), PlotHeight);
  DrawPlots(result, figures, svg);
  StageText(svg.TakeDocument(), folder / (name + ".svg"), staged);
  Drawing png(PlotWidth(figures.size()), PlotHeight);
  DrawPlots(result, figures, png);
  StagePng(png, folder / (name + ".png"), staged);
}

/** Draws the plots and pictures of an experiment. */
std::vector<PagePicture>
StagePictures(const ExperimentRun & run, const std::filesystem::path & folder, StagedFiles & staged)
{
  const Experiment & experiment = run.result.experiment;
  std::vector<PagePicture> pictures;
  if (experiment.hasPlot)
  {
    const std::string name = experiment.name + "-plot";
    StagePlots(run.result, { "samples", "triangles" }, name, folder, staged);
    StagePlots(run.result, { "seconds" }, experiment.name + "-times", folder, staged); // not on the page: see times.csv
    pictures.push_back({ name + ".png",
                         "Mean distance from the true surface against the number of samples, and of triangles. Lower "
                         "and further left is better. [SVG](" +
                           name + ".svg)" });
  }
  if (!experiment.views.empty())
  {
    for (const bool showsErrors : { false, true })
    {
      pictures.push_back({ experiment.name + (showsErrors ? "-errors.jpg" : "-surfaces.jpg"),
                           showsErrors
                             ? "The same surfaces. Colours show how far the middle of each triangle is from the "
                               "true surface, in h."
                             : "The true surface, then those of the methods, with flat triangles." });
      PictureMetadata small;
      small.jpegQuality = 80;
      StagePicture(DrawSurfaces(run, showsErrors), folder / pictures.back().file, staged, small);
    }
  }
  return pictures;
}

} // namespace

void
RunComparison(const ComparisonRequest & request, const ComparisonSettings & settings, const Events & events)
{
  vtkSMPTools::SetBackend("Sequential"); // as many threads as ITK's filters have when times are compared: one
  std::vector<ExperimentResult> results;
  std::vector<std::vector<PagePicture>> pictures;
  StagedFiles staged;
  MakeOutputFolder(settings.output);
  for (const Experiment & experiment : request.experiments)
  {
    if (settings.only.empty() || settings.only == experiment.name)
    {
      const ExperimentRun run = RunExperiment(experiment, settings.repeats, events);
      pictures.push_back(settings.hasPictures ? StagePictures(run, settings.output, staged)
                                              : std::vector<PagePicture>());
      results.push_back(run.result);
      events.Note(experiment.name + ": done");
    }
  }
  if (results.empty())
  {
    throw Failure(FailureKind::Usage, "There is no experiment '" + settings.only + "' in the file.");
  }
  std::string page = "# " + request.title + "\n";
  if (settings.only.empty())
  {
    page += "\n" + FillIn(request.text, results);
  }
  if (settings.only.empty() && !request.claims.empty())
  {
    page += "\n" + MarkdownOf(request.claims, results);
  }
  for (std::size_t n = 0; n < results.size(); ++n)
  {
    page += "\n" + MarkdownOf(results[n], results, pictures[n]);
  }
  if (request.hasLattices && settings.only.empty() && settings.hasPictures)
  {
    Drawing drawing(LatticeDrawingWidth, LatticeDrawingHeight);
    DrawLattices(drawing);
    StagePng(drawing, settings.output / "lattices.png", staged);
    page +=
      "\n## Figures 3 to 7: the lattices and their cells\n\n![Lattices and cells](lattices.png)\n\n*How samples are "
      "left out, how a rhombic "
      "dodecahedron, the space nearest to a sample of FCC, is made, tiles space and is cut, and how tetrahedra of "
      "neighbouring parallelepipeds meet: the orange edges fall onto each other.*\n";
  }
  StageText(page, settings.output / "RESULTS.md", staged);
  StageText(FiguresAsCsv(results), settings.output / "figures.csv", staged);
  StageText(TimesAsCsv(results), settings.output / "times.csv", staged);
  StageText(FiguresAsJson(results), settings.output / "figures.json", staged);
  staged.Commit();
}

} // namespace rhombic
