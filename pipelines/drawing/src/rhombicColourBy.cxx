#include "rhombicColourBy.h"

#include "rhombicColourScale.h"
#include "rhombicFailure.h"
#include "rhombicGreyWindow.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicPictureSteps.h"
#include "rhombicScanReader.h"
#include "rhombicSurfaceIO.h"
#include "rhombicWording.h"

#include "itkLinearInterpolateImageFunction.h"
#include "itkTriangleSurfaceDistance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace rhombic
{
namespace
{

constexpr float NoValue = std::numeric_limits<float>::quiet_NaN();

/** Values of the points of a surface. */
using Values = std::vector<float>;

/** The values of a volume at a surface's points; NaN outside of the volume. */
Values
SampleVolume(const ScanImage & volume, const itk::TriangleSurface & surface)
{
  return std::visit(
    [&](const auto & image) {
      using ImageType = typename std::decay_t<decltype(image)>::ObjectType;
      const auto interpolator = itk::LinearInterpolateImageFunction<ImageType, double>::New();
      interpolator->SetInputImage(image);
      Values values(surface.GetNumberOfPoints(), NoValue);
      for (std::size_t n = 0; n < values.size(); ++n)
      {
        const itk::Point<double, 3> position(surface.GetPoints()[n].data());
        if (interpolator->IsInsideBuffer(position))
        {
          values[n] = static_cast<float>(interpolator->Evaluate(position));
        }
      }
      return values;
    },
    volume);
}

/** The surfaces that distances are measured to: of a label map those with the names of the scene's surfaces, if there
 * are any, as walls depend on which labels have surfaces.
 * \param isOnly set: whether the file holds one surface or label */
std::vector<SceneSurface>
ReadOthers(const std::filesystem::path & file,
           const std::vector<SceneSurface> & surfaces,
           const Events & events,
           bool & isOnly)
{
  if (IsSurfacePath(file))
  {
    std::vector<SceneSurface> read = ReadSurfaces(file);
    isOnly = read.size() == 1;
    return read;
  }
  ScanSource source;
  source.path = file;
  SurfaceSelection selection;
  selection.labels.emplace();
  const LoadedSource loaded = LoadSource(source, selection, std::nullopt, events);
  isOnly = loaded.labels->labels.size() == 1;
  LabelSurfaceSettings settings;
  for (const LabelSummary & summary : loaded.labels->labels)
  {
    const auto isNamed = [&](const SceneSurface & surface) { return surface.name == summary.label.name; };
    if (std::any_of(surfaces.begin(), surfaces.end(), isNamed))
    {
      settings.labels.push_back(std::to_string(summary.label.value));
    }
  }
  LabelMesh mesh = LabelsToWalls(*loaded.labels, settings, events);
  ExtractSurfaces(mesh);
  std::vector<SceneSurface> others;
  for (const LabelSurface & label : mesh.labels)
  {
    others.push_back(label.scene);
  }
  return others;
}

/** Signed distances of the points of each surface to the one of its name; a single other surface is that of all. */
std::vector<Values>
MeasureDistances(const ColourBy & by, const PictureScene & scene, const Events & events)
{
  bool isOnly = false;
  const std::vector<SceneSurface> others = ReadOthers(by.file, scene.surfaces, events, isOnly);
  std::vector<Values> all;
  for (const SceneSurface & surface : scene.surfaces)
  {
    const auto named =
      std::find_if(others.begin(), others.end(), [&](const auto & other) { return other.name == surface.name; });
    const auto found = isOnly ? others.begin() : named;
    if (found == others.end())
    {
      events.Note(surface.name + ": " + by.file.filename().string() + " has no surface of this name; it stays grey");
      all.emplace_back(surface.surface->GetNumberOfPoints(), NoValue);
      continue;
    }
    all.push_back(ComputeTriangleSurfaceSignedDistances(*surface.surface, itk::TriangleTree(*found->surface)));
  }
  return all;
}

/** The values of a volume at the points of each surface, and their unit. */
std::vector<Values>
SampleSurfaces(const ColourBy & by, const PictureScene & scene, const Events & events, std::string & unit)
{
  ScanSource source;
  source.path = by.file;
  const Scan volume = ReadScan(source, events);
  if (!volume.sliceOrigins.empty())
  {
    throw Failure(FailureKind::Usage,
                  by.file.string() + " has unevenly spaced slices, between which values are not computed; resample it "
                                     "first.");
  }
  unit = IsInHounsfieldUnits(volume) ? "HU" : ReadDicomExamination(volume).units;
  std::vector<Values> all;
  for (const SceneSurface & surface : scene.surfaces)
  {
    all.push_back(SampleVolume(volume.image, *surface.surface));
  }
  return all;
}

/** All values that are known, in ascending order. */
Values
SortKnown(const std::vector<Values> & all)
{
  Values known;
  for (const Values & values : all)
  {
    std::copy_if(
      values.begin(), values.end(), std::back_inserter(known), [](float value) { return !std::isnan(value); });
  }
  std::sort(known.begin(), known.end());
  return known;
}

/** The ends of the scale: what most points have. */
std::pair<double, double>
FindRange(const ColourBy & by, Values known)
{
  const auto at = [&known](double share) {
    return double{ known[static_cast<std::size_t>(share * static_cast<double>(known.size() - 1))] };
  };
  if (by.range)
  {
    return *by.range;
  }
  if (by.kind == ColourBy::Kind::Distance)
  {
    std::transform(known.begin(), known.end(), known.begin(), [](float value) { return std::abs(value); });
    std::sort(known.begin(), known.end());
    const double most = std::max(at(0.95), 0.1);
    return { -most, most };
  }
  return { at(0.02), at(0.98) };
}

} // namespace

ColourBy
ParseColourBy(const std::string & text)
{
  const std::vector<std::string> fields = Split(text, ",");
  ColourBy by;
  const std::string distance = "distance:";
  if (fields.front().compare(0, distance.size(), distance) == 0)
  {
    by.kind = ColourBy::Kind::Distance;
    by.file = fields.front().substr(distance.size());
  }
  else
  {
    by.file = fields.front();
  }
  std::vector<double> numbers;
  for (std::size_t n = 1; n < fields.size(); ++n)
  {
    if (const auto number = ToNumber<double>(fields[n]))
    {
      numbers.push_back(*number);
    }
    else
    {
      by.map = fields[n];
      ColourOf({ by.map, 0.0, 1.0, "" }, 0.0); // throws for an unknown map
    }
  }
  const bool hasRange = numbers.size() == 2 && numbers[0] < numbers[1];
  if ((!numbers.empty() && !hasRange) || by.file.empty())
  {
    throw Failure(
      FailureKind::Usage,
      "'" + text +
        "' says not what to colour by; write pet.nii.gz,0,7,inferno or distance:other.stl,-2,2, with the lower "
        "value first.");
  }
  if (hasRange)
  {
    by.range = { numbers[0], numbers[1] };
  }
  return by;
}

void
ColourSurfaces(const ColourBy & by, PictureScene & scene, const Events & events)
{
  events.Progress("colouring", 0.0);
  const bool isDistance = by.kind == ColourBy::Kind::Distance;
  std::string unit;
  const std::vector<Values> all =
    isDistance ? MeasureDistances(by, scene, events) : SampleSurfaces(by, scene, events, unit);
  const Values known = SortKnown(all);
  if (known.empty())
  {
    throw Failure(FailureKind::Geometry,
                  by.file.string() + " reaches no point of the surfaces; check that it is of the same patient and in "
                                     "the same space.");
  }
  ColourScale scale;
  scale.map = !by.map.empty() ? by.map : isDistance ? "diverging" : "viridis";
  std::tie(scale.low, scale.high) = FindRange(by, known);
  scale.title = isDistance ? "distance, mm" : unit.empty() ? "value" : unit;
  std::size_t points = 0;
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    points += all[n].size();
    auto colours = std::make_shared<std::vector<std::array<std::uint8_t, 3>>>(all[n].size());
    std::transform(
      all[n].begin(), all[n].end(), colours->begin(), [&](float value) { return ToBytes(ColourOf(scale, value)); });
    scene.surfaces[n].pointColours = std::move(colours);
  }
  if (known.size() < points)
  {
    events.Note(FormatFixed(100.0 * static_cast<double>(points - known.size()) / static_cast<double>(points), 1) +
                " % of the surfaces' points have no value, and are grey");
  }
  events.Note("colours by " + scale.title + ": " + FormatNumber(known.front(), 4) + " to " +
              FormatNumber(known.back(), 4) + ", scale from " + FormatNumber(scale.low, 4) + " to " +
              FormatNumber(scale.high, 4));
  scene.report["colours"] = { { "by", isDistance ? "distance" : "volume" },
                              { "title", scale.title },
                              { "map", scale.map },
                              { "low", scale.low },
                              { "high", scale.high },
                              { "lowestValue", known.front() },
                              { "highestValue", known.back() } };
  scene.scale = scale;
}

} // namespace rhombic
