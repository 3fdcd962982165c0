#include "rhombicActorTriangles.h"

#include "rhombicVector3.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolygon.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace rhombic
{
namespace
{

constexpr int MostClipPlanes = 6;        // OpenGL promises 8
constexpr std::size_t OneTriangleIn = 8; // is measured

/** Spreads the bits of a number (the finalizer of D. Stafford's variant 13 of MurmurHash3). */
std::uint64_t
Mix(std::uint64_t value)
{
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

/** Whether distances between such points are numbers. */
bool
IsFinite(const PointOfActor & point)
{
  return std::all_of(point.begin(), point.end(), [](float value) { return std::abs(value) < 1e18f; });
}

bool
HasOwnProgram(vtkActor * actor)
{
  vtkShaderProperty * const program = actor->GetShaderProperty();
  return program->GetNumberOfShaderReplacements() > 0 || program->HasVertexShaderCode() ||
         program->HasFragmentShaderCode() || program->HasGeometryShaderCode();
}

bool
IsPlainSurface(vtkActor * actor)
{
  vtkProperty * const property = actor->GetProperty();
  return property->GetRepresentation() == VTK_SURFACE && !property->GetEdgeVisibility() &&
         !property->GetVertexVisibility() && property->GetInterpolation() != VTK_PBR &&
         property->GetNumberOfTextures() == 0 && !HasOwnProgram(actor);
}

bool
HasPlainColours(vtkMapper * mapper)
{
  return !mapper->GetScalarVisibility() ||
         (!mapper->GetInterpolateScalarsBeforeMapping() && mapper->GetScalarMode() != VTK_SCALAR_MODE_USE_FIELD_DATA);
}

bool
CanBeInverted(vtkMatrix4x4 * matrix)
{
  const double * const values = matrix->GetData();
  return std::all_of(values, values + 16, [](double value) { return std::isfinite(value); }) &&
         std::abs(matrix->Determinant()) > 1e-30;
}

/** The values of an array, less an origin, as 32 bits. */
PointOfActor
TupleOf(vtkDataArray * array, vtkIdType n, const Vector3 & origin = {})
{
  Vector3 tuple{};
  array->GetTuple(n, tuple.data());
  const Vector3 rest = Subtract(tuple, origin);
  return { static_cast<float>(rest[0]), static_cast<float>(rest[1]), static_cast<float>(rest[2]) };
}

/** The first of points of 64 bits, so that what is far from 0 stays exact in 32 bits; 0 for points of 32 bits. */
Vector3
OriginOf(vtkDataArray * points)
{
  Vector3 first{};
  if (points->GetDataTypeSize() > 4 && points->GetNumberOfTuples() > 0 && IsFinite(TupleOf(points, 0)))
  {
    points->GetTuple(0, first.data());
  }
  return first;
}

/** A triangle of a polygon or strip of polydata, by the indices of points. */
struct TriangleOfCell
{
  std::array<vtkIdType, 3> corners;
  vtkIdType cell;
};

/** Whether the triangles from the first corner of a polygon to all others lie beside each other. */
bool
IsFan(vtkIdList * corners, vtkPoints * points)
{
  const auto cornerAt = [&](vtkIdType n) {
    Vector3 corner;
    points->GetPoint(corners->GetId(n), corner.data());
    return corner;
  };
  const Vector3 first = cornerAt(0);
  std::vector<Vector3> normals;
  Vector3 sum{};
  for (vtkIdType n = 2; n < corners->GetNumberOfIds(); ++n)
  {
    normals.push_back(Cross(Subtract(cornerAt(n - 1), first), Subtract(cornerAt(n), first)));
    sum = Add(sum, normals.back());
  }
  return std::none_of(
    normals.begin(), normals.end(), [&sum](const Vector3 & normal) { return Dot(normal, sum) < 0.0; });
}

/** The corners of a polygon's triangles, one after the other: from the first corner to all others, as VTK's mapper
 * draws them, unless the polygon has notches. */
void
TriangulatePolygon(vtkIdList * corners, vtkPoints * points, vtkIdList * triangles)
{
  triangles->Reset();
  const vtkIdType count = corners->GetNumberOfIds();
  if (count > 3 && !IsFan(corners, points))
  {
    const vtkNew<vtkPolygon> polygon;
    polygon->Initialize(static_cast<int>(count), corners->GetPointer(0), points);
    if (polygon->Triangulate(triangles))
    {
      for (vtkIdType n = 0; n < triangles->GetNumberOfIds(); ++n)
      {
        triangles->SetId(n, corners->GetId(triangles->GetId(n)));
      }
      return;
    }
    triangles->Reset();
  }
  for (vtkIdType n = 2; n < count; ++n)
  {
    triangles->InsertNextId(corners->GetId(0));
    triangles->InsertNextId(corners->GetId(n - 1));
    triangles->InsertNextId(corners->GetId(n));
  }
}

std::vector<TriangleOfCell>
TrianglesOf(vtkPolyData * polyData)
{
  std::vector<TriangleOfCell> triangles;
  const vtkNew<vtkIdList> corners;
  const vtkNew<vtkIdList> ofPolygon;
  const vtkIdType polygons = polyData->GetNumberOfPolys();
  for (vtkIdType cell = 0; cell < polygons; ++cell)
  {
    polyData->GetPolys()->GetCellAtId(cell, corners);
    TriangulatePolygon(corners, polyData->GetPoints(), ofPolygon);
    for (vtkIdType n = 2; n < ofPolygon->GetNumberOfIds(); n += 3)
    {
      triangles.push_back({ { ofPolygon->GetId(n - 2), ofPolygon->GetId(n - 1), ofPolygon->GetId(n) }, cell });
    }
  }
  for (vtkIdType strip = 0; strip < polyData->GetNumberOfStrips(); ++strip)
  {
    polyData->GetStrips()->GetCellAtId(strip, corners);
    for (vtkIdType n = 2; n < corners->GetNumberOfIds(); ++n)
    {
      const vtkIdType turned = n % 2; // every second triangle runs the other way round
      triangles.push_back(
        { { corners->GetId(n - 2 + turned), corners->GetId(n - 1 - turned), corners->GetId(n) }, polygons + strip });
    }
  }
  return triangles;
}

template <typename TValue>
ArrayView<TValue>
ViewOf(const std::vector<TValue> & values)
{
  return { values.data(), values.size() };
}

/** Tuples of floats in the memory of an array of VTK. */
template <typename TTuple>
ArrayView<TTuple>
ViewOf(vtkFloatArray * array)
{
  return { reinterpret_cast<const TTuple *>(array->GetPointer(0)),
           static_cast<std::size_t>(array->GetNumberOfTuples()) };
}

} // namespace

ActorTriangles::ActorTriangles(vtkActor * actor, bool withColours, bool isFlat)
{
  auto * const mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  int colouredBy = 0;
  vtkPolyData * const input = mapper->GetInput();
  vtkUnsignedCharArray * const mapped = withColours ? mapper->MapScalars(input, 1.0, colouredBy) : nullptr;
  if (mapped || !TakeArrays(input, isFlat))
  {
    CopyArrays(input, isFlat, mapped, colouredBy != 0);
  }
  KeepTrianglesWithPoints();
}

bool
ActorTriangles::TakeArrays(vtkPolyData * polyData, bool isFlat)
{
  vtkCellArray * const polygons = polyData->GetPolys();
  auto * const positions = vtkFloatArray::SafeDownCast(polyData->GetPoints()->GetData());
  vtkDataArray * const given = isFlat ? nullptr : polyData->GetPointData()->GetNormals();
  auto * const directions = vtkFloatArray::SafeDownCast(given);
  vtkDataArray * const places = polyData->GetPointData()->GetTCoords();
  const bool hasNormalsOfCells = !given && polyData->GetCellData()->GetNormals();
  if (polyData->GetNumberOfStrips() > 0 || polygons->IsStorage64Bit() || polygons->IsHomogeneous() != 3 || !positions ||
      (given && !directions) || places || hasNormalsOfCells)
  {
    return false;
  }
  m_PolyData = vtkSmartPointer<vtkPolyData>::New();
  m_PolyData->ShallowCopy(polyData);
  points = ViewOf<PointOfActor>(positions);
  normals = directions ? ViewOf<PointOfActor>(directions) : ArrayView<PointOfActor>{};
  triangles = { reinterpret_cast<const TriangleOfActor *>(polygons->GetConnectivityArray32()->GetPointer(0)),
                static_cast<std::size_t>(polygons->GetNumberOfCells()) };
  return true;
}

void
ActorTriangles::CopyArrays(vtkPolyData * polyData, bool isFlat, vtkUnsignedCharArray * mapped, bool areOfCells)
{
  vtkDataArray * const positions = polyData->GetPoints()->GetData();
  vtkDataArray * const pointNormals = isFlat ? nullptr : polyData->GetPointData()->GetNormals();
  vtkDataArray * const cellNormals = pointNormals ? nullptr : polyData->GetCellData()->GetNormals();
  vtkDataArray * const places = polyData->GetPointData()->GetTCoords();
  const bool repeats = cellNormals || (mapped && areOfCells);
  origin = OriginOf(positions);
  const auto addPoint = [&](vtkIdType point, vtkIdType cell) {
    m_Points.push_back(TupleOf(positions, point, origin));
    if (pointNormals || cellNormals)
    {
      m_Normals.push_back(pointNormals ? TupleOf(pointNormals, point) : TupleOf(cellNormals, cell));
    }
    if (mapped)
    {
      m_Colours.emplace_back();
      mapped->GetTypedTuple(areOfCells ? cell : point, m_Colours.back().data());
    }
    if (places)
    {
      m_TexturePositions.push_back(
        { static_cast<float>(places->GetComponent(point, 0)), static_cast<float>(places->GetComponent(point, 1)) });
    }
  };
  for (vtkIdType point = 0; !repeats && point < polyData->GetNumberOfPoints(); ++point)
  {
    addPoint(point, 0);
  }
  for (const auto & [corners, cell] : TrianglesOf(polyData))
  {
    TriangleOfActor triangle{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      triangle[k] = static_cast<std::uint32_t>(repeats ? static_cast<vtkIdType>(m_Points.size()) : corners[k]);
      if (repeats)
      {
        addPoint(corners[k], cell);
      }
    }
    m_Triangles.push_back(triangle);
  }
  points = ViewOf(m_Points);
  normals = ViewOf(m_Normals);
  colours = ViewOf(m_Colours);
  texturePositions = ViewOf(m_TexturePositions);
  triangles = ViewOf(m_Triangles);
}

void
ActorTriangles::KeepTrianglesWithPoints()
{
  constexpr float largest = std::numeric_limits<float>::max();
  box = { { largest, largest, largest }, { -largest, -largest, -largest } };
  bool allAreFinite = true;
  for (const PointOfActor & point : points)
  {
    if (IsFinite(point))
    {
      box.Add(point);
    }
    else
    {
      allAreFinite = false;
    }
  }
  const auto hasPoints = [&](const TriangleOfActor & triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t point) {
      return point < points.size && (allAreFinite || IsFinite(points[point]));
    });
  };
  std::uint32_t last = 0;
  for (const TriangleOfActor & triangle : triangles)
  {
    last = std::max({ last, triangle[0], triangle[1], triangle[2] });
  }
  if (!allAreFinite || last >= points.size)
  {
    std::vector<TriangleOfActor> kept;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(kept), hasPoints);
    m_Triangles = std::move(kept);
    triangles = ViewOf(m_Triangles);
  }
}

