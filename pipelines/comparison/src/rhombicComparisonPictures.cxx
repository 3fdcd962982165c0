#include "rhombicComparisonSteps.h"

#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include "itkTriangleTree.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr int PageWidth = 1200; // pixels
constexpr int LongerSide = 235; // of a view
constexpr int HeadHeight = 74;
constexpr int BarHeight = 72;
constexpr std::size_t NumberOfBands = 9;
const Ink black{ { 0.1, 0.1, 0.1 } };

/** From light yellow over red to dark violet: brightness alone tells the order. */
Colour
BandColour(std::size_t band)
{
  constexpr Colour stops[] = {
    { 0.99, 0.96, 0.75 }, { 0.98, 0.65, 0.35 }, { 0.83, 0.24, 0.36 }, { 0.45, 0.11, 0.46 }, { 0.10, 0.05, 0.27 }
  };
  const double position = 4.0 * static_cast<double>(band) / (NumberOfBands - 1);
  const auto stop = std::min<std::size_t>(3, static_cast<std::size_t>(position));
  Colour colour;
  for (std::size_t n = 0; n < 3; ++n)
  {
    colour[n] = stops[stop][n] + (position - static_cast<double>(stop)) * (stops[stop + 1][n] - stops[stop][n]);
  }
  return colour;
}

/** A part of a scene for each band of distances, up to \a range and beyond. */
std::vector<SceneSurface>
SplitByError(const itk::TriangleSurface & surface, const itk::TriangleTree & truth, double range)
{
  std::vector<SceneSurface> bands;
  std::vector<itk::TriangleSurface::Pointer> parts;
  for (std::size_t band = 0; band < NumberOfBands; ++band)
  {
    parts.push_back(itk::TriangleSurface::New());
    parts.back()->GetPoints() = surface.GetPoints();
    bands.push_back({ "band " + std::to_string(band), parts.back().GetPointer(), BandColour(band) });
  }
  for (const auto & ids : surface.GetTriangles())
  {
    itk::TriangleTree::PositionType centroid{};
    for (unsigned int n = 0; n < 9; ++n)
    {
      centroid[n / 3] += surface.GetPoints()[ids[n % 3]][n / 3] / 3.0;
    }
    const double distance = std::sqrt(truth.FindClosestPoint(centroid).squaredDistance);
    const double band = std::min(distance / range * NumberOfBands, NumberOfBands - 1.0);
    parts[static_cast<std::size_t>(band)]->GetTriangles().push_back(ids);
  }
  return bands;
}

void
DrawColourBar(Drawing & drawing, double range, double top)
{
  constexpr double left = 20.0;
  const double width = (drawing.GetWidth() - 2.0 * left) / NumberOfBands;
  drawing.Text("distance from the true surface, in h; the last colour is for all that is farther",
               { left, top + 18.0 },
               { 14.0, black, { {}, 0.0 }, false, Alignment::Left, NumberOfBands * width });
  for (std::size_t band = 0; band < NumberOfBands; ++band)
  {
    const double x = left + width * static_cast<double>(band);
    drawing.Fill({ x, top + 28.0, width, 16.0 }, { BandColour(band) });
    drawing.Text(
      FormatNumber(range * static_cast<double>(band) / NumberOfBands, 2), { x, top + 62.0 }, { 14.0, black });
  }
}

/** The ends of a logarithmic axis, a quarter beyond the values. */
std::pair<double, double>
AxisRange(const std::vector<double> & values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return { *least / 1.25, *most * 1.25 };
}

/** The values on an axis that have a label: 1, 2 and 5 times powers of ten. */
std::vector<double>
TicksIn(const std::pair<double, double> & range)
{
  std::vector<double> ticks;
  for (double power = std::pow(10.0, std::floor(std::log10(range.first))); power < range.second; power *= 10.0)
  {
    for (const double factor : { 1.0, 2.0, 5.0 })
    {
      if (factor * power >= range.first && factor * power <= range.second)
      {
        ticks.push_back(factor * power);
      }
    }
  }
  return ticks;
}

constexpr Colour lineColours[] = { { 0.00, 0.45, 0.70 }, { 0.84, 0.37, 0.00 }, { 0.00, 0.62, 0.45 },
                                   { 0.80, 0.47, 0.65 }, { 0.34, 0.71, 0.91 }, { 0.90, 0.62, 0.00 },
                                   { 0.40, 0.40, 0.40 }, { 0.55, 0.35, 0.15 } };

