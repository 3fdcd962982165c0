#include "rhombicPassPictures.h"

#include <vtkCellPicker.h>
#include <vtkHardwareSelector.h>
#include <vtkInformation.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vtk_glew.h>

/** Scenes that change between pictures, and passes that outlive or change their windows. */
namespace
{

using namespace rhombic::test;

/** A scene in a window, whose pictures the test asks for one after the other. */
class ChangingScene : public testing::Test
{
protected:
  ChangingScene()
    : m_Surface(Ball(1.2, true, 32))
  {
    m_Window->AddRenderer(m_Renderer);
    m_Renderer->SetBackground(0.1, 0.2, 0.3);
    Look(m_Renderer);
    PeelDepths(m_Renderer);
    const vtkNew<vtkFloatArray> heights;
    for (vtkIdType n = 0; n < m_Surface->GetNumberOfPoints(); ++n)
    {
      heights->InsertNextValue(static_cast<float>(m_Surface->GetPoint(n)[2]));
    }
    m_Table->SetRange(-1.2, 1.2);
    m_Table->Build();
    m_Actor = Add(m_Renderer, m_Surface);
    Mapper()->SetLookupTable(m_Table);
    Mapper()->UseLookupTableScalarRangeOn();
    m_Surface->GetPointData()->SetScalars(heights); // later than the mapper's changes
    m_Surface->Modified();
    m_Other = Add(m_Renderer, Ball(0.5));
    m_Other->SetPosition(1.4, -0.4, 0.4);
    m_Renderer->ResetCameraClippingRange();
  }

  vtkMapper *
  Mapper()
  {
    return m_Actor->GetMapper();
  }

  Drawn
  DrawBy(vtkRenderPass * pass)
  {
    m_Renderer->SetPass(pass);
    return Render(m_Window);
  }

  /** A picture by the pass, which is that of VTK. */
  Drawn
  ExpectVTKsPictureNow(const std::string & change)
  {
    Drawn drawn = DrawBy(m_Pass);
    const Drawn expected = DrawBy(nullptr);
    EXPECT_LE(ShareOfOtherDepths(expected, drawn), ShareAtEdges) << change;
    EXPECT_LE(ShareOfOtherColours(expected, drawn, LargestLitDifference), ShareAtEdges) << change;
    return drawn;
  }

