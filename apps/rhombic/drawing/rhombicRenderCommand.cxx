#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPresets.h"
#include "rhombicRenderScan.h"
#include "rhombicScanOptions.h"
#include "rhombicSurfaceOptions.h"

#include <charconv>
#include <iostream>

namespace rhombic
{
namespace
{

struct RenderOptions
{
  ScanOptions scan;
  SurfaceOptions surfaces;
  std::string picture;
  std::vector<std::string> views{ "anterior" };
  std::string size = "1200x1200";
  std::string background;
  bool isPerspective = false;
  bool hasNoLetters = false;
  bool listsPresets = false;
};

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
        std::cout << "Otsu's threshold";
      }
      std::cout << (surface.opacity < 1.0 ? ", translucent" : "") << '\n';
    }
    if (preset.denoising != "none")
    {
      std::cout << "    noisy scans: --denoise " << preset.denoising << '\n';
    }
  }
}

/** "1200" or "1600x1200". */
void
ParseSize(const std::string & text, RenderSettings & render)
{
  const char * const end = text.data() + text.size();
  auto parsed = std::from_chars(text.data(), end, render.width);
  render.height = render.width;
  if (parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == 'x')
  {
    parsed = std::from_chars(parsed.ptr + 1, end, render.height);
  }
  if (parsed.ec != std::errc() || parsed.ptr != end || render.width <= 0 || render.height <= 0)
  {
    throw Failure(FailureKind::Usage, "'" + text + "' is no picture size; write it as 1200 or 1600x1200.");
  }
}

std::vector<View>
ParseViews(const std::vector<std::string> & names)
{
  std::vector<View> views;
  for (const std::string & name : names)
  {
    if (name == "all")
    {
      return { AllViews.begin(), AllViews.end() };
    }
    views.push_back(ViewFromName(name));
  }
  return views;
}

void
Render(const RenderOptions & options, const CommandContext & context)
{
  if (options.listsPresets)
  {
    ListPresets();
    return;
  }
  RenderScanSettings settings;
  settings.source = options.scan.GetSource(context);
  if (options.picture.empty())
  {
    throw Failure(FailureKind::Usage, "No picture is named; give one with -o, for example -o picture.png.");
  }
  settings.picture = options.picture;
  settings.surfaces = options.surfaces.GetSelection();
  settings.views = ParseViews(options.views);
  ParseSize(options.size, settings.render);
  if (!options.background.empty())
  {
    settings.render.background = ParseColour(options.background);
  }
  settings.render.perspective = options.isPerspective;
  settings.render.orientationLabels = !options.hasNoLetters;
  settings.provenance = options.scan.GetProvenance(context, options.surfaces.GetNames());
  for (const auto & picture : RenderScan(settings, context.console->MakeEvents()))
  {
    context.console->Note("picture: " + picture.string());
  }
}

} // namespace

void
StartDrawingProgram(char **)
{
  // This is the drawing program.
}

CommandRun
AddRenderCommand(CLI::App & parser)
{
  const auto options = std::make_shared<RenderOptions>();
  options->scan.AddSource(parser);
  parser.add_option("-o,--output", options->picture, "the picture: .png, .jpg, .tif or .exr");
  options->surfaces.Add(parser);
  parser
    .add_option("--view", options->views, "anterior, posterior, left, right, superior, inferior or all; repeatable")
    ->allow_extra_args(false)
    ->capture_default_str();
  parser.add_option("--size", options->size, "width x height in pixels")->capture_default_str();
  parser.add_option("--background", options->background, "a colour: #rrggbb, #rgb or a name, as white (default black)");
  parser.add_flag("--perspective", options->isPerspective, "perspective instead of parallel projection");
  parser.add_flag("--no-letters", options->hasNoLetters, "leave out the orientation letters at the edges");
  parser.add_flag("--list-presets", options->listsPresets, "list the presets and stop");
  options->scan.AddLattice(parser);
  options->scan.AddSidecar(parser);
  return [options](const CommandContext & context) { Render(*options, context); };
}

} // namespace rhombic
