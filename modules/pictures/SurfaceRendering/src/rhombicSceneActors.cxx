#include "rhombicSceneActors.h"

#include "rhombicSceneCheck.h"
#include "rhombicSurfaceToPolyData.h"
#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicSurfacePass.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

VTK_MODULE_INIT(vtkRenderingOpenGL2); // makes OpenGL's classes of actors, mappers and renderers

namespace rhombic
{
namespace
{

constexpr double Degrees = 57.29577951308232; // in a radian

/** An array of VTK in the memory of colours, which must outlive it. */
vtkSmartPointer<vtkUnsignedCharArray>
ShareColours(const PointColours & colours)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  // VTK has no arrays of constant values.
  array->SetArray(const_cast<std::uint8_t *>(colours.front().data()), static_cast<vtkIdType>(3 * colours.size()), 1);
  return array;
}

vtkSmartPointer<vtkActor>
MakeSurfaceActor(const SceneSurface & item, const std::vector<ClipPlane> & cuts)
{
  const vtkNew<vtkPolyDataMapper> mapper;
  const auto data = SurfaceToPolyData(item.surface);
  mapper->SetInputData(data);
  mapper->SetScalarVisibility(item.pointColours != nullptr);
  if (item.pointColours)
  {
    data->GetPointData()->SetScalars(ShareColours(*item.pointColours));
    mapper->SetColorModeToDirectScalars();
  }
  for (const ClipPlane & cut : cuts)
  {
    if (IsCut(item, cut))
    {
      const Vector3 kept = Scaled(cut.normal, -1.0 / Length(cut.normal));
      const vtkNew<vtkPlane> plane;
      plane->SetOrigin(cut.point[0], cut.point[1], cut.point[2]);
      plane->SetNormal(kept[0], kept[1], kept[2]);
      mapper->AddClippingPlane(plane);
    }
  }
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty * const property = actor->GetProperty();
  property->SetColor(item.colour[0], item.colour[1], item.colour[2]);
  property->SetOpacity(item.opacity);
  property->SetLighting(item.pointColours == nullptr);
  property->SetSpecular(item.isGlossy ? 1.0 : 0.0);
  property->SetInterpolation(item.surface->HasNormals() ? VTK_GOURAUD : VTK_FLAT);
  return actor;
}

vtkSmartPointer<vtkTexture>
MakeTexture(const Picture & picture)
{
  const vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetNumberOfComponents(picture.channels);
  // VTK has no arrays of constant values.
  bytes->SetArray(const_cast<std::uint8_t *>(picture.pixels.data()), static_cast<vtkIdType>(picture.pixels.size()), 1);
  const vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->GetPointData()->SetScalars(bytes);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  return texture;
}

vtkSmartPointer<vtkActor>
MakePlaneActor(const ScenePlane & plane)
{
  const auto width = static_cast<double>(plane.projection.width);
  const auto height = static_cast<double>(plane.projection.height);
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  const vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(4);
  for (const auto & [x, y] : { PicturePosition{ 0, 0 }, PicturePosition{ 1, 0 }, { 1, 1 }, { 0, 1 } })
  {
    polygons->InsertCellPoint(points->InsertNextPoint(plane.projection.PointAt({ x * width, y * height }).data()));
    places->InsertNextTuple2(x, y);
  }
  const vtkNew<vtkPolyData> rectangle;
  rectangle->SetPoints(points);
  rectangle->SetPolys(polygons);
  rectangle->GetPointData()->SetTCoords(places);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(rectangle);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(MakeTexture(plane.picture));
  actor->GetProperty()->LightingOff();
  actor->ForceTranslucentOn();
  return actor;
}

/** How far a surface is moved back along its normal, in mm, so that surfaces of earlier layers are seen instead. */
double
DistanceBehind(const SceneSurface & item, double pixelSize)
{
  constexpr std::size_t mostLayers = 5;
  constexpr double apart =
    0.6; // pixels: simplified for a picture, two walls in one place are half a pixel apart at most
  return static_cast<double>(std::min(item.layer, mostLayers)) * std::max(apart * pixelSize, item.layerGap);
}

/** Moves surfaces away from the viewer, so that the first of those in one place is seen: by steps far below a pixel,
 * and by their layers.
 * \param depth mm between the clipping planes, as differences of depths have them where they are shortest */
void
OffsetSurfaces(const std::vector<SceneSurface> & surfaces, double pixelSize, double depth, vtkActorCollection * actors)
{
  constexpr std::size_t mostSteps = 100;
  const double unitsOfMillimetre = 2.0 / (depth * vtkRhombicOpaquePass::OffsetUnit);
  actors->InitTraversal();
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const auto step = static_cast<double>(std::min(n, mostSteps));
    const double behind = DistanceBehind(surfaces[n], pixelSize) * unitsOfMillimetre;
    actors->GetNextActor()->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(behind, step + behind);
  }
}

