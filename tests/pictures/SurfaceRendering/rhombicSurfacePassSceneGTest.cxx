#include "rhombicPassPictures.h"

#include <vtkAssembly.h>
#include <vtkAutoInit.h>
#include <vtkAxesActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkCubeSource.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkFollower.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAAPass.h>
#include <vtkScalarBarActor.h>
#include <vtkStripper.h>
#include <vtkTextActor.h>
#include <vtkTransform.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2) // vtkGPUVolumeRayCastMapper draws by OpenGL

/** What programs of VTK have in their scenes, drawn by Rhombic's passes and by VTK's own. */
namespace
{

using namespace rhombic::test;

/** A sheet of 6 x 6 cells with four corners each, which are not flat. */
vtkSmartPointer<vtkPolyData>
WarpedSheet()
{
  constexpr int rows = 7;
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> cells;
  const vtkNew<vtkFloatArray> values;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < rows; ++column)
    {
      const double height = 0.5 * std::sin(2.1 * row) * std::cos(1.7 * column);
      points->InsertNextPoint(0.5 * (column - 3), height, 0.4 * (row - 3) + 0.1 * (column % 2));
      values->InsertNextValue(static_cast<float>((row * 5 + column * 3) % 7));
    }
  }
  for (int row = 0; row + 1 < rows; ++row)
  {
    for (int column = 0; column + 1 < rows; ++column)
    {
      const vtkIdType first = row * rows + column;
      cells->InsertNextCell({ first, first + 1, first + rows + 1, first + rows });
    }
  }
  auto sheet = vtkSmartPointer<vtkPolyData>::New();
  sheet->SetPoints(points);
  sheet->SetPolys(cells);
  sheet->GetPointData()->SetScalars(values);
  return sheet;
}

/** Colours of bytes for each point of a ball. */
vtkSmartPointer<vtkUnsignedCharArray>
Bytes(vtkIdType count, int components)
{
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetNumberOfComponents(components);
  for (vtkIdType n = 0; n < count; ++n)
  {
    for (int k = 0; k < components; ++k)
    {
      bytes->InsertNextValue(static_cast<unsigned char>(k == 3 ? 60 + n % 5 * 20 : (40 + 7 * n * (k + 1)) % 256));
    }
  }
  return bytes;
}

/** \a surface with values of points along z. */
vtkSmartPointer<vtkPolyData>
WithHeights(vtkSmartPointer<vtkPolyData> surface)
{
  const vtkNew<vtkFloatArray> heights;
  heights->SetName("height");
  for (vtkIdType n = 0; n < surface->GetNumberOfPoints(); ++n)
  {
    heights->InsertNextValue(static_cast<float>(surface->GetPoint(n)[2]));
  }
  surface->GetPointData()->SetScalars(heights);
  return surface;
}

/** \a surface with values of cells. */
vtkSmartPointer<vtkPolyData>
WithValuesOfCells(vtkSmartPointer<vtkPolyData> surface)
{
  const vtkNew<vtkFloatArray> values;
  for (vtkIdType n = 0; n < surface->GetNumberOfCells(); ++n)
  {
    values->InsertNextValue(static_cast<float>(n * 5 % 11));
  }
  surface->GetCellData()->SetScalars(values);
  return surface;
}

void
CutInFront(vtkActor * actor)
{
  const vtkNew<vtkPlane> front;
  front->SetNormal(0.1, 1.0, 0.0);
  actor->GetMapper()->AddClippingPlane(front);
}

/** The share of pixels of which a colour differs from VTK's picture at all. */
double
ShareOfOthers(const SetUp & setUp)
{
  return ShareOfOtherColours(Draw(setUp, nullptr), Draw(setUp, PlainPass()), 0.0);
}

// Shapes

TEST(SurfacePassScene, CubesWithTexturePositionsOfTheirOwn)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    const vtkNew<vtkCubeSource> cube;
    cube->SetXLength(2.0);
    cube->Update();
    Add(renderer, cube->GetOutput())->RotateY(25.0);
  });
}

