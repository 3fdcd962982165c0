#include "rhombicPassScene.h"
#include "vtkRhombicOpaquePass.h"

#include <vtkCellArray.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtk_glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

/** Scenes that change between pictures, and passes and windows that come and go. */
namespace
{

using namespace rhombic::test;

using Change = std::function<void(PassScene &)>;

/** Draws, changes, draws; the second picture differs and is that of a fresh scene with the change. */
void
ExpectToShow(
  const char * what,
  const Change & change,
  const Change & before = [](PassScene &) {})
{
  SCOPED_TRACE(what);
  PassScene scene;
  before(scene);
  const Bytes first = scene.Draw();
  EXPECT_EQ(scene.Draw(), first);
  change(scene);
  const Bytes second = scene.Draw();
  PassScene fresh;
  before(fresh);
  change(fresh);
  EXPECT_EQ(DifferentPixels(second, fresh.Draw()), 0u);
  EXPECT_GT(DifferentPixels(first, second), 20u);
}

void
ShowValues(PassScene & scene)
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
ShowNewValues(PassScene & scene)
{
  ShowValues(scene);
  scene.surface->GetPointData()->GetScalars()->Modified();
}

TEST(SurfacePassChanges, Shape)
{
  const auto movePoints = [](PassScene & scene) {
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
  ExpectToShow("cells", [](PassScene & scene) {
    const vtkNew<vtkCellArray> some;
    const vtkNew<vtkIdList> corners;
    for (vtkIdType cell = 0; cell < scene.surface->GetNumberOfPolys(); cell += 2)
    {
      scene.surface->GetCellPoints(cell, corners);
      some->InsertNextCell(corners);
    }
    scene.surface->SetPolys(some);
  });
  ExpectToShow("another surface", [](PassScene & scene) {
    static_cast<vtkPolyDataMapper *>(scene.ball->GetMapper())->SetInputData(BallOf(0.6));
  });
  ExpectToShow("another mapper", [](PassScene & scene) { scene.ball->SetMapper(ActorOf(BallOf(0.6))->GetMapper()); });
  ExpectToShow(
    "an older surface",
    [older = BallOf(0.6)](PassScene & scene) {
      static_cast<vtkPolyDataMapper *>(scene.ball->GetMapper())->SetInputData(older);
    },
    ShowNewValues);
}

TEST(SurfacePassChanges, Values)
{
  ExpectToShow("visible", ShowValues);
  const auto hide = [](PassScene & scene) { scene.ball->GetMapper()->ScalarVisibilityOff(); };
  ExpectToShow("hidden", hide, ShowValues);
  ExpectToShow("new ones hidden", hide, ShowNewValues);
  const auto turn = [](PassScene & scene) {
    vtkDataArray * const values = scene.surface->GetPointData()->GetScalars();
    for (vtkIdType n = 0; n < values->GetNumberOfTuples(); ++n)
    {
      values->SetTuple1(n, scene.surface->GetPoint(n)[0]);
    }
    values->Modified();
  };
  ExpectToShow("others", turn, ShowValues);
  ExpectToShow(
    "range", [](PassScene & scene) { scene.ball->GetMapper()->SetScalarRange(-0.2, 0.4); }, ShowValues);
  ExpectToShow(
    "colours of the table",
    [](PassScene & scene) {
      auto * const table = vtkLookupTable::SafeDownCast(scene.ball->GetMapper()->GetLookupTable());
      table->Build();
      table->SetHueRange(0.2, 0.4);
      table->Build();
      table->SetTableValue(128, 1.0, 1.0, 1.0, 1.0);
    },
    ShowNewValues);
  ExpectToShow(
    "another table",
    [](PassScene & scene) {
      const vtkNew<vtkLookupTable> table;
      table->SetHueRange(0.5, 0.7);
      scene.ball->GetMapper()->SetLookupTable(table);
    },
    ShowNewValues);
  ExpectToShow(
    "table with opacity",
    [](PassScene & scene) {
      const vtkNew<vtkLookupTable> table;
      table->SetAlphaRange(0.2, 0.6);
      scene.ball->GetMapper()->SetLookupTable(table);
    },
    ShowNewValues);
}

TEST(SurfacePassChanges, Property)
{
  const auto property = [](PassScene & scene) { return scene.ball->GetProperty(); };
  ExpectToShow("colour", [&](PassScene & scene) { property(scene)->SetColor(0.2, 0.9, 0.2); });
  ExpectToShow("specular", [&](PassScene & scene) { property(scene)->SetSpecular(0.8); });
  ExpectToShow("ambient", [&](PassScene & scene) { property(scene)->SetAmbient(0.8); });
  ExpectToShow("flat", [&](PassScene & scene) { property(scene)->SetInterpolationToFlat(); });
  ExpectToShow(
    "flat under values", [&](PassScene & scene) { property(scene)->SetInterpolationToFlat(); }, ShowNewValues);
  ExpectToShow("culled", [&](PassScene & scene) { property(scene)->FrontfaceCullingOn(); });
  ExpectToShow("light", [](PassScene & scene) {
    const vtkNew<vtkLight> light;
    light->SetPosition(5.0, -3.0, 2.0);
    scene.renderer->RemoveAllLights(); // the one that VTK adds to a scene without lights
    scene.renderer->AddLight(light);
  });
  ExpectToShow("another property", [](PassScene & scene) {
    const vtkNew<vtkProperty> other;
    other->SetColor(0.0, 0.0, 1.0);
    scene.ball->SetProperty(other);
  });
  ExpectToShow("lines", [&](PassScene & scene) { property(scene)->SetRepresentationToWireframe(); });
  ExpectToShow(
    "surface again",
    [&](PassScene & scene) { property(scene)->SetRepresentationToSurface(); },
    [&](PassScene & scene) { property(scene)->SetRepresentationToWireframe(); });
}

TEST(SurfacePassChanges, OpaqueTranslucentAndBack)
{
  const auto set = [](double opacity) {
    return [opacity](PassScene & scene) { scene.ball->GetProperty()->SetOpacity(opacity); };
  };
  ExpectToShow("translucent", set(0.4));
  ExpectToShow("less", set(0.4), set(0.6));
  ExpectToShow("opaque", set(1.0), set(0.4));
  ExpectToShow("gone", set(0.0), set(0.4));
  PassScene scene;
  const Bytes opaque = scene.Draw();
  set(0.4)(scene);
  EXPECT_NE(scene.Draw(), opaque);
  set(1.0)(scene);
  EXPECT_EQ(scene.Draw(), opaque);
}

TEST(SurfacePassChanges, CameraMatrixAndCuts)
{
  ExpectToShow("zoom", [](PassScene & scene) { scene.renderer->GetActiveCamera()->SetParallelScale(3.5); });
  ExpectToShow("turn", [](PassScene & scene) { scene.renderer->GetActiveCamera()->Azimuth(30.0); });
  ExpectToShow("perspective", [](PassScene & scene) { scene.renderer->GetActiveCamera()->ParallelProjectionOff(); });
  ExpectToShow("clipping range",
               [](PassScene & scene) { scene.renderer->GetActiveCamera()->SetClippingRange(9.5, 20.0); });
  ExpectToShow("position", [](PassScene & scene) { scene.ball->AddPosition(0.2, 0.3, 0.0); });
  ExpectToShow("scale", [](PassScene & scene) { scene.ball->SetScale(0.7); });
  const vtkNew<vtkMatrix4x4> moved;
  moved->SetElement(1, 3, 0.5);
  ExpectToShow("user matrix", [&](PassScene & scene) { scene.ball->SetUserMatrix(moved); });
  const auto cut = [](PassScene & scene) {
    const vtkNew<vtkPlane> plane;
    plane->SetOrigin(1.5, 0.2, 0.0);
    plane->SetNormal(0.0, -1.0, 0.3);
    scene.ball->GetMapper()->AddClippingPlane(plane);
  };
  ExpectToShow("cut", cut);
  ExpectToShow(
    "cut moved",
    [](PassScene & scene) { scene.ball->GetMapper()->GetClippingPlanes()->GetItem(0)->SetOrigin(1.5, -0.3, 0.0); },
    cut);
  ExpectToShow(
    "cut removed", [](PassScene & scene) { scene.ball->GetMapper()->RemoveAllClippingPlanes(); }, cut);
}

TEST(SurfacePassChanges, ActorsComeAndGo)
{
  const auto add = [](PassScene & scene) { scene.Add(scene.surface, -1.5); };
  const auto other = [](PassScene & scene) { return scene.renderer->GetActors()->GetLastActor(); };
  ExpectToShow("added", add);
  ExpectToShow(
    "hidden", [&](PassScene & scene) { other(scene)->VisibilityOff(); }, add);
  ExpectToShow(
    "removed", [&](PassScene & scene) { scene.renderer->RemoveActor(other(scene)); }, add);
  ExpectToShow(
    "all removed", [](PassScene & scene) { scene.renderer->RemoveAllViewProps(); }, add);
  ExpectToShow(
    "removed and another added",
    [&](PassScene & scene) {
      scene.renderer->RemoveActor(other(scene));
      scene.Add(BallOf(0.5), -1.5);
    },
    add);
  PassScene scene;
  add(scene);
  const Bytes both = scene.Draw();
  other(scene)->VisibilityOff();
  EXPECT_EQ(scene.Draw(), BallAlone());
  other(scene)->VisibilityOn();
  EXPECT_EQ(scene.Draw(), both);
}

TEST(SurfacePassChanges, TranslucentPictures)
{
  const auto red = TextureOf(250, 0);
  const auto green = TextureOf(0, 250);
  const auto add = [&](PassScene & scene) {
    const auto poster = Poster(red);
    poster->GetProperty()->LightingOff();
    poster->GetProperty()->SetOpacity(0.7);
    scene.renderer->AddActor(poster);
  };
  const auto poster = [](PassScene & scene) { return scene.renderer->GetActors()->GetLastActor(); };
  ExpectToShow("added", add);
  ExpectToShow(
    "another picture", [&](PassScene & scene) { poster(scene)->SetTexture(green); }, add);
  ExpectToShow(
    "no picture", [&](PassScene & scene) { poster(scene)->SetTexture(nullptr); }, add);
  ExpectToShow(
    "opacity", [&](PassScene & scene) { poster(scene)->GetProperty()->SetOpacity(0.3); }, add);
}

/** The number of uploads to buffers of OpenGL by VTK's classes, which call through one table in a process. */
class CountedUploads
{
public:
  CountedUploads()
  {
    s_Count = 0;
    s_Upload = __glewBufferData;
    __glewBufferData = Upload;
  }
  ~CountedUploads()
  {
    __glewBufferData = s_Upload;
  }
  CountedUploads(const CountedUploads &) = delete;
  CountedUploads &
  operator=(const CountedUploads &) = delete;

  int
  Get() const
  {
    return s_Count;
  }

private:
  static void GLAPIENTRY
  Upload(GLenum target, GLsizeiptr size, const void * data, GLenum usage)
  {
    ++s_Count;
    s_Upload(target, size, data, usage);
  }

  inline static int s_Count = 0;
  inline static PFNGLBUFFERDATAPROC s_Upload = nullptr;
};

TEST(SurfacePassChanges, OnlyWhatHasChangedIsUploaded)
{
  PassScene scene;
  ShowNewValues(scene);
  const auto other = scene.Add(BallOf(0.5), -1.5);
  scene.Draw();
  other->VisibilityOff();
  scene.Draw();
  const auto uploadsAfter = [&scene](const std::function<void()> & change) {
    change();
    const CountedUploads uploads;
    scene.Draw();
    return uploads.Get();
  };
  EXPECT_EQ(uploadsAfter([]() {}), 0);
  EXPECT_EQ(uploadsAfter([&]() { scene.renderer->GetActiveCamera()->Azimuth(10.0); }), 0);
  EXPECT_EQ(uploadsAfter([&]() { scene.ball->SetPosition(1.4, 0.0, 0.0); }), 0);
  EXPECT_EQ(uploadsAfter([&]() { scene.ball->GetProperty()->SetColor(0.0, 1.0, 0.0); }), 0);
  EXPECT_EQ(uploadsAfter([&]() { other->VisibilityOn(); }), 0);
  EXPECT_EQ(uploadsAfter([&]() { scene.surface->Modified(); }), 4); // points, normals, colours, indices of one actor
}

// Windows and passes that come and go

/** The scene with lines of VTK on the left. */
void
AddLines(PassScene & scene, double y = 0.0)
{
  const auto wires = scene.Add(BallOf(1.0, 8), -1.5);
  wires->AddPosition(0.0, y, 0.0);
  wires->GetProperty()->SetRepresentationToWireframe();
}

TEST(SurfacePassLife, DrawsAgainAfterItsResourcesAreReleased)
{
  for (const double opacity : { 1.0, 0.5 })
  {
    PassScene scene;
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
    PassScene first;
    AddLines(first);
    first.ball->GetProperty()->SetOpacity(opacity);
    const Bytes ofFirst = first.Draw();
    PassScene alone;
    AddLines(alone, 0.7);
    alone.ball->GetProperty()->SetColor(0.0, 1.0, 0.0);
    const Bytes ofSecond = alone.Draw();
    PassScene second(nullptr);
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
  PassScene scene;
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
    PassScene scene;
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

TEST(SurfacePassLife, EndsWhileAnotherWindowIsCurrent)
{
  PassScene ended;
  ended.Draw();
  PassScene kept;
  AddLines(kept);
  const Bytes before = kept.Draw();
  ended.renderer->SetPass(nullptr);
  ended.pass = nullptr; // its buffers have the names of the other window's
  EXPECT_EQ(kept.Draw(), before);
}

TEST(SurfacePassLife, OutlivesItsWindowAndRenderer)
{
  vtkSmartPointer<vtkRenderPass> pass;
  const Bytes expected = BallAlone();
  for (int window = 0; window < 3; ++window)
  {
    PassScene scene;
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
    PassScene scene;
    scene.ball->GetProperty()->SetOpacity(opacity);
    const Bytes pixels = scene.Draw();
    for (const std::array<int, 2> size : { std::array<int, 2>{ 200, 150 }, { 31, 77 }, { 1, 1 }, { 64, 300 } })
    {
      scene.window->SetSize(size[0], size[1]);
      PassScene fresh;
      fresh.ball->GetProperty()->SetOpacity(opacity);
      fresh.window->SetSize(size[0], size[1]);
      EXPECT_EQ(scene.Draw(), fresh.Draw()) << size[0] << " x " << size[1];
    }
    scene.window->SetSize(Width, Height);
    EXPECT_EQ(scene.Draw(), pixels);
  }
}

} // namespace
