#ifndef itkExampleCloseSheets_h
#define itkExampleCloseSheets_h

#include "itkExampleSurfaces.h"

namespace itk::example
{

/** Kinds of surfaces of which one lies close to another. */
enum class CloseSheets : unsigned int
{
  Spheres,
  Tori,
  Planes ///< open sheets
};

/** A wavy sheet of squares at a height, each cut into two triangles. */
inline TriangleSurface::Pointer
MakeWavySheet(std::uint32_t squares, double side, double wave, double height)
{
  auto surface = TriangleSurface::New();
  for (std::uint32_t row = 0; row <= squares; ++row)
  {
    for (std::uint32_t column = 0; column <= squares; ++column)
    {
      const double x = side * column, y = side * row;
      surface->GetPoints().push_back({ static_cast<float>(x),
                                       static_cast<float>(y),
                                       static_cast<float>(height + wave * std::sin(0.3 * x) * std::cos(0.2 * y)) });
    }
  }
  const std::uint32_t width = squares + 1;
  for (std::uint32_t row = 0; row < squares; ++row)
  {
    for (std::uint32_t column = 0; column < squares; ++column)
    {
      const std::uint32_t corner = row * width + column;
      surface->GetTriangles().push_back({ corner, corner + 1, corner + width + 1 });
      surface->GetTriangles().push_back({ corner, corner + width + 1, corner + width });
    }
  }
  return surface;
}

/** Two sheets of some thousand triangles in all, of random size, at a random distance of 0.05 to 0.5 sides of their
 * triangles, the second inside the first or above it, turned round, and shifted by up to a tenth of the distance. They
 * do not cross. */
inline TriangleSurface::Pointer
MakeCloseSheets(CloseSheets kind, unsigned int seed)
{
  std::mt19937 random(seed);
  const auto draw = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const double size = draw(10.0, 30.0);
  const double share = draw(0.05, 0.5);
  TriangleSurface::Pointer first, second;
  double gap = 0.0;
  switch (kind)
  {
    case CloseSheets::Spheres:
      gap = share * 0.1 * size;
      first = MakeSphere(size, 4);
      second = MakeSphere(size - gap, 4);
      break;
    case CloseSheets::Tori:
    {
      const double tube = draw(0.3, 0.6) * size;
      const auto segments = static_cast<std::uint32_t>(draw(24.0, 36.0));
      gap = share * tube * 6.0 / segments;
      first = MakeTorus(size, tube, segments);
      second = MakeTorus(size, tube - gap, segments);
      break;
    }
    case CloseSheets::Planes:
    {
      const double wave = draw(0.5, 2.0);
      gap = share * 0.05 * size;
      first = MakeWavySheet(30, 0.05 * size, wave, gap);
      second = MakeWavySheet(30, 0.05 * size, wave, 0.0);
      break;
    }
  }
  TurnInsideOut(*second);
  const auto shift = [&] { return static_cast<float>(draw(-0.05, 0.05) * gap); };
  const float x = shift(), y = shift(), z = shift();
  Append(*first, *second, { x, y, z });
  return first;
}

} // namespace itk::example

#endif
