#include "rhombicPassPictures.h"
#include "vtkRhombicTranslucentPass.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkLogger.h>
#include <vtkMatrix4x4.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkRenderStepsPass.h>

#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/** What should not be in a scene, drawn by Rhombic's passes: a picture or errors of VTK, and no end of the program. */
namespace
{

using namespace rhombic::test;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/** \class QuietMessages
 * \brief VTK's messages are not printed during the lifetime of this object. */
class QuietMessages
{
public:
  QuietMessages()
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  }
  ~QuietMessages()
  {
    vtkOutputWindow::GetInstance()->SetDisplayModeToDefault();
    vtkLogger::SetStderrVerbosity(m_Before);
  }
  QuietMessages(const QuietMessages &) = delete;
  QuietMessages &
  operator=(const QuietMessages &) = delete;

private:
  const vtkLogger::Verbosity m_Before = vtkLogger::GetCurrentVerbosityCutoff();
};

/** A pass with all of its effects. */
vtkSmartPointer<vtkRhombicSurfacePass>
FullPass()
{
  return vtkSmartPointer<vtkRhombicSurfacePass>::New();
}

/** Draws a good ball beside what is bad, by all kinds of passes, twice, opaque and translucent. */
void
ExpectThatTheGoodBallIsSeen(const std::string & what, const std::function<void(vtkRenderer *, double)> & addBad)
{
  const QuietMessages quiet;
  const auto draw = [&](vtkRenderPass * pass, double opacity, bool isBad) {
    const auto window = MakeWindow();
    const vtkNew<vtkRenderer> renderer;
    Look(renderer);
    Add(renderer, Ball(0.8, true, 32))->GetProperty()->SetOpacity(opacity);
    renderer->ResetCameraClippingRange();
    if (isBad)
    {
      addBad(renderer, opacity);
    }
    renderer->SetPass(pass);
    window->AddRenderer(renderer);
    Render(window);
    return Render(window);
  };
  for (const double opacity : { 1.0, 0.5 })
  {
    EXPECT_TRUE(draw(PlainPass(), opacity, true).colours == draw(PlainPass(), opacity, false).colours)
      << what << ' ' << opacity;
    draw(FullPass(), opacity, true);
  }
}

