#include "rhombicSceneCheck.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int LargestSampledSide = 16384; // the largest one that was tested
constexpr std::size_t MostCuts = 6;       // OpenGL promises 8

[[noreturn]] void
FailUsage(const std::string & sentence)
{
  throw Failure(FailureKind::Usage, sentence);
}

void
CheckColour(const Colour & colour, const std::string & what)
{
  if (!std::all_of(colour.begin(), colour.end(), [](double value) { return value >= 0.0 && value <= 1.0; }))
  {
    FailUsage("The colour of " + what + " has a component outside 0 to 1.");
  }
}

/** Sides from 1 pixel, or from 0 when \a smallest is 0. */
void
CheckSize(int width, int height, int smallest, int samples, int largestSide)
{
  const int largest = std::min(largestSide, LargestSampledSide) / samples;
  if (width < smallest || height < smallest || width > largest || height > largest)
  {
    FailUsage("A picture of " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels can't be drawn here; choose sides from 1 to " + std::to_string(largest) + ".");
  }
}

bool
IsPositive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

void
CheckCamera(const RenderSettings & settings)
{
  if (!IsPositive(settings.zoom))
  {
    FailUsage("The zoom must be above 0; 2 shows everything twice as large.");
  }
  if (settings.pixelSize && !IsPositive(*settings.pixelSize))
  {
    FailUsage("The pixel size must be above 0 mm.");
  }
  if (settings.pixelSize && settings.perspective)
  {
    FailUsage("In perspective pixels have no one size in mm; give a pixel size for parallel projection only.");
  }
  if (settings.margins &&
      std::min({ settings.margins->left, settings.margins->right, settings.margins->top, settings.margins->bottom }) <
        0)
  {
    FailUsage("A margin can't be below 0 pixels.");
  }
  for (std::size_t axis = 0; settings.extent && axis < 3; ++axis)
  {
    if (!(settings.extent->lowest[axis] < settings.extent->highest[axis]))
    {
      FailUsage("The box to be shown is empty; its lowest point must be below its highest in x, y and z.");
    }
  }
}

void
CheckSurface(const SceneSurface & item)
{
  CheckColour(item.colour, "the surface \"" + item.name + "\"");
  if (!(item.opacity > 0.0 && item.opacity <= 1.0))
  {
    FailUsage("The opacity of the surface \"" + item.name + "\" must be above 0 and at most 1.");
  }
}

void
CheckCuts(const Scene & scene)
{
  if (scene.cuts.size() > MostCuts)
  {
    FailUsage("A scene can be cut at most " + std::to_string(MostCuts) + " times, not " +
              std::to_string(scene.cuts.size()) + ".");
  }
  std::vector<std::string> names;
  for (const SceneSurface & item : scene.surfaces)
  {
    names.push_back(item.name);
  }
  for (const ClipPlane & cut : scene.cuts)
  {
    if (!IsPositive(Dot(cut.normal, cut.normal)))
    {
      FailUsage("A cut needs a normal with a direction.");
    }
    for (const std::string & name : cut.surfaces)
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
        FailUsage(DescribeUnknown("surface", name, names, "cut one of these: " + Enumerate(names)));
      }
    }
  }
}

void
CheckPlane(const ScenePlane & plane)
{
  const Picture & picture = plane.picture;
  if (picture.width < 1 || picture.height < 1 || picture.width != plane.projection.width ||
      picture.height != plane.projection.height || !IsPositive(plane.projection.pixelSize))
  {
    FailUsage("A plane's picture and its projection must have the same size, at least 1 x 1 pixels of more than 0 mm.");
  }
}

} // namespace

void
CheckSettings(const RenderSettings & settings, int largestSide)
{
  if (settings.samples < 1 || settings.samples > 4)
  {
    FailUsage("A pixel can have 1 to 4 samples along each side, not " + std::to_string(settings.samples) + ".");
  }
  CheckSize(settings.width, settings.height, 0, settings.samples, largestSide);
  CheckCamera(settings);
  CheckColour(BackgroundOf(settings), "the background");
}

void
CheckSizes(const std::vector<Camera> & cameras, int samples, int largestSide)
{
  for (const Camera & camera : cameras)
  {
    CheckSize(camera.width, camera.height, 1, samples, largestSide);
  }
}

Scene
DrawableScene(const Scene & scene)
{
  CheckCuts(scene);
  std::for_each(scene.planes.begin(), scene.planes.end(), CheckPlane);
  Scene drawable{ {}, scene.cuts, scene.planes };
  for (const auto & item : scene.surfaces)
  {
    CheckSurface(item);
    if (item.surface && item.surface->GetNumberOfTriangles() > 0)
    {
      drawable.surfaces.push_back(item);
    }
  }
  if (drawable.surfaces.empty() && drawable.planes.empty())
  {
    throw Failure(FailureKind::Empty, "There is no surface to draw; try another threshold.");
  }
  return drawable;
}

bool
IsTranslucent(const Scene & scene)
{
  return !scene.planes.empty() || std::any_of(scene.surfaces.begin(),
                                              scene.surfaces.end(),
                                              [](const SceneSurface & item) { return item.opacity < 1.0; });
}

LPSBox
BoxAround(const std::vector<SceneSurface> & surfaces)
{
  constexpr double largest = std::numeric_limits<double>::max();
  LPSBox box{ { largest, largest, largest }, { -largest, -largest, -largest } };
  for (const SceneSurface & item : DrawableScene({ surfaces, {}, {} }).surfaces)
  {
    const auto bounds = item.surface->GetBounds();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lowest[axis] = std::min(box.lowest[axis], bounds[2 * axis]);
      box.highest[axis] = std::max(box.highest[axis], bounds[2 * axis + 1]);
    }
  }
  return box;
}

Colour
BackgroundOf(const RenderSettings & settings)
{
  const double grey = settings.style == PictureStyle::Clinic ? 0.0 : 1.0;
  return settings.background.value_or(Colour{ grey, grey, grey });
}

} // namespace rhombic
