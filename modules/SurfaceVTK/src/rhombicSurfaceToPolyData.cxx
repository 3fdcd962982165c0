#include "rhombicSurfaceToPolyData.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <cstdint>
#include <limits>

namespace rhombic
{
namespace
{

using SurfacePointer = itk::TriangleSurface::ConstPointer;

/** An observer that does nothing but keep the surface alive: an array drops its observers when it is destroyed. */
class SurfaceKeeper : public vtkCommand
{
public:
  static SurfaceKeeper *
  New(const SurfacePointer & surface)
  {
    auto * const keeper = new SurfaceKeeper;
    keeper->m_Surface = surface;
    return keeper;
  }

  void
  Execute(vtkObject *, unsigned long, void *) override
  {}

private:
  SurfacePointer m_Surface;
};

/** A VTK array that shares the memory of some tuples of the surface. */
template <typename TArray, typename TValue, typename TTuples>
vtkSmartPointer<TArray>
Wrap(const TTuples & tuples, int components, const SurfacePointer & surface)
{
  using TupleType = typename TTuples::value_type;
  constexpr int doNotFree = 1;
  auto array = vtkSmartPointer<TArray>::New();
  array->SetNumberOfComponents(components);
  // VTK's arrays have no const view; the header forbids changes.
  auto * const values = reinterpret_cast<TValue *>(const_cast<TupleType *>(tuples.data()));
  array->SetArray(values, static_cast<vtkIdType>(tuples.size() * sizeof(TupleType) / sizeof(TValue)), doNotFree);
  const auto keeper = vtkSmartPointer<SurfaceKeeper>::Take(SurfaceKeeper::New(surface));
  array->AddObserver(vtkCommand::UserEvent, keeper);
  return array;
}

} // namespace

vtkSmartPointer<vtkPolyData>
SurfaceToPolyData(const itk::TriangleSurface * surface)
{
  if (surface == nullptr)
  {
    itkGenericExceptionMacro("VTK's polydata needs a surface, not a null pointer; give the output of a filter");
  }
  const SurfacePointer keep(surface);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(Wrap<vtkFloatArray, float>(surface->GetPoints(), 3, keep));

  // uint32 indices read as int32 are the same bytes, as long as there are fewer than 2^31 points.
  if (surface->GetNumberOfPoints() > static_cast<itk::SizeValueType>(std::numeric_limits<std::int32_t>::max()) ||
      3 * surface->GetNumberOfTriangles() > static_cast<itk::SizeValueType>(std::numeric_limits<std::int32_t>::max()))
  {
    itkGenericExceptionMacro("VTK's 32-bit cells can't hold "
                             << surface->GetNumberOfTriangles()
                             << " triangles; extract at a lower density or from a smaller region.");
  }
  const auto offsets = vtkSmartPointer<vtkTypeInt32Array>::New();
  offsets->SetNumberOfValues(static_cast<vtkIdType>(surface->GetNumberOfTriangles()) + 1);
  for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
  {
    offsets->SetValue(i, static_cast<std::int32_t>(3 * i));
  }
  const auto triangles = vtkSmartPointer<vtkCellArray>::New();
  triangles->SetData(offsets, Wrap<vtkTypeInt32Array, std::int32_t>(surface->GetTriangles(), 1, keep));

  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  polyData->SetPolys(triangles);
  if (surface->HasNormals())
  {
    const auto normals = Wrap<vtkFloatArray, float>(surface->GetNormals(), 3, keep);
    normals->SetName("Normals");
    polyData->GetPointData()->SetNormals(normals);
  }
  return polyData;
}

} // namespace rhombic
