#include "rhombicPassPictures.h"
#include "rhombicPassScene.h"
#include "vtkRhombicTranslucentPass.h"

#include <vtkAssembly.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkExecutive.h>
#include <vtkFollower.h>
#include <vtkHardwareSelector.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkInformation.h>
#include <vtkLineSource.h>
#include <vtkLogger.h>
#include <vtkMatrix4x4.h>
#include <vtkOutputWindow.h>
#include <vtkPropPicker.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/** What comes into vtkRhombicSurfacePass: bad input, props of others, selections. */
namespace
{

using namespace rhombic::test;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/** The middle of the ball, of the smaller ball in front of its edge, and of the background. */
constexpr std::array<int, 2> OnBall{ 90, 50 };
constexpr std::array<int, 2> OnFront{ 108, 50 };
constexpr std::array<int, 2> OnNothing{ 20, 50 };

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

/** The errors that objects report while this is alive; none of them is printed. */
class Errors
{
public:
  Errors()
  {
    m_Command->SetClientData(this);
    m_Command->SetCallback([](vtkObject *, unsigned long, void * errors, void * text) {
      static_cast<Errors *>(errors)->m_Texts.emplace_back(static_cast<const char *>(text));
    });
  }

  void
  Observe(vtkObject * object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, m_Command);
    object->AddObserver(vtkCommand::WarningEvent, m_Command);
  }

  std::vector<std::string> m_Texts;

private:
  const vtkNew<vtkCallbackCommand> m_Command;
};

/** Adds something bad to the left half, draws twice, and expects the ball alone, or errors that objects have reported.
 */
void
ExpectOnlyTheBall(const char * what,
                  const std::function<void(PassScene &, Errors &)> & add,
                  std::size_t mostDifferent = 0)
{
  SCOPED_TRACE(what);
  static const Bytes expected = BallAlone();
  PassScene scene;
  Errors errors;
  errors.Observe(scene.window);
  errors.Observe(scene.renderer);
  errors.Observe(scene.pass);
  add(scene, errors);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (int picture = 0; picture < 2; ++picture)
  {
    EXPECT_LE(DifferentPixels(scene.Draw(), expected), mostDifferent);
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/** Three points in the left half and one triangle. */
vtkSmartPointer<vtkPolyData>
TriangleOf(const std::array<double, 3> & third)
{
  auto triangle = vtkSmartPointer<vtkPolyData>::New();
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> cells;
  points->InsertNextPoint(-2.0, -1.0, 0.0);
  points->InsertNextPoint(-1.0, -1.0, 0.0);
  points->InsertNextPoint(third.data());
  cells->InsertNextCell({ 0, 1, 2 });
  triangle->SetPoints(points);
  triangle->SetPolys(cells);
  return triangle;
}

TEST(SurfacePassInput, AGoodTriangleIsSeen)
{
  PassScene scene;
  scene.Add(TriangleOf({ -1.5, 1.0, 0.0 }), 0.0);
  EXPECT_GT(DifferentPixels(scene.Draw(), BallAlone()), 300u);
}

TEST(SurfacePassInput, ActorsWithoutSurfaces)
{
  ExpectOnlyTheBall("no mapper", [](PassScene & scene, Errors & errors) {
    const vtkNew<vtkActor> actor;
    errors.Observe(actor);
    scene.renderer->AddActor(actor);
  });
  ExpectOnlyTheBall("no input", [](PassScene & scene, Errors & errors) {
    const vtkNew<vtkActor> actor;
    const vtkNew<vtkPolyDataMapper> mapper;
    actor->SetMapper(mapper);
    errors.Observe(mapper);
    errors.Observe(mapper->GetExecutive());
    scene.renderer->AddActor(actor);
  });
  ExpectOnlyTheBall("empty polydata",
                    [](PassScene & scene, Errors &) { scene.Add(vtkSmartPointer<vtkPolyData>::New(), -1.5); });
  ExpectOnlyTheBall("no cells", [](PassScene & scene, Errors &) {
    const auto points = BallOf(1.0);
    points->SetPolys(vtkSmartPointer<vtkCellArray>::New());
    scene.Add(points, -1.5);
  });
  ExpectOnlyTheBall("no points", [](PassScene & scene, Errors &) {
    const vtkNew<vtkPolyData> cells;
    cells->SetPoints(vtkSmartPointer<vtkPoints>::New());
    const vtkNew<vtkCellArray> polygons;
    cells->SetPolys(polygons);
    scene.Add(cells, -1.5);
  });
  ExpectOnlyTheBall(
    "opacity 0", [](PassScene & scene, Errors &) { scene.Add(scene.surface, -1.5)->GetProperty()->SetOpacity(0.0); });
}

TEST(SurfacePassInput, TrianglesOfMissingPoints)
{
  ExpectOnlyTheBall("points that are not there", [](PassScene & scene, Errors &) {
    const auto triangle = TriangleOf({ -1.5, 1.0, 0.0 });
    const vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 7 });
    triangle->SetPolys(cells);
    scene.Add(triangle, 0.0);
  });
}

