#ifndef rhombicPassScene_h
#define rhombicPassScene_h

#include "vtkRhombicHeadlessRenderWindow.h"
#include "vtkRhombicSurfacePass.h"

#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <vector>

/** A ball in a window, drawn by vtkRhombicSurfacePass, beside what a test adds or changes. */
namespace rhombic::test
{

inline constexpr int Width = 120; // pixels
inline constexpr int Height = 100;

/** RGB. */
using Bytes = std::vector<unsigned char>;

inline vtkSmartPointer<vtkPolyData>
BallOf(double radius, int resolution = 24)
{
  const vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

inline vtkSmartPointer<vtkActor>
ActorOf(vtkPolyData * surface)
{
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.5, 0.3);
  return actor;
}

/** A ball of radius 1 to the right of the middle of a window, with a value at each point; the camera looks along -z and
 * shows 6 x 5. */
struct PassScene
{
  explicit PassScene(vtkRenderPass * with = vtkSmartPointer<vtkRhombicSurfacePass>::New())
    : pass(with)
  {
    window->SetSize(Width, Height);
    window->SetMultiSamples(0);
    window->SetAlphaBitPlanes(1);
    window->AddRenderer(renderer);
    renderer->SetBackground(0.1, 0.2, 0.3);
    renderer->SetPass(pass);
    vtkCamera * const camera = renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 10.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(2.5);
    camera->SetClippingRange(1.0, 20.0);
    surface = BallOf(1.0);
    const vtkNew<vtkFloatArray> values;
    for (vtkIdType n = 0; n < surface->GetNumberOfPoints(); ++n)
    {
      values->InsertNextValue(static_cast<float>(surface->GetPoint(n)[1]));
    }
    surface->GetPointData()->SetScalars(values);
    ball = ActorOf(surface);
    ball->SetPosition(1.5, 0.0, 0.0);
    ball->GetMapper()->ScalarVisibilityOff();
    renderer->AddActor(ball);
  }

  vtkSmartPointer<vtkActor>
  Add(vtkPolyData * polyData, double x)
  {
    auto actor = ActorOf(polyData);
    actor->SetPosition(x, 0.0, 0.0);
    renderer->AddActor(actor);
    return actor;
  }

  Bytes
  Draw()
  {
    window->Render();
    const vtkNew<vtkUnsignedCharArray> pixels;
    const int * const size = window->GetSize();
    EXPECT_EQ(window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels, 0), VTK_OK);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  vtkSmartPointer<vtkRenderPass> pass;
  vtkSmartPointer<vtkRhombicHeadlessRenderWindow> window = vtkSmartPointer<vtkRhombicHeadlessRenderWindow>::New();
  vtkSmartPointer<vtkRenderer> renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkActor> ball;
};

inline std::array<int, 3>
At(const Bytes & pixels, int x, int y)
{
  const auto first = 3 * (static_cast<std::size_t>(y) * Width + static_cast<std::size_t>(x));
  return { pixels[first], pixels[first + 1], pixels[first + 2] };
}

/** The left or the right half of a picture. */
inline Bytes
HalfOf(const Bytes & pixels, bool left)
{
  Bytes half;
  for (std::size_t n = 0; n < pixels.size(); ++n)
  {
    if ((n / 3 % Width < Width / 2) == left)
    {
      half.push_back(pixels[n]);
    }
  }
  return half;
}

/** The number of pixels with another colour. */
inline std::size_t
DifferentPixels(const Bytes & a, const Bytes & b)
{
  EXPECT_EQ(a.size(), b.size());
  std::size_t count = 0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); n += 3)
  {
    count += std::equal(a.begin() + static_cast<std::ptrdiff_t>(n),
                        a.begin() + static_cast<std::ptrdiff_t>(n + 3),
                        b.begin() + static_cast<std::ptrdiff_t>(n))
               ? 0
               : 1;
  }
  return count;
}

inline Bytes
BallAlone()
{
  return PassScene().Draw();
}

/** A picture of one colour. */
inline vtkSmartPointer<vtkTexture>
TextureOf(unsigned char red, unsigned char green)
{
  const vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto * const bytes = static_cast<unsigned char *>(image->GetScalarPointer());
  for (std::size_t n = 0; n < 12; n += 3)
  {
    bytes[n] = red;
    bytes[n + 1] = green;
    bytes[n + 2] = 0;
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

inline vtkSmartPointer<vtkActor>
Poster(vtkTexture * texture)
{
  const vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2.5, -1.0, 0.0);
  plane->SetPoint1(-0.5, -1.0, 0.0);
  plane->SetPoint2(-2.5, 1.0, 0.0);
  plane->Update();
  auto actor = ActorOf(plane->GetOutput());
  actor->SetTexture(texture);
  return actor;
}

} // namespace rhombic::test

#endif