TEST(SurfacePassScene, CellsOfFourCornersThatAreNotFlat)
{
  for (const bool hasColours : { false, true })
  {
    ExpectVTKsPicture([hasColours](vtkRenderer * renderer) {
      Look(renderer);
      vtkActor * const sheet = Add(renderer, WarpedSheet());
      sheet->GetMapper()->SetScalarVisibility(hasColours);
      sheet->GetMapper()->SetScalarRange(0.0, 6.0);
    });
  }
}

// VTK 9.1 draws triangles from the first corner to all others, which cover the notch.
TEST(SurfacePassScene, NotchesOfPolygonsAreEmpty)
{
  const Drawn drawn = Draw(
    [](vtkRenderer * renderer) {
      renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 10.0);
      const vtkNew<vtkPoints> points;
      points->InsertNextPoint(-1.5, -1.5, 0.0);
      points->InsertNextPoint(0.0, 0.9, 0.0);
      points->InsertNextPoint(1.5, -1.5, 0.0);
      points->InsertNextPoint(0.0, 1.8, 0.0);
      const vtkNew<vtkCellArray> cells;
      cells->InsertNextCell({ 0, 1, 2, 3 });
      const vtkNew<vtkPolyData> arrow;
      arrow->SetPoints(points);
      arrow->SetPolys(cells);
      Add(renderer, arrow);
    },
    PlainPass());
  const auto depthAt = [&drawn](int x, int y) { return drawn.depths[static_cast<std::size_t>(y * Side + x)]; };
  EXPECT_LT(depthAt(Side / 2, Side / 2 + 48), 1.0f); // at 1.3 mm
  EXPECT_EQ(depthAt(Side / 2, Side / 2), 1.0f);
}

TEST(SurfacePassScene, NormalsOfCellsCountForFlatActorsToo)
{
  for (const bool isFlat : { false, true })
  {
    ExpectVTKsPicture([isFlat](vtkRenderer * renderer) {
      Look(renderer);
      const auto ball = Ball(1.4, false);
      const vtkNew<vtkFloatArray> normals;
      normals->SetNumberOfComponents(3);
      for (vtkIdType n = 0; n < ball->GetNumberOfCells(); ++n)
      {
        normals->InsertNextTuple3(std::sin(1.0 * n), -1.0, std::cos(2.0 * n));
      }
      ball->GetCellData()->SetNormals(normals);
      vtkActor * const actor = Add(renderer, ball);
      if (isFlat)
      {
        actor->GetProperty()->SetInterpolationToFlat();
      }
    });
  }
}

TEST(SurfacePassScene, FacetsSeenFromTheSideInAWidePerspective)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    vtkCamera * const camera = renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 1.0);
    camera->SetViewAngle(140.0);
    for (const double x : { -1.8, 1.8 })
    {
      vtkActor * const ball = Add(renderer, Ball(0.8, false, 9));
      ball->SetPosition(x, 0.3, 0.3);
      ball->RotateX(25.0); // the normals of some facets that are seen point away from the camera's plane
    }
  });
}

TEST(SurfacePassScene, DoublePointsFarFromTheOrigin)
{
  const auto draw = [](vtkRenderer * renderer) {
    constexpr double far = 4e6;
    const auto ball = Ball(1.0);
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType n = 0; n < ball->GetNumberOfPoints(); ++n)
    {
      const double * const point = ball->GetPoint(n);
      points->InsertNextPoint(far + point[0], point[1] - far, point[2] + 0.5 * far);
    }
    ball->SetPoints(points);
    Add(renderer, ball);
    vtkCamera * const camera = renderer->GetActiveCamera();
    camera->SetPosition(far, -8.0 - far, 0.5 * far);
    camera->SetFocalPoint(far, -far, 0.5 * far);
    camera->SetViewUp(0.0, 0.0, 1.0);
  };
  // VTK's own matrices are of 32 bits, so that pixels at the edge differ.
  const Drawn expected = Draw(draw, nullptr);
  EXPECT_GT(ShareOfSurfaces(expected), 0.15);
  EXPECT_LE(ShareOfOtherColours(expected, Draw(draw, PlainPass()), LargestLitDifference), 0.01);
}

