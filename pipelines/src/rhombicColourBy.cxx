#include "rhombicColourBy.h"

#include "rhombicFailure.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicScanSource.h"
#include "rhombicSurfaceIO.h"
#include "rhombicVolumeValues.h"
#include "rhombicWording.h"

#include "itkPointBox.h"
#include "itkTriangleSurfaceCurvature.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceThickness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

namespace rhombic
{
namespace
{

constexpr float NoValue = std::numeric_limits<float>::quiet_NaN();
constexpr const char * TitleOfDistances = "distance, mm";
constexpr const char * NameOfDistances = "distance_mm";

/** Values of the points of a surface. */
using Values = itk::BulkVector<float>;

/** The surfaces that distances are measured to: of a label map those with the names of the other surfaces, if there
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
MeasureDistances(const ColourBy & by, const std::vector<SceneSurface> & surfaces, const Events & events)
{
  bool isOnly = false;
  const std::vector<SceneSurface> others = ReadOthers(by.file, surfaces, events, isOnly);
  std::optional<itk::PointBox> box;
  std::vector<Values> all;
  for (const SceneSurface & surface : surfaces)
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
    for (const auto & point : found->surface->GetPoints())
    {
      box = box.value_or(itk::PointBox{ point, point });
      box->Add(point);
    }
    all.push_back(ComputeTriangleSurfaceSignedDistances(*surface.surface, itk::TriangleTree(*found->surface)));
  }
  if (box)
  {
    RequireSamePlace(by.file,
                     { box->lowest[0], box->lowest[1], box->lowest[2] },
                     { box->highest[0], box->highest[1], box->highest[2] },
                     surfaces);
  }
  return all;
}

/** Numbers of the points of all surfaces, and what they are. */
struct NamedValues
{
  std::vector<Values> all;
  std::string title; ///< "distance, mm"
  std::string name;  ///< "distance_mm"
};

/** What a volume's values are called. */
NamedValues
NameVolume(const ColourBy & by, VolumeValues sampled)
{
  const std::string unit = sampled.unit;
  std::string word = unit.empty() ? "value" : unit;
  std::string name = unit == "SUV" ? "SUVbw_g_per_ml" : unit.empty() ? "value" : "value_" + unit;
  for (std::size_t slash = 0; (slash = name.find('/')) != name.npos;)
  {
    name.replace(slash, 1, "_per_");
  }
  if (by.summary != ColourBy::Summary::AtSurface)
  {
    const std::string which = by.summary == ColourBy::Summary::Mean ? "mean" : "max";
    word += ", " + which + " in " + FormatNumber(by.depth) + " mm";
    name = which + "_" + name;
  }
  return { std::move(sampled.values), word, name };
}

/** Measures what surfaces are coloured by. */
NamedValues
MeasureValues(const ColourBy & by,
              const std::string & frameOfReference,
              const std::vector<SceneSurface> & surfaces,
              const Events & events)
{
  switch (by.kind)
  {
    case ColourBy::Kind::Distance:
      return { MeasureDistances(by, surfaces, events), TitleOfDistances, NameOfDistances };
    case ColourBy::Kind::Volume:
      return NameVolume(by, SampleVolume(by, frameOfReference, surfaces, events));
    case ColourBy::Kind::Curvature:
    case ColourBy::Kind::Thickness:
      break;
  }
  const bool isCurvature = by.kind == ColourBy::Kind::Curvature;
  NamedValues found{ {},
                     isCurvature ? "curvature, 1/mm" : "thickness, mm",
                     isCurvature ? "curvature_per_mm" : "thickness_mm" };
  for (const SceneSurface & surface : surfaces)
  {
    events.Progress("colouring", static_cast<double>(found.all.size()) / static_cast<double>(surfaces.size()));
    found.all.push_back(
      isCurvature ? ComputeTriangleSurfaceMeanCurvature(*surface.surface, by.radius)
                  : ComputeTriangleSurfaceThickness(*surface.surface, itk::TriangleTree(*surface.surface)).balls);
  }
  return found;
}

/** Whether numbers have two sides of 0. */
bool
HasTwoSides(const ColourBy & by)
{
  return by.kind == ColourBy::Kind::Distance || by.kind == ColourBy::Kind::Curvature;
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
  if (HasTwoSides(by))
  {
    std::transform(known.begin(), known.end(), known.begin(), [](float value) { return std::abs(value); });
    std::sort(known.begin(), known.end());
    const double smallest = by.kind == ColourBy::Kind::Distance ? 0.1 : 0.001; // mm and 1/mm
    const double most = std::max(at(0.95), smallest);
    return { -most, most };
  }
  return { at(0.02), at(0.98) };
}

/** A length written as 5mm or 5; nothing for other texts. */
std::optional<double>
LengthIn(std::string text)
{
  const std::string unit = "mm";
  if (text.size() > unit.size() && text.compare(text.size() - unit.size(), unit.size(), unit) == 0)
  {
    text.resize(text.size() - unit.size());
  }
  const auto length = ToNumber<double>(text);
  return length && *length > 0.0 && *length <= 1000.0 ? length : std::nullopt;
}

/** The text behind a beginning, if a text has it. */
std::optional<std::string>
TextAfter(const std::string & beginning, const std::string & text)
{
  return text.compare(0, beginning.size(), beginning) == 0 ? std::optional(text.substr(beginning.size()))
                                                           : std::nullopt;
}

/** Sets what the first part of a text names. Returns whether it names something. */
bool
ParseSubject(const std::string & text, ColourBy & by)
{
  if (const auto other = TextAfter("distance:", text))
  {
    by.kind = ColourBy::Kind::Distance;
    by.file = *other;
    return !other->empty();
  }
  if (text == "thickness")
  {
    by.kind = ColourBy::Kind::Thickness;
    return true;
  }
  const auto radius = TextAfter("curvature:", text);
  if (text == "curvature" || radius)
  {
    by.kind = ColourBy::Kind::Curvature;
    const auto length = radius ? LengthIn(*radius) : std::optional(by.radius);
    by.radius = length.value_or(by.radius);
    return length.has_value();
  }
  by.file = text;
  return !text.empty();
}

/** Sets what a further part of a text, which is no number, tells. Returns whether it tells something. */
bool
ParseDetail(const std::string & text, ColourBy & by)
{
  const auto mean = TextAfter("mean:", text);
  const auto maximum = TextAfter("max:", text);
  if (mean || maximum)
  {
    const auto depth = LengthIn(mean ? *mean : *maximum);
    by.summary = mean ? ColourBy::Summary::Mean : ColourBy::Summary::Maximum;
    by.depth = depth.value_or(0.0);
    return depth && by.kind == ColourBy::Kind::Volume;
  }
  by.map = text;
  ColourOf({ by.map, 0.0, 1.0, "" }, 0.0); // throws for an unknown map
  return true;
}

/** The shares of points outside of a scale, and without values. */
struct OutsideShares
{
  double below = 0.0; ///< in percent, and next
  double above = 0.0;
  double unknown = 0.0;
};

OutsideShares
FindOutside(const Values & known, std::size_t points, const ColourScale & scale)
{
  const auto percentOf = [points](std::ptrdiff_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, points));
  };
  const auto low = std::lower_bound(known.begin(), known.end(), static_cast<float>(scale.low));
  const auto high = std::upper_bound(known.begin(), known.end(), static_cast<float>(scale.high));
  return { percentOf(low - known.begin()),
           percentOf(known.end() - high),
           percentOf(static_cast<std::ptrdiff_t>(points) - static_cast<std::ptrdiff_t>(known.size())) };
}