/** The methods of an experiment in the order of their first rows, leaving out resampled ones. */
std::vector<std::string>
MethodsOf(const ExperimentResult & result)
{
  std::vector<std::string> methods;
  for (const ComparedRow & row : result.experiment.rows)
  {
    if (!row.isResampled && std::find(methods.begin(), methods.end(), row.method) == methods.end())
    {
      methods.push_back(row.method);
    }
  }
  return methods;
}

void
DrawPanel(const ExperimentResult & result, const std::string & figure, const Rectangle & place, Drawing & drawing)
{
  std::vector<double> all[2];
  for (std::size_t row = 0; row < result.rows.size(); ++row)
  {
    all[0].push_back(result.rows[row].at(figure));
    all[1].push_back(result.rows[row].at("mean"));
  }
  const auto rangeX = AxisRange(all[0]);
  const auto rangeY = AxisRange(all[1]);
  const auto x = [&](double value) {
    return place.left + place.width * std::log(value / rangeX.first) / std::log(rangeX.second / rangeX.first);
  };
  const auto y = [&](double value) {
    return place.Bottom() - place.height * std::log(value / rangeY.first) / std::log(rangeY.second / rangeY.first);
  };
  const LineStyle grid{ 1.0, { { 0.85, 0.85, 0.85 } } };
  for (const double tick : TicksIn(rangeX))
  {
    drawing.Line({ { x(tick), place.top }, { x(tick), place.Bottom() } }, grid);
    drawing.Text(
      FormatNumber(tick), { x(tick), place.Bottom() + 18.0 }, { 13.0, black, { {}, 0.0 }, false, Alignment::Centre });
  }
  for (const double tick : TicksIn(rangeY))
  {
    drawing.Line({ { place.left, y(tick) }, { place.Right(), y(tick) } }, grid);
    drawing.TextAbout(
      FormatNumber(tick), { place.left - 6.0, y(tick) }, { 13.0, black, { {}, 0.0 }, false, Alignment::Right });
  }
  drawing.Frame(place, { 1.0, black });
  const auto methods = MethodsOf(result);
  for (std::size_t method = 0; method < methods.size(); ++method)
  {
    const Ink ink{ lineColours[method % std::size(lineColours)] };
    std::vector<PicturePosition> points;
    for (std::size_t row = 0; row < result.rows.size(); ++row)
    {
      if (!result.experiment.rows[row].isResampled && result.experiment.rows[row].method == methods[method])
      {
        points.push_back({ x(all[0][row]), y(all[1][row]) });
        drawing.Ellipse(points.back(), { 4.0, 0.0 }, { 0.0, 4.0 }, ink);
      }
    }
    std::sort(points.begin(), points.end(), [](const auto & a, const auto & b) { return a.x < b.x; });
    drawing.Line(points, { 1.8, ink });
  }
  drawing.Text("mean distance in h, against " + figure, { place.left, place.top - 8.0 }, { 15.0, black });
}

/** How a picture is divided: a block for each surface, with its views side by side. */
struct BlockPlan
{
  std::vector<std::pair<View, RenderSettings>> views;
  int viewsWidth = 0;
  int width = 0; ///< of a block
  int height = HeadHeight;
  int columns = 1;
  int rows = 1;
};

/** Views are as wide and high as the true surface needs, all at one scale. */
BlockPlan
PlanBlocks(const Scene & truth, const std::vector<std::string> & names, std::size_t mostViews, std::size_t blocks)
{
  constexpr int leastWidth = 190; // for titles
  RenderSettings settings;
  settings.style = PictureStyle::Paper;
  settings.extent = BoxAround(truth.surfaces);
  settings.sameScale = true;
  settings.width = 0;
  settings.height = 0;
  std::vector<View> views;
  std::transform(names.begin(), names.end(), std::back_inserter(views), ViewFromText);
  views.resize(std::min(views.size(), mostViews));
  const auto projections = SurfaceRenderer::Plan(truth, settings, views);
  int longest = 1;
  for (const Projection & projection : projections)
  {
    longest = std::max({ longest, projection.width, projection.height });
  }
  BlockPlan plan;
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    settings.width = projections[n].width * LongerSide / longest;
    settings.height = projections[n].height * LongerSide / longest;
    plan.views.emplace_back(views[n], settings);
    plan.viewsWidth += settings.width;
    plan.height = std::max(plan.height, HeadHeight + settings.height);
  }
  plan.width = std::max(plan.viewsWidth, leastWidth);
  const int most = std::max(1, PageWidth / plan.width);
  plan.rows = (static_cast<int>(blocks) + most - 1) / most;
  plan.columns = (static_cast<int>(blocks) + plan.rows - 1) / plan.rows;
  return plan;
}

} // namespace

