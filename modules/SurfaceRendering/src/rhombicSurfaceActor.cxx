#include "rhombicSurfaceActor.h"

#include "rhombicSurfaceToPolyData.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

namespace rhombic
{
namespace
{

/** The opacity of a thin wall seen at an angle: light passes 1 / cos(angle) times as much of it. So a translucent skin
 * is clear where it faces the viewer, and its outline is visible. */
constexpr const char * OpacityAtAnAngle = R"(//VTK::Light::Impl
  fragOutput0.a = 1.0 - pow(1.0 - fragOutput0.a, 1.0 / max(abs(normalVCVSOutput.z), 0.15));
)";

vtkSmartPointer<vtkPolyDataMapper>
MakeMapper(const itk::TriangleSurface * surface)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(SurfaceToPolyData(surface));
  mapper->ScalarVisibilityOff();
  mapper->StaticOn();
  return mapper;
}

void
SetMaterial(const SceneSurface & item, vtkProperty * property)
{
  const bool translucent = item.opacity < 1.0;
  property->SetInterpolationToPhong();
  property->SetColor(item.colour[0], item.colour[1], item.colour[2]);
  property->SetAmbient(translucent ? 0.35 : 0.05); // brightens the outline of a translucent surface
  property->SetDiffuse(0.95);
  property->SetSpecularColor(1.0, 1.0, 1.0);
  property->SetSpecular(0.10);
  property->SetSpecularPower(20.0);
  property->SetOpacity(item.opacity);
  property->SetBackfaceCulling(translucent); // far walls would hide detail inside
}

} // namespace

vtkSmartPointer<vtkActor>
MakeSurfaceActor(const SceneSurface & item)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(MakeMapper(item.surface));
  SetMaterial(item, actor->GetProperty());
  if (item.opacity < 1.0)
  {
    actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, OpacityAtAnAngle, false);
  }
  return actor;
}

} // namespace rhombic
