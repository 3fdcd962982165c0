#include "rhombicPassPictures.h"
#include "vtkRhombicTranslucentPass.h"

#include <gtest/gtest.h>

#include <vtkCameraPass.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkLight.h>
#include <vtkLightKit.h>
#include <vtkLightsPass.h>
#include <vtkLookupTable.h>
#include <vtkOpaquePass.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkStripper.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

/** Scenes of VTK drawn by Rhombic's passes and by VTK's own, which tell what is right. */
namespace
{

using namespace rhombic::test;

/** A ball with a value at each point and cell. */
vtkSmartPointer<vtkPolyData>
BallWithValues()
{
  auto ball = Ball(1.5);
  const vtkNew<vtkFloatArray> ofPoints;
  for (vtkIdType n = 0; n < ball->GetNumberOfPoints(); ++n)
  {
    ofPoints->InsertNextValue(static_cast<float>(ball->GetPoint(n)[2]));
  }
  ball->GetPointData()->SetScalars(ofPoints);
  const vtkNew<vtkFloatArray> ofCells;
  for (vtkIdType n = 0; n < ball->GetNumberOfCells(); ++n)
  {
    ofCells->InsertNextValue(static_cast<float>(n % 7) - 3.0f);
  }
  ball->GetCellData()->SetScalars(ofCells);
  return ball;
}

// Shapes

TEST(SurfacePassOracle, NormalsOfPointsOfCellsAndNone)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.0));
    Add(renderer, Ball(0.7, false))->SetPosition(1.6, 0.0, 0.0);
    const vtkNew<vtkPolyDataNormals> ofCells;
    ofCells->SetInputData(Ball(0.7, false));
    ofCells->ComputePointNormalsOff();
    ofCells->ComputeCellNormalsOn();
    ofCells->Update();
    Add(renderer, ofCells->GetOutput())->SetPosition(-1.6, 0.0, 0.0);
    vtkActor * const flat = Add(renderer, Ball(0.7));
    flat->SetPosition(0.0, 0.0, 1.6);
    flat->GetProperty()->SetInterpolationToFlat();
  });
}

TEST(SurfacePassOracle, StripsAndPolygons)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    const vtkNew<vtkStripper> strips;
    strips->SetInputData(Ball(1.0));
    strips->Update();
    Add(renderer, strips->GetOutput());
    const vtkNew<vtkPolyData> polygon;
    const vtkNew<vtkPoints> points;
    const vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(7);
    for (int n = 0; n < 7; ++n)
    {
      const double angle = 2.0 * std::acos(-1.0) * n / 7.0;
      cells->InsertCellPoint(points->InsertNextPoint(1.5 + std::cos(angle), -0.5, std::sin(angle)));
    }
    polygon->SetPoints(points);
    polygon->SetPolys(cells);
    Add(renderer, polygon);
  });
}

TEST(SurfacePassOracle, MatricesOfActors)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    vtkActor * const stretched = Add(renderer, Ball(1.0));
    stretched->SetScale(1.0, 0.4, 1.5);
    stretched->RotateX(40.0);
    stretched->SetPosition(-1.0, 0.0, 0.3);
    vtkActor * const small = Add(renderer, Ball(1.0));
    small->SetScale(0.6);
    small->SetPosition(1.5, 0.5, 0.0);
  });
}

// VTK 9.1 takes the near side of a mirrored actor for its back, and leaves it dark.
TEST(SurfacePassOracle, MirroredActorsAreLitAsOthers)
{
  const auto draw = [](double scale) {
    return Draw(
      [scale](vtkRenderer * renderer) {
        Look(renderer);
        Add(renderer, Ball(1.3, true, 96))->SetScale(scale, 1.0, 1.0);
      },
      PlainPass());
  };
  const Drawn mirrored = draw(-1.0);
  EXPECT_GT(ShareOfSurfaces(mirrored), 0.05);
  EXPECT_LE(ShareOfOtherColours(draw(1.0), mirrored, LargestLitDifference), 0.005);
}