Picture
DrawSurfaces(const ExperimentRun & run, bool showsErrors)
{
  const auto & experiment = run.result.experiment;
  std::vector<std::size_t> shown;
  double range = 0.0; // in h
  for (std::size_t row = 0; row < run.surfaces.size(); ++row)
  {
    if (experiment.rows[row].isShown)
    {
      shown.push_back(row);
      range = std::max(range, run.result.rows[row].at("p99"));
    }
  }
  const Scene truth{ { { "truth", run.truth.GetPointer() } }, {}, {} };
  const BlockPlan plan = PlanBlocks(truth, experiment.views, showsErrors ? 1 : 2, shown.size() + (showsErrors ? 0 : 1));
  Drawing drawing(plan.width * plan.columns, plan.height * plan.rows + (showsErrors ? BarHeight : 0));
  SurfaceRenderer renderer;
  int next = 0;
  const auto drawBlock = [&](const Scene & scene, const std::array<std::string, 3> & lines) {
    const double left = next % plan.columns * plan.width;
    const double top = next / plan.columns * plan.height;
    double x = left + 0.5 * (plan.width - plan.viewsWidth);
    for (const auto & [view, settings] : plan.views)
    {
      const double width = settings.width;
      drawing.Place(renderer.Render(scene, settings, { view }).front().picture,
                    { x, top + HeadHeight, width, double(settings.height) });
      x += width;
    }
    double y = top + 24.0;
    for (const std::string & line : lines)
    {
      drawing.Text(line,
                   { left + 0.5 * plan.width, y },
                   { 14.0, black, { {}, 0.0 }, &line == &lines.front(), Alignment::Centre, plan.width - 8.0 });
      y += 20.0;
    }
    ++next;
  };
  if (!showsErrors)
  {
    drawBlock(truth, { "true surface", "", FormatFixed(run.result.truth.at("triangles"), 0) + " triangles" });
  }
  const itk::TriangleTree tree(*run.truth);
  for (const std::size_t row : shown)
  {
    auto bare = itk::TriangleSurface::New(); // without normals: facets are seen
    bare->Graft(run.surfaces[row]);
    bare->GetNormals().clear();
    const Scene scene{ showsErrors ? SplitByError(*bare, tree, range * run.result.spacing)
                                   : std::vector<SceneSurface>{ { "surface", bare.GetPointer() } },
                       {},
                       {} };
    drawBlock(
      scene,
      { LabelOf(run.result, row),
        GetComparedMethod(experiment.rows[row].method).lattice + ", " + std::to_string(run.samples[row]) + " samples",
        std::to_string(bare->GetNumberOfTriangles()) + " triangles" });
  }
  if (showsErrors)
  {
    DrawColourBar(drawing, range, double(plan.height) * plan.rows);
  }
  return drawing.TakePictures({ { 1.0, 1.0, 1.0 } }).front();
}

void
DrawPlots(const ExperimentResult & result, const std::vector<std::string> & figures, Drawing & drawing)
{
  drawing.Fill({ 0.0, 0.0, double(drawing.GetWidth()), PlotHeight }, { { 1.0, 1.0, 1.0 } });
  drawing.Text(result.experiment.title,
               { 20.0, 28.0 },
               { 18.0, black, { {}, 0.0 }, true, Alignment::Left, drawing.GetWidth() - 40.0 });
  double left = 70.0;
  for (const std::string & figure : figures)
  {
    DrawPanel(result, figure, { left, 70.0, 360.0, 350.0 }, drawing);
    left += 430.0;
  }
  const auto methods = MethodsOf(result);
  for (std::size_t method = 0; method < methods.size(); ++method)
  {
    const double y = 84.0 + 26.0 * static_cast<double>(method);
    drawing.Line({ { left - 50.0, y }, { left - 26.0, y } }, { 3.0, { lineColours[method % std::size(lineColours)] } });
    drawing.TextAbout(methods[method], { left - 18.0, y }, { 14.0, black });
  }
}

} // namespace rhombic
