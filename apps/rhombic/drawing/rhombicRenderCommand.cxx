#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPresets.h"
#include "rhombicRenderScan.h"
#include "rhombicScanOptions.h"
#include "rhombicFinishOptions.h"
#include "rhombicNamedValues.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceOptions.h"
#include "rhombicTextFile.h"
#include "rhombicVTPToPLY.h"
#include "rhombicWording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>

namespace rhombic
{
namespace
{

/** What stands for a further surface file in reports, before a number. */
const std::string FurtherFile = "FILE-";

struct RenderOptions
{
  ScanOptions scan;
  std::vector<std::string> furtherFiles;
  SurfaceOptions surfaces;
  FinishOptions finish;
  std::string picture;
  std::vector<std::string> views;
  std::vector<std::string> slices;
  std::size_t lightbox = 0;
  std::size_t turntable = 0;
  std::size_t onlyPicture = 0;
  bool isSheet = false;
  bool isLandscape = false;
  bool writesDicom = false;
  double pixelsPerInch = 200.0;

  std::string style;
  std::string size;
  std::string background;
  double zoom = 1.0;
  std::optional<double> pixelSize;
  bool hasSameScale = false;
  std::string focus;
  bool isPerspective = false;
  bool hasNoShadows = false;
  bool hasNoSilhouettes = false;
  std::vector<std::string> cuts;
  std::vector<std::string> uncut;
  std::vector<std::string> planes;

  std::string window = "auto";
  bool isNeurological = false;
  bool hasNoOutlines = false;