TEST(SurfacePassOracle, CamerasInParallelAndPerspectiveOffTheMiddle)
{
  for (const bool isParallel : { false, true })
  {
    ExpectVTKsPicture([isParallel](vtkRenderer * renderer) {
      Look(renderer, isParallel);
      renderer->GetActiveCamera()->SetWindowCenter(0.3, -0.2);
      renderer->GetActiveCamera()->Roll(20.0);
      Add(renderer, Ball(1.2));
    });
  }
}

TEST(SurfacePassOracle, ClippingPlanesShowBacksWithTheirProperty)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    vtkActor * const cut = Add(renderer, Ball(1.5));
    cut->RotateZ(30.0);
    const vtkNew<vtkPlane> front;
    front->SetNormal(0.0, 1.0, 0.0);
    const vtkNew<vtkPlane> top;
    top->SetOrigin(0.0, 0.0, 0.8);
    top->SetNormal(0.2, 0.0, -1.0);
    cut->GetMapper()->AddClippingPlane(front);
    cut->GetMapper()->AddClippingPlane(top);
    const vtkNew<vtkProperty> back;
    back->SetColor(0.1, 0.8, 0.3);
    cut->SetBackfaceProperty(back);
  });
}

// Light and colours

TEST(SurfacePassOracle, PropertiesAndHeadlight)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    vtkProperty * const property = Add(renderer, Ball(1.5, true, 64))->GetProperty();
    property->SetAmbient(0.2);
    property->SetAmbientColor(0.3, 0.0, 0.8);
    property->SetDiffuse(0.6);
    property->SetSpecular(0.5);
    property->SetSpecularPower(20.0);
    property->SetSpecularColor(1.0, 1.0, 0.4);
    vtkProperty * const unlit = Add(renderer, Ball(0.5))->GetProperty();
    unlit->LightingOff();
  });
}

TEST(SurfacePassOracle, LightKitSceneLightsAndSpots)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.5, true, 64))->GetProperty()->SetSpecular(0.3);
    const vtkNew<vtkLightKit> kit;
    kit->AddLightsToRenderer(renderer);
  });
  for (const bool isPositional : { false, true })
  {
    ExpectVTKsPicture([isPositional](vtkRenderer * renderer) {
      Look(renderer);
      Add(renderer, Ball(1.5, true, 64))->GetProperty()->SetSpecular(0.3);
      const vtkNew<vtkLight> red;
      red->SetLightTypeToSceneLight();
      red->SetPosition(4.0, -4.0, 0.0);
      red->SetColor(1.0, 0.3, 0.3);
      red->SetPositional(isPositional);
      red->SetConeAngle(120.0);
      red->SetAttenuationValues(0.5, 0.1, 0.02);
      const vtkNew<vtkLight> spot;
      spot->SetLightTypeToCameraLight();
      spot->SetPosition(-0.5, 0.5, 1.0);
      spot->SetIntensity(0.7);
      spot->SetPositional(isPositional);
      spot->SetConeAngle(10.0);
      spot->SetExponent(3.0);
      renderer->AddLight(red);
      renderer->AddLight(spot);
    });
  }
}

TEST(SurfacePassOracle, ScalarsOfPointsAndCells)
{
  for (const bool ofCells : { false, true })
  {
    ExpectVTKsPicture([ofCells](vtkRenderer * renderer) {
      Look(renderer);
      vtkActor * const actor = Add(renderer, BallWithValues());
      actor->GetProperty()->SetAmbient(0.2);
      actor->GetMapper()->SetScalarRange(-3.0, 3.0);
      actor->GetMapper()->SetScalarMode(ofCells ? VTK_SCALAR_MODE_USE_CELL_DATA : VTK_SCALAR_MODE_USE_POINT_DATA);
    });
  }
}

TEST(SurfacePassOracle, SeveralSamplesOfTheWindow)
{
  const auto setUp = [](vtkRenderer * renderer) {
    Look(renderer);
    Add(renderer, Ball(1.5));
  };
  // Within the ball, where samples are alike.
  EXPECT_LE(ShareOfOtherColours(Draw(setUp, nullptr, 4), Draw(setUp, PlainPass(), 4), 3.0), 0.02);
}

