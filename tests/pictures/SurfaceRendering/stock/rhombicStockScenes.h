#ifndef rhombicStockScenes_h
#define rhombicStockScenes_h

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkSSAOPass.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <array>

/** Scenes of plain VTK, each 200 x 160 pixels on blue. */
namespace rhombic::test
{

inline constexpr int StockWidth = 200;
inline constexpr int StockHeight = 160;

inline vtkSmartPointer<vtkActor>
MakeBall(double radius, double opacity)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

/** A red ball of radius 1, seen from the distance 10, and a small one of green lines, 3 pixels wide, to its right. */
inline void
AddBall(vtkRenderWindow *, vtkRenderer * renderer)
{
  const auto ball = MakeBall(1.0, 1.0);
  ball->GetProperty()->SetSpecular(0.5);
  const auto lines = MakeBall(0.3, 1.0);
  lines->SetPosition(1.5, 0.0, 0.0);
  lines->GetProperty()->SetRepresentationToWireframe();
  lines->GetProperty()->SetLineWidth(3.0f);
  lines->GetProperty()->SetColor(0.0, 1.0, 0.0);
  renderer->AddActor(ball);
  renderer->AddActor(lines);
}

/** Three balls in each other, each with the opacity 0.5, without shades: six layers at the centre. */
inline void
AddTranslucentBalls(vtkRenderWindow * window, vtkRenderer * renderer)
{
  window->SetAlphaBitPlanes(1);
  window->SetMultiSamples(0);
  renderer->SetUseDepthPeeling(true);
  renderer->SetMaximumNumberOfPeels(20);
  renderer->SetOcclusionRatio(0.0);
  for (const double radius : { 0.4, 0.7, 1.0 })
  {
    const auto ball = MakeBall(radius, 0.5);
    ball->GetProperty()->LightingOff();
    renderer->AddActor(ball);
  }
}

inline void
AddOccludedBalls(vtkRenderWindow * window, vtkRenderer * renderer)
{
  window->SetMultiSamples(0);
  const auto other = MakeBall(0.6, 1.0);
  other->SetPosition(0.9, 0.3, 0.5);
  renderer->AddActor(MakeBall(1.0, 1.0));
  renderer->AddActor(other);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetRadius(0.5);
  occlusion->SetBias(0.005);
  occlusion->SetDelegatePass(steps);
  static_cast<vtkOpenGLRenderer *>(renderer)->SetPass(occlusion);
}

inline void
AddText(vtkRenderWindow *, vtkRenderer * renderer)
{
  vtkNew<vtkTextActor> text;
  text->SetInput("Rhombic 12");
  text->GetTextProperty()->SetFontSize(30);
  text->GetTextProperty()->SetColor(1.0, 1.0, 0.0);
  text->SetPosition(15, 60);
  renderer->AddActor2D(text);
}

inline void
AddImageSlice(vtkRenderWindow *, vtkRenderer * renderer)
{
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-10, 10, -10, 10, -10, 10);
  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(wavelet->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  slice->SetScale(0.1);
  slice->GetProperty()->SetColorWindow(240.0);
  slice->GetProperty()->SetColorLevel(160.0);
  renderer->AddViewProp(slice);
}

inline void
AddScalarBar(vtkRenderWindow *, vtkRenderer * renderer)
{
  vtkNew<vtkLookupTable> colours;
  colours->SetTableRange(-1000.0, 3000.0);
  colours->SetHueRange(0.0, 0.3);
  colours->Build();
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetTitle("HU");
  renderer->AddActor2D(bar);
}

struct StockScene
{
  const char * name;
  void (*add)(vtkRenderWindow *, vtkRenderer *);
};

inline constexpr std::array<StockScene, 6> StockScenes{ { { "ball", AddBall },
                                                          { "peeling", AddTranslucentBalls },
                                                          { "occlusion", AddOccludedBalls },
                                                          { "text", AddText },
                                                          { "slice", AddImageSlice },
                                                          { "bar", AddScalarBar } } };

/** Draws a scene in a new renderer of a window. */
inline vtkSmartPointer<vtkRenderer>
DrawStockScene(vtkRenderWindow * window, const StockScene & scene)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(0.0, 0.0, 1.0);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 10.0);
  renderer->GetActiveCamera()->SetViewAngle(20.0);
  window->AddRenderer(renderer);
  window->SetSize(StockWidth, StockHeight);
  scene.add(window, renderer);
  renderer->ResetCameraClippingRange();
  window->Render();
  return renderer;
}

} // namespace rhombic::test

#endif
