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

constexpr std::uintmax_t SampleBytes = 8;       // colour and depth
constexpr std::uintmax_t LayerSampleBytes = 20; // colours of a layer and of all, two depths
constexpr std::uintmax_t PixelBytes = 8;        // colour, and the picture
constexpr std::uintmax_t ShadePixelBytes = 12;  // depth, surface, share of light

// For the scene:
constexpr std::uintmax_t VertexBytes = 24;            // point and normal
constexpr std::uintmax_t TriangleBytes = 12;          // indices of its vertices
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
         (settings.ambientOcclusion || settings.silhouettes ? ShadePixelBytes : 0);
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
MemoryToHoldScene(const Scene & scene)
{
  std::uintmax_t bytes = 0;
  std::uintmax_t triangles = 0;
  for (const SceneSurface & item : scene.surfaces)
  {
    bytes += item.surface->GetNumberOfPoints() * VertexBytes + item.surface->GetNumberOfTriangles() * TriangleBytes;
    triangles += item.surface->GetNumberOfTriangles();
  }
  for (const ScenePlane & plane : scene.planes)
  {
    bytes += static_cast<std::uintmax_t>(plane.picture.width) * static_cast<std::uintmax_t>(plane.picture.height) *
             PlanePixelBytes;
  }
  return bytes + std::min(triangles * BinnedTriangleBytes, MostBinnedBytes);
}

std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  const RenderSettings sized = WithSize(settings);
  return LibraryBytes + sceneBytes +
         static_cast<std::uintmax_t>(sized.width) * static_cast<std::uintmax_t>(sized.height) *
           BytesOfPixel(sized, isTranslucent);
}

void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes)
{
  const RenderSettings sized = WithSize(settings);
  const auto left =
    static_cast<double>(MemoryAllowance(sized.maximumMemory)) - static_cast<double>(LibraryBytes + sceneBytes);
  RequireMemory(MemoryToDraw(sized, isTranslucent, sceneBytes),
                sized.maximumMemory,
                "A picture of " + std::to_string(sized.width) + " x " + std::to_string(sized.height) + " pixels",
                AdviseSize(sized, left, static_cast<double>(BytesOfPixel(sized, isTranslucent))));
}

} // namespace rhombic
