#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPresets.h"
#include "rhombicRenderPage.h"
#include "rhombicRenderScan.h"
#include "rhombicScanOptions.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceOptions.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

#include <algorithm>
#include <iostream>
#include <optional>

namespace rhombic
{
namespace
{

struct RenderOptions
{
  ScanOptions scan;
  std::vector<std::string> furtherFiles;
  SurfaceOptions surfaces;
  SurfaceFinish finish;
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
  std::string largestPage = "8M";
  bool hasNoSlices = false;

  std::string style;
  std::string size;
  std::string background;
  double zoom = 1.0;
  std::optional<double> pixelSize;
  bool hasSameScale = false;
  std::string focus;
  double ghost = 0.15;
  bool isPerspective = false;
  bool hasNoShadows = false;
  bool hasNoSilhouettes = false;
  std::vector<std::string> cuts;
  std::vector<std::string> uncut;
  std::vector<std::string> planes;
  std::string colourBy;

  std::string window = "auto";
  bool isNeurological = false;
  bool hasNoOutlines = false;

  std::vector<std::string> annotations{ "letters", "scale", "legend" };
  bool hasNoLetters = false;
  std::string title;
  std::string from;
  bool listsPresets = false;
  bool isDryRun = false;
  std::string thumbnail;
};

void
AddTables(RenderOptions & options, CommandSettings & command);

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
  const std::vector<std::string> sides = Split(text, "x");
  render.width = ToNumber<int>(sides.front()).value_or(-1);
  render.height = ToNumber<int>(sides.back()).value_or(-1);
  constexpr int smallest = 32; // on which there is room for a letter
  const auto isSide = [](int side) { return side == 0 || side >= smallest; };
  if (sides.size() > 2 || !isSide(render.width) || !isSide(render.height) || render.width + render.height == 0)
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
ParseStyle(const std::string & text, const std::string & usual)
{
  return FindNamed<PictureStyle>("style",
                                 text.empty() ? usual : text,
                                 { { "clinic", PictureStyle::Clinic },
                                   { "paper", PictureStyle::Paper },
                                   { "transparent", PictureStyle::Transparent } });
}

AnnotationSettings
ParseAnnotations(const RenderOptions & options)
{
  AnnotationSettings settings;
  settings.letters = settings.scaleBar = settings.legend = false;
  static const NamedValues<bool AnnotationSettings::*> known{
    { "letters", &AnnotationSettings::letters },   { "scale", &AnnotationSettings::scaleBar },
    { "legend", &AnnotationSettings::legend },     { "figure", &AnnotationSettings::figure },
    { "footnote", &AnnotationSettings::footnote }, { "names", &AnnotationSettings::names }
  };
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

/** The source, without the preset that auto chooses: FinishSource() reads the scan for it. */
PictureSource
GetPictureSource(const RenderOptions & options)
{
  PictureSource source;
  source.scan = options.scan.GetSource();
  source.finish = options.finish;
  CheckSurfaceFinish(source.finish);
  const bool isOfFiles = IsSurfacePath(source.scan.path);
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

/** Completes a source that was checked; returns what the scan's source holds, if it was read for that.
 * \param places of slices, checked when the headers are read */
std::optional<SourceVolume>
FinishSource(const RenderOptions & options,
             const CommandContext & context,
             const std::vector<PlaneRequest> & places,
             PictureSource & source)
{
  std::optional<SourceVolume> volume;
  if (!source.surfaceFiles.empty())
  {
    return volume;
  }
  source.scan.check = [places](const Scan & scan) { CheckPlaces(places, scan); };
  const Preset preset = options.surfaces.GetPreset(source.scan, volume, context.console->MakeEvents());
  options.scan.ApplyPreset(preset, source.scan);
  source.surfaces = options.surfaces.GetSelection(preset);
  return volume;
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

/** Returns the files, or in a check those that would be written. */
std::vector<MadeFile>
RenderSheetOf(const RenderOptions & options, const CommandContext & context)
{
  RenderSheetSettings settings;
  settings.source = GetPictureSource(options);
  settings.page = options.picture;
  settings.choosesViews = options.views.empty();
  if (!settings.choosesViews)
  {
    settings.views = ParseViews(options);
  }
  settings.slices = ParseAll(options.slices, ParsePlaneRequest);
  settings.slice = GetSliceSettings(options);
  settings.colourBy = GetColourBy(options.colourBy);
  settings.style = ParseStyle(options.style, "paper");
  if (settings.style == PictureStyle::Transparent)
  {
    throw Failure(FailureKind::Usage, "Pages are not transparent; use --style paper or clinic.");
  }
  const AnnotationSettings annotations = ParseAnnotations(options);
  if (annotations.figure || annotations.footnote)
  {
    throw Failure(FailureKind::Usage,
                  "The views of a page have no figure or footnote; choose letters, scale and names for --annotate.");
  }
  settings.letters = annotations.letters;
  settings.scaleBar = annotations.scaleBar;
  settings.names = annotations.names;
  settings.title = options.title;
  settings.isLandscape = options.isLandscape;
  settings.pixelsPerInch = options.pixelsPerInch;
  settings.writesDicom = options.writesDicom;
  settings.thumbnail = options.thumbnail;
  settings.provenance = options.scan.GetProvenance(*context.settings);
  std::vector<MadeFile> planned;
  AddOutputs(CheckRenderSheet(settings), "", planned);
  if (context.onlyChecks)
  {
    return planned;
  }
  if (options.isDryRun)
  {
    std::cout << PlanRenderSheet(settings, context.console->MakeEvents());
    return {};
  }
  auto volume = FinishSource(options, context, settings.slices, settings.source);
  return RenderSheet(settings, context.console->MakeEvents(), std::move(volume));
}

/** A number of bytes, as "8M" or "800k". Throws Failure(Usage). */
std::uintmax_t
ParseSizeOfPage(const std::string & text)
{
  const char last = text.empty() ? ' ' : text.back();
  const double unit = last == 'M' ? 1e6 : last == 'k' ? 1e3 : 1.0;
  const auto number = ToNumber<double>(text.substr(0, text.size() - (unit > 1.0 ? 1 : 0)));
  if (!number || !(*number > 0.0) || *number * unit > 1e9)
  {
    throw Failure(FailureKind::Usage, "'" + text + "' is no size of a page; write it as 8M, 800k, or in bytes.");
  }
  return static_cast<std::uintmax_t>(*number * unit);
}

/** Throws Failure(Usage) for options that interactive pages do not have. */
void
CheckOptionsOfPage(const RenderOptions & options)
{
  const RenderOptions none;
  const std::pair<bool, const char *> others[] = { { options.turntable > 0, "--turntable" },
                                                   { options.lightbox > 0, "--lightbox" },
                                                   { !options.cuts.empty(), "--cut" },
                                                   { !options.planes.empty(), "--show-slice" },
                                                   { !options.size.empty(), "--size" },
                                                   { options.zoom != none.zoom, "--zoom" },
                                                   { options.pixelSize.has_value(), "--pixel-size" },
                                                   { options.hasSameScale, "--same-scale" },
                                                   { !options.focus.empty(), "--focus" },
                                                   { options.isPerspective, "--perspective" },
                                                   { !options.background.empty(), "--background" },
                                                   { !options.style.empty(), "--style" },
                                                   { options.hasNoShadows, "--no-shadows" },
                                                   { options.hasNoSilhouettes, "--no-silhouettes" },
                                                   { options.annotations != none.annotations, "--annotate" },
                                                   { options.hasNoLetters, "--no-letters" },
                                                   { options.isLandscape, "--landscape" },
                                                   { options.pixelsPerInch != none.pixelsPerInch, "--dpi" },
                                                   { options.isNeurological, "--neurological" } };
  for (const auto & [isGiven, name] : others)
  {
    if (isGiven)
    {
      throw Failure(FailureKind::Usage,
                    std::string(name) + " has no meaning for an interactive page (.html), whose reader turns, cuts and "
                                        "enlarges it; leave it out, or name a picture.");
    }
  }
}

/** Throws Failure(Usage) for options that only interactive pages have. */
void
RefuseOptionsOfPage(const RenderOptions & options)
{
  const bool hasSize = options.largestPage != RenderOptions().largestPage;
  if (hasSize || options.hasNoSlices)
  {
    throw Failure(FailureKind::Usage,
                  std::string(hasSize ? "--page-size" : "--no-slices") +
                    " is for an interactive page; leave it out, or name one: -o page.html.");
  }
}

/** As RenderSheetOf(). */
std::vector<MadeFile>
RenderPageOf(const RenderOptions & options, const CommandContext & context)
{
  CheckOptionsOfPage(options);
  RenderPageSettings settings;
  settings.source = GetPictureSource(options);
  settings.page = options.picture;
  if (!options.views.empty())
  {
    settings.views = ParseViews(options);
  }
  settings.slices = ParseAll(options.slices, ParsePlaneRequest);
  settings.slice = GetSliceSettings(options);
  settings.colourBy = GetColourBy(options.colourBy);
  settings.title = options.title;
  settings.hasSlices = !options.hasNoSlices;
  settings.largestSize = ParseSizeOfPage(options.largestPage);
  settings.writesDicom = options.writesDicom;
  settings.thumbnail = options.thumbnail;
  settings.provenance = options.scan.GetProvenance(*context.settings);
  std::vector<MadeFile> planned;
  AddOutputs(CheckRenderPage(settings), "", planned);
  if (context.onlyChecks)
  {
    return planned;
  }
  if (options.isDryRun)
  {
    std::cout << PlanRenderPage(settings, context.console->MakeEvents());
    return {};
  }
  auto volume = FinishSource(options, context, settings.slices, settings.source);
  return RenderPage(settings, context.console->MakeEvents(), std::move(volume));
}

/** As RenderSheetOf(). */
std::vector<MadeFile>
RenderPictures(const RenderOptions & options, const CommandContext & context)
{
  RenderScanSettings settings;
  settings.source = GetPictureSource(options);
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
  settings.ghost = options.ghost;
  settings.choosesViews = options.views.empty() && !settings.views.empty();
  ParseSize(options.size, settings.render);
  settings.render.style = ParseStyle(options.style, "clinic");
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
  settings.colourBy = GetColourBy(options.colourBy);
  settings.annotations = ParseAnnotations(options);
  settings.thumbnail = options.thumbnail;
  settings.provenance = options.scan.GetProvenance(*context.settings);
  std::vector<MadeFile> planned;
  AddOutputs(CheckRenderScan(settings), "", planned);
  if (context.onlyChecks)
  {
    return planned;
  }
  if (options.isDryRun)
  {
    std::cout << PlanRenderScan(settings, context.console->MakeEvents());
    return {};
  }
  std::vector<PlaneRequest> places = settings.slices;
  places.insert(places.end(), settings.planes.begin(), settings.planes.end());
  for (const CutRequest & cut : settings.cuts)
  {
    places.push_back(cut.plane);
  }
  auto volume = FinishSource(options, context, places, settings.source);
  return RenderScan(settings, context.console->MakeEvents(), std::move(volume));
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

/** The settings in a report of before, which has the words of the command line. */
Report
ParseOldReport(const Report & report)
{
  std::vector<std::string> words;
  for (const Report & word : report.value("arguments", Report::array()))
  {
    words.push_back(word.is_string() ? word.get<std::string>() : "");
  }
  const auto command = std::find(words.begin(), words.end(), "render"); // options of all commands may stand before
  if (command == words.end())
  {
    return nullptr;
  }
  CLI::App parser("", "render");
  unsigned int threads = 0;
  parser.add_option("--threads", threads);
  parser.add_flag("-v,--verbose,-q,--quiet");
  CommandSettings settings(parser);
  RenderOptions options;
  AddTables(options, settings);
  parser.parse(std::vector<std::string>(words.rbegin(), std::make_reverse_iterator(command + 1)));
  return settings.GetRecorded();
}

/** The settings in a picture's report that draw this picture, but for the views and slices if others are given. */
Report
ReadSettings(const std::string & path, bool areViewsGiven)
{
  const Report report = Report::parse(ReadTextFile(path, "report"), nullptr, false);
  const bool isOfRender = report.is_object() && report.value("command", std::string()).rfind("rhombic render", 0) == 0;
  Report settings = isOfRender && report.contains("settings") ? report["settings"]
                    : report.is_object()                      ? ParseOldReport(report)
                                                              : Report();
  if (!settings.is_object())
  {
    throw Failure(FailureKind::Unreadable,
                  "The file " + path + " is no report of rhombic render; name the .json beside a picture.");
  }
  settings.erase("dicom-sc"); // copies the patient's name, and so has to be asked for each time
  if (areViewsGiven)
  {
    for (const char * const key : { "view", "slice", "picture" })
    {
      settings.erase(key);
    }
  }
  else if (report.contains("picture"))
  {
    settings["picture"] = report["picture"];
  }
  return settings;
}

/** Takes the settings of a report that are not given. */
void
TakeSettingsOfReport(const RenderOptions & options, CommandSettings & command)
{
  try
  {
    command.SetRecorded(ReadSettings(options.from, !options.views.empty() || !options.slices.empty()));
  }
  catch (const CLI::ParseError & error)
  {
    throw Failure(FailureKind::Usage,
                  "The options of " + options.from + " do not go with those of this command: " + error.what() + ".");
  }
}

std::vector<MadeFile>
Render(const RenderOptions & options, const CommandContext & context)
{
  if (!options.from.empty())
  {
    TakeSettingsOfReport(options, *context.settings);
  }
  if (options.listsPresets)
  {
    ListPresets();
    return {};
  }
  if (options.picture.empty())
  {
    throw Failure(FailureKind::Usage, "No picture is named; give one with -o, for example -o picture.png.");
  }
  CheckEnding(options);
  if (!IsPagePath(options.picture))
  {
    RefuseOptionsOfPage(options);
  }
  std::vector<MadeFile> outputs = IsPagePath(options.picture) ? RenderPageOf(options, context)
                                  : options.isSheet           ? RenderSheetOf(options, context)
                                                              : RenderPictures(options, context);
  if (!context.onlyChecks && !options.isDryRun)
  {
    NoteOutputs("picture", outputs, *context.console);
  }
  return outputs;
}

/** What is drawn, and from where. */
const SettingsTable<RenderOptions> &
PictureTable()
{
  static const SettingsTable<RenderOptions> table{
    { "--view",
      &RenderOptions::views,
      "anterior (default), posterior, left, right, superior, inferior or all; or azimuth,elevation in degrees, as "
      "30,15: from the front towards the patient's left, and up; repeatable" },
    { "--slice",
      &RenderOptions::slices,
      "a slice with the surfaces' outlines: axial, coronal or sagittal, and where: =12.5 (LPS mm), =#40 (of the scan), "
      "=liver (through its centroid); repeatable" },
    { "--lightbox",
      &RenderOptions::lightbox,
      "so many slices evenly along the axis of each --slice, in one picture",
      Checked(CLI::Range(2u, 400u)),
      Needs({ "--slice" }) },
    { "--sheet",
      &RenderOptions::isSheet,
      "a page (A4) instead: four views, three slices, a table of volumes; .png, .jpg, .tif or .pdf",
      Excludes({ "--cut",
                 "--uncut",
                 "--show-slice",
                 "--focus",
                 "--zoom",
                 "--size",
                 "--turntable",
                 "--lightbox",
                 "--background",
                 "--no-silhouettes",
                 "--perspective",
                 "--no-shadows",
                 "--no-letters",
                 "--pixel-size",
                 "--same-scale" }) },
    { "--landscape", &RenderOptions::isLandscape, "a page that is wider than high", Needs({ "--sheet" }) },
    { "--dpi",
      &RenderOptions::pixelsPerInch,
      "pixels per inch of a page",
      Checked(CLI::Range(36.0, 600.0)),
      ShowingDefault,
      Needs({ "--sheet" }) },
    { "--page-size",
      &RenderOptions::largestPage,
      "of an interactive page (.html): surfaces and slices are simplified until it is so small",
      ShowingDefault },
    { "--no-slices", &RenderOptions::hasNoSlices, "of an interactive page: leave out the scan's slices" },
    { "--turntable",
      &RenderOptions::turntable,
      "so many views around the patient: one .gif, or numbered pictures",
      Checked(CLI::Range(2u, 720u)),
      Excludes({ "--view", "--slice", "--lightbox" }) },
    { "--dicom-sc",
      &RenderOptions::writesDicom,
      "also write each picture, page or turntable as a DICOM file beside it (.dcm, Secondary Capture): a new series in "
      "the scan's study, with the patient's name and study copied; of DICOM scans only" },
  };
  return table;
}

/** How the scene is fitted into a picture, and what is cut away. */
const SettingsTable<RenderOptions> &
FitTable()
{
  static const SettingsTable<RenderOptions> table{
    { "--size", &RenderOptions::size, "width x height in pixels (default: what fits, the longer side 1200)" },
    { "--focus",
      &RenderOptions::focus,
      "fit the picture to surfaces by name, as 'kidney*' (default: all), seen from the side from which most of them is "
      "seen, or from --view" },
    { "--ghost",
      &RenderOptions::ghost,
      "opacity of what hides the surfaces of --focus: 0 leaves it out, 1 leaves it as it is",
      Checked(CLI::Range(0.0, 1.0)),
      ShowingDefault,
      Needs({ "--focus" }) },
    { "--zoom", &RenderOptions::zoom, "enlarge", AboveZero },
    { "--pixel-size",
      &RenderOptions::pixelSize,
      "mm per pixel, for one scale in the pictures of several scans",
      AboveZero,
      Excludes({ "--zoom", "--perspective", "--same-scale" }) },
    { "--same-scale", &RenderOptions::hasSameScale, "all views at the scale of the view that needs most room" },
    { "--perspective", &RenderOptions::isPerspective, "perspective instead of parallel projection" },
    { "--colour-by", &RenderOptions::colourBy, GetColourByHelp(), OfKind(SettingKind::Source) },
    { "--cut",
      &RenderOptions::cuts,
      "remove what lies above (axial), in front (coronal) or left of a plane (sagittal), named as for --slice, or "
      "x>12, y<0, z>100 in LPS mm; cut faces show the scan; repeatable" },
    { "--uncut",
      &RenderOptions::uncut,
      "surfaces that are not cut, by name as --only",
      SplitAtCommas,
      Needs({ "--cut" }) },
    { "--show-slice", &RenderOptions::planes, "a slice that stands in the scene, named as for --slice; repeatable" },
  };
  return table;
}

/** How pictures look. */
const SettingsTable<RenderOptions> &
LookTable()
{
  static const SettingsTable<RenderOptions> table{
    { "--style",
      &RenderOptions::style,
      "clinic (black; default of pictures), paper (white, for print; default of pages) or transparent" },
    { "--background", &RenderOptions::background, "a colour: #rrggbb, #rgb or a name, as white" },
    { "--no-shadows", &RenderOptions::hasNoShadows, "do not darken cavities" },
    { "--no-silhouettes", &RenderOptions::hasNoSilhouettes, "do not draw dark lines at outlines" },
    { "--window",
      &RenderOptions::window,
      "greys of slices: a name, as bone, lung or brain, width/centre as 350/50, or auto",
      ShowingDefault },
    { "--neurological", &RenderOptions::isNeurological, "slices with the patient's left on the left" },
    { "--no-outlines", &RenderOptions::hasNoOutlines, "slices without the surfaces' outlines" },
    { "--annotate",
      &RenderOptions::annotations,
      "what is written over pictures: letters (of directions), scale, legend (of two surfaces or more), figure, "
      "footnote, names (beside views, with lines to the surfaces); or none; on pages letters, scale and names",
      SplitAtCommas,
      ShowingDefault },
    { "--no-letters", &RenderOptions::hasNoLetters, "leave out the orientation letters at the edges" },
    { "--title", &RenderOptions::title, "a line above the picture, or the page's title" },
    { "--from",
      &RenderOptions::from,
      "the options that a picture's report (PICTURE.json) holds",
      OfKind(SettingKind::Run) },
    { "--picture", // for --from: which one of several to draw, from 1
      &RenderOptions::onlyPicture,
      "",
      Hidden },
    { "--thumbnail", // for batches: the first picture, small
      &RenderOptions::thumbnail,
      "",
      Hidden,
      OfKind(SettingKind::Output) },
    { "--list-presets", &RenderOptions::listsPresets, "list the presets and stop", OfKind(SettingKind::Run) },
  };
  return table;
}

void
AddTables(RenderOptions & options, CommandSettings & command)
{
  static const SettingsTable<RenderOptions> files{
    { "FILES", &RenderOptions::furtherFiles, "further surface files, if SCAN is one", OfKind(SettingKind::Source) },
    { "-o,--output",
      &RenderOptions::picture,
      "the picture: .png, .jpg, .tif or .exr; .gif for a turntable, .pdf for a page, .html for a page to turn and "
      "scroll",
      OfKind(SettingKind::Output) },
  };
  static const SettingsTable<RenderOptions> run{
    { "--dry-run",
      &RenderOptions::isDryRun,
      "print where voxels and lattice will be, slabs and passes, and the memory, triangles and time as estimates, and "
      "stop; refused as the work would be",
      OfKind(SettingKind::Run) },
  };
  command.Add(ScanOptions::SourceTable(), options.scan);
  command.Add(files, options);
  command.Add(SurfaceOptions::Table(), options.surfaces);
  command.Add(FinishTable(), options.finish);
  command.Add(PictureTable(), options);
  command.Add(FitTable(), options);
  command.Add(LookTable(), options);
  command.Add(ScanOptions::LatticeTable(), options.scan);
  command.Add(ScanOptions::SidecarTable(), options.scan);
  command.Add(run, options);
}

} // namespace

CommandRun
AddRenderCommand(CommandSettings & command)
{
  const auto options = std::make_shared<RenderOptions>();
  options->surfaces.takesAuto = true;
  AddTables(*options, command);
  return AddPipelineOption(command, [options](const CommandContext & context) { return Render(*options, context); });
}

} // namespace rhombic
