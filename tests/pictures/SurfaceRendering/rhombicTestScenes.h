#ifndef rhombicTestScenes_h
#define rhombicTestScenes_h

#include "rhombicFailure.h"
#include "rhombicSurfaceRenderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rhombic::test
{

inline constexpr Colour Red{ 0.9, 0.1, 0.1 };
inline constexpr Colour Green{ 0.1, 0.8, 0.1 };
inline constexpr Colour Blue{ 0.1, 0.1, 0.9 };

using Point = std::array<double, 3>;

/** A sphere with normals, from a grid of latitudes and longitudes. */
inline itk::TriangleSurface::ConstPointer
Sphere(const Point & centre, double radius)
{
  constexpr std::uint32_t rows = 48;
  constexpr std::uint32_t columns = 96;
  const double pi = std::acos(-1.0);
  auto surface = itk::TriangleSurface::New();
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    for (std::uint32_t column = 0; column <= columns; ++column)
    {
      const double latitude = pi * row / rows;
      const double longitude = 2.0 * pi * column / columns;
      const Point normal{ std::sin(latitude) * std::cos(longitude),
                          std::sin(latitude) * std::sin(longitude),
                          std::cos(latitude) };
      surface->GetNormals().push_back(
        { static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2]) });
      surface->GetPoints().push_back({ static_cast<float>(centre[0] + radius * normal[0]),
                                       static_cast<float>(centre[1] + radius * normal[1]),
                                       static_cast<float>(centre[2] + radius * normal[2]) });
    }
  }
  for (std::uint32_t row = 0; row < rows; ++row)
  {
    for (std::uint32_t column = 0; column < columns; ++column)
    {
      const std::uint32_t first = row * (columns + 1) + column;
      const std::uint32_t below = first + columns + 1;
      surface->GetTriangles().push_back({ first, below, below + 1 });
      surface->GetTriangles().push_back({ first, below + 1, first + 1 });
    }
  }
  return surface.GetPointer();
}

inline SceneSurface
Item(const itk::TriangleSurface * surface, const Colour & colour, double opacity = 1.0)
{
  return { "test", surface, colour, opacity };
}

inline RenderSettings
Small()
{
  RenderSettings settings;
  settings.width = 200;
  settings.height = 160;
  return settings;
}

/** Without effects that depend on the surroundings of a pixel. */
inline RenderSettings
Plain()
{
  RenderSettings settings = Small();
  settings.ambientOcclusion = false;
  settings.silhouettes = false;
  return settings;
}

inline Picture
Draw(SurfaceRenderer & renderer, const Scene & scene, const RenderSettings & settings, const View & view = {})
{
  return renderer.Render(scene, settings, { view }).front().picture;
}

inline Picture
Draw(SurfaceRenderer & renderer,
     const std::vector<SceneSurface> & surfaces,
     const RenderSettings & settings,
     const View & view = {})
{
  return Draw(renderer, Scene{ surfaces, {}, {} }, settings, view);
}

inline FailureKind
KindThrownBy(SurfaceRenderer & renderer, const Scene & scene, const RenderSettings & settings)
{
  try
  {
    renderer.Render(scene, settings, { View() });
  }
  catch (const Failure & failure)
  {
    return failure.GetKind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return FailureKind::Internal;
}

} // namespace rhombic::test

#endif
