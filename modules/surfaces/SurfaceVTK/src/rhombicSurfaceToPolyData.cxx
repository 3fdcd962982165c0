#include "rhombicSurfaceToPolyData.h"

#include <vtkBuffer.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace rhombic
{
namespace
{

/** The memory of an array of a surface, which lives as long as this buffer does. */
template <typename TValue, typename TTuples>
class SharedBuffer : public vtkBuffer<TValue>
{
public:
  static SharedBuffer *
  New(std::shared_ptr<const TTuples> tuples)
  {
    auto * const buffer = new SharedBuffer;
    buffer->InitializeObjectBase();
    buffer->SetFreeFunction(true);
    // VTK has no arrays of constant values.
    auto * const values = const_cast<typename TTuples::value_type *>(tuples->data());
    buffer->SetBuffer(reinterpret_cast<TValue *>(values),
                      static_cast<vtkIdType>(tuples->size() * sizeof(*values) / sizeof(TValue)));
    buffer->m_Tuples = std::move(tuples);
    return buffer;
  }

private:
  std::shared_ptr<const TTuples> m_Tuples;
};

/** An array of VTK whose values are a SharedBuffer. Shallow copies share the buffer. */
template <typename TArray>
class SharedArray : public TArray
{
public:
  template <typename TTuples>
  static vtkSmartPointer<TArray>
  New(std::shared_ptr<const TTuples> tuples, int components)
  {
    auto * const array = new SharedArray;
    array->InitializeObjectBase();
    array->Buffer->Delete();
    array->Buffer = SharedBuffer<typename TArray::ValueType, TTuples>::New(std::move(tuples));
    array->SetNumberOfComponents(components);
    array->Size = array->Buffer->GetSize();
    array->MaxId = array->Size - 1;
    return vtkSmartPointer<TArray>::Take(array);
  }
};

} // namespace

vtkSmartPointer<vtkPolyData>
SurfaceToPolyData(const itk::TriangleSurface * surface)
{
  if (surface == nullptr)
  {
    itkGenericExceptionMacro("VTK's polydata needs a surface, not a null pointer; give the output of a filter");
  }
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(SharedArray<vtkFloatArray>::New(surface->SharePoints(), 3));

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
  triangles->SetData(offsets, SharedArray<vtkTypeInt32Array>::New(surface->ShareTriangles(), 1));

  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  polyData->SetPolys(triangles);
  if (surface->HasNormals())
  {
    const auto normals = SharedArray<vtkFloatArray>::New(surface->ShareNormals(), 3);
    normals->SetName("Normals");
    polyData->GetPointData()->SetNormals(normals);
  }
  return polyData;
}

} // namespace rhombic