  const vtkSmartPointer<vtkRenderWindow> m_Window = MakeWindow();
  const vtkNew<vtkRenderer> m_Renderer;
  const vtkSmartPointer<vtkRhombicSurfacePass> m_Pass = PlainPass();
  const vtkSmartPointer<vtkPolyData> m_Surface;
  const vtkNew<vtkLookupTable> m_Table;
  vtkActor * m_Actor = nullptr;
  vtkActor * m_Other = nullptr;
};

TEST_F(ChangingScene, EachChangeIsSeen)
{
  const auto positions = vtkFloatArray::SafeDownCast(m_Surface->GetPoints()->GetData());
  auto * const heights = vtkFloatArray::SafeDownCast(m_Surface->GetPointData()->GetScalars());
  const vtkNew<vtkPolyDataMapper> sameInput;
  sameInput->SetInputData(m_Surface);
  sameInput->SetLookupTable(m_Table);
  sameInput->SetScalarRange(0.0, 0.5);
  m_Table->Modified();                            // later than both mappers
  const auto otherSurface = Ball(0.9, false, 12); // older than what replaces it
  const std::vector<std::pair<std::string, std::function<void()>>> changes{
    { "mapper", [&]() { m_Actor->SetMapper(sameInput); } },
    { "table", [&]() { m_Table->SetHueRange(0.2, 0.9), m_Table->ForceBuild(); } },
    { "scalars", [&]() { heights->SetValue(200, 9.0f), heights->FillComponent(0, 0.3), heights->Modified(); } },
    { "range", [&]() { m_Surface->Modified(), Mapper()->SetScalarRange(0.0, 0.4); } },
    { "without scalars", [&]() { Mapper()->ScalarVisibilityOff(); } },
    { "with scalars", [&]() { Mapper()->ScalarVisibilityOn(); } },
    { "surface is changed", [&]() { m_Surface->Modified(); } },
    { "without scalars again", [&]() { Mapper()->ScalarVisibilityOff(); } },
    { "points",
      [&]() {
        for (vtkIdType n = 0; n < positions->GetNumberOfTuples(); ++n)
        {
          positions->SetComponent(n, 2, 0.8 * positions->GetComponent(n, 2));
        }
        m_Surface->GetPoints()->Modified();
      } },
    { "colour", [&]() { m_Actor->GetProperty()->SetColor(0.2, 0.4, 0.9); } },
    { "opacity", [&]() { m_Actor->GetProperty()->SetOpacity(0.4); } },
    { "solid", [&]() { m_Actor->GetProperty()->SetOpacity(1.0); } },
    { "flat", [&]() { m_Actor->GetProperty()->SetInterpolationToFlat(); } },
    { "matrix", [&]() { m_Actor->RotateX(30.0), m_Actor->SetPosition(-0.4, 0.2, 0.3); } },
    { "camera", [&]() { m_Renderer->GetActiveCamera()->Azimuth(40.0); } },
    { "plane",
      [&]() {
        const vtkNew<vtkPlane> plane;
        plane->SetNormal(0.0, 0.0, 1.0);
        Mapper()->AddClippingPlane(plane);
      } },
    { "moved plane", [&]() { Mapper()->GetClippingPlanes()->GetItem(0)->SetOrigin(0.0, 0.0, 0.5); } },
    { "without plane", [&]() { Mapper()->RemoveAllClippingPlanes(); } },
    { "scene light",
      [&]() {
        m_Renderer->RemoveAllLights();
        const vtkNew<vtkLight> light;
        light->SetPosition(5.0, -3.0, 2.0);
        m_Renderer->AddLight(light);
      } },
    { "other surface", [&]() { sameInput->SetInputData(otherSurface); } },
    { "hidden", [&]() { m_Other->VisibilityOff(); } },
    { "shown", [&]() { m_Other->VisibilityOn(); } },
    { "removed", [&]() { m_Renderer->RemoveActor(m_Other); } },
    { "added", [&]() { Add(m_Renderer, Ball(0.6))->SetPosition(-1.2, 0.0, -0.9); } },
    { "samples", [&]() { m_Window->SetSize(Side, Side), m_Renderer->SetBackground(0.3, 0.2, 0.1); } },
  };
  Drawn before = ExpectVTKsPictureNow("first");
  for (const auto & [name, change] : changes)
  {
    change();
    Drawn after = ExpectVTKsPictureNow(name);
    if (name != "surface is changed")
    {
      EXPECT_GT(ShareOfOtherColours(before, after, 0.0), 0.0) << name;
    }
    before = std::move(after);
  }
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

TEST_F(ChangingScene, OnlyWhatHasChangedIsUploaded)
{
  DrawBy(m_Pass);
  m_Other->VisibilityOff();
  DrawBy(m_Pass);
  const auto uploadsAfter = [this](const std::function<void()> & change) {
    change();
    const CountedUploads uploads;
    DrawBy(m_Pass);
    return uploads.Get();
  };
  EXPECT_EQ(uploadsAfter([]() {}), 0);
  EXPECT_EQ(uploadsAfter([this]() { m_Renderer->GetActiveCamera()->Azimuth(10.0); }), 0);
  EXPECT_EQ(uploadsAfter([this]() { m_Actor->SetPosition(0.1, 0.0, 0.0); }), 0);
  EXPECT_EQ(uploadsAfter([this]() { m_Actor->GetProperty()->SetColor(0.0, 1.0, 0.0); }), 0);
  EXPECT_EQ(uploadsAfter([this]() { m_Other->VisibilityOn(); }), 0);
  EXPECT_EQ(uploadsAfter([this]() { m_Surface->Modified(); }), 4); // points, normals, colours, indices of one actor
}

// Windows and their ends

/** Balls that Rhombic's pass draws, and one of lines that VTK draws. */
void
AddBallsAndLines(vtkRenderer * renderer, double radius)
{
  Look(renderer);
  Add(renderer, Ball(radius));
  Add(renderer, Ball(1.5))->GetProperty()->SetOpacity(0.4);
  Add(renderer, Ball(1.6))->GetProperty()->SetRepresentationToWireframe();
  PeelDepths(renderer);
  renderer->ResetCameraClippingRange();
}

/** A window with one renderer that draws by a pass. */
struct OneRenderer
{
  OneRenderer(vtkRenderPass * pass, double radius)
  {
    AddBallsAndLines(renderer, radius);
    renderer->SetPass(pass);
    window->AddRenderer(renderer);
  }

  vtkSmartPointer<vtkRenderWindow> window = MakeWindow();
  vtkSmartPointer<vtkRenderer> renderer = vtkSmartPointer<vtkRenderer>::New();
};

TEST(SurfacePassWindows, OnePassServesOneWindowAfterTheOther)
{
  const Drawn first = Render(OneRenderer(PlainPass(), 1.0).window);
  const Drawn second = Render(OneRenderer(PlainPass(), 0.5).window);
  EXPECT_NE(first.colours, second.colours);
  const auto pass = PlainPass();
  OneRenderer a(pass, 1.0);
  OneRenderer b(pass, 0.5);
  for (int n = 0; n < 3; ++n)
  {
    EXPECT_TRUE(Render(a.window).colours == first.colours) << n;
    EXPECT_TRUE(Render(b.window).colours == second.colours) << n;
  }
}

TEST(SurfacePassWindows, APassMayEndWhileAnotherWindowIsCurrent)
{
  auto pass = PlainPass();
  OneRenderer ended(pass, 1.0);
  Render(ended.window);
  OneRenderer kept(PlainPass(), 0.5);
  const Drawn before = Render(kept.window);
  ended.renderer->SetPass(nullptr);
  pass = nullptr; // its buffers have the names of the other window's
  EXPECT_TRUE(Render(kept.window).colours == before.colours);
}

TEST(SurfacePassWindows, APassMayOutliveTheWindowItHasLeft)
{
  const auto pass = PlainPass();
  auto ended = std::make_unique<OneRenderer>(pass, 1.0);
  const Drawn first = Render(ended->window);
  OneRenderer kept(PlainPass(), 0.5);
  const Drawn before = Render(kept.window);
  ended->renderer->SetPass(nullptr);
  ended = nullptr;
  EXPECT_TRUE(Render(kept.window).colours == before.colours);
  EXPECT_TRUE(Render(OneRenderer(pass, 1.0).window).colours == first.colours);
  EXPECT_TRUE(Render(kept.window).colours == before.colours);
}

TEST(SurfacePassWindows, PassWindowAndRendererEndInAnyOrder)
{
  const Drawn expected = Render(OneRenderer(PlainPass(), 1.0).window);
  OneRenderer kept(PlainPass(), 0.5);
  const Drawn before = Render(kept.window);
  for (const std::string order : { "pwr", "prw", "wpr", "wrp", "rpw", "rwp" })
  {
    auto pass = PlainPass();
    OneRenderer scene(pass, 1.0);
    EXPECT_TRUE(Render(scene.window).colours == expected.colours) << order;
    for (const char what : order)
    {
      if (what == 'p')
      {
        if (scene.renderer)
        {
          scene.renderer->SetPass(nullptr);
        }
        pass = nullptr;
      }
      else if (what == 'w')
      {
        scene.window = nullptr;
      }
      else
      {
        if (scene.window)
        {
          scene.window->RemoveRenderer(scene.renderer);
        }
        scene.renderer = nullptr;
      }
    }
    EXPECT_TRUE(Render(kept.window).colours == before.colours) << order;
  }
}

TEST(SurfacePassWindows, DrawsAgainAfterReleasingAndFinalizing)
{
  const auto pass = PlainPass();
  OneRenderer scene(pass, 1.0);
  const Drawn first = Render(scene.window);
  pass->ReleaseGraphicsResources(scene.window);
  EXPECT_TRUE(Render(scene.window).colours == first.colours);
  scene.window->Finalize();
  EXPECT_TRUE(Render(scene.window).colours == first.colours);
}

// Selection

TEST(SurfacePassWindows, ActorsAreSelectedAndPicked)
{
  const auto window = MakeWindow();
  const vtkNew<vtkRenderer> renderer;
  Look(renderer);
  vtkActor * const ball = Add(renderer, Ball(1.0));
  Add(renderer, Ball(0.5))->SetPosition(2.0, 0.0, 0.0);
  renderer->ResetCameraClippingRange();
  renderer->SetPass(PlainPass());
  window->AddRenderer(renderer);
  const Drawn before = Render(window);

  const vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  selector->SetArea(90, 90, 110, 110);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1U);
  EXPECT_EQ(selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()), ball);
  EXPECT_GT(selection->GetNode(0)->GetSelectionList()->GetNumberOfTuples(), 10);

  const vtkNew<vtkCellPicker> picker;
  EXPECT_NE(picker->Pick(100.0, 100.0, 0.0, renderer), 0);
  EXPECT_EQ(picker->GetActor(), ball);
  EXPECT_TRUE(Render(window).colours == before.colours);
}

} // namespace
