#include "rhombicHiding.h"
#include "rhombicPictureSteps.h"
#include "rhombicWording.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rhombic
{
namespace
{

constexpr double OpacityOfEnclosing = 0.2;

Scene
SceneOf(const PictureScene & scene, const std::vector<ClipPlane> & cuts)
{
  return { scene.surfaces, cuts, {} };
}

/** Whether a surface covers others by its name; covers are thin in places, and so do not hide all that is in them. */
bool
IsNameOfCover(const std::string & name)
{
  static const std::vector<std::string> patterns{ "skin*",   "*fat",     "*fat_*", "*subcutaneous*", "muscle",
                                                  "muscles", "*_muscle", "body",   "body_*",         "torso*" };
  return std::any_of(
    patterns.begin(), patterns.end(), [&name](const std::string & pattern) { return MatchesPattern(pattern, name); });
}

/** Makes a surface translucent, unless it is already or its opacity was asked for. Returns whether it has changed. */
bool
Open(const SurfaceSelection & selection, double opacity, SceneSurface & surface)
{
  if (surface.opacity <= opacity || HasOwnOpacity(selection, surface))
  {
    return false;
  }
  surface.opacity = opacity;
  return true;
}

/** "liver, colon and stomach", or the number of many. */
std::string
DescribeAll(const std::vector<std::string> & names)
{
  constexpr std::size_t few = 6;
  return names.size() <= few ? Enumerate(names, "and") : Count(names.size(), "surface");
}

/** Leaves surfaces of opacity 0 out, with their rows. */
void
LeaveOutInvisible(PictureScene & scene)
{
  for (std::size_t n = scene.surfaces.size(); n-- > 0;)
  {
    if (scene.surfaces[n].opacity == 0.0)
    {
      scene.surfaces.erase(scene.surfaces.begin() + static_cast<std::ptrdiff_t>(n));
      scene.rows.erase(scene.rows.begin() + static_cast<std::ptrdiff_t>(n));
    }
  }
}

} // namespace

void
OpenEnclosing(const SurfaceSelection & selection,
              const std::vector<ClipPlane> & cuts,
              PictureScene & scene,
              const Events & events)
{
  if (scene.surfaces.size() < 2)
  {
    return;
  }
  const std::vector<std::size_t> enclosing = FindEnclosing(SceneOf(scene, cuts));
  std::vector<std::string> opened;
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    SceneSurface & surface = scene.surfaces[n];
    const bool encloses = std::binary_search(enclosing.begin(), enclosing.end(), n) || IsNameOfCover(surface.name);
    if (encloses && surface.opacity == 1.0 && Open(selection, OpacityOfEnclosing, surface))
    {
      opened.push_back(surface.name);
    }
  }
  if (!opened.empty())
  {
    scene.report["opened"] = opened;
    events.Note("translucent, to show what is inside: " + DescribeAll(opened) + " (--draw '" + opened.front() +
                "=,1' draws it opaque)");
  }
}

std::vector<View>
ViewsOfFaces(const std::vector<SceneSurface> & surfaces)
{
  constexpr double flat = 0.15; // of the second shortest side of the box
  const LPSBox box = BoxAround(surfaces);
  std::array<std::pair<double, std::size_t>, 3> sides;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sides[axis] = { box.highest[axis] - box.lowest[axis], axis };
  }
  std::sort(sides.begin(), sides.end());
  if (!(sides[0].first < flat * sides[1].first))
  {
    return {};
  }
  constexpr std::size_t faces[3][2]{ { 2, 3 }, { 0, 1 }, { 5, 4 } }; // of StandardViews(), for each axis
  const auto & [first, second] = faces[sides[0].second];
  return { StandardViews()[first], StandardViews()[second] };
}

void
ShowFocus(const std::vector<ClipPlane> & cuts,
          RenderScanSettings & settings,
          PictureScene & scene,
          const Events & events)
{
  const bool choosesView = settings.choosesViews && settings.turntable == 0;
  if (settings.focus.empty())
  {
    if (const std::vector<View> faces = ViewsOfFaces(scene.surfaces); choosesView && !faces.empty())
    {
      settings.views = { faces.front() };
      events.Note("flat surfaces: " + faces.front().name + " view of their faces");
    }
    return;
  }
  std::vector<bool> isFocus;
  for (const SceneSurface & surface : scene.surfaces)
  {
    isFocus.push_back(FitsPattern(settings.focus, surface.name));
  }
  const Scene shown = SceneOf(scene, cuts);
  if (choosesView)
  {
    settings.views = { FindBestView(shown, isFocus) };
  }
  const std::vector<View> views = ViewsOf(settings);
  std::vector<std::string> opened;
  for (const std::size_t n : settings.ghost < 1.0 ? FindHiding(shown, isFocus, views) : std::vector<std::size_t>())
  {
    if (Open(settings.source.surfaces, settings.ghost, scene.surfaces[n]))
    {
      opened.push_back(scene.surfaces[n].name);
    }
  }
  LeaveOutInvisible(scene);
  Report & report = scene.report["focus"];
  report["opened"] = opened;
  std::string note = "focus on " + settings.focus;
  if (choosesView)
  {
    report["view"] = views.front().name;
    note += ": " + views.front().name + " view, in which most of it is seen";
  }
  if (!opened.empty())
  {
    note +=
      "; " + DescribeAll(opened) + (settings.ghost > 0.0 ? " translucent" : " left out") + ", which would hide it";
  }
  events.Note(note);
}

} // namespace rhombic
