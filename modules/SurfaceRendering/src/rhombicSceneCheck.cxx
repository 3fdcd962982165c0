#include "rhombicSceneCheck.h"

#include "rhombicFailure.h"

#include <algorithm>

namespace rhombic
{
namespace
{

constexpr int LargestSampledSide = 8192; // the largest one that was tested

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

} // namespace

void
CheckSettings(const RenderSettings & settings, int largestSide)
{
  if (settings.samples < 1 || settings.samples > 4)
  {
    FailUsage("A pixel can have 1 to 4 samples along each side, not " + std::to_string(settings.samples) + ".");
  }
  const int largest = std::min(largestSide, LargestSampledSide) / settings.samples;
  if (settings.width < 1 || settings.height < 1 || settings.width > largest || settings.height > largest)
  {
    FailUsage("A picture of " + std::to_string(settings.width) + " x " + std::to_string(settings.height) +
              " pixels can't be drawn here; choose sides from 1 to " + std::to_string(largest) + ".");
  }
  CheckColour(settings.background, "the background");
}

std::vector<SceneSurface>
DrawableSurfaces(const std::vector<SceneSurface> & scene)
{
  std::vector<SceneSurface> drawable;
  for (const auto & item : scene)
  {
    CheckColour(item.colour, "the surface \"" + item.name + "\"");
    if (!(item.opacity > 0.0 && item.opacity <= 1.0))
    {
      FailUsage("The opacity of the surface \"" + item.name + "\" must be above 0 and at most 1.");
    }
    if (item.surface && item.surface->GetNumberOfTriangles() > 0)
    {
      drawable.push_back(item);
    }
  }
  if (drawable.empty())
  {
    throw Failure(FailureKind::Empty, "There is no surface to draw; try another threshold.");
  }
  return drawable;
}

bool
IsTranslucent(const std::vector<SceneSurface> & scene)
{
  return std::any_of(scene.begin(), scene.end(), [](const SceneSurface & item) { return item.opacity < 1.0; });
}

} // namespace rhombic