TEST(SurfacePassInput, PointsThatAreNoPlaces)
{
  for (const double bad : { NaN, Infinity, -Infinity, 1e30, -1e300 })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::array<double, 3> point{ -1.5, 1.0, 0.0 };
      point[axis] = bad;
      for (const double opacity : { 1.0, 0.5 })
      {
        ExpectOnlyTheBall(std::to_string(bad).c_str(), [&](PassScene & scene, Errors &) {
          scene.Add(TriangleOf(point), 0.0)->GetProperty()->SetOpacity(opacity);
        });
      }
    }
  }
}

TEST(SurfacePassInput, ASurfaceWithABadPointLacksOnlyItsTriangles)
{
  PassScene scene;
  const Bytes whole = scene.Draw();
  scene.surface->GetPoints()->SetPoint(100, std::nan(""), 0.0, 0.0);
  scene.surface->GetPoints()->Modified();
  const Bytes holed = scene.Draw();
  EXPECT_LT(DifferentPixels(whole, holed), 150u);
  EXPECT_GT(DifferentPixels(holed, PassScene().Draw()), 0u);
}

TEST(SurfacePassInput, TrianglesWithoutArea)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    ExpectOnlyTheBall("three times one point and a line", [opacity](PassScene & scene, Errors &) {
      scene.Add(TriangleOf({ -2.0, -1.0, 0.0 }), 0.0)->GetProperty()->SetOpacity(opacity);
      const auto point = TriangleOf({ -2.0, -1.0, 0.0 });
      const vtkNew<vtkCellArray> cells;
      cells->InsertNextCell({ 0, 0, 0 });
      point->SetPolys(cells);
      scene.Add(point, 0.0)->GetProperty()->SetOpacity(opacity);
    });
  }
}

TEST(SurfacePassInput, AMirroredBallIsTheBallMirrored)
{
  PassScene scene;
  const auto mirrored = scene.Add(scene.surface, 0.0);
  mirrored->GetMapper()->ScalarVisibilityOff();
  mirrored->SetScale(-1.0, 1.0, 1.0);
  mirrored->SetPosition(-1.5, 0.0, 0.0);
  vtkRhombicOpaquePass * const surfaces = vtkRhombicSurfacePass::SafeDownCast(scene.pass)->GetSurfaces();
  surfaces->AmbientOcclusionOff();
  surfaces->SilhouettesOff();
  const Bytes pixels = scene.Draw();
  // The headlight shines along the line of sight, so both halves of the picture look the same.
  int different = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width / 2; ++x)
    {
      const auto left = At(pixels, x, y);
      const auto right = At(pixels, Width - 1 - x, y);
      different += std::abs(left[0] - right[0]) > 3 ? 1 : 0;
    }
  }
  EXPECT_LE(different, 5);
  EXPECT_GT(At(pixels, Width / 4, Height / 2)[0], 180);
}

TEST(SurfacePassInput, SixtyFiveTranslucentShells)
{
  PassScene scene;
  for (int shell = 0; shell < 65; ++shell)
  {
    const auto actor = scene.Add(BallOf(0.3 + 0.01 * shell), -1.5);
    actor->GetProperty()->SetOpacity(0.3);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  }
  const Bytes pixels = scene.Draw();
  EXPECT_EQ(HalfOf(pixels, false), HalfOf(BallAlone(), false));
  EXPECT_EQ(scene.Draw(), pixels);
  // Of the background 0.7^130 is seen; 0.7^16 is less than 1/255.
  for (const int colour : At(pixels, Width / 4, Height / 2))
  {
    EXPECT_GE(colour, 253);
  }
}

