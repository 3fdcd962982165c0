#include "vtkRhombicHeadlessRenderWindow.h"
#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicSurfacePass.h"

#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkHardwareSelector.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkInformation.h>
#include <vtkLineSource.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropPicker.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/** What comes into vtkRhombicSurfacePass: bad input, changes between pictures, windows that come and go, other props.
 */
namespace
{

constexpr int Width = 120; // pixels
constexpr int Height = 100;

/** RGB. */
using Bytes = std::vector<unsigned char>;

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

vtkSmartPointer<vtkPolyData>
BallOf(double radius, int resolution = 24)
{
  const vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkActor>
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
struct Scene
{
  explicit Scene(vtkRenderPass * with = vtkSmartPointer<vtkRhombicSurfacePass>::New())
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

std::array<int, 3>
At(const Bytes & pixels, int x, int y)
{
  const auto first = 3 * (static_cast<std::size_t>(y) * Width + static_cast<std::size_t>(x));
  return { pixels[first], pixels[first + 1], pixels[first + 2] };
}

/** The left or the right half of a picture. */
Bytes
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
std::size_t
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

Bytes
BallAlone()
{
  return Scene().Draw();
}

// Bad input

/** Adds something bad to the left half, draws twice, and expects the ball alone, or errors that objects have reported.
 */
void
ExpectOnlyTheBall(const char * what, const std::function<void(Scene &, Errors &)> & add, std::size_t mostDifferent = 0)
{
  SCOPED_TRACE(what);
  static const Bytes expected = BallAlone();
  Scene scene;
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
  Scene scene;
  scene.Add(TriangleOf({ -1.5, 1.0, 0.0 }), 0.0);
  EXPECT_GT(DifferentPixels(scene.Draw(), BallAlone()), 300u);
}

TEST(SurfacePassInput, ActorsWithoutSurfaces)
{
  ExpectOnlyTheBall("no mapper", [](Scene & scene, Errors & errors) {
    const vtkNew<vtkActor> actor;
    errors.Observe(actor);
    scene.renderer->AddActor(actor);
  });
  ExpectOnlyTheBall("no input", [](Scene & scene, Errors & errors) {
    const vtkNew<vtkActor> actor;
    const vtkNew<vtkPolyDataMapper> mapper;
    actor->SetMapper(mapper);
    errors.Observe(mapper);
    errors.Observe(mapper->GetExecutive());
    scene.renderer->AddActor(actor);
  });
  ExpectOnlyTheBall("empty polydata",
                    [](Scene & scene, Errors &) { scene.Add(vtkSmartPointer<vtkPolyData>::New(), -1.5); });
  ExpectOnlyTheBall("no cells", [](Scene & scene, Errors &) {
    const auto points = BallOf(1.0);
    points->SetPolys(vtkSmartPointer<vtkCellArray>::New());
    scene.Add(points, -1.5);
  });
  ExpectOnlyTheBall("no points", [](Scene & scene, Errors &) {
    const vtkNew<vtkPolyData> cells;
    cells->SetPoints(vtkSmartPointer<vtkPoints>::New());
    const vtkNew<vtkCellArray> polygons;
    cells->SetPolys(polygons);
    scene.Add(cells, -1.5);
  });
  ExpectOnlyTheBall("opacity 0",
                    [](Scene & scene, Errors &) { scene.Add(scene.surface, -1.5)->GetProperty()->SetOpacity(0.0); });
}

TEST(SurfacePassInput, TrianglesOfMissingPoints)
{
  ExpectOnlyTheBall("points that are not there", [](Scene & scene, Errors &) {
    const auto triangle = TriangleOf({ -1.5, 1.0, 0.0 });
    const vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 7 });
    triangle->SetPolys(cells);
    scene.Add(triangle, 0.0);
  });
}

TEST(SurfacePassInput, PointsThatAreNoPlaces)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : { nan, infinite, -infinite, 1e30, -1e30 })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::array<double, 3> point{ -1.5, 1.0, 0.0 };
      point[axis] = bad;
      for (const double opacity : { 1.0, 0.5 })
      {
        ExpectOnlyTheBall(std::to_string(bad).c_str(), [&](Scene & scene, Errors &) {
          scene.Add(TriangleOf(point), 0.0)->GetProperty()->SetOpacity(opacity);
        });
      }
    }
  }
}