TEST(SurfacePassScene, FrontsAndBacksMayBeCulled)
{
  for (const bool hidesFronts : { false, true })
  {
    for (const bool hidesBacks : { false, true })
    {
      const auto setUp = [&](vtkRenderer * renderer) {
        Look(renderer);
        vtkActor * const cut = Add(renderer, Ball(1.4));
        CutInFront(cut);
        cut->GetProperty()->SetFrontfaceCulling(hidesFronts);
        cut->GetProperty()->SetBackfaceCulling(hidesBacks);
        vtkActor * const whole = Add(renderer, Ball(0.4));
        whole->SetPosition(1.8, 0.0, 0.0);
        whole->GetProperty()->SetFrontfaceCulling(hidesFronts);
      };
      ExpectVTKsPicture(setUp);
    }
  }
}

// Light and colours

TEST(SurfacePassScene, HighlightsOfALightKitInParallelProjection)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer, true);
    vtkProperty * const property = Add(renderer, Ball(1.5, true, 64))->GetProperty();
    property->SetSpecular(0.6);
    property->SetSpecularPower(8.0);
    const vtkNew<vtkLightKit> kit;
    kit->AddLightsToRenderer(renderer);
  });
}

TEST(SurfacePassScene, WithoutAnyLightOn)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    vtkActor * const cut = Add(renderer, Ball(1.5));
    CutInFront(cut);
    cut->GetProperty()->SetAmbient(0.3);
    const vtkNew<vtkProperty> back;
    back->SetColor(0.2, 0.4, 0.3);
    cut->SetBackfaceProperty(back);
    const vtkNew<vtkLight> light;
    light->SwitchOff();
    renderer->AddLight(light);
  });
}

TEST(SurfacePassScene, MappedColoursCoverTheBackfaceProperty)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    vtkActor * const cut = Add(renderer, WithHeights(Ball(1.5)));
    CutInFront(cut);
    cut->GetMapper()->SetScalarRange(-1.5, 1.5);
    cut->GetProperty()->SetSpecular(0.3);
    const vtkNew<vtkProperty> back;
    back->SetColor(0.1, 0.8, 0.3);
    back->SetAmbient(0.5);
    back->SetDiffuse(0.2);
    back->SetSpecular(0.9);
    cut->SetBackfaceProperty(back);
  });
}

TEST(SurfacePassScene, ColoursOfBytes)
{
  for (const int components : { 3, 4 })
  {
    for (const bool ofCells : { false, true })
    {
      ExpectVTKsPicture([&](vtkRenderer * renderer) {
        Look(renderer);
        const auto ball = Ball(1.5);
        if (ofCells)
        {
          ball->GetCellData()->SetScalars(Bytes(ball->GetNumberOfCells(), components));
        }
        else
        {
          ball->GetPointData()->SetScalars(Bytes(ball->GetNumberOfPoints(), components));
        }
        Add(renderer, ball);
        Add(renderer, Ball(0.6));
      });
    }
  }
}

TEST(SurfacePassScene, LookupTablesWithAlphaAndValuesThatAreNoNumbers)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    const auto ball = WithHeights(Ball(1.5));
    auto * const heights = vtkFloatArray::SafeDownCast(ball->GetPointData()->GetArray("height"));
    for (vtkIdType n = 0; n < 100; ++n)
    {
      heights->SetValue(3 * n, std::numeric_limits<float>::quiet_NaN());
    }
    vtkActor * const actor = Add(renderer, ball);
    const vtkNew<vtkLookupTable> table;
    table->SetRange(-1.0, 1.0);
    table->SetAlphaRange(0.2, 0.9);
    table->SetNanColor(1.0, 1.0, 1.0, 0.5);
    table->Build();
    actor->GetMapper()->SetLookupTable(table);
    actor->GetMapper()->UseLookupTableScalarRangeOn();
    actor->GetMapper()->SetScalarModeToUsePointFieldData();
    actor->GetMapper()->SelectColorArray("height");
    Add(renderer, Ball(0.6));
  });
}