TEST(SurfacePassInput, TrianglesWithTinySides)
{
  for (const double tiny : { 1e-44, 1e-39, 1e-30 })
  {
    ExpectOnlyTheBall(std::to_string(tiny).c_str(), [tiny](PassScene & scene, Errors &) {
      const auto triangle = TriangleOf({ 0.0, tiny, 0.0 });
      triangle->GetPoints()->SetPoint(0, 0.0, 0.0, 0.0);
      triangle->GetPoints()->SetPoint(1, tiny, 0.0, 0.0);
      scene.Add(triangle, -1.5);
    });
  }
}

TEST(SurfacePassInput, NormalsAndValuesThatAreNoNumbers)
{
  PassScene scene;
  auto * const normals = vtkFloatArray::SafeDownCast(scene.surface->GetPointData()->GetNormals());
  auto * const values = vtkFloatArray::SafeDownCast(scene.surface->GetPointData()->GetScalars());
  for (vtkIdType n = 0; n < scene.surface->GetNumberOfPoints(); ++n)
  {
    values->SetValue(n, static_cast<float>(n % 3 == 0 ? NaN : n % 2 ? Infinity : -1e38));
    normals->SetTuple3(n, n % 2 ? NaN : 0.0, 0.0, n % 3 ? Infinity : 0.0);
  }
  scene.ball->GetMapper()->ScalarVisibilityOn();
  scene.Draw();
  const vtkNew<vtkFloatArray> depths;
  EXPECT_EQ(scene.window->GetZbufferData(0, 0, Width - 1, Height - 1, depths), VTK_OK);
  EXPECT_LT(depths->GetValue(OnBall[1] * Width + OnBall[0]), 1.0f);
}

TEST(SurfacePassInput, MatricesThatCannotBeInverted)
{
  const std::vector<std::array<double, 2>> scalesAndShifts{ { 0.0, 0.0 },      { NaN, 0.0 },  { 1.0, NaN },
                                                            { Infinity, 0.0 }, { 1.0, 1e30 }, { 1.0, Infinity },
                                                            { 1.0, 1e200 },    { 1e-8, 0.0 } };
  for (const auto & [scale, shift] : scalesAndShifts)
  {
    for (const double opacity : { 1.0, 0.5 })
    {
      const auto add = [&, scale = scale, shift = shift](PassScene & scene, Errors &) {
        const vtkNew<vtkMatrix4x4> matrix;
        for (int n = 0; n < 3; ++n)
        {
          matrix->SetElement(n, n, scale);
          matrix->SetElement(n, 3, shift);
        }
        const auto actor = scene.Add(BallOf(0.8), 0.0);
        actor->GetProperty()->SetOpacity(opacity);
        actor->SetUserMatrix(matrix);
      };
      ExpectOnlyTheBall((std::to_string(scale) + ' ' + std::to_string(shift)).c_str(), add);
    }
  }
}

TEST(SurfacePassInput, CamerasThatSeeNothing)
{
  const std::vector<std::function<void(vtkCamera *)>> changes{
    [](vtkCamera * camera) { camera->SetPosition(camera->GetFocalPoint()); },
    [](vtkCamera * camera) { camera->SetPosition(NaN, 0.0, 0.0); },
    [](vtkCamera * camera) { camera->SetFocalPoint(Infinity, 0.0, 0.0); },
    [](vtkCamera * camera) { camera->SetViewUp(camera->GetDirectionOfProjection()); },
    [](vtkCamera * camera) { camera->SetClippingRange(NaN, NaN); },
    [](vtkCamera * camera) { camera->SetClippingRange(0.0, 0.0); },
    [](vtkCamera * camera) { camera->ParallelProjectionOff(), camera->SetViewAngle(NaN); },
    [](vtkCamera * camera) { camera->ParallelProjectionOff(), camera->SetViewAngle(1e-8); },
    [](vtkCamera * camera) { camera->SetParallelScale(0.0); },
    [](vtkCamera * camera) { camera->SetParallelScale(NaN); },
    [](vtkCamera * camera) { camera->SetPosition(1.5, 0.0, 0.1); }, // within the ball
  };
  const QuietMessages quiet;
  const Bytes expected = BallAlone();
  for (std::size_t n = 0; n < changes.size(); ++n)
  {
    PassScene scene;
    const auto shell = scene.Add(BallOf(1.2), 1.5);
    shell->GetProperty()->SetOpacity(0.5);
    const vtkNew<vtkCamera> seeing;
    seeing->DeepCopy(scene.renderer->GetActiveCamera());
    changes[n](scene.renderer->GetActiveCamera());
    scene.Draw();
    // The window and the pass go on with a camera that sees.
    scene.renderer->SetActiveCamera(seeing);
    scene.renderer->RemoveActor(shell);
    EXPECT_EQ(DifferentPixels(scene.Draw(), expected), 0u) << n;
  }
}

