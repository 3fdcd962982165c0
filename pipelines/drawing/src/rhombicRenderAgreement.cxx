#include "rhombicRenderAgreement.h"

#include "rhombicColourBy.h"
#include "rhombicFailure.h"
#include "rhombicPictureSteps.h"
#include "rhombicRenderPage.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rhombic
{
namespace
{

RenderSheetSettings
SheetOf(const CompareLabelsSettings & settings)
{
  RenderSheetSettings sheet;
  sheet.source.scan.lattice.maximumMemory = settings.first.lattice.maximumMemory;
  sheet.page = settings.page;
  sheet.title = "Agreement of two segmentations";
  sheet.provenance = settings.provenance;
  return sheet;
}

/** The page as an interactive one. */
RenderPageSettings
InteractivePageOf(const CompareLabelsSettings & settings)
{
  RenderPageSettings page;
  page.source.scan.lattice.maximumMemory = settings.first.lattice.maximumMemory;
  page.page = settings.page;
  page.title = SheetOf(settings).title;
  page.provenance = settings.provenance;
  return page;
}

bool
AreCompared(const LabelAgreement & label)
{
  return label.status == AgreementStatus::Compared;
}

/** Labels that B lacks come first, then the others by the distance within which 95 % of the surfaces lie. */
bool
IsWorse(const LabelAgreement & one, const LabelAgreement & other)
{
  return AreCompared(one) != AreCompared(other) ? AreCompared(other)
                                                : one.surfaces.hausdorff95 > other.surfaces.hausdorff95;
}

const std::vector<std::string> Headings{ "A ml", "B - A %", "Dice", "HD95 mm", "MASD mm", "NSD" };

LegendRow
RowOf(const LabelAgreement & label)
{
  const std::string none = "\u2013";
  LegendRow row{ label.label, label.colour, label.first.millilitres, {}, {}, "" };
  std::replace(row.name.begin(), row.name.end(), '_', ' ');
  if (label.change && NameChange(*label.change) != "kept")
  {
    row.name += " (" + NameChange(*label.change) + ")";
  }
  if (!AreCompared(label))
  {
    row.name += label.change ? "" : label.firstSurface != nullptr ? " (not in B)" : " (not in A)";
    row.figures.assign(Headings.size(), none);
    row.figures.front() = label.firstSurface != nullptr ? FormatFixed(label.first.millilitres, 1) : none;
    return row;
  }
  const double growth = 100.0 * (label.second.millilitres / label.first.millilitres - 1.0);
  row.figures = {
    FormatFixed(label.first.millilitres, 1),         std::isfinite(growth) ? FormatFixed(growth, 1) : none,
    label.dice ? FormatFixed(*label.dice, 3) : none, FormatFixed(label.surfaces.hausdorff95, 2),
    FormatFixed(label.surfaces.meanOfMeans, 2),      FormatFixed(label.surfaces.normalizedDice, 3)
  };
  return row;
}

/** The tolerance in mm, if all labels have one. */
std::optional<double>
FindTolerance(const std::vector<LabelAgreement> & labels)
{
  const double tolerance = labels.front().tolerance;
  const bool isOne = std::all_of(
    labels.begin(), labels.end(), [tolerance](const LabelAgreement & label) { return label.tolerance == tolerance; });
  return isOne ? std::optional(tolerance) : std::nullopt;
}

std::vector<std::string>
FactsOf(const std::vector<LabelAgreement> & labels, const CompareLabelsSettings & settings)
{
  const auto compared = std::count_if(labels.begin(), labels.end(), AreCompared);
  const auto tolerance = FindTolerance(labels);
  const auto meanOf = [&](const auto & measure) {
    double sum = 0.0;
    for (const LabelAgreement & label : labels)
    {
      sum += AreCompared(label) ? measure(label) : 0.0;
    }
    return sum / static_cast<double>(std::max<std::ptrdiff_t>(1, compared));
  };
  return { "colours: signed distance of A's surface from B's; above 0 A lies outside of B" +
             std::string(tolerance ? "; lines in the bar: the tolerance" : ""),
           "lines: B's surface",
           "labels: " + std::to_string(compared) + " compared, " + std::to_string(labels.size() - compared) +
             " in one segmentation only",
           "means: HD95 " + FormatFixed(meanOf([](const auto & label) { return label.surfaces.hausdorff95; }), 2) +
             " mm, MASD " + FormatFixed(meanOf([](const auto & label) { return label.surfaces.meanOfMeans; }), 2) +
             " mm, NSD " + FormatFixed(meanOf([](const auto & label) { return label.surfaces.normalizedDice; }), 3) +
             " of those compared",
           "tolerance: " + (tolerance ? FormatNumber(*tolerance) + " mm" : std::string("by label")),
           std::string("surfaces: ") + (settings.takesVoxelSurfaces ? "faces of the voxels" : "smooth") +
             (settings.transform.empty() ? "" : "; B was moved by the transform of a registration") };
}

/** The scene of a page. \param labels worst first */
PictureScene
SceneOf(const CompareLabelsSettings & settings,
        const std::vector<LabelAgreement> & labels,
        const std::optional<double> & range,
        const Events & events)
{
  PictureScene scene;
  std::vector<itk::TriangleSurface::ConstPointer> others;
  std::vector<LegendRow> rowsOfOthers;
  for (const LabelAgreement & label : labels)
  {
    SceneSurface surface;
    surface.name = label.label;
    surface.colour = label.colour;
    if (label.secondSurface != nullptr)
    {
      surface.surface = label.secondSurface;
      scene.drawnAsLines.push_back(surface);
      scene.drawnAsLines.back().name = RowOf(label).name;
    }
    if (label.firstSurface != nullptr)
    {
      surface.surface = label.firstSurface;
      scene.surfaces.push_back(surface);
      others.push_back(label.secondSurface);
    }
    (label.firstSurface != nullptr ? scene.rows : rowsOfOthers).push_back(RowOf(label));
  }
  if (scene.surfaces.empty())
  {
    throw Failure(FailureKind::Empty, "A has no surface to draw; leave the page out, or compare other labels.");
  }
  scene.rows.insert(scene.rows.end(), rowsOfOthers.begin(), rowsOfOthers.end());
  scene.box = BoxOfSurfaces(scene.surfaces);
  scene.headings = Headings;
  scene.facts = FactsOf(labels, settings);
  const auto ends = range ? std::optional(std::make_pair(-*range, *range)) : std::nullopt;
  SurfaceColours colours = ColourSurfacesByDistance(others, ends, scene.surfaces, events);
  if (const auto tolerance = FindTolerance(labels))
  {
    colours.scale.marks = { -*tolerance, *tolerance };
  }
  scene.scale = colours.scale;
  scene.report["colours"] = colours.report;
  return scene;
}

} // namespace

void
CheckAgreementPage(const CompareLabelsSettings & settings, const std::optional<double> & range)
{
  if (range && (!(*range > 0.0) || !std::isfinite(*range)))
  {
    throw Failure(FailureKind::Usage, "The range of colours must be above 0 mm; write --range 3, for example.");
  }
  if (IsPagePath(settings.page))
  {
    CheckRenderPage(InteractivePageOf(settings));
  }
  else if (!settings.page.empty())
  {
    CheckRenderSheet(SheetOf(settings));
  }
}

std::vector<MadeFile>
RenderAgreement(const CompareLabelsSettings & settings,
                const std::vector<LabelAgreement> & labels,
                const std::optional<double> & range,
                const Events & events)
{
  std::vector<LabelAgreement> worstFirst = labels;
  std::stable_sort(worstFirst.begin(), worstFirst.end(), IsWorse);
  PictureScene scene = SceneOf(settings, worstFirst, range, events);
  SurfaceRenderer renderer;
  OutputFiles outputs{ settings.provenance };
  if (IsPagePath(settings.page))
  {
    StageScenePage(InteractivePageOf(settings), std::move(scene), renderer, events, outputs);
    outputs.staged.Commit();
    return outputs.made;
  }
  RenderSheetSettings sheet = SheetOf(settings);
  sheet.names = !settings.parts.empty(); // "lesion 3" in the table and in the views
  if (const std::vector<View> faces = ViewsOfFaces(scene.surfaces); !faces.empty())
  {
    sheet.views = faces;
  }
  const std::vector<PlaneRequest> planes{ { SlicePlane::Axial, "" },
                                          { SlicePlane::Coronal, "" },
                                          { SlicePlane::Sagittal, "" } };
  StageScenePages(sheet, scene, planes, false, renderer, events, outputs);
  outputs.staged.Commit();
  events.Progress("drawing the page", 1.0);
  return outputs.made;
}

} // namespace rhombic
