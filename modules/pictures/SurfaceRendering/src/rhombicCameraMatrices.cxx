#include "rhombicCameraMatrices.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

using Matrix = CameraMatrices::Matrix;

Matrix
ValuesOf(vtkMatrix4x4 * matrix)
{
  Matrix values;
  std::copy_n(matrix->GetData(), values.size(), values.begin());
  return values;
}

Matrix
Product(const Matrix & a, const Matrix & b)
{
  Matrix product;
  vtkMatrix4x4::Multiply4x4(a.data(), b.data(), product.data());
  return product;
}

Matrix
Translation(const Vector3 & way)
{
  return { 1, 0, 0, way[0], 0, 1, 0, way[1], 0, 0, 1, way[2], 0, 0, 0, 1 };
}

std::array<float, 16>
ByColumns(const Matrix & matrix)
{
  std::array<float, 16> columns;
  for (std::size_t row = 0; row < 4; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      columns[4 * column + row] = static_cast<float>(matrix[4 * row + column]);
    }
  }
  return columns;
}

/** The transpose of the inverse of the upper left part, so that normals stay at right angles to surfaces. */
std::array<float, 9>
ForNormals(const Matrix & matrix)
{
  Matrix inverse;
  vtkMatrix4x4::Invert(matrix.data(), inverse.data());
  std::array<float, 9> columns;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      columns[3 * column + row] = static_cast<float>(inverse[4 * column + row]);
    }
  }
  return columns;
}

} // namespace

CameraMatrices::CameraMatrices(vtkRenderer * renderer, int targetWidth, int targetHeight)
  : width(targetWidth)
  , height(targetHeight)
{
  vtkCamera * const camera = renderer->GetActiveCamera();
  viewFromWorld = ValuesOf(camera->GetModelViewTransformMatrix());
  clipFromView = ValuesOf(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  camera->GetFocalPoint(focalPoint.data());
  isParallel = camera->GetParallelProjection() != 0;
  const double distance = camera->GetDistance();
  const auto clipAt = [&](std::size_t row, double depth) {
    return clipFromView[4 * row + 3] - clipFromView[4 * row + 2] * (distance + depth);
  };
  const double w = clipAt(3, 0.0);
  spread = (clipAt(3, 1.0) - w) / w;
  depthFactor = (clipAt(2, 1.0) - clipAt(2, 0.0)) / w;
  depthOffset = clipAt(2, 0.0) / w;
  pixelSize = 2.0 * w / (height * clipFromView[5]);
}

ActorMatrices::ActorMatrices(const CameraMatrices & camera, vtkMatrix4x4 * worldFromActor, const Vector3 & origin)
  : worldFromModel(Product(ValuesOf(worldFromActor), Translation(origin)))
{
  Matrix modelFromWorld;
  vtkMatrix4x4::Invert(worldFromModel.data(), modelFromWorld.data());
  const std::array<double, 4> focalPoint{ camera.focalPoint[0], camera.focalPoint[1], camera.focalPoint[2], 1.0 };
  std::array<double, 4> centreOfModel;
  vtkMatrix4x4::MultiplyPoint(modelFromWorld.data(), focalPoint.data(), centreOfModel.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centre[axis] = static_cast<float>(centreOfModel[axis]);
  }
  worldFromCentred = Product(worldFromModel, Translation({ centre[0], centre[1], centre[2] }));
  const Matrix view = Product(camera.viewFromWorld, worldFromCentred);
  clipFromCentred = ByColumns(Product(camera.clipFromView, view));
  viewFromCentred = ByColumns(view);
  viewFromNormal = ForNormals(view);
  scale = std::cbrt(std::abs(worldFromActor->Determinant()));
  const bool mirrorsByCamera = vtkMatrix4x4::Determinant(camera.clipFromView.data()) > 0.0; // depths run away from z
  isMirrored = (vtkMatrix4x4::Determinant(view.data()) < 0.0) != mirrorsByCamera;
  handedness = mirrorsByCamera ? -1.0f : 1.0f;
}

} // namespace rhombic