/** Triangles of a strip of points. */
vtkSmartPointer<vtkPolyData>
TrianglesThrough(const std::vector<std::array<double, 3>> & corners)
{
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkNew<vtkCellArray> cells;
  for (vtkIdType n = 0; n < static_cast<vtkIdType>(corners.size()); ++n)
  {
    points->InsertNextPoint(corners[static_cast<std::size_t>(n)].data());
    if (n > 1)
    {
      cells->InsertNextCell({ n - 2, n - 1, n });
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

TEST(SurfacePassBadInput, ActorsWithoutMapperInputOrCells)
{
  ExpectThatTheGoodBallIsSeen("no mapper",
                              [](vtkRenderer * renderer, double) { renderer->AddActor(vtkNew<vtkActor>()); });
  ExpectThatTheGoodBallIsSeen("no input", [](vtkRenderer * renderer, double) {
    const vtkNew<vtkActor> actor;
    actor->SetMapper(vtkNew<vtkPolyDataMapper>());
    renderer->AddActor(actor);
  });
  ExpectThatTheGoodBallIsSeen("no points", [](vtkRenderer * renderer, double opacity) {
    Add(renderer, vtkNew<vtkPolyData>())->GetProperty()->SetOpacity(opacity);
  });
  ExpectThatTheGoodBallIsSeen("no cells", [](vtkRenderer * renderer, double opacity) {
    const vtkNew<vtkPolyData> points;
    points->SetPoints(vtkNew<vtkPoints>());
    points->GetPoints()->InsertNextPoint(0.0, 0.0, 0.0);
    points->SetPolys(vtkNew<vtkCellArray>());
    Add(renderer, points)->GetProperty()->SetOpacity(opacity);
  });
  ExpectThatTheGoodBallIsSeen("cells of two and no corners", [](vtkRenderer * renderer, double opacity) {
    const auto surface = TrianglesThrough({ { 3.0, 0.0, 0.0 }, { 3.0, 1.0, 0.0 } });
    surface->GetPolys()->InsertNextCell({ 0, 1 });
    surface->GetPolys()->InsertNextCell(0);
    Add(renderer, surface)->GetProperty()->SetOpacity(opacity);
  });
}

TEST(SurfacePassBadInput, PointsThatAreNoPlaces)
{
  for (const double bad : { NaN, Infinity, -Infinity, 1e30, 1e300 })
  {
    ExpectThatTheGoodBallIsSeen("all points " + std::to_string(bad), [bad](vtkRenderer * renderer, double opacity) {
      Add(renderer, TrianglesThrough({ { bad, bad, bad }, { bad, 0.0, bad }, { bad, bad, 1.0 } }))
        ->GetProperty()
        ->SetOpacity(opacity);
    });
    ExpectThatTheGoodBallIsSeen("one point " + std::to_string(bad), [bad](vtkRenderer * renderer, double opacity) {
      Add(renderer, TrianglesThrough({ { bad, 0.0, 0.0 }, { 9.0, 0.0, 0.0 }, { 9.0, 1.0, 0.0 } }))
        ->GetProperty()
        ->SetOpacity(opacity);
    });
  }
  for (const double tiny : { 0.0, 1e-44, 1e-39, 1e-30 })
  {
    ExpectThatTheGoodBallIsSeen("size " + std::to_string(tiny), [tiny](vtkRenderer * renderer, double opacity) {
      const auto surface = TrianglesThrough({ { 0.0, 0.0, 0.0 }, { tiny, 0.0, 0.0 }, { 0.0, tiny, 0.0 } });
      const vtkNew<vtkFloatArray> positions; // as floats, which keep such values when moved
      positions->SetNumberOfComponents(3);
      for (vtkIdType n = 0; n < 3; ++n)
      {
        positions->InsertNextTuple(surface->GetPoint(n));
      }
      surface->GetPoints()->SetData(positions);
      Add(renderer, surface)->GetProperty()->SetOpacity(opacity);
    });
  }
}

TEST(SurfacePassBadInput, NormalsAndValuesThatAreNoNumbers)
{
  const QuietMessages quiet;
  const auto setUp = [](vtkRenderer * renderer) {
    Look(renderer);
    const auto ball = Ball(1.0);
    auto * const normals = vtkFloatArray::SafeDownCast(ball->GetPointData()->GetNormals());
    const vtkNew<vtkFloatArray> values;
    for (vtkIdType n = 0; n < ball->GetNumberOfPoints(); ++n)
    {
      values->InsertNextValue(n % 3 == 0 ? static_cast<float>(NaN) : static_cast<float>(n % 2 ? Infinity : -1e38));
      normals->SetTuple3(n, n % 2 ? NaN : 0.0, 0.0, n % 3 ? Infinity : 0.0);
    }
    ball->GetPointData()->SetScalars(values);
    Add(renderer, ball);
  };
  for (const auto & pass : { PlainPass(), FullPass() })
  {
    const Drawn drawn = Draw(setUp, pass);
    EXPECT_GT(ShareOfSurfaces(drawn), 0.05);
  }
}

TEST(SurfacePassBadInput, MatricesThatCannotBeInverted)
{
  const auto with = [](double scale, double shift) {
    return [=](vtkRenderer * renderer, double opacity) {
      vtkActor * const actor = Add(renderer, Ball(0.8, true, 32));
      actor->GetProperty()->SetOpacity(opacity);
      const vtkNew<vtkMatrix4x4> matrix;
      for (int n = 0; n < 3; ++n)
      {
        matrix->SetElement(n, n, scale);
        matrix->SetElement(n, 3, shift);
      }
      actor->SetUserMatrix(matrix);
    };
  };
  ExpectThatTheGoodBallIsSeen("0", with(0.0, 0.0));
  ExpectThatTheGoodBallIsSeen("NaN", with(NaN, 0.0));
  ExpectThatTheGoodBallIsSeen("NaN away", with(1.0, NaN));
  ExpectThatTheGoodBallIsSeen("infinite", with(Infinity, 0.0));
  ExpectThatTheGoodBallIsSeen("infinitely far", with(1.0, Infinity));
  ExpectThatTheGoodBallIsSeen("very far", with(1.0, 1e30));
  ExpectThatTheGoodBallIsSeen("farther than 32 bits tell", with(1.0, 1e200));
  ExpectThatTheGoodBallIsSeen("very small", with(1e-8, 0.0));
}

TEST(SurfacePassBadInput, CamerasThatSeeNothing)
{
  const QuietMessages quiet;
  const std::vector<std::function<void(vtkCamera *)>> changes{
    [](vtkCamera * camera) { camera->SetPosition(camera->GetFocalPoint()); },
    [](vtkCamera * camera) { camera->SetPosition(NaN, 0.0, 0.0); },
    [](vtkCamera * camera) { camera->SetFocalPoint(Infinity, 0.0, 0.0); },
    [](vtkCamera * camera) { camera->SetViewUp(camera->GetDirectionOfProjection()); },
    [](vtkCamera * camera) { camera->SetClippingRange(NaN, NaN); },
    [](vtkCamera * camera) { camera->SetClippingRange(0.0, 0.0); },
    [](vtkCamera * camera) { camera->SetViewAngle(NaN); },
    [](vtkCamera * camera) { camera->SetViewAngle(1e-8); },
    [](vtkCamera * camera) { camera->ParallelProjectionOn(), camera->SetParallelScale(0.0); },
    [](vtkCamera * camera) { camera->ParallelProjectionOn(), camera->SetParallelScale(NaN); },
    [](vtkCamera * camera) { camera->SetPosition(0.0, 0.0, 0.1); }, // within the balls
  };
  for (std::size_t n = 0; n < changes.size(); ++n)
  {
    for (const auto & pass : { PlainPass(), FullPass() })
    {
      const auto window = MakeWindow();
      const vtkNew<vtkRenderer> renderer;
      Look(renderer);
      Add(renderer, Ball(1.0));
      Add(renderer, Ball(1.2))->GetProperty()->SetOpacity(0.5);
      renderer->ResetCameraClippingRange();
      changes[n](renderer->GetActiveCamera());
      renderer->SetPass(pass);
      window->AddRenderer(renderer);
      Render(window);
      // The window and the pass go on with a camera that sees.
      renderer->SetActiveCamera(vtkNew<vtkCamera>());
      Look(renderer);
      renderer->ResetCameraClippingRange();
      EXPECT_GT(ShareOfSurfaces(Render(window)), 0.05) << n;
    }
  }
}

TEST(SurfacePassBadInput, WindowsOfOnePixelAndViewportsOfNone)
{
  const QuietMessages quiet;
  const auto pass = FullPass();
  const auto window = MakeWindow();
  const vtkNew<vtkRenderer> renderer;
  Look(renderer);
  Add(renderer, Ball(1.5));
  Add(renderer, Ball(1.8))->GetProperty()->SetOpacity(0.5);
  renderer->SetPass(pass);
  window->AddRenderer(renderer);
  const Drawn before = Render(window);
  window->SetSize(1, 1);
  window->Render();
  window->SetSize(Side, Side);
  renderer->SetViewport(0.5, 0.5, 0.5, 0.5);
  window->Render();
  renderer->SetViewport(0.0, 0.0, 1.0, 1.0);
  EXPECT_TRUE(Render(window).colours == before.colours);
}

TEST(SurfacePassBadInput, OpacityNoughtIsNotSeen)
{
  ExpectThatTheGoodBallIsSeen(
    "opacity 0", [](vtkRenderer * renderer, double) { Add(renderer, Ball(1.5))->GetProperty()->SetOpacity(0.0); });
}

TEST(SurfacePassBadInput, OfManyLayersTheNearestSixteenAreSeen)
{
  const auto shells = [](int first) {
    return [first](vtkRenderer * renderer) {
      Look(renderer);
      for (int n = first; n < 65; ++n)
      {
        vtkProperty * const property = Add(renderer, Ball(0.3 + 0.02 * n, true, 48))->GetProperty();
        property->SetOpacity(0.2);
        property->SetColor(n % 2, n % 3 / 2.0, 0.5);
        property->BackfaceCullingOn();
      }
    };
  };
  const Drawn all = Draw(shells(0), PlainPass());
  const Drawn nearest = Draw(shells(65 - 16), PlainPass());
  const auto middle = static_cast<std::size_t>(3 * (Side / 2 * Side + Side / 2));
  EXPECT_NE(all.colours[middle], all.colours[0]);
  for (std::size_t k = middle; k < middle + 3; ++k)
  {
    EXPECT_EQ(all.colours[k], nearest.colours[k]);
  }
}

TEST(SurfacePassBadInput, TenThousandActors)
{
  const auto window = MakeWindow();
  const vtkNew<vtkRenderer> renderer;
  Look(renderer);
  const auto ball = Ball(0.02, true, 6);
  for (int n = 0; n < 10000; ++n)
  {
    vtkActor * const actor = Add(renderer, ball);
    actor->SetPosition(0.04 * (n % 100 - 50), 0.0, 0.04 * (n / 100 - 50));
    actor->GetProperty()->SetOpacity(n % 10 == 0 ? 0.5 : 1.0);
  }
  renderer->ResetCameraClippingRange();
  window->AddRenderer(renderer);
  const auto secondsOf = [&](const std::string & name, vtkRenderPass * pass) {
    renderer->SetPass(pass);
    double seconds = 0.0;
    for (const std::string turn : { "First", "Again" })
    {
      const auto start = std::chrono::steady_clock::now();
      EXPECT_GT(ShareOfSurfaces(Render(window)), 0.1);
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      RecordProperty(name + turn, std::to_string(seconds));
    }
    return seconds;
  };
  const double ofRhombic = secondsOf("rhombic", FullPass());
  const double ofVTK = secondsOf("vtk", nullptr);
  EXPECT_LT(ofRhombic, 3.0 * ofVTK + 1.0);
}

TEST(SurfacePassBadInput, WithoutAnOpaquePassThereIsAnErrorOfVTK)
{
  const QuietMessages quiet;
  const vtkNew<vtkRhombicTranslucentPass> pass;
  pass->SetOpaquePass(nullptr);
  const vtkNew<vtkRenderStepsPass> steps;
  steps->SetTranslucentPass(pass);
  int errors = 0;
  const vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&errors);
  count->SetCallback([](vtkObject *, unsigned long, void * data, void *) { ++*static_cast<int *>(data); });
  pass->AddObserver(vtkCommand::ErrorEvent, count);
  const Drawn drawn = Draw(
    [](vtkRenderer * renderer) {
      Look(renderer);
      Add(renderer, Ball(0.8));
    },
    steps);
  EXPECT_EQ(errors, 1);
  EXPECT_GT(ShareOfSurfaces(drawn), 0.05);
}

} // namespace
