#include "rhombicCommands.h"
#include "rhombicIntensities.h"
#include "rhombicScanOptions.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

namespace rhombic
{
namespace
{

using Json = nlohmann::ordered_json;

struct InfoOptions
{
  ScanOptions scan;
  bool isJson = false;
};

/** A threshold worth trying, and what it shows. */
struct Suggestion
{
  const char * surface;
  double isovalue;
};

std::vector<Suggestion>
Suggest(const std::string & modality, const Intensities & intensities)
{
  std::vector<Suggestion> suggestions{ { "foreground (Otsu)", intensities.otsu } };
  constexpr double nearAir = -900.0; // raw numbers of an uncalibrated CT don't go below 0
  if ((modality == "CT" || modality.empty()) && intensities.lowest < nearAir)
  {
    for (const Suggestion & organ :
         { Suggestion{ "skin", -300.5 }, Suggestion{ "lungs, below", -500.5 }, Suggestion{ "bone", 250.5 } })
    {
      if (organ.isovalue > intensities.lowest && organ.isovalue <= intensities.highest)
      {
        suggestions.push_back(organ);
      }
    }
  }
  return suggestions;
}

/** For each image axis, the letter of the anatomical direction nearest to it: LPS for LPS. */
std::string
OrientationLetters(const itk::ImageBase<3>::DirectionType & direction)
{
  constexpr char letters[3][2] = { { 'L', 'R' }, { 'P', 'A' }, { 'S', 'I' } };
  std::string text;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    unsigned int nearest = 0;
    for (unsigned int row = 1; row < 3; ++row)
    {
      nearest = std::abs(direction[row][axis]) > std::abs(direction[nearest][axis]) ? row : nearest;
    }
    text += letters[nearest][direction[nearest][axis] < 0.0 ? 1 : 0];
  }
  return text;
}

Json
DescribeScan(const Scan & scan)
{
  const auto & geometry = GeometryOf(scan.image);
  const auto & size = geometry.GetLargestPossibleRegion().GetSize();
  const auto & direction = geometry.GetDirection();
  const auto intensities = ComputeIntensities(scan.image);

  Json json;
  json["format"] = scan.format;
  json["modality"] = scan.modality;
  json["pixelType"] = PixelTypeName(scan.image);
  json["size"] = { size[0], size[1], size[2] };
  json["spacing"] = { geometry.GetSpacing()[0], geometry.GetSpacing()[1], geometry.GetSpacing()[2] };
  json["origin"] = { geometry.GetOrigin()[0], geometry.GetOrigin()[1], geometry.GetOrigin()[2] };
  for (unsigned int row = 0; row < 3; ++row)
  {
    json["direction"].push_back({ direction[row][0], direction[row][1], direction[row][2] });
  }
  json["orientation"] = scan.isOriented ? OrientationLetters(direction) : "unknown";
  json["range"] = { intensities.lowest, intensities.highest };
  for (const Suggestion & suggestion : Suggest(scan.modality, intensities))
  {
    json["suggestedThresholds"].push_back({ { "surface", suggestion.surface }, { "isovalue", suggestion.isovalue } });
  }
  json["series"] = Json::array();
  for (const SeriesSummary & series : scan.series)
  {
    json["series"].push_back({ { "number", series.number },
                               { "id", series.id },
                               { "seriesNumber", series.seriesNumber },
                               { "modality", series.modality },
                               { "files", series.numberOfFiles },
                               { "size", series.size },
                               { "chosen", series.chosen } });
  }
  json["filesSkipped"] = scan.filesSkipped;
  json["notes"] = scan.notes;
  return json;
}

Json
DescribeLattice(const FCCVolume & volume)
{
  Json json;
  std::visit(
    [&](const auto & image) {
      const auto & size = image->GetLargestPossibleRegion().GetSize();
      const auto & spacing = image->GetSpacing();
      const auto & origin = image->GetOrigin();
      json["format"] = "lattice volume (face-centered cubic)";
      json["size"] = { size[0], size[1], size[2] };
      json["spacing"] = { spacing[0], spacing[1], spacing[2] };
      json["origin"] = { origin[0], origin[1], origin[2] };
      json["orientation"] = OrientationLetters(image->GetDirection());
    },
    volume);
  const auto intensities = ComputeIntensities(volume);
  json["range"] = { intensities.lowest, intensities.highest };
  json["suggestedThresholds"] = { { { "surface", "foreground (Otsu)" }, { "isovalue", intensities.otsu } } };
  return json;
}

std::string
ToText(const Json & value)
{
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_number_float())
  {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << value.get<double>();
    return text.str();
  }
  if (!value.is_array())
  {
    return value.dump();
  }
  std::string text;
  for (const Json & item : value)
  {
    text += (text.empty() ? "" : " x ") + ToText(item);
  }
  return text;
}

void
Print(const Json & json)
{
  const auto line = [](const std::string & name, const std::string & text) {
    std::cout << name << std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') << text << '\n';
  };
  line("format", ToText(json["format"]));
  for (const auto & [key, unit] : { std::pair<const char *, const char *>{ "modality", "" },
                                    { "pixelType", "" },
                                    { "size", " samples" },
                                    { "spacing", " mm" },
                                    { "orientation", "" } })
  {
    if (json.contains(key) && !ToText(json[key]).empty())
    {
      line(key, ToText(json[key]) + unit);
    }
  }
  line("origin",
       ToText(json["origin"][0]) + ", " + ToText(json["origin"][1]) + ", " + ToText(json["origin"][2]) + " mm (LPS)");
  line("values", ToText(json["range"][0]) + " to " + ToText(json["range"][1]));
  for (const Json & suggestion : json["suggestedThresholds"])
  {
    line("threshold", ToText(suggestion["isovalue"]) + "  " + ToText(suggestion["surface"]));
  }
  for (const Json & series : json.value("series", Json::array()))
  {
    line("series " + series["number"].dump(),
         ToText(series["modality"]) + " " + ToText(series["size"]) + ", " + series["files"].dump() + " files, id " +
           ToText(series["id"]) + (series["chosen"].get<bool>() ? "  <- chosen" : ""));
  }
  for (const auto & [reason, count] : json.value("filesSkipped", Json::object()).items())
  {
    line("skipped", count.dump() + " " + reason);
  }
  for (const Json & note : json.value("notes", Json::array()))
  {
    line("note", ToText(note));
  }
}

void
Info(const InfoOptions & options)
{
  const ScanSource source = options.scan.GetSource();
  const Json json = IsFCCImageFile(source.path) ? DescribeLattice(ReadFCCImage(source.path))
                                                : DescribeScan(ReadScan(source.path, source.read));
  if (options.isJson)
  {
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  }
  else
  {
    Print(json);
  }
}

} // namespace

CommandRun
AddInfoCommand(CLI::App & parser)
{
  const auto options = std::make_shared<InfoOptions>();
  options->scan.AddSource(parser);
  parser.add_flag("--json", options->isJson, "as JSON, on standard output");
  return [options](const CommandContext &) { Info(*options); };
}

} // namespace rhombic