TEST(SurfacePassScene, StripsAndPolygonsWithColoursOfCells)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    const vtkNew<vtkStripper> strips;
    strips->SetInputData(Ball(1.0));
    strips->Update();
    vtkActor * const stripped = Add(renderer, WithValuesOfCells(strips->GetOutput()));
    stripped->SetPosition(-1.0, 0.0, 0.0);
    stripped->GetMapper()->SetScalarRange(0.0, 10.0);
    const auto sheet = WarpedSheet();
    sheet->GetPointData()->SetScalars(nullptr);
    vtkActor * const cells = Add(renderer, WithValuesOfCells(sheet));
    cells->SetPosition(1.0, 0.5, 0.0);
    cells->GetMapper()->SetScalarRange(0.0, 10.0);
  });
}

TEST(SurfacePassScene, ActorsMayBeForcedToBeTranslucent)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(0.8));
    vtkActor * const layer = Add(renderer, WithHeights(Ball(1.3)));
    layer->ForceTranslucentOn();
    layer->SetPosition(0.6, 0.3, 0.0);
  });
}

// VTK 9.1 blends such an actor with what happens to be drawn before.
TEST(SurfacePassScene, ActorsThatAreForcedToBeOpaqueHideWhatIsBehind)
{
  const auto draw = [](double opacity) {
    return Draw(
      [opacity](vtkRenderer * renderer) {
        Look(renderer);
        vtkActor * const solid = Add(renderer, Ball(0.8));
        solid->GetProperty()->SetOpacity(opacity);
        solid->ForceOpaqueOn();
        Add(renderer, Ball(1.2))->GetProperty()->SetOpacity(0.5);
      },
      PlainPass());
  };
  const Drawn drawn = draw(0.3);
  EXPECT_GT(ShareOfSurfaces(drawn), 0.05);
  EXPECT_EQ(drawn.colours, draw(1.0).colours);
}

TEST(SurfacePassScene, TheNearestActorIsTheSame)
{
  const auto setUp = [](vtkRenderer * renderer) {
    Look(renderer);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1.2, 1.2);
    for (int n = 0; n < 60; ++n)
    {
      vtkActor * const ball = Add(renderer, Ball(0.5));
      ball->SetPosition(place(random), place(random), place(random));
      ball->SetScale(1.0, 0.3, 0.8);
      ball->RotateWXYZ(90.0 * place(random), place(random), 1.0, 0.3);
      ball->GetProperty()->LightingOff();
      ball->GetProperty()->SetColor(n % 4 / 4.0, n / 4 % 4 / 4.0, n / 16 / 4.0);
    }
  };
  EXPECT_LE(ShareOfOthers(setUp), ShareAtEdges);
}

// Camera and window

TEST(SurfacePassScene, MirroredCamerasSeeFacetsAsVTK)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.2, false))->SetScale(1.0, 0.5, 1.5);
    const vtkNew<vtkTransform> mirrored;
    mirrored->Scale(-1.0, 1.0, 1.0);
    renderer->GetActiveCamera()->SetUserTransform(mirrored);
  });
}

TEST(SurfacePassScene, TransformsOfTheCamera)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.2, false))->SetScale(1.0, 0.5, 1.5);
    const vtkNew<vtkTransform> turned;
    turned->RotateZ(35.0);
    turned->Scale(1.2, 0.8, 1.0);
    renderer->GetActiveCamera()->SetUserTransform(turned);
    const vtkNew<vtkTransform> model;
    model->Translate(0.3, 0.1, 0.2);
    renderer->GetActiveCamera()->SetModelTransformMatrix(model->GetMatrix());
  });
}

/** Two renderers beside each other, and one over both. */
Drawn
DrawThreeRenderers(const std::vector<vtkSmartPointer<vtkRhombicSurfacePass>> & passes, int multiSamples)
{
  const auto window = MakeWindow(multiSamples);
  window->SetNumberOfLayers(2);
  for (int n = 0; n < 3; ++n)
  {
    const vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(0.1 + 0.2 * n, 0.3, 0.2);
    Look(renderer, n == 1);
    vtkActor * const ball = Add(renderer, Ball(0.9 + 0.3 * n, true, 64));
    ball->GetProperty()->SetOpacity(n == 1 ? 0.5 : 1.0);
    Add(renderer, Ball(0.5))->SetPosition(0.4, 0.4, 1.1);
    if (n == 2)
    {
      renderer->SetLayer(1);
      ball->SetScale(0.4);
    }
    else
    {
      renderer->SetViewport(0.5 * n, 0.1 * n, 0.5 + 0.5 * n, 0.8);
    }
    PeelDepths(renderer);
    renderer->ResetCameraClippingRange();
    if (!passes.empty())
    {
      renderer->SetPass(passes[static_cast<std::size_t>(n) % passes.size()]);
    }
    window->AddRenderer(renderer);
  }
  Render(window);
  return Render(window); // a pass that serves several renderers has seen them all
}

