// A scene of VTK without an X server: on the left drawn by Rhombic's passes, on the right by VTK's own.

#include "rhombicFailure.h"
#include "vtkRhombicHeadlessRenderWindow.h"
#include "vtkRhombicSurfacePass.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <iostream>
#include <stdexcept>

void
AddBall(vtkRenderer * renderer, double x, double radius, double red, double opacity)
{
  const vtkNew<vtkSphereSource> ball;
  ball->SetCenter(x, 0.0, 0.0);
  ball->SetRadius(radius);
  ball->SetThetaResolution(96);
  ball->SetPhiResolution(48);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  const vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, 0.6, 0.4);
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
}

int
main(int argc, char ** argv)
try
{
  if (argc != 2)
  {
    throw std::runtime_error("usage: DrawInVTK OUTPUT.png");
  }
  const vtkNew<vtkRhombicHeadlessRenderWindow> window;
  if (!window->SupportsOpenGL())
  {
    throw std::runtime_error(window->GetOpenGLSupportMessage());
  }
  window->SetSize(800, 400);
  window->SetAlphaBitPlanes(1);
  window->SetMultiSamples(0);
  for (const double left : { 0.0, 0.5 })
  {
    const vtkNew<vtkRenderer> renderer;
    AddBall(renderer, 0.0, 30.0, 0.9, 0.4);
    AddBall(renderer, 5.0, 12.0, 0.2, 1.0);
    AddBall(renderer, -14.0, 8.0, 0.6, 1.0);
    renderer->SetViewport(left, 0.0, left + 0.5, 1.0);
    renderer->SetBackground(1.0, 1.0, 1.0);
    renderer->UseDepthPeelingOn(); // without effect on Rhombic's passes, which always sort
    if (left == 0.0)
    {
      renderer->SetPass(vtkNew<vtkRhombicSurfacePass>());
    }
    renderer->ResetCamera();
    window->AddRenderer(renderer);
  }
  const vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  const vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw std::runtime_error(std::string("Cannot write ") + argv[1] + "; check that its folder exists");
  }
}
catch (const std::exception & error)
{
  std::cerr << rhombic::DescribeError(error) << '\n';
  return 1;
}