void
NoteColours(const ColourScale & scale, const Values & known, const OutsideShares & outside, const Events & events)
{
  if (outside.unknown > 0.0)
  {
    events.Note(FormatFixed(outside.unknown, 1) + " % of the surfaces' points have no value, and are grey");
  }
  events.Note("colours by " + scale.title + ": " + FormatNumber(known.front(), 4) + " to " +
              FormatNumber(known.back(), 4) + ", scale from " + FormatNumber(scale.low, 4) + " to " +
              FormatNumber(scale.high, 4) + "; " + FormatFixed(outside.below, 1) + " % of the points lie below and " +
              FormatFixed(outside.above, 1) + " % above, and have the colours of its ends");
}

/** Colours surfaces by the numbers of their points. */
SurfaceColours
Paint(const ColourBy & by, NamedValues found, std::vector<SceneSurface> & surfaces, const Events & events)
{
  static const std::map<ColourBy::Kind, std::string> kinds{ { ColourBy::Kind::Volume, "volume" },
                                                            { ColourBy::Kind::Distance, "distance" },
                                                            { ColourBy::Kind::Curvature, "curvature" },
                                                            { ColourBy::Kind::Thickness, "thickness" } };
  const Values known = SortKnown(found.all);
  if (known.empty())
  {
    throw Failure(FailureKind::Geometry,
                  by.file.empty()
                    ? "No point of the surfaces has a " + kinds.at(by.kind) +
                        ": they are open, or have no area; repair them first."
                    : by.file.string() + " reaches no point of the surfaces; check that it is of the same "
                                         "patient and in the same space.");
  }
  SurfaceColours colours;
  ColourScale & scale = colours.scale;
  scale.map = !by.map.empty() ? by.map : HasTwoSides(by) ? "diverging" : "viridis";
  std::tie(scale.low, scale.high) = FindRange(by, known);
  scale.title = found.title;
  std::size_t points = 0;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    Values & values = found.all[n];
    points += values.size();
    auto ofPoints = std::make_shared<PointColours>(values.size());
    std::transform(
      values.begin(), values.end(), ofPoints->begin(), [&](float value) { return ToBytes(ColourOf(scale, value)); });
    surfaces[n].pointColours = std::move(ofPoints);
    surfaces[n].pointValues = std::make_shared<PointValues>(PointValues{ found.name, std::move(values) });
  }
  const OutsideShares outside = FindOutside(known, points, scale);
  NoteColours(scale, known, outside, events);
  colours.report = { { "by", kinds.at(by.kind) },
                     { "title", scale.title },
                     { "map", scale.map },
                     { "low", scale.low },
                     { "high", scale.high },
                     { "lowestValue", known.front() },
                     { "highestValue", known.back() },
                     { "pointsBelowInPercent", outside.below },
                     { "pointsAboveInPercent", outside.above },
                     { "pointsWithoutValueInPercent", outside.unknown } };
  return colours;
}

} // namespace