/** Whether a surface has colours of points, which are drawn without light: by the pass only with a renderer's lights.
 */
bool
HasPointColours(const Scene & scene)
{
  return std::any_of(
    scene.surfaces.begin(), scene.surfaces.end(), [](const auto & item) { return item.pointColours != nullptr; });
}

} // namespace

vtkSmartPointer<vtkRenderer>
MakeRenderer(const Scene & scene, const RenderSettings & settings)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->GetCullers()->RemoveAllItems();
  renderer->SetActiveCamera(vtkNew<vtkCamera>()); // one of VTK's own would be fitted to all actors, which takes time
  for (const SceneSurface & item : scene.surfaces)
  {
    renderer->AddActor(MakeSurfaceActor(item, scene.cuts));
  }
  for (const ScenePlane & plane : scene.planes)
  {
    renderer->AddActor(MakePlaneActor(plane));
  }
  const bool hasAlpha = settings.style == PictureStyle::Transparent;
  const Colour background = hasAlpha ? Colour{} : BackgroundOf(settings);
  renderer->SetBackground(background[0], background[1], background[2]);
  renderer->SetBackgroundAlpha(hasAlpha ? 0.0 : 1.0);
  const vtkNew<vtkRhombicSurfacePass> pass;
  vtkRhombicOpaquePass * const surfaces = pass->GetSurfaces();
  surfaces->SetLights(HasPointColours(scene)                   ? vtkRhombicOpaquePass::RendererLights
                      : settings.style == PictureStyle::Clinic ? vtkRhombicOpaquePass::ClinicLights
                                                               : vtkRhombicOpaquePass::PaperLights);
  surfaces->SetSamples(settings.samples);
  surfaces->SetAmbientOcclusion(settings.ambientOcclusion);
  surfaces->SetSilhouettes(settings.silhouettes);
  surfaces->SetStraightAlpha(hasAlpha);
  renderer->SetPass(pass);
  return renderer;
}

void
SetCamera(const Camera & camera, const Scene & scene, vtkRenderer * renderer)
{
  const bool isParallel = camera.spread == 0.0;
  const double distance = isParallel ? std::max(1.0, 1.0 - camera.nearest) : 1.0 / camera.spread;
  const Vector3 position = Along(camera.centre, camera.frame.look, -distance);
  vtkCamera * const seen = renderer->GetActiveCamera();
  seen->SetFocalPoint(camera.centre.data());
  seen->SetPosition(position.data());
  seen->SetViewUp(camera.frame.up.data());
  seen->SetParallelProjection(isParallel);
  const double reach = 0.5 * camera.height * camera.pixelSize;
  seen->SetParallelScale(reach);
  seen->SetViewAngle(isParallel ? 30.0 : 2.0 * std::atan(reach / distance) * Degrees);
  seen->SetWindowCenter(-2.0 * camera.rightward / camera.width, -2.0 * camera.upward / camera.height);
  // A difference of depths is shorter in front in perspective, in mm, and longer behind.
  constexpr double mostStretch = 3.0;
  const double stretch =
    isParallel ? 1.0 : std::min((distance + camera.farthest) / (distance + camera.nearest), mostStretch);
  const double room = (1.0 + vtkRhombicOpaquePass::SteepestSlope) * std::pow(stretch, 3.0);
  double farthest = camera.farthest;
  for (const SceneSurface & item : scene.surfaces)
  {
    farthest = std::max(farthest, camera.farthest + room * DistanceBehind(item, camera.pixelSize));
  }
  seen->SetClippingRange(distance + camera.nearest, distance + farthest);
  const double depth = (farthest - camera.nearest) / stretch;
  OffsetSurfaces(scene.surfaces, camera.pixelSize, depth, renderer->GetActors()); // come first
}

} // namespace rhombic