// Depth

TEST(SurfacePassOracle, TheNearestOfManyIsSeen)
{
  ExpectVTKsPicture([](vtkRenderer * renderer) {
    Look(renderer);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    for (int n = 0; n < 40; ++n)
    {
      vtkActor * const ball = Add(renderer, Ball(0.4));
      ball->SetPosition(place(random), place(random), place(random));
      ball->GetProperty()->SetColor(0.5 + place(random) / 3.0, 0.5 + place(random) / 3.0, 0.5);
    }
  });
}

void
AddShells(vtkRenderer * renderer)
{
  Look(renderer);
  for (int n = 0; n < 4; ++n)
  {
    vtkActor * const shell = Add(renderer, Ball(0.5 + 0.3 * n, true, 48));
    shell->GetProperty()->SetColor(0.2 + 0.2 * n, 0.9 - 0.2 * n, 0.5);
    shell->GetProperty()->SetOpacity(0.3);
  }
  Add(renderer, Ball(0.3))->SetPosition(0.5, -0.3, 0.1);
}

TEST(SurfacePassOracle, NestedTranslucentShellsAreThoseOfDepthPeeling)
{
  ExpectVTKsPicture(AddShells);
}

vtkSmartPointer<vtkImageSlice>
Slice()
{
  const vtkNew<vtkImageData> image;
  image->SetDimensions(32, 32, 1);
  image->SetSpacing(0.1, 0.1, 0.1);
  image->SetOrigin(-1.55, -1.55, 0.1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto * const values = static_cast<unsigned char *>(image->GetScalarPointer());
  for (int n = 0; n < 32 * 32; ++n)
  {
    values[n] = static_cast<unsigned char>((n % 32 * 5 + n / 32 * 3) % 256);
  }
  const vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputData(image);
  auto slice = vtkSmartPointer<vtkImageSlice>::New();
  slice->SetMapper(mapper);
  slice->GetProperty()->SetInterpolationTypeToNearest();
  return slice;
}

void
AddSliceInABall(vtkRenderer * renderer)
{
  Look(renderer);
  renderer->AddViewProp(Slice());
  Add(renderer, Ball(1.3, true, 48))->GetProperty()->SetOpacity(0.4);
  Add(renderer, Ball(0.4))->SetPosition(0.3, 0.2, 0.1);
}

TEST(SurfacePassOracle, OpaqueSliceInsideATranslucentBall)
{
  ExpectVTKsPicture(AddSliceInABall);
}

TEST(SurfacePassOracle, OthersMayDrawBetweenThePasses)
{
  const vtkNew<vtkRhombicOpaquePass> opaque;
  opaque->SetSamples(1);
  opaque->AmbientOcclusionOff();
  opaque->SilhouettesOff();
  const vtkNew<vtkOpaquePass> others;
  opaque->SetOtherPass(nullptr);
  const vtkNew<vtkRhombicTranslucentPass> translucent;
  translucent->SetOpaquePass(opaque);
  const vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(opaque);
  passes->AddItem(others); // draws the slice, and once more the opaque ball
  passes->AddItem(translucent);
  const vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  const vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  const Drawn expected = Draw(AddSliceInABall, nullptr);
  const Drawn drawn = Draw(AddSliceInABall, camera);
  EXPECT_LE(ShareOfOtherDepths(expected, drawn), ShareAtEdges);
  EXPECT_LE(ShareOfOtherColours(expected, drawn, LargestLitDifference), ShareAtEdges);
}

TEST(SurfacePassOracle, FourSamplesAreSmoothAtEdgesAndTheSameWithin)
{
  const auto fine = PlainPass();
  fine->GetSurfaces()->SetSamples(2);
  const Drawn one = Draw(AddShells, PlainPass());
  const Drawn four = Draw(AddShells, fine);
  const double share = ShareOfOtherColours(one, four, 2.0 * LargestLitDifference);
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 0.08);
}

} // namespace