ColourBy
ParseColourBy(const std::string & text)
{
  const std::vector<std::string> fields = Split(text, ",");
  ColourBy by;
  bool isKnown = ParseSubject(fields.front(), by);
  std::vector<double> numbers;
  for (std::size_t n = 1; n < fields.size(); ++n)
  {
    if (const auto number = ToNumber<double>(fields[n]))
    {
      numbers.push_back(*number);
    }
    else
    {
      isKnown = ParseDetail(fields[n], by) && isKnown;
    }
  }
  const bool hasRange = numbers.size() == 2 && numbers[0] < numbers[1];
  if ((!numbers.empty() && !hasRange) || !isKnown)
  {
    throw Failure(
      FailureKind::Usage,
      "'" + text +
        "' says not what to colour by; write pet.nii.gz,0,7,inferno, pet.nii.gz,max:5mm, distance:other.stl,-2,2, "
        "thickness or curvature:3mm, with the lower value first.");
  }
  if (hasRange)
  {
    by.range = { numbers[0], numbers[1] };
  }
  return by;
}

std::vector<std::filesystem::path>
InputsOf(const std::optional<ColourBy> & by)
{
  if (!by || by->file.empty())
  {
    return {};
  }
  std::error_code error;
  if (!std::filesystem::exists(by->file, error))
  {
    throw Failure(FailureKind::NotFound, "There is no " + by->file.string() + " to colour by; check its name.");
  }
  return { by->file };
}

ColourBytes
CountColourBytes(const ColourBy & by)
{
  constexpr std::uintmax_t perByteOfFile = 5; // with a tree; PLY files have some 20 bytes a triangle
  ColourBytes bytes;
  if (by.kind == ColourBy::Kind::Distance)
  {
    std::error_code error; // the size of a folder, or where reading will fail
    const std::uintmax_t size = std::filesystem::file_size(by.file, error);
    bytes.others = error ? 0 : perByteOfFile * size;
  }
  if (by.kind == ColourBy::Kind::Volume)
  {
    const ScanSource source = SourceOfVolume(by);
    const UnreadScan file = OpenScan(source.path, source.read);
    const auto count = [](const auto & image) -> std::uintmax_t {
      return image->GetLargestPossibleRegion().GetNumberOfPixels() *
             sizeof(typename std::decay_t<decltype(*image)>::PixelType);
    };
    const bool isInMemory = !file.findPlace || file.findPlace() == VoxelPlace::Memory;
    bytes.voxels = isInMemory ? std::visit(count, file.scan.image) : 0;
  }
  return bytes;
}

SurfaceColours
ColourSurfaces(const ColourBy & by,
               const std::string & frameOfReference,
               std::vector<SceneSurface> & surfaces,
               const Events & events)
{
  events.Progress("colouring", 0.0);
  return Paint(by, MeasureValues(by, frameOfReference, surfaces, events), surfaces, events);
}

SurfaceColours
ColourSurfacesByDistance(const std::vector<itk::TriangleSurface::ConstPointer> & others,
                         const std::optional<std::pair<double, double>> & range,
                         std::vector<SceneSurface> & surfaces,
                         const Events & events)
{
  events.Progress("colouring", 0.0);
  ColourBy by;
  by.kind = ColourBy::Kind::Distance;
  by.range = range;
  std::vector<Values> all;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const itk::TriangleSurface & surface = *surfaces[n].surface;
    all.push_back(others[n] != nullptr ? ComputeTriangleSurfaceSignedDistances(surface, itk::TriangleTree(*others[n]))
                                       : Values(surface.GetNumberOfPoints(), NoValue));
  }
  return Paint(by, { std::move(all), TitleOfDistances, NameOfDistances }, surfaces, events);
}

} // namespace rhombic
