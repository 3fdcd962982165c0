#include "rhombicSceneCheck.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"
#include "rhombicMemoryBudget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace rhombic
{
namespace
{

constexpr int LargestSampledSide = 16384; // the largest side that was tested
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
    if (item.pointColours && item.pointColours->size() != item.surface->GetNumberOfPoints())
    {
      FailUsage("The surface " + item.name + " has " + std::to_string(item.pointColours->size()) + " colours for " +
                std::to_string(item.surface->GetNumberOfPoints()) + " points.");
    }
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

constexpr std::uintmax_t LibraryBytes = 110 << 20; // graphics libraries and compiled shaders

constexpr std::uintmax_t SampleBytes = 8;      // colour and depth
constexpr std::uintmax_t LayerSampleBytes = 8; // colour of all layers
constexpr std::uintmax_t ListBytes = 72 << 20; // lists of fragments, at most
constexpr std::uintmax_t LayerPixelBytes = 8;  // colour and depth below the layers
// The window's buffers 28, what is behind the surfaces 12, relief and shades 12, the picture and VTK's copy of it 8.
constexpr std::uintmax_t PixelBytes = 60;

// For the scene:
constexpr std::uintmax_t VertexBytes = 24;            // point and normal
constexpr std::uintmax_t TriangleBytes = 16;          // indices of its vertices, its place in the polydata
constexpr std::uintmax_t PlanePixelBytes = 8;         // its texture, and a copy meanwhile
constexpr std::uintmax_t BinnedTriangleBytes = 64;    // a triangle that waits to be drawn
constexpr std::uintmax_t MostBinnedBytes = 100 << 20; // all triangles that wait, at most

/** The settings with sides that are not 0. */
RenderSettings
WithSize(const RenderSettings & settings)
{
  constexpr int defaultSide = 1200;
  RenderSettings sized = settings;
  sized.width = settings.width > 0 ? settings.width : defaultSide;
  sized.height = settings.height > 0 ? settings.height : defaultSide;
  return sized;
}

std::uintmax_t
BytesOfPixel(const RenderSettings & settings, bool isTranslucent)
{
  const std::uintmax_t sample = SampleBytes + (isTranslucent ? LayerSampleBytes : 0);
  return static_cast<std::uintmax_t>(settings.samples * settings.samples) * sample + PixelBytes +
         (isTranslucent ? LayerPixelBytes : 0);
}

/** What does not depend on the scene or the size. */
std::uintmax_t
FixedBytes(bool isTranslucent)
{
  return LibraryBytes + (isTranslucent ? ListBytes : 0);
}

/** Advice to draw a smaller picture of the same shape that needs at most \a bytes; empty when there is none. */
std::string
AdviseSize(const RenderSettings & settings, double bytes, double bytesOfPixel)
{
  const double pixels = static_cast<double>(settings.width) * static_cast<double>(settings.height);
  const double scale = std::min(1.0, std::sqrt(std::max(bytes, 0.0) / bytesOfPixel / pixels));
  const auto width = static_cast<int>(settings.width * scale);
  const auto height = static_cast<int>(settings.height * scale);
  return width < 1 || height < 1 ? ""
                                 : "draw at most " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

} // namespace

bool
IsCut(const SceneSurface & item, const ClipPlane & cut)
{
  return cut.surfaces.empty() || std::find(cut.surfaces.begin(), cut.surfaces.end(), item.name) != cut.surfaces.end();
}

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

std::uintmax_t
MemoryToHold(std::uintmax_t points, std::uintmax_t triangles)
{
  return points * VertexBytes + triangles * TriangleBytes + std::min(triangles * BinnedTriangleBytes, MostBinnedBytes);
}

std::uintmax_t
MemoryToHoldScene(const Scene & scene)
{
  std::uintmax_t bytes = 0;
  std::uintmax_t points = 0;
  std::uintmax_t triangles = 0;
  for (const SceneSurface & item : scene.surfaces)
  {
    points += item.surface->GetNumberOfPoints();
    triangles += item.surface->GetNumberOfTriangles();
  }
  for (const ScenePlane & plane : scene.planes)
  {
    bytes += static_cast<std::uintmax_t>(plane.picture.width) * static_cast<std::uintmax_t>(plane.picture.height) *
             PlanePixelBytes;
  }
  return bytes + MemoryToHold(points, triangles);
}

std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  const RenderSettings sized = WithSize(settings);
  return FixedBytes(isTranslucent) + sceneBytes +
         static_cast<std::uintmax_t>(sized.width) * static_cast<std::uintmax_t>(sized.height) *
           BytesOfPixel(sized, isTranslucent);
}

void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  const RenderSettings sized = WithSize(settings);
  const auto left = static_cast<double>(MemoryAllowance(sized.maximumMemory)) -
                    static_cast<double>(FixedBytes(isTranslucent) + sceneBytes);
  RequireMemory(MemoryToDraw(sized, isTranslucent, sceneBytes),
                sized.maximumMemory,
                "A picture of " + std::to_string(sized.width) + " x " + std::to_string(sized.height) + " pixels",
                AdviseSize(sized, left, static_cast<double>(BytesOfPixel(sized, isTranslucent))));
}

} // namespace rhombic