TEST(SurfacePassScene, SeveralRenderersInOneWindow)
{
  const Drawn expected = DrawThreeRenderers({}, 0);
  for (const auto & passes : { std::vector{ PlainPass(), PlainPass(), PlainPass() }, std::vector{ PlainPass() } })
  {
    const Drawn drawn = DrawThreeRenderers(passes, 0);
    EXPECT_LE(ShareOfOtherDepths(expected, drawn), ShareAtEdges);
    EXPECT_LE(ShareOfOtherColours(expected, drawn, LargestLitDifference), ShareAtEdges);
  }
  // Within surfaces, where VTK's pictures of one and four samples are alike.
  const Drawn smooth = DrawThreeRenderers({}, 4);
  const double edges = ShareOfOtherColours(expected, smooth, 0.0);
  const Drawn drawn = DrawThreeRenderers({ PlainPass() }, 4);
  EXPECT_LE(ShareOfOtherColours(smooth, drawn, LargestLitDifference), edges + ShareAtEdges);
}

/** A picture of twice the size, from tiles. */
std::vector<unsigned char>
DrawTiles(vtkRenderPass * pass)
{
  const auto window = MakeWindow();
  const vtkNew<vtkRenderer> renderer;
  Look(renderer);
  Add(renderer, Ball(1.5, true, 64));
  Add(renderer, Ball(1.8, true, 64))->GetProperty()->SetOpacity(0.4);
  PeelDepths(renderer);
  renderer->SetPass(pass);
  window->AddRenderer(renderer);
  const vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window);
  filter->SetScale(2);
  filter->ReadFrontBufferOff();
  filter->Update();
  const auto * const bytes = static_cast<const unsigned char *>(filter->GetOutput()->GetScalarPointer());
  return { bytes, bytes + 3 * 4 * Side * Side };
}

TEST(SurfacePassScene, PicturesOfSeveralTiles)
{
  const Drawn expected{ DrawTiles(nullptr), {} };
  const Drawn drawn{ DrawTiles(PlainPass()), {} };
  EXPECT_LE(ShareOfOtherColours(expected, drawn, LargestLitDifference), 4.0 * ShareAtEdges); // of four tiles
}

// With others

TEST(SurfacePassScene, APassOfVTKMayWorkOnThePicture)
{
  const auto setUp = [](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.2, true, 64));
    Add(renderer, Ball(0.6, true, 64))->SetPosition(1.2, 0.0, 0.0);
  };
  const vtkNew<vtkSSAAPass> smoothOfVTK;
  smoothOfVTK->SetDelegatePass(vtkNew<vtkRenderStepsPass>());
  const vtkNew<vtkSSAAPass> smooth;
  smooth->SetDelegatePass(PlainPass());
  const Drawn drawn = Draw(setUp, smooth);
  EXPECT_LE(ShareOfOtherColours(Draw(setUp, smoothOfVTK), drawn, LargestLitDifference), ShareAtEdges);
  EXPECT_GT(ShareOfOtherColours(Draw(setUp, PlainPass()), drawn, LargestLitDifference), 0.01); // edges are smooth
}