TEST(SurfacePassInput, ASurfaceWithABadPointLacksOnlyItsTriangles)
{
  Scene scene;
  const Bytes whole = scene.Draw();
  scene.surface->GetPoints()->SetPoint(100, std::nan(""), 0.0, 0.0);
  scene.surface->GetPoints()->Modified();
  const Bytes holed = scene.Draw();
  EXPECT_LT(DifferentPixels(whole, holed), 150u);
  EXPECT_GT(DifferentPixels(holed, Scene().Draw()), 0u);
}

TEST(SurfacePassInput, TrianglesWithoutArea)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    ExpectOnlyTheBall("three times one point and a line", [opacity](Scene & scene, Errors &) {
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
  Scene scene;
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
  Scene scene;
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

TEST(SurfacePassInput, AViewportWithoutPixels)
{
  const Bytes expected = BallAlone();
  for (const std::array<double, 4> part : { std::array<double, 4>{ 0.5, 0.5, 0.5, 0.5 }, { 0.0, 0.0, 0.0, 1.0 } })
  {
    Scene scene;
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

// Changes between pictures

using Change = std::function<void(Scene &)>;

/** Draws, changes, draws; the second picture differs and is that of a fresh scene with the change. */
void
ExpectToShow(
  const char * what,
  const Change & change,
  const Change & before = [](Scene &) {})
{
  SCOPED_TRACE(what);
  Scene scene;
  before(scene);
  const Bytes first = scene.Draw();
  EXPECT_EQ(scene.Draw(), first);
  change(scene);
  const Bytes second = scene.Draw();
  Scene fresh;
  before(fresh);
  change(fresh);
  EXPECT_EQ(DifferentPixels(second, fresh.Draw()), 0u);
  EXPECT_GT(DifferentPixels(first, second), 20u);
}

void
ShowValues(Scene & scene)
{
  vtkMapper * const mapper = scene.ball->GetMapper();
  mapper->ScalarVisibilityOn();
  mapper->SetScalarRange(-1.0, 1.0);
  const vtkNew<vtkLookupTable> table;
  table->SetRange(-1.0, 1.0);
  table->Build();
  mapper->SetLookupTable(table);
}

/** As ShowValues(), with values that are newer than the mapper. */
void
ShowNewValues(Scene & scene)
{
  ShowValues(scene);
  scene.surface->GetPointData()->GetScalars()->Modified();
}

TEST(SurfacePassChanges, Shape)
{
  const auto movePoints = [](Scene & scene) {
    for (vtkIdType n = 0; n < scene.surface->GetNumberOfPoints(); ++n)
    {
      std::array<double, 3> point{};
      scene.surface->GetPoint(n, point.data());
      scene.surface->GetPoints()->SetPoint(n, point[0], 1.3 * point[1], point[2]);
    }
    scene.surface->GetPoints()->Modified();
  };
  ExpectToShow("points", movePoints);
  ExpectToShow("points under values", movePoints, ShowValues);
  ExpectToShow("cells", [](Scene & scene) {
    const vtkNew<vtkCellArray> some;
    const vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < scene.surface->GetNumberOfPolys(); cell += 2)
    {
      scene.surface->GetCellPoints(cell, corners);
      some->InsertNextCell(corners);
    }
    scene.surface->SetPolys(some);
  });
  ExpectToShow("another surface", [](Scene & scene) {
    static_cast<vtkPolyDataMapper *>(scene.ball->GetMapper())->SetInputData(BallOf(0.6));
  });
  ExpectToShow("another mapper", [](Scene & scene) { scene.ball->SetMapper(ActorOf(BallOf(0.6))->GetMapper()); });
  ExpectToShow(
    "an older surface",
    [older = BallOf(0.6)](Scene & scene) {
      static_cast<vtkPolyDataMapper *>(scene.ball->GetMapper())->SetInputData(older);
    },
    ShowNewValues);
}

TEST(SurfacePassChanges, Values)
{
  ExpectToShow("visible", ShowValues);
  const auto hide = [](Scene & scene) { scene.ball->GetMapper()->ScalarVisibilityOff(); };
  ExpectToShow("hidden", hide, ShowValues);
  ExpectToShow("new ones hidden", hide, ShowNewValues);
  const auto turn = [](Scene & scene) {
    vtkDataArray * const values = scene.surface->GetPointData()->GetScalars();
    for (vtkIdType n = 0; n < values->GetNumberOfTuples(); ++n)
    {
      values->SetTuple1(n, scene.surface->GetPoint(n)[0]);
    }
    values->Modified();
  };
  ExpectToShow("others", turn, ShowValues);
  ExpectToShow(
    "range", [](Scene & scene) { scene.ball->GetMapper()->SetScalarRange(-0.2, 0.4); }, ShowValues);
  ExpectToShow(
    "colours of the table",
    [](Scene & scene) {
      auto * const table = vtkLookupTable::SafeDownCast(scene.ball->GetMapper()->GetLookupTable());
      table->Build();
      table->SetHueRange(0.2, 0.4);
      table->Build();
      table->SetTableValue(128, 1.0, 1.0, 1.0, 1.0);
    },
    ShowNewValues);
  ExpectToShow(
    "another table",
    [](Scene & scene) {
      const vtkNew<vtkLookupTable> table;
      table->SetHueRange(0.5, 0.7);
      scene.ball->GetMapper()->SetLookupTable(table);
    },
    ShowNewValues);
  ExpectToShow(
    "table with opacity",
    [](Scene & scene) {
      const vtkNew<vtkLookupTable> table;
      table->SetAlphaRange(0.2, 0.6);
      scene.ball->GetMapper()->SetLookupTable(table);
    },
    ShowNewValues);
}

TEST(SurfacePassChanges, Property)
{
  const auto property = [](Scene & scene) { return scene.ball->GetProperty(); };
  ExpectToShow("colour", [&](Scene & scene) { property(scene)->SetColor(0.2, 0.9, 0.2); });
  ExpectToShow("specular", [&](Scene & scene) { property(scene)->SetSpecular(0.8); });
  ExpectToShow("ambient", [&](Scene & scene) { property(scene)->SetAmbient(0.8); });
  ExpectToShow("flat", [&](Scene & scene) { property(scene)->SetInterpolationToFlat(); });
  ExpectToShow(
    "flat under values", [&](Scene & scene) { property(scene)->SetInterpolationToFlat(); }, ShowNewValues);
  ExpectToShow("culled", [&](Scene & scene) { property(scene)->FrontfaceCullingOn(); });
  ExpectToShow("another property", [](Scene & scene) {
    const vtkNew<vtkProperty> other;
    other->SetColor(0.0, 0.0, 1.0);
    scene.ball->SetProperty(other);
  });
  ExpectToShow("lines", [&](Scene & scene) { property(scene)->SetRepresentationToWireframe(); });
  ExpectToShow(
    "surface again",
    [&](Scene & scene) { property(scene)->SetRepresentationToSurface(); },
    [&](Scene & scene) { property(scene)->SetRepresentationToWireframe(); });
}

TEST(SurfacePassChanges, OpaqueTranslucentAndBack)
{
  const auto set = [](double opacity) {
    return [opacity](Scene & scene) { scene.ball->GetProperty()->SetOpacity(opacity); };
  };
  ExpectToShow("translucent", set(0.4));
  ExpectToShow("less", set(0.4), set(0.6));
  ExpectToShow("opaque", set(1.0), set(0.4));
  ExpectToShow("gone", set(0.0), set(0.4));
  Scene scene;
  const Bytes opaque = scene.Draw();
  set(0.4)(scene);
  EXPECT_NE(scene.Draw(), opaque);
  set(1.0)(scene);
  EXPECT_EQ(scene.Draw(), opaque);
}

TEST(SurfacePassChanges, CameraMatrixAndCuts)
{
  ExpectToShow("zoom", [](Scene & scene) { scene.renderer->GetActiveCamera()->SetParallelScale(3.5); });
  ExpectToShow("turn", [](Scene & scene) { scene.renderer->GetActiveCamera()->Azimuth(30.0); });
  ExpectToShow("perspective", [](Scene & scene) { scene.renderer->GetActiveCamera()->ParallelProjectionOff(); });
  ExpectToShow("clipping range", [](Scene & scene) { scene.renderer->GetActiveCamera()->SetClippingRange(9.5, 20.0); });
  ExpectToShow("position", [](Scene & scene) { scene.ball->AddPosition(0.2, 0.3, 0.0); });
  ExpectToShow("scale", [](Scene & scene) { scene.ball->SetScale(0.7); });
  const vtkNew<vtkMatrix4x4> moved;
  moved->SetElement(1, 3, 0.5);
  ExpectToShow("user matrix", [&](Scene & scene) { scene.ball->SetUserMatrix(moved); });
  const auto cut = [](Scene & scene) {
    const vtkNew<vtkPlane> plane;
    plane->SetOrigin(1.5, 0.2, 0.0);
    plane->SetNormal(0.0, -1.0, 0.3);
    scene.ball->GetMapper()->AddClippingPlane(plane);
  };
  ExpectToShow("cut", cut);
  ExpectToShow(
    "cut moved",
    [](Scene & scene) { scene.ball->GetMapper()->GetClippingPlanes()->GetItem(0)->SetOrigin(1.5, -0.3, 0.0); },
    cut);
  ExpectToShow(
    "cut removed", [](Scene & scene) { scene.ball->GetMapper()->RemoveAllClippingPlanes(); }, cut);
}

TEST(SurfacePassChanges, ActorsComeAndGo)
{
  const auto add = [](Scene & scene) { scene.Add(scene.surface, -1.5); };
  const auto other = [](Scene & scene) { return scene.renderer->GetActors()->GetLastActor(); };
  ExpectToShow("added", add);
  ExpectToShow(
    "hidden", [&](Scene & scene) { other(scene)->VisibilityOff(); }, add);
  ExpectToShow(
    "removed", [&](Scene & scene) { scene.renderer->RemoveActor(other(scene)); }, add);
  ExpectToShow(
    "all removed", [](Scene & scene) { scene.renderer->RemoveAllViewProps(); }, add);
  ExpectToShow(
    "removed and another added",
    [&](Scene & scene) {
      scene.renderer->RemoveActor(other(scene));
      scene.Add(BallOf(0.5), -1.5);
    },
    add);
  Scene scene;
  add(scene);
  const Bytes both = scene.Draw();
  other(scene)->VisibilityOff();
  EXPECT_EQ(scene.Draw(), BallAlone());
  other(scene)->VisibilityOn();
  EXPECT_EQ(scene.Draw(), both);
}

/** A picture of one colour. */
vtkSmartPointer<vtkTexture>
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

vtkSmartPointer<vtkActor>
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

TEST(SurfacePassChanges, TranslucentPictures)
{
  const auto red = TextureOf(250, 0);
  const auto green = TextureOf(0, 250);
  const auto add = [&](Scene & scene) {
    const auto poster = Poster(red);
    poster->GetProperty()->LightingOff();
    poster->GetProperty()->SetOpacity(0.7);
    scene.renderer->AddActor(poster);
  };
  const auto poster = [](Scene & scene) { return scene.renderer->GetActors()->GetLastActor(); };
  ExpectToShow("added", add);
  ExpectToShow(
    "another picture", [&](Scene & scene) { poster(scene)->SetTexture(green); }, add);
  ExpectToShow(
    "no picture", [&](Scene & scene) { poster(scene)->SetTexture(nullptr); }, add);
  ExpectToShow(
    "opacity", [&](Scene & scene) { poster(scene)->GetProperty()->SetOpacity(0.3); }, add);
}

// Windows and passes that come and go

/** The scene with lines of VTK on the left. */
void
AddLines(Scene & scene, double y = 0.0)
{
  const auto wires = scene.Add(BallOf(1.0, 8), -1.5);
  wires->AddPosition(0.0, y, 0.0);
  wires->GetProperty()->SetRepresentationToWireframe();
}

TEST(SurfacePassLife, DrawsAgainAfterItsResourcesAreReleased)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    Scene scene;
    AddLines(scene);
    scene.ball->GetProperty()->SetOpacity(opacity);
    const Bytes pixels = scene.Draw();
    scene.pass->ReleaseGraphicsResources(scene.window);
    EXPECT_EQ(scene.Draw(), pixels);
    scene.renderer->ReleaseGraphicsResources(scene.window);
    EXPECT_EQ(scene.Draw(), pixels);
    scene.window->ReleaseGraphicsResources(scene.window);
    EXPECT_EQ(scene.Draw(), pixels);
    scene.window->Finalize();
    EXPECT_EQ(scene.Draw(), pixels);
    scene.pass->ReleaseGraphicsResources(scene.window);
    scene.window->Finalize();
    scene.pass->ReleaseGraphicsResources(scene.window);
    EXPECT_EQ(scene.Draw(), pixels);
  }
}

TEST(SurfacePassLife, GoesFromOneWindowToAnother)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    Scene first;
    AddLines(first);
    first.ball->GetProperty()->SetOpacity(opacity);
    const Bytes ofFirst = first.Draw();
    Scene alone;
    AddLines(alone, 0.7);
    alone.ball->GetProperty()->SetColor(0.0, 1.0, 0.0);
    const Bytes ofSecond = alone.Draw();
    Scene second(nullptr);
    AddLines(second, 0.7);
    second.ball->GetProperty()->SetColor(0.0, 1.0, 0.0);
    second.Draw(); // so that VTK's mappers have buffers
    second.renderer->SetPass(first.pass);
    for (int turn = 0; turn < 3; ++turn)
    {
      EXPECT_EQ(DifferentPixels(second.Draw(), ofSecond), 0u) << turn;
      EXPECT_EQ(DifferentPixels(first.Draw(), ofFirst), 0u) << turn;
    }
  }
}