TEST(SurfacePassInput, TenThousandActors)
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
  const double ofRhombic = secondsOf("rhombic", vtkNew<vtkRhombicSurfacePass>());
  const double ofVTK = secondsOf("vtk", nullptr);
  EXPECT_LT(ofRhombic, 3.0 * ofVTK + 1.0);
}

TEST(SurfacePassInput, WithoutAnOpaquePassThereIsAnErrorOfVTK)
{
  const vtkNew<vtkRhombicTranslucentPass> pass;
  pass->SetOpaquePass(nullptr);
  const vtkNew<vtkRenderStepsPass> steps;
  steps->SetTranslucentPass(pass);
  Errors errors;
  errors.Observe(pass);
  PassScene scene(steps);
  EXPECT_EQ(scene.Draw(), PassScene(vtkSmartPointer<vtkRenderStepsPass>::New()).Draw()); // opaque as by VTK
  EXPECT_EQ(errors.m_Texts.size(), 1u);
}

TEST(SurfacePassInput, AViewportWithoutPixels)
{
  const Bytes expected = BallAlone();
  for (const std::array<double, 4> part : { std::array<double, 4>{ 0.5, 0.5, 0.5, 0.5 }, { 0.0, 0.0, 0.0, 1.0 } })
  {
    PassScene scene;
    const vtkNew<vtkRenderer> nothing;
    nothing->SetPass(vtkSmartPointer<vtkRhombicSurfacePass>::New());
    nothing->SetViewport(part[0], part[1], part[2], part[3]);
    nothing->AddActor(ActorOf(BallOf(1.0)));
    nothing->AddActor(ActorOf(BallOf(2.0)));
    nothing->GetActors()->GetLastActor()->GetProperty()->SetOpacity(0.5);
    nothing->SetLayer(0);
    scene.window->AddRenderer(nothing);
    testing::internal::CaptureStderr();
    EXPECT_LE(DifferentPixels(scene.Draw(), expected), static_cast<std::size_t>(Width + Height));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}
// Props that are left to VTK

using AddProp = std::function<void(vtkRenderer *)>;

/** Expects a prop in the left half as VTK draws it, while a surface is drawn in the right half. */
void
ExpectVTKsProp(const char * what, const AddProp & add)
{
  SCOPED_TRACE(what);
  PassScene withVTK(vtkSmartPointer<vtkRenderStepsPass>::New());
  add(withVTK.renderer);
  const Bytes expected = withVTK.Draw();
  PassScene scene;
  add(scene.renderer);
  const Bytes drawn = scene.Draw();
  const Bytes surface = BallAlone();
  EXPECT_EQ(DifferentPixels(HalfOf(drawn, true), HalfOf(expected, true)), 0u);
  EXPECT_EQ(HalfOf(drawn, false), HalfOf(surface, false));
  EXPECT_GT(DifferentPixels(HalfOf(drawn, true), HalfOf(surface, true)), 30u);
}

TEST(SurfacePassOthers, AreDrawnAsByVTK)
{
  const auto ballOnTheLeft = [] {
    auto actor = ActorOf(BallOf(1.0, 12));
    actor->SetPosition(-1.5, 0.0, 0.0);
    return actor;
  };
  ExpectVTKsProp("lines", [](vtkRenderer * renderer) {
    const vtkNew<vtkLineSource> line;
    line->SetPoint1(-2.5, -1.0, 0.0);
    line->SetPoint2(-0.5, 1.5, 0.0);
    line->Update();
    const auto actor = ActorOf(line->GetOutput());
    actor->GetProperty()->SetLineWidth(3.0f);
    renderer->AddActor(actor);
  });
  for (const double opacity : { 1.0, 0.5 })
  {
    ExpectVTKsProp("wireframe", [&](vtkRenderer * renderer) {
      const auto actor = ballOnTheLeft();
      actor->GetProperty()->SetRepresentationToWireframe();
      actor->GetProperty()->SetOpacity(opacity);
      renderer->AddActor(actor);
    });
    ExpectVTKsProp("edges", [&](vtkRenderer * renderer) {
      const auto actor = ballOnTheLeft();
      actor->GetProperty()->EdgeVisibilityOn();
      actor->GetProperty()->SetOpacity(opacity);
      renderer->AddActor(actor);
    });
    ExpectVTKsProp("assembly", [&](vtkRenderer * renderer) {
      const vtkNew<vtkAssembly> assembly;
      const auto part = ballOnTheLeft();
      part->GetProperty()->SetOpacity(opacity);
      assembly->AddPart(part);
      renderer->AddActor(assembly);
    });
    ExpectVTKsProp("follower", [&](vtkRenderer * renderer) {
      const vtkNew<vtkFollower> follower;
      follower->SetMapper(ballOnTheLeft()->GetMapper());
      follower->SetPosition(-1.5, 0.0, 0.0);
      follower->GetProperty()->SetOpacity(opacity);
      follower->SetCamera(renderer->GetActiveCamera());
      renderer->AddActor(follower);
    });
  }
  ExpectVTKsProp("texture", [](vtkRenderer * renderer) { renderer->AddActor(Poster(TextureOf(250, 120))); });
  ExpectVTKsProp("image slice", [](vtkRenderer * renderer) {
    const vtkNew<vtkImageData> image;
    image->SetDimensions(3, 3, 1);
    image->SetOrigin(-2.5, -1.0, 0.0);
    image->AllocateScalars(VTK_FLOAT, 1);
    for (int n = 0; n < 9; ++n)
    {
      static_cast<float *>(image->GetScalarPointer())[n] = static_cast<float>(n);
    }
    const vtkNew<vtkImageSliceMapper> mapper;
    mapper->SetInputData(image);
    const vtkNew<vtkImageSlice> slice;
    slice->SetMapper(mapper);
    slice->GetProperty()->SetColorWindow(9.0);
    slice->GetProperty()->SetColorLevel(4.5);
    renderer->AddViewProp(slice);
  });
}

// Selection

TEST(SurfacePassSelection, FindsTheActorThatIsSeen)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    PassScene scene;
    scene.ball->GetProperty()->SetOpacity(opacity);
    const auto front = scene.Add(BallOf(0.4), 2.4);
    front->AddPosition(0.0, 0.0, 2.0);
    front->GetProperty()->SetOpacity(opacity);
    const Bytes pixels = scene.Draw();
    const auto select = [&scene](const std::array<int, 2> & at) -> vtkProp * {
      const vtkNew<vtkHardwareSelector> selector;
      selector->SetRenderer(scene.renderer);
      selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
      const auto x = static_cast<unsigned int>(at[0]);
      const auto y = static_cast<unsigned int>(at[1]);
      selector->SetArea(x, y, x, y);
      const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
      if (!selection || selection->GetNumberOfNodes() == 0)
      {
        return nullptr;
      }
      return vtkProp::SafeDownCast(selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()));
    };
    EXPECT_EQ(select(OnBall), scene.ball);
    EXPECT_EQ(select(OnFront), front);
    EXPECT_EQ(select(OnNothing), nullptr);
    const vtkNew<vtkPropPicker> picker;
    EXPECT_EQ(picker->Pick(OnBall[0], OnBall[1], 0.0, scene.renderer), 1);
    EXPECT_EQ(picker->GetActor(), scene.ball);
    EXPECT_EQ(picker->Pick(OnFront[0], OnFront[1], 0.0, scene.renderer), 1);
    EXPECT_EQ(picker->GetActor(), front);
    EXPECT_EQ(picker->Pick(OnNothing[0], OnNothing[1], 0.0, scene.renderer), 0);
    EXPECT_EQ(scene.Draw(), pixels);
  }
}

} // namespace
