#include "rhombicComparison.h"

#include "rhombicComparisonPictures.h"
#include "rhombicComparisonReport.h"
#include "rhombicExperimentRun.h"
#include "rhombicFailure.h"
#include "rhombicPictureIO.h"
#include "rhombicSidecar.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace rhombic
{
namespace
{

/** Draws what an experiment asks for, and returns the names of the files. */
std::vector<std::string>
StagePictures(const ExperimentRun & run, const std::filesystem::path & folder, StagedFiles & staged)
{
  const Experiment & experiment = run.result.experiment;
  std::vector<std::string> names;
  if (experiment.hasPlot)
  {
    Drawing svg = Drawing::ForSvg(PlotWidth, PlotHeight);
    DrawPlots(run.result, svg);
    StageText(svg.TakeDocument(), folder / (experiment.name + "-plot.svg"), staged);
    Drawing png(PlotWidth, PlotHeight);
    DrawPlots(run.result, png);
    names.push_back(experiment.name + "-plot.png");
    StagePicture(png.TakePictures({ { 1.0, 1.0, 1.0 } }).front(), folder / names.back(), staged, {});
  }
  if (!experiment.views.empty())
  {
    for (const bool showsErrors : { false, true })
    {
      names.push_back(experiment.name + (showsErrors ? "-errors.jpg" : "-surfaces.jpg"));
      StagePicture(DrawSurfaces(run, showsErrors), folder / names.back(), staged, {});
    }
  }
  return names;
}

} // namespace

void
RunComparison(const ComparisonRequest & request, const ComparisonSettings & settings, const Events & events)
{
  vtkSMPTools::SetBackend("Sequential"); // as many threads as ITK's filters have when times are compared: one
  std::vector<ExperimentResult> results;
  std::vector<std::vector<std::string>> pictures;
  StagedFiles staged;
  std::filesystem::create_directories(settings.output);
  for (const Experiment & experiment : request.experiments)
  {
    if (settings.only.empty() || settings.only == experiment.name)
    {
      const ExperimentRun run = RunExperiment(experiment, settings.repeats, events);
      pictures.push_back(settings.hasPictures ? StagePictures(run, settings.output, staged)
                                              : std::vector<std::string>());
      results.push_back(run.result);
      events.Note(experiment.name + ": done");
    }
  }
  if (results.empty())
  {
    throw Failure(FailureKind::Usage, "There is no experiment '" + settings.only + "' in the file.");
  }
  std::string page = "# " + request.title + "\n\n" + request.text;
  if (settings.only.empty())
  {
    page += "\n" + MarkdownOf(request.claims, results);
  }
  for (std::size_t n = 0; n < results.size(); ++n)
  {
    page += "\n" + MarkdownOf(results[n], results, pictures[n]);
  }
  StageText(page, settings.output / "RESULTS.md", staged);
  StageText(FiguresAsCsv(results), settings.output / "figures.csv", staged);
  StageText(TimesAsCsv(results), settings.output / "times.csv", staged);
  StageText(FiguresAsJson(results), settings.output / "figures.json", staged);
  staged.Commit();
}

} // namespace rhombic