TEST(SurfacePassLife, SharesAWindowWithAnotherRenderer)
{
  Scene scene;
  const vtkNew<vtkRenderer> other;
  other->SetPass(scene.pass);
  other->AddActor(ActorOf(BallOf(0.8)));
  other->SetActiveCamera(scene.renderer->GetActiveCamera());
  other->SetViewport(0.0, 0.0, 0.5, 1.0);
  scene.renderer->SetViewport(0.5, 0.0, 1.0, 1.0);
  scene.window->AddRenderer(other);
  const Bytes shared = scene.Draw();
  EXPECT_EQ(scene.Draw(), shared);
  other->SetPass(vtkSmartPointer<vtkRhombicSurfacePass>::New());
  EXPECT_EQ(scene.Draw(), shared);
  EXPECT_GT(DifferentPixels(HalfOf(shared, true), HalfOf(shared, false)), 100u);
}

TEST(SurfacePassLife, IsDeletedInAnyOrder)
{
  const Bytes expected = BallAlone();
  std::array<int, 3> order{ 0, 1, 2 };
  do
  {
    Scene scene;
    scene.Draw();
    const auto another = BallOf(0.5);
    for (const int which : order)
    {
      if (which == 0)
      {
        scene.renderer ? scene.renderer->SetPass(nullptr) : void();
        scene.pass = nullptr;
      }
      else if (which == 1)
      {
        scene.window = nullptr;
      }
      else
      {
        scene.window ? scene.window->RemoveRenderer(scene.renderer) : void();
        scene.renderer = nullptr;
      }
      scene.window ? scene.window->Render() : void();
    }
    EXPECT_EQ(BallAlone(), expected);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SurfacePassLife, OutlivesItsWindowAndRenderer)
{
  vtkSmartPointer<vtkRenderPass> pass;
  const Bytes expected = BallAlone();
  for (int window = 0; window < 3; ++window)
  {
    Scene scene;
    if (pass)
    {
      scene.renderer->SetPass(pass);
    }
    else
    {
      pass = scene.pass;
    }
    EXPECT_EQ(scene.Draw(), expected) << window;
  }
}

TEST(SurfacePassLife, WindowsOfOtherSizes)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    Scene scene;
    scene.ball->GetProperty()->SetOpacity(opacity);
    const Bytes pixels = scene.Draw();
    for (const std::array<int, 2> size : { std::array<int, 2>{ 200, 150 }, { 31, 77 }, { 1, 1 }, { 64, 300 } })
    {
      scene.window->SetSize(size[0], size[1]);
      Scene fresh;
      fresh.ball->GetProperty()->SetOpacity(opacity);
      fresh.window->SetSize(size[0], size[1]);
      EXPECT_EQ(scene.Draw(), fresh.Draw()) << size[0] << " x " << size[1];
    }
    scene.window->SetSize(Width, Height);
    EXPECT_EQ(scene.Draw(), pixels);
  }
}

// Props that are left to VTK

using AddProp = std::function<void(vtkRenderer *)>;

/** Expects a prop in the left half as VTK draws it, while a surface is drawn in the right half. */
void
ExpectVTKsProp(const char * what, const AddProp & add)
{
  SCOPED_TRACE(what);
  Scene withVTK(vtkSmartPointer<vtkRenderStepsPass>::New());
  add(withVTK.renderer);
  const Bytes expected = withVTK.Draw();
  Scene scene;
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

/** The middle of the ball, of the smaller ball in front of its edge, and of the background. */
constexpr std::array<int, 2> OnBall{ 90, 50 };
constexpr std::array<int, 2> OnFront{ 108, 50 };
constexpr std::array<int, 2> OnNothing{ 20, 50 };

TEST(SurfacePassSelection, FindsTheActorThatIsSeen)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    Scene scene;
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