TEST(SurfacePassScene, LinesTextAndBarsAreDrawnByVTK)
{
  const auto setUp = [](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(0.7));
    const vtkNew<vtkAxesActor> axes;
    axes->SetTotalLength(1.5, 1.5, 1.5);
    renderer->AddActor(axes);
    const vtkNew<vtkScalarBarActor> bar;
    const vtkNew<vtkLookupTable> table;
    table->Build();
    bar->SetLookupTable(table);
    bar->SetTitle("mm");
    renderer->AddActor2D(bar);
    const vtkNew<vtkTextActor> text;
    text->SetInput("Rhombic");
    text->SetPosition(5, 5);
    renderer->AddActor2D(text);
    vtkActor * const lines = Add(renderer, Ball(0.8));
    lines->GetProperty()->SetRepresentationToWireframe();
    vtkActor * const edges = Add(renderer, Ball(0.4));
    edges->GetProperty()->EdgeVisibilityOn();
    edges->SetPosition(-1.3, 0.0, 0.5);
    vtkActor * const dots = Add(renderer, Ball(0.4));
    dots->GetProperty()->SetRepresentationToPoints();
    dots->GetProperty()->SetPointSize(3.0f);
    dots->SetPosition(-1.3, 0.0, -0.8);
    const vtkNew<vtkAssembly> assembly;
    const vtkNew<vtkActor> part;
    part->SetMapper(edges->GetMapper());
    assembly->AddPart(part);
    assembly->SetPosition(1.3, -1.0, -0.8);
    renderer->AddViewProp(assembly);
    const vtkNew<vtkFollower> follower;
    follower->SetMapper(edges->GetMapper());
    follower->SetCamera(renderer->GetActiveCamera());
    follower->SetPosition(-0.3, 0.0, 1.5);
    renderer->AddActor(follower);
  };
  ExpectVTKsPicture(setUp);
}

TEST(SurfacePassScene, VolumesAreDrawnByVTKAfterSurfaces)
{
  const auto setUp = [](vtkRenderer * renderer, bool isSeen) {
    Look(renderer);
    Add(renderer, Ball(0.6))->SetPosition(0.3, -0.2, 0.1);
    const vtkNew<vtkImageData> image;
    image->SetDimensions(20, 20, 20);
    image->SetSpacing(0.1, 0.1, 0.1);
    image->SetOrigin(-0.6, -0.6, -0.95);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    auto * const values = static_cast<unsigned char *>(image->GetScalarPointer());
    for (int n = 0; n < 20 * 20 * 20; ++n)
    {
      values[n] = static_cast<unsigned char>(n % 20 * 12);
    }
    const vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0.0, 0.0);
    opacity->AddPoint(255.0, 0.2);
    const vtkNew<vtkColorTransferFunction> colours;
    colours->AddRGBPoint(0.0, 1.0, 0.0, 0.0);
    colours->AddRGBPoint(255.0, 0.0, 1.0, 0.0);
    const vtkNew<vtkGPUVolumeRayCastMapper> mapper;
    mapper->SetInputData(image);
    mapper->AutoAdjustSampleDistancesOff();
    const vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->GetProperty()->SetScalarOpacity(opacity);
    volume->GetProperty()->SetColor(colours);
    volume->SetVisibility(isSeen);
    renderer->AddVolume(volume);
  };
  const auto withVolume = [&setUp](vtkRenderer * renderer) { setUp(renderer, true); };
  ExpectVTKsPicture(withVolume);
  const auto without = [&setUp](vtkRenderer * renderer) { setUp(renderer, false); };
  EXPECT_GT(ShareOfOtherColours(Draw(withVolume, PlainPass()), Draw(without, PlainPass()), 10.0), 0.05);
}

// Layers

TEST(SurfacePassScene, TranslucentActorsThatCrossAreThoseOfDepthPeeling)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    std::mt19937 random(17);
    std::uniform_real_distribution<double> place(-0.8, 0.8);
    for (int n = 0; n < 6; ++n)
    {
      vtkActor * const ball = Add(renderer, Ball(0.7));
      ball->SetPosition(place(random), place(random), place(random));
      ball->GetProperty()->SetColor(n % 2, n / 2 % 2, n / 4);
      ball->GetProperty()->SetOpacity(n == 5 ? 1.0 : 0.15 + 0.1 * n);
      if (n == 2)
      {
        CutInFront(ball);
        const vtkNew<vtkProperty> back;
        back->SetColor(1.0, 1.0, 1.0);
        back->SetOpacity(0.8);
        ball->SetBackfaceProperty(back);
      }
    }
  });
}

} // namespace
