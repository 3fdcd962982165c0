#include "rhombicDrawingMemory.h"

#include "rhombicMemoryBudget.h"
#include "rhombicPicture.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace rhombic
{
namespace
{

constexpr std::uintmax_t LibraryBytes = 110 << 20; // graphics libraries and compiled shaders

// For each sample:
constexpr std::uintmax_t WindowBytes = 28;    // colours and depths of VTK's window, and Mesa's copy for reading
constexpr std::uintmax_t OcclusionBytes = 40; // colour, position, normal, depth and darkness in VTK's occlusion pass
constexpr std::uintmax_t PeelingBytes = 38;   // four colours, two pairs of depths and one depth in VTK's peeling pass

// For the scene:
constexpr std::uintmax_t VertexBytes = 24;            // point and normal
constexpr std::uintmax_t TriangleBytes = 12;          // indices of its vertices
constexpr double ShareHandedOver = 1.25;              // factor for both: a part is copied while OpenGL receives it
constexpr std::uintmax_t BinnedTriangleBytes = 64;    // a triangle that waits to be drawn
constexpr std::uintmax_t MostBinnedBytes = 100 << 20; // all triangles that wait, at most

std::uintmax_t
BytesOfPixel(const RenderSettings & settings, bool isTranslucent)
{
  const std::uintmax_t sample =
    WindowBytes + (settings.ambientOcclusion ? OcclusionBytes : 0) + (isTranslucent ? PeelingBytes : 0);
  return static_cast<std::uintmax_t>(settings.samples * settings.samples) * sample + Picture::Channels;
}

/** Advice to draw a smaller picture of the same shape that needs at most \a bytes; empty when there is none. */
std::string
AdviseSize(const RenderSettings & settings, double bytes, double bytesOfPixel)
{
  const double pixels = static_cast<double>(settings.width) * static_cast<double>(settings.height);
  const double scale = std::sqrt(std::max(bytes, 0.0) / bytesOfPixel / pixels);
  const auto width = static_cast<int>(settings.width * scale);
  const auto height = static_cast<int>(settings.height * scale);
  return width < 1 || height < 1 ? ""
                                 : "draw at most " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

} // namespace

std::uintmax_t
MemoryToHoldScene(const std::vector<SceneSurface> & scene)
{
  std::uintmax_t vertices = 0;
  std::uintmax_t triangles = 0;
  for (const SceneSurface & item : scene)
  {
    vertices += item.surface->GetNumberOfPoints();
    triangles += item.surface->GetNumberOfTriangles();
  }
  const auto held = static_cast<double>(vertices * VertexBytes + triangles * TriangleBytes);
  return static_cast<std::uintmax_t>(ShareHandedOver * held) +
         std::min(triangles * BinnedTriangleBytes, MostBinnedBytes);
}

std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  return LibraryBytes + sceneBytes +
         static_cast<std::uintmax_t>(settings.width) * static_cast<std::uintmax_t>(settings.height) *
           BytesOfPixel(settings, isTranslucent);
}

void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  const auto left =
    static_cast<double>(MemoryAllowance(settings.maximumMemory)) - static_cast<double>(LibraryBytes + sceneBytes);
  RequireMemory(MemoryToDraw(settings, isTranslucent, sceneBytes),
                settings.maximumMemory,
                "A picture of " + std::to_string(settings.width) + " x " + std::to_string(settings.height) + " pixels",
                AdviseSize(settings, left, static_cast<double>(BytesOfPixel(settings, isTranslucent))));
}

} // namespace rhombic
