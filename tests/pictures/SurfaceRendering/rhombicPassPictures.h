#ifndef rhombicPassPictures_h
#define rhombicPassPictures_h

#include "vtkRhombicHeadlessRenderWindow.h"
#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicSurfacePass.h"

#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <functional>
#include <vector>

/** Scenes of VTK, drawn by Rhombic's passes or by VTK's own, and how their pictures differ. */
namespace rhombic::test
{

inline constexpr int Side = 200; // pixels
inline constexpr double LargestLitDifference = 3.0;
inline constexpr double ShareAtEdges = 0.001; // of pixels, that may differ by rounding

/** What is in a window. */
struct Drawn
{
  std::vector<unsigned char> colours; ///< RGB
  std::vector<float> depths;
};

using SetUp = std::function<void(vtkRenderer *)>;

/** Renders a window of Side x Side pixels, and reads it. */
inline Drawn
Render(vtkRenderWindow * window)
{
  window->Render();
  const vtkNew<vtkUnsignedCharArray> colours;
  const vtkNew<vtkFloatArray> depths;
  EXPECT_EQ(window->GetPixelData(0, 0, Side - 1, Side - 1, 0, colours, 0), VTK_OK);
  EXPECT_EQ(window->GetZbufferData(0, 0, Side - 1, Side - 1, depths), VTK_OK);
  return { { colours->GetPointer(0), colours->GetPointer(0) + colours->GetNumberOfValues() },
           { depths->GetPointer(0), depths->GetPointer(0) + depths->GetNumberOfValues() } };
}

inline vtkSmartPointer<vtkRenderWindow>
MakeWindow(int multiSamples = 0)
{
  const vtkNew<vtkRhombicHeadlessRenderWindow> window;
  window->SetSize(Side, Side);
  window->SetAlphaBitPlanes(1);
  window->SetMultiSamples(multiSamples);
  return window.Get();
}

/** Lets VTK's own passes peel all layers. */
inline void
PeelDepths(vtkRenderer * renderer)
{
  renderer->UseDepthPeelingOn();
  renderer->SetMaximumNumberOfPeels(20);
  renderer->SetOcclusionRatio(0.0);
}

inline Drawn
Draw(const SetUp & setUp, vtkRenderPass * pass, int multiSamples = 0)
{
  const auto window = MakeWindow(multiSamples);
  const vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.1, 0.2, 0.3);
  setUp(renderer);
  renderer->ResetCameraClippingRange();
  PeelDepths(renderer);
  renderer->SetPass(pass);
  window->AddRenderer(renderer);
  return Render(window);
}

/** The passes as VTK draws: one sample, the renderer's lights, no shades. */
inline vtkSmartPointer<vtkRhombicSurfacePass>
PlainPass()
{
  auto pass = vtkSmartPointer<vtkRhombicSurfacePass>::New();
  pass->GetSurfaces()->SetSamples(1);
  pass->GetSurfaces()->AmbientOcclusionOff();
  pass->GetSurfaces()->SilhouettesOff();
  return pass;
}

/** The share of pixels of which a colour differs by more than a limit. */
inline double
ShareOfOtherColours(const Drawn & a, const Drawn & b, double limit)
{
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.colours.size(); n += 3)
  {
    bool differs = false;
    for (std::size_t k = n; k < n + 3; ++k)
    {
      differs = differs || std::abs(a.colours[k] - b.colours[k]) > limit;
    }
    count += differs ? 1 : 0;
  }
  return static_cast<double>(count) / (Side * Side);
}

inline double
ShareOfOtherDepths(const Drawn & a, const Drawn & b)
{
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.depths.size(); ++n)
  {
    count += std::abs(a.depths[n] - b.depths[n]) > 1e-6f ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(a.depths.size());
}

/** The share of pixels with a surface. */
inline double
ShareOfSurfaces(const Drawn & drawn)
{
  std::size_t count = 0;
  for (const float depth : drawn.depths)
  {
    count += depth < 1.0f ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(drawn.depths.size());
}

inline void
ExpectVTKsPicture(const SetUp & setUp, double limit = LargestLitDifference)
{
  const Drawn expected = Draw(setUp, nullptr);
  const Drawn drawn = Draw(setUp, PlainPass());
  EXPECT_GT(ShareOfSurfaces(expected), 0.005);
  EXPECT_LE(ShareOfOtherDepths(expected, drawn), ShareAtEdges);
  EXPECT_LE(ShareOfOtherColours(expected, drawn, limit), ShareAtEdges);
}

inline void
Look(vtkRenderer * renderer, bool isParallel = false)
{
  vtkCamera * const camera = renderer->GetActiveCamera();
  camera->SetPosition(3.0, -9.0, 4.0);
  camera->SetFocalPoint(0.2, 0.1, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetParallelProjection(isParallel);
  camera->SetParallelScale(2.5);
}

inline vtkSmartPointer<vtkPolyData>
Ball(double radius, bool hasNormals = true, int resolution = 24)
{
  const vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(resolution);
  ball->SetPhiResolution(resolution);
  ball->SetGenerateNormals(hasNormals);
  ball->Update();
  return ball->GetOutput();
}

inline vtkActor *
Add(vtkRenderer * renderer, vtkPolyData * surface)
{
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  const vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.2);
  renderer->AddActor(actor);
  return actor;
}

} // namespace rhombic::test

#endif