  std::vector<std::string> annotations{ "letters", "scale", "legend" };
  bool hasNoLetters = false;
  std::string title;
  std::string from;
  bool listsPresets = false;
};

void
AddOptions(RenderOptions & options, CLI::App & parser);

void
ListPresets()
{
  for (const Preset & preset : GetPresets())
  {
    std::cout << preset.name << "\n    " << preset.description << '\n';
    for (const SurfaceRequest & surface : preset.surfaces)
    {
      std::cout << "    " << surface.name << (surface.insideIsBelow ? " below " : " from ");
      if (surface.isovalue)
      {
        std::cout << *surface.isovalue;
      }
      else
      {
        std::cout << (surface.otsu == &Intensities::otsu       ? "Otsu's threshold"
                      : surface.otsu == &Intensities::lowOtsu  ? "Otsu's threshold of the values below Otsu's"
                      : surface.otsu == &Intensities::highOtsu ? "Otsu's threshold of the values above Otsu's"
                                                               : "the third Otsu's threshold towards low values");
      }
      std::cout << (surface.opacity < 1.0 ? ", translucent" : "") << '\n';
    }
    if (preset.denoising.kind == Denoising::Kind::Gaussian)
    {
      std::cout << "    smoothed: --denoise gaussian:" << preset.denoising.sigma << '\n';
    }
  }
}

/** "1200", "1600x1200", or with 0 or nothing for a side that fits: "1200x0". */
void
ParseSize(const std::string & text, RenderSettings & render)
{
  render.width = render.height = 0;
  if (text.empty())
  {
    return;
  }
  const char * const end = text.data() + text.size();
  auto parsed = std::from_chars(text.data(), end, render.width);
  render.height = render.width;
  if (parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == 'x')
  {
    parsed = std::from_chars(parsed.ptr + 1, end, render.height);
  }
  constexpr int smallest = 32; // on which there is room for a letter
  const auto isSide = [](int side) { return side == 0 || side >= smallest; };
  if (parsed.ec != std::errc() || parsed.ptr != end || !isSide(render.width) || !isSide(render.height) ||
      render.width + render.height == 0)
  {
    throw Failure(FailureKind::Usage,
                  "'" + text +
                    "' is no picture size; write it as 1200, 1600x1200, or 1200x0 for a height that fits, "
                    "with sides of at least " +
                    std::to_string(smallest) + " pixels.");
  }
}

std::vector<View>
ParseViews(const RenderOptions & options)
{
  if (options.views.empty())
  {
    const bool drawsOthers = !options.slices.empty() && options.turntable == 0;
    return drawsOthers ? std::vector<View>{} : std::vector<View>{ View() };
  }
  std::vector<View> views;
  for (const std::string & text : options.views)
  {
    if (text == "all")
    {
      views.insert(views.end(), StandardViews().begin(), StandardViews().end());
    }
    else
    {
      views.push_back(ViewFromText(text));
    }
  }
  return views;
}

PictureStyle
ParseStyle(const std::string & text)
{
  static const NamedValues<PictureStyle> styles{ { "clinic", PictureStyle::Clinic },
                                                 { "paper", PictureStyle::Paper },
                                                 { "transparent", PictureStyle::Transparent } };
  return FindNamed("style", text, styles);
}

AnnotationSettings
ParseAnnotations(const RenderOptions & options)
{
  AnnotationSettings settings;
  settings.letters = settings.scaleBar = settings.legend = false;
  static const NamedValues<bool AnnotationSettings::*> known{ { "letters", &AnnotationSettings::letters },
                                                              { "scale", &AnnotationSettings::scaleBar },
                                                              { "legend", &AnnotationSettings::legend },
                                                              { "figure", &AnnotationSettings::figure },
                                                              { "footnote", &AnnotationSettings::footnote } };
  for (const std::string & word : options.annotations)
  {
    if (word != "none")
    {
      settings.*FindNamed("annotation", word, known) = true;
    }
  }
  settings.letters = settings.letters && !options.hasNoLetters;
  settings.title = options.title;
  return settings;
}

template <typename TRequest>
std::vector<TRequest>
ParseAll(const std::vector<std::string> & texts, TRequest (*parse)(const std::string &))
{
  std::vector<TRequest> requests;
  std::transform(texts.begin(), texts.end(), std::back_inserter(requests), parse);
  return requests;
}

bool
IsSurfaceFile(const std::filesystem::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  const std::vector<std::string> known = Split(GetSurfaceFileExtensions(), ", ");
  return !extension.empty() && std::find(known.begin(), known.end(), extension) != known.end();
}

/** The source, without the preset that auto chooses: FinishSource() reads the scan for it. */
PictureSource
GetPictureSource(const RenderOptions & options, const CommandContext & context)
{
  PictureSource source;
  source.scan = options.scan.GetSource(context);
  source.finish = options.finish.Get();
  const bool isOfFiles = IsSurfaceFile(source.scan.path);
  if (!isOfFiles && !options.furtherFiles.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Several inputs can only be surface files (" + GetSurfaceFileExtensions() +
                    "); give one scan at a time, and a label map with --labels.");
  }
  if (isOfFiles)
  {
    if (options.surfaces.ChoosesSurfaces())
    {
      throw Failure(FailureKind::Usage,
                    "--preset, --surface, --labels and --label choose surfaces of a scan; of surface files, --only and "
                    "--hide choose some, and --draw sets colours.");
    }
    source.surfaceFiles = { source.scan.path };
    source.surfaceFiles.insert(source.surfaceFiles.end(), options.furtherFiles.begin(), options.furtherFiles.end());
    source.surfaces.rules = options.surfaces.GetRules();
  }
  else
  {
    source.surfaces = options.surfaces.GetSelection(options.surfaces.GetNamedPreset());
  }
  return source;
}

/** Completes a source that was checked. \param places of slices, checked when the headers are read */
void
FinishSource(const RenderOptions & options,
             const CommandContext & context,
             const std::vector<PlaneRequest> & places,
             PictureSource & source)
{
  if (!source.surfaceFiles.empty())
  {
    return;
  }
  source.scan.check = [places](const Scan & scan) { CheckPlaces(places, scan); };
  const Preset preset = options.surfaces.GetPreset(source.scan, context.console->MakeEvents());
  options.scan.ApplyPreset(preset, source.scan);
  source.surfaces = options.surfaces.GetSelection(preset);
  source.surfaces.rules.opensEnclosing = source.surfaces.labels && source.surfaces.labels->labels.empty();
}

SliceSettings
GetSliceSettings(const RenderOptions & options)
{
  SliceSettings slice;
  slice.window = options.window;
  slice.convention = options.isNeurological ? SliceConvention::Neurological : SliceConvention::Radiological;
  slice.outlines = !options.hasNoOutlines;
  slice.lightbox = options.lightbox;
  return slice;
}

/** Where a batch wants a small picture, which no picture before has made. From the environment, so that it is not in
 * reports. */
std::filesystem::path
FindThumbnail()
{
  const char * const path = std::getenv("RHOMBIC_THUMBNAIL");
  return path == nullptr || std::filesystem::exists(path) ? "" : path;
}

/** Returns the files, or in a check those that would be written. */
std::vector<std::filesystem::path>
RenderPage(const RenderOptions & options, const CommandContext & context, const Provenance & provenance)
{
  RenderSheetSettings settings;
  settings.source = GetPictureSource(options, context);
  settings.page = options.picture;
  if (!options.views.empty())
  {
    settings.views = ParseViews(options);
  }
  settings.slices = ParseAll(options.slices, ParsePlaneRequest);
  settings.slice = GetSliceSettings(options);
  settings.style = options.style.empty() ? PictureStyle::Paper : ParseStyle(options.style);
  if (settings.style == PictureStyle::Transparent)
  {
    throw Failure(FailureKind::Usage, "Pages are not transparent; use --style paper or clinic.");
  }
  settings.title = options.title;
  settings.isLandscape = options.isLandscape;
  settings.pixelsPerInch = options.pixelsPerInch;
  settings.writesDicom = options.writesDicom;
  settings.thumbnail = FindThumbnail();
  settings.provenance = provenance;
  auto planned = CheckRenderSheet(settings);
  if (context.planned != nullptr)
  {
    return planned;
  }
  FinishSource(options, context, settings.slices, settings.source);
  return RenderSheet(settings, context.console->MakeEvents());
}

/** As RenderPage(). */
std::vector<std::filesystem::path>
RenderPictures(const RenderOptions & options, const CommandContext & context, const Provenance & provenance)
{
  RenderScanSettings settings;
  settings.source = GetPictureSource(options, context);
  settings.picture = options.picture;
  settings.views = ParseViews(options);
  settings.slices = ParseAll(options.slices, ParsePlaneRequest);
  settings.planes = ParseAll(options.planes, ParsePlaneRequest);
  settings.cuts = ParseAll(options.cuts, ParseCutRequest);
  settings.uncut = options.uncut;
  settings.slice = GetSliceSettings(options);
  settings.turntable = options.turntable;
  settings.onlyPicture = options.onlyPicture;
  settings.focus = options.focus;
  ParseSize(options.size, settings.render);
  settings.render.style = options.style.empty() ? PictureStyle::Clinic : ParseStyle(options.style);
  settings.writesDicom = options.writesDicom;
  if (settings.writesDicom && settings.render.style == PictureStyle::Transparent)
  {
    throw Failure(FailureKind::Usage, "DICOM pictures are not transparent; use --style paper or clinic.");
  }
  if (!options.background.empty())
  {
    settings.render.background = ParseColour(options.background);
  }
  settings.render.perspective = options.isPerspective;
  settings.render.zoom = options.zoom;
  settings.render.pixelSize = options.pixelSize;
  settings.render.sameScale = options.hasSameScale;
  settings.render.ambientOcclusion = !options.hasNoShadows;
  settings.render.silhouettes = !options.hasNoSilhouettes;
  settings.annotations = ParseAnnotations(options);
  settings.thumbnail = FindThumbnail();
  settings.provenance = provenance;
  auto planned = CheckRenderScan(settings);
  if (context.planned != nullptr)
  {
    return planned;
  }
  std::vector<PlaneRequest> places = settings.slices;
  places.insert(places.end(), settings.planes.begin(), settings.planes.end());
  for (const CutRequest & cut : settings.cuts)
  {
    places.push_back(cut.plane);
  }
  FinishSource(options, context, places, settings.source);
  return RenderScan(settings, context.console->MakeEvents());
}

/** Throws Failure(Usage) for a file name that only other options or programs write. */
void
CheckEnding(const RenderOptions & options)
{
  const std::string ending = LowerCase(std::filesystem::path(options.picture).extension().string());
  if (ending == ".dcm")
  {
    throw Failure(FailureKind::Usage,
                  "DICOM files are written beside pictures: name a .png file, and add --dicom-sc, which copies the "
                  "patient's name and study into a DICOM file.");
  }
  if ((ending == ".gif" && options.turntable == 0) || (ending == ".pdf" && !options.isSheet))
  {
    throw Failure(FailureKind::Usage,
                  "Only " + std::string(ending == ".gif" ? "--turntable" : "--sheet") + " writes " + ending +
                    " files; use it, or name a .png, .jpg, .tif or .exr file.");
  }
  if (ending == ".mp4" || ending == ".webm" || ending == ".avi" || ending == ".mov")
  {
    throw Failure(FailureKind::Usage,
                  "Videos are not written; make a .gif, or numbered pictures with -o turn.png, which ffmpeg -i "
                  "turn-%03d.png turn" +
                    ending + " joins.");
  }
}

/** Whether an argument is an option, or an option and its value: --view or --view=left. */
bool
IsOption(const std::string & argument, const std::string & option)
{
  return argument == option || argument.rfind(option + "=", 0) == 0;
}

/** The arguments in a picture's report that draw this picture, without those that a new command gives: the scan, the
 * label map, the output, and perhaps the views and slices. */
std::vector<std::string>
ReadArguments(const std::string & path, bool areViewsGiven)
{
  const auto report = nlohmann::json::parse(ReadTextFile(path, "report"), nullptr, false);
  const auto stored = report.is_object() ? report.value("arguments", nlohmann::json()) : nlohmann::json();
  const auto command = std::find(stored.begin(), stored.end(), "render"); // options of all commands may stand before
  if (!stored.is_array() || command == stored.end())
  {
    throw Failure(FailureKind::Unreadable,
                  "The file " + path + " is no report of rhombic render; name the .json beside a picture.");
  }
  std::vector<std::string> left{ "-o", "--output", "--labels", "--probabilities" };
  if (areViewsGiven)
  {
    left.insert(left.end(), { "--view", "--slice", "--picture" });
  }
  std::vector<std::string> arguments;
  for (auto n = static_cast<std::size_t>(command - stored.begin()) + 1; n < stored.size(); ++n)
  {
    const std::string argument = stored[n].is_string() ? stored[n].get<std::string>() : "";
    const bool isLeft =
      std::any_of(left.begin(), left.end(), [&](const std::string & option) { return IsOption(argument, option); });
    const bool isGiven = argument == "SCAN" || argument.rfind("PROBABILITIES", 0) == 0 || argument == "--dicom-sc" ||
                         argument.rfind(FurtherFile, 0) == 0 || (argument.rfind("-o", 0) == 0 && argument.size() > 2);
    n += isLeft && argument.find('=') == std::string::npos ? 1 : 0;
    if (!isLeft && !isGiven)
    {
      arguments.push_back(argument);
    }
  }
  if (!areViewsGiven && report.contains("picture"))
  {
    arguments.insert(arguments.end(), { "--picture", report["picture"].dump() });
  }
  return arguments;
}

void
Render(const RenderOptions & options, const CommandContext & context);

/** Draws with the options of a report, and those of this command but --from. */
void
RenderAgain(const RenderOptions & options, const CommandContext & context)
{
  CommandContext again = context;
  again.arguments = { "render" };
  const std::vector<std::string> stored =
    ReadArguments(options.from, !options.views.empty() || !options.slices.empty());
  again.arguments.insert(again.arguments.end(), stored.begin(), stored.end());
  bool isSkipped = false; // --from, with its value
  bool isCommandFound = false;
  for (const std::string & argument : context.arguments)
  {
    const bool isFrom = argument == "--from";
    const bool isCommand = argument == "render" && !isCommandFound;
    isCommandFound = isCommandFound || isCommand;
    if (!isSkipped && !isFrom && argument.rfind("--from=", 0) != 0 && !isCommand)
    {
      again.arguments.push_back(argument);
    }
    isSkipped = isFrom;
  }
  CLI::App parser("", "rhombic render");
  unsigned int threads = 0; // options of all commands have had their effect
  parser.add_option("--threads", threads);
  parser.add_flag("-v,--verbose,-q,--quiet");
  RenderOptions all;
  AddOptions(all, parser);
  std::vector<std::string> reversed(again.arguments.rbegin(), again.arguments.rend() - 1);
  try
  {
    parser.parse(reversed);
  }
  catch (const CLI::ParseError & error)
  {
    throw Failure(FailureKind::Usage,
                  "The options of " + options.from + " do not go with those of this command: " + error.what() + ".");
  }
  Render(all, again);
}

void
Render(const RenderOptions & options, const CommandContext & context)
{
  if (!options.from.empty())
  {
    RenderAgain(options, context);
    return;
  }
  if (options.listsPresets)
  {
    ListPresets();
    return;
  }
  if (options.picture.empty())
  {
    throw Failure(FailureKind::Usage, "No picture is named; give one with -o, for example -o picture.png.");
  }
  CheckEnding(options);
  std::map<std::string, std::string> names = options.surfaces.GetNames();
  for (const std::string & file : options.furtherFiles)
  {
    names[FurtherFile + std::to_string(names.size())] = file;
  }
  const Provenance provenance = options.scan.GetProvenance(context, names);
  const auto paths =
    options.isSheet ? RenderPage(options, context, provenance) : RenderPictures(options, context, provenance);
  if (context.planned != nullptr)
  {
    context.planned->insert(context.planned->end(), paths.begin(), paths.end());
    return;
  }
  for (const auto & picture : paths)
  {
    context.console->Note("picture: " + picture.string());
  }
}

/** What is drawn, and from where. */
void
AddPictureOptions(RenderOptions & options, CLI::App & parser)
{
  parser
    .add_option(
      "--view",
      options.views,
      "anterior (default), posterior, left, right, superior, inferior or all; or azimuth,elevation in degrees, "
      "as 30,15: from the front towards the patient's left, and up; repeatable")
    ->allow_extra_args(false);
  parser
    .add_option(
      "--slice",
      options.slices,
      "a slice with the surfaces' outlines: axial, coronal or sagittal, and where: =12.5 (LPS mm), =#40 (of the "
      "scan), =liver (through its centroid); repeatable")
    ->allow_extra_args(false);
  parser
    .add_option("--lightbox", options.lightbox, "so many slices evenly along the axis of each --slice, in one picture")
    ->check(CLI::Range(2u, 400u));
  parser.add_flag("--sheet",
                  options.isSheet,
                  "a page (A4) instead: four views, three slices, a table of volumes; .png, .jpg, .tif or .pdf");
  parser.add_flag("--landscape", options.isLandscape, "a page that is wider than high");
  parser.add_option("--dpi", options.pixelsPerInch, "pixels per inch of a page")
    ->check(CLI::Range(36.0, 600.0))
    ->capture_default_str();
  parser
    .add_option("--turntable", options.turntable, "so many views around the patient: one .gif, or numbered pictures")
    ->check(CLI::Range(2u, 720u));
  parser.add_flag(
    "--dicom-sc",
    options.writesDicom,
    "also write each picture, page or turntable as a DICOM file beside it (.dcm, Secondary Capture): a new "
    "series in the scan's study, with the patient's name and study copied; of DICOM scans only");
  parser.add_option("--size", options.size, "width x height in pixels (default: what fits, the longer side 1200)");
  parser.add_option("--focus", options.focus, "fit the picture to surfaces by name, as 'kidney*' (default: all)");
  parser.add_option("--zoom", options.zoom, "enlarge")->check(CLI::PositiveNumber);
  parser.add_option("--pixel-size", options.pixelSize, "mm per pixel, for one scale in the pictures of several scans")
    ->check(CLI::PositiveNumber);
  parser.add_flag("--same-scale", options.hasSameScale, "all views at the scale of the view that needs most room");
  parser.add_flag("--perspective", options.isPerspective, "perspective instead of parallel projection");
  parser
    .add_option(
      "--cut",
      options.cuts,
      "remove what lies above (axial), in front (coronal) or left of a plane (sagittal), named as for --slice, "
      "or x>12, y<0, z>100 in LPS mm; cut faces show the scan; repeatable")
    ->allow_extra_args(false);
  parser.add_option("--uncut", options.uncut, "surfaces that are not cut, by name as --only")
    ->delimiter(',')
    ->allow_extra_args(false);
  parser
    .add_option("--show-slice", options.planes, "a slice that stands in the scene, named as for --slice; repeatable")
    ->allow_extra_args(false);
}

/** How it looks. */
void
AddLookOptions(RenderOptions & options, CLI::App & parser)
{
  parser.add_option("--style",
                    options.style,
                    "clinic (black; default of pictures), paper (white, for print; default of pages) or transparent");
  parser.add_option("--background", options.background, "a colour: #rrggbb, #rgb or a name, as white");
  parser.add_flag("--no-shadows", options.hasNoShadows, "do not darken cavities");
  parser.add_flag("--no-silhouettes", options.hasNoSilhouettes, "do not draw dark lines at outlines");
  parser
    .add_option(
      "--window", options.window, "greys of slices: a name, as bone, lung or brain, width/centre as 350/50, or auto")
    ->capture_default_str();
  parser.add_flag("--neurological", options.isNeurological, "slices with the patient's left on the left");
  parser.add_flag("--no-outlines", options.hasNoOutlines, "slices without the surfaces' outlines");
  parser
    .add_option(
      "--annotate",
      options.annotations,
      "what is written over pictures: letters (of directions), scale, legend (of two surfaces or more), figure, "
      "footnote; or none")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  parser.add_flag("--no-letters", options.hasNoLetters, "leave out the orientation letters at the edges");
  parser.add_option("--title", options.title, "a line above the picture, or the page's title");
}

/** Refuses options together that would not have an effect on each other. */
void
AddExclusions(CLI::App & parser)
{
  const std::vector<std::string> notOnPages{ "--cut",        "--uncut",          "--show-slice",  "--focus",
                                             "--zoom",       "--size",           "--turntable",   "--lightbox",
                                             "--background", "--no-silhouettes", "--perspective", "--no-shadows",
                                             "--annotate",   "--no-letters",     "--pixel-size",  "--same-scale" };
  for (const std::string & option : notOnPages)
  {
    parser.get_option("--sheet")->excludes(parser.get_option(option));
  }
  for (const char * option : { "--view", "--slice", "--lightbox" })
  {
    parser.get_option("--turntable")->excludes(parser.get_option(option));
  }
  for (const char * option : { "--zoom", "--perspective", "--same-scale" })
  {
    parser.get_option("--pixel-size")->excludes(parser.get_option(option));
  }
  parser.get_option("--lightbox")->needs(parser.get_option("--slice"));
  parser.get_option("--uncut")->needs(parser.get_option("--cut"));
  for (const char * option : { "--landscape", "--dpi" })
  {
    parser.get_option(option)->needs(parser.get_option("--sheet"));
  }
}

void
AddOptions(RenderOptions & options, CLI::App & parser)
{
  options.scan.AddSource(parser);
  parser.add_option("FILES", options.furtherFiles, "further surface files, if SCAN is one");
  parser.add_option(
    "-o,--output", options.picture, "the picture: .png, .jpg, .tif or .exr; .gif for a turntable, .pdf for a page");
  options.surfaces.Add(parser);
  options.finish.Add(parser);
  AddPictureOptions(options, parser);
  AddLookOptions(options, parser);
  AddExclusions(parser);
  parser.add_option("--from", options.from, "the options that a picture's report (PICTURE.json) holds");
  parser.add_option("--picture", options.onlyPicture)->group(""); // for --from: which one of several to draw, from 1
  parser.add_flag("--list-presets", options.listsPresets, "list the presets and stop");
  options.scan.AddLattice(parser);
  options.scan.AddSidecar(parser);
}

} // namespace

void
StartDrawingProgram(char **)
{
  // This is the drawing program.
}

VoxelRequest::Function
GetVTPConverter()
{
  return ConvertVTPToPLY;
}

CommandRun
AddRenderCommand(CLI::App & parser)
{
  const auto options = std::make_shared<RenderOptions>();
  AddOptions(*options, parser);
  return AddPipelineOption(parser, [options](const CommandContext & context) { Render(*options, context); });
}

} // namespace rhombic