bool
ActorTriangles::AreClosed() const
{
  // The hashes of the edges that run from the smaller to the larger index, less those of the others.
  std::uint64_t sum = 0;
  double volume = 0.0;
  for (const TriangleOfActor & triangle : triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint64_t from = triangle[k];
      const std::uint64_t to = triangle[(k + 1) % 3];
      sum += from < to ? Mix(from << 32 | to) : -Mix(to << 32 | from);
    }
    const auto corner = [&](std::size_t k) {
      const PointOfActor & point = points[triangle[k]];
      return Vector3{ point[0], point[1], point[2] };
    };
    volume += Dot(corner(0), Cross(corner(1), corner(2)));
  }
  return sum == 0 && volume > 0.0;
}

double
ActorTriangles::MeanEdge() const
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < triangles.size; n += OneTriangleIn)
  {
    for (std::size_t k = 0; k < 3; ++k, ++count)
    {
      const PointOfActor & from = points[triangles[n][k]];
      const PointOfActor & to = points[triangles[n][(k + 1) % 3]];
      sum += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

vtkActor *
CanDraw(vtkProp * prop)
{
  auto * const actor = vtkActor::SafeDownCast(prop);
  if (!actor || actor->GetClassName() != std::string("vtkOpenGLActor") || !actor->GetMapper() ||
      actor->GetMapper()->GetClassName() != std::string("vtkOpenGLPolyDataMapper"))
  {
    return nullptr;
  }
  auto * const mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  if (mapper->GetNumberOfInputConnections(0) == 0)
  {
    return nullptr;
  }
  if (!mapper->GetStatic())
  {
    mapper->GetInputAlgorithm()->Update();
  }
  vtkPolyData * const input = mapper->GetInput();
  const bool isOfPolygons = input && input->GetPoints() && input->GetNumberOfVerts() == 0 &&
                            input->GetNumberOfLines() == 0 &&
                            input->GetNumberOfPolys() + input->GetNumberOfStrips() > 0;
  vtkPlaneCollection * const cuts = mapper->GetClippingPlanes();
  const bool isCutLittle = !cuts || cuts->GetNumberOfItems() <= MostClipPlanes;
  const bool hasNoTexture = !actor->GetTexture() || (PictureOf(actor) && actor->HasTranslucentPolygonalGeometry());
  return isOfPolygons && isCutLittle && hasNoTexture && IsPlainSurface(actor) && HasPlainColours(mapper) &&
             CanBeInverted(actor->GetMatrix())
           ? actor
           : nullptr;
}

vtkImageData *
PictureOf(vtkActor * actor)
{
  vtkTexture * const texture = actor->GetTexture();
  if (!texture || actor->GetProperty()->GetLighting() || texture->GetCubeMap())
  {
    return nullptr;
  }
  if (vtkAlgorithm * const source = texture->GetInputAlgorithm())
  {
    source->Update();
  }
  vtkImageData * const picture = texture->GetInput();
  const bool isOfBytes = picture && picture->GetScalarType() == VTK_UNSIGNED_CHAR && picture->GetDataDimension() == 2 &&
                         (picture->GetNumberOfScalarComponents() == 3 || picture->GetNumberOfScalarComponents() == 4);
  return isOfBytes ? picture : nullptr;
}

} // namespace rhombic
