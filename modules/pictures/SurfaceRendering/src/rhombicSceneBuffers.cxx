#include "rhombicSceneBuffers.h"

#include "detail/itkPositionArithmetic.h"

#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkType.h>

#include <algorithm>
#include <cmath>

#include <vtk_glew.h>

namespace rhombic
{
namespace
{

/** In OpenGL's depths, -1 to 1: some times the rounding errors of 32 bits, less than 0.001 mm in 500 mm. */
constexpr float BackwardStep = 2e-6f;

/** Numbers of surfaces in a byte, from 1; 0 is the background. */
float
NumberInAByte(std::size_t number)
{
  return static_cast<float>(1 + number % 255) / 255.0f;
}

/** Spreads the bits of a number (the finalizer of D. Stafford's variant 13 of MurmurHash3). */
std::uint64_t
Mix(std::uint64_t value)
{
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

std::array<float, 3>
FloatsOf(const Vector3 & vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2]) };
}

/** A clip plane's equation for points relative to the camera's centre: negative where the scene is removed. */
std::array<float, 4>
EquationOf(const ClipPlane & cut, const Vector3 & centre)
{
  const double length = Length(cut.normal);
  double offset = 0.0;
  std::array<float, 4> equation{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    equation[axis] = static_cast<float>(-cut.normal[axis] / length);
    offset += cut.normal[axis] / length * (cut.point[axis] - centre[axis]);
  }
  equation[3] = static_cast<float>(offset);
  return equation;
}

/** Rows right, up and towards the viewer; column by column. */
std::array<float, 9>
ViewFromPatient(const ViewFrame & frame)
{
  std::array<float, 9> matrix{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    matrix[3 * axis] = static_cast<float>(frame.right[axis]);
    matrix[3 * axis + 1] = static_cast<float>(frame.up[axis]);
    matrix[3 * axis + 2] = static_cast<float>(-frame.look[axis]);
  }
  return matrix;
}

vtkSmartPointer<vtkTextureObject>
UploadPicture(const Picture & picture, vtkOpenGLRenderWindow * window)
{
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t first = 0; first < picture.pixels.size(); first += channels)
  {
    pixels.insert(pixels.end(), &picture.pixels[first], &picture.pixels[first] + 3);
    pixels.push_back(channels == 4 ? picture.pixels[first + 3] : 255);
  }
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->Create2DFromRaw(static_cast<unsigned int>(picture.width),
                           static_cast<unsigned int>(picture.height),
                           4,
                           VTK_UNSIGNED_CHAR,
                           pixels.data());
  return texture;
}

} // namespace

bool
IsClosed(const itk::TriangleSurface * surface)
{
  // The hashes of the edges that run from the smaller to the larger index, less those of the others.
  std::uint64_t sum = 0;
  double volume = 0.0;
  for (const auto & triangle : surface->GetTriangles())
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint64_t from = triangle[k];
      const std::uint64_t to = triangle[(k + 1) % 3];
      sum += from < to ? Mix(from << 32 | to) : -Mix(to << 32 | from);
    }
    const auto [a, b, c] = itk::CornersOf(*surface, triangle);
    volume += Dot(a, Cross(b, c));
  }
  return sum == 0 && volume > 0.0;
}

SceneBuffers::SceneBuffers(const Scene & scene, const RenderSettings & settings, vtkOpenGLRenderWindow * window)
  : m_Window(window)
{
  const bool isPaper = settings.style != PictureStyle::Clinic;
  m_Light = isPaper ? std::array<float, 4>{ 0.48f, 0.24f, 0.39f, -0.06f } : std::array{ 0.68f, 0.24f, 0.20f, 0.16f };
  m_MatteShine = isPaper ? std::array<float, 2>{ 0.03f, 0.0f } : std::array{ 0.07f, 0.0f };
  m_GlossyShine = isPaper ? std::array<float, 2>{ 0.10f, 0.28f } : std::array{ 0.14f, 0.40f };
  for (std::size_t number = 0; number < scene.surfaces.size(); ++number)
  {
    AddSurface(scene.surfaces[number], number, scene.cuts);
  }
  for (const ScenePlane & plane : scene.planes)
  {
    AddPlane(plane);
  }
}

void
SceneBuffers::AddSurface(const SceneSurface & item, std::size_t number, const std::vector<ClipPlane> & cuts)
{
  Batch batch;
  for (const ClipPlane & cut : cuts)
  {
    if (cut.surfaces.empty() || std::find(cut.surfaces.begin(), cut.surfaces.end(), item.name) != cut.surfaces.end())
    {
      batch.cuts.push_back(cut);
    }
  }
  const bool isTranslucent = item.opacity < 1.0;
  batch.program = { item.surface->HasNormals(), isTranslucent, false, static_cast<int>(batch.cuts.size()) };
  const auto colour = FloatsOf(item.colour);
  batch.colour = {
    colour[0], colour[1], colour[2], isTranslucent ? static_cast<float>(item.opacity) : NumberInAByte(number)
  };
  batch.backward = BackwardStep * static_cast<float>(std::min<std::size_t>(number, 100));
  batch.shine = item.isGlossy ? m_GlossyShine : m_MatteShine;
  // Far walls of a translucent surface would hide detail inside.
  batch.hidesBacks = isTranslucent || (batch.cuts.empty() && IsClosed(item.surface));
  Upload(item.surface, batch);
  (isTranslucent ? m_Translucent : m_Opaque).push_back(std::move(batch));
}

void
SceneBuffers::AddPlane(const ScenePlane & plane)
{
  const auto width = static_cast<float>(plane.projection.width);
  const auto height = static_cast<float>(plane.projection.height);
  auto rectangle = itk::TriangleSurface::New();
  rectangle->GetNormals() = { { 0, 0, 0 }, { width, 0, 0 }, { width, height, 0 }, { 0, height, 0 } };
  for (const auto & corner : rectangle->GetNormals())
  {
    rectangle->GetPoints().push_back(FloatsOf(plane.projection.PointAt({ corner[0], corner[1] })));
  }
  rectangle->GetTriangles() = { { 0, 1, 2 }, { 0, 2, 3 } };
  Batch batch;
  batch.program = { true, true, true, 0 };
  batch.picture = UploadPicture(plane.picture, m_Window);
  Upload(rectangle, batch);
  m_Translucent.push_back(std::move(batch));
}

void
SceneBuffers::Upload(const itk::TriangleSurface * surface, Batch & batch)
{
  const auto upload = [](const auto & tuples, vtkOpenGLBufferObject::ObjectType type) {
    auto buffer = vtkSmartPointer<vtkOpenGLBufferObject>::New();
    buffer->Upload(tuples.data(), tuples.size(), type);
    return buffer;
  };
  batch.points = upload(surface->GetPoints(), vtkOpenGLBufferObject::ArrayBuffer);
  if (surface->HasNormals())
  {
    batch.normals = upload(surface->GetNormals(), vtkOpenGLBufferObject::ArrayBuffer);
  }
  TriangleCells ordered = SortIntoCells(surface);
  batch.indices = upload(ordered.triangles, vtkOpenGLBufferObject::ElementArrayBuffer);
  batch.cells = std::move(ordered.cells);
}

void
SceneBuffers::SetUniforms(const Batch & batch,
                          const Camera & camera,
                          vtkTextureObject * depthBefore,
                          vtkShaderProgram * program)
{
  program->SetUniform3f("centre", FloatsOf(camera.centre).data());
  program->SetUniformMatrix4x4("clipFromCentred", camera.Matrix().data());
  program->SetUniformf("backward", batch.backward);
  if (depthBefore)
  {
    program->SetUniformi("depthBefore", depthBefore->GetTextureUnit());
  }
  if (batch.picture)
  {
    program->SetUniformi("picture", batch.picture->GetTextureUnit());
    return;
  }
  program->SetUniformMatrix3x3("viewFromPatient", ViewFromPatient(camera.frame).data());
  program->SetUniform4f("colour", batch.colour.data());
  program->SetUniform4f("light", m_Light.data());
  program->SetUniform2f("shine", batch.shine.data());
  std::vector<float> equations;
  for (const ClipPlane & cut : batch.cuts)
  {
    const auto equation = EquationOf(cut, camera.centre);
    equations.insert(equations.end(), equation.begin(), equation.end());
  }
  if (!equations.empty())
  {
    program->SetUniform4fv("cuts", static_cast<int>(batch.cuts.size()), equations.data());
  }
}

void
SceneBuffers::DrawCells(const Batch & batch, const Camera & camera, const OpenTiles & open)
{
  // The nearest first, so that fewer samples are computed that others hide later.
  std::array<std::vector<const TriangleCell *>, 64> slabs;
  for (const TriangleCell & cell : batch.cells)
  {
    const itk::PointBox footprint = FootprintOf(cell.box, camera);
    if (open.MayShow(footprint))
    {
      const auto last = static_cast<float>(slabs.size() - 1);
      slabs[static_cast<std::size_t>(std::clamp(footprint.lowest[2], 0.0f, 1.0f) * last)].push_back(&cell);
    }
  }
  std::vector<GLsizei> counts;
  std::vector<const void *> firsts;
  std::size_t end = 0;
  for (const auto & slab : slabs)
  {
    for (const TriangleCell * cell : slab)
    {
      if (counts.empty() || cell->firstTriangle != end)
      {
        counts.push_back(0);
        firsts.push_back(reinterpret_cast<const void *>(12 * cell->firstTriangle)); // OpenGL takes offsets as pointers
      }
      counts.back() += static_cast<GLsizei>(3 * cell->numberOfTriangles);
      end = cell->firstTriangle + cell->numberOfTriangles;
    }
  }
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(), static_cast<GLsizei>(counts.size()));
}

void
SceneBuffers::Draw(Batch & batch, const Camera & camera, vtkTextureObject * depthBefore, const OpenTiles & open)
{
  vtkShaderProgram * const program = m_Window->GetShaderCache()->ReadyShaderProgram(
    SurfaceVertexShader(batch.program).c_str(), SurfaceFragmentShader(batch.program).c_str(), "");
  if (!program)
  {
    return; // VTK has reported an error
  }
  if (!batch.arrays)
  {
    batch.arrays = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
    batch.arrays->Bind();
    batch.arrays->AddAttributeArray(program, batch.points, "point", 0, 12, VTK_FLOAT, 3, false);
    if (batch.normals)
    {
      batch.arrays->AddAttributeArray(program, batch.normals, "normal", 0, 12, VTK_FLOAT, 3, false);
    }
  }
  if (batch.picture)
  {
    batch.picture->Activate();
  }
  SetUniforms(batch, camera, depthBefore, program);
  vtkOpenGLState * const state = m_Window->GetState();
  state->SetEnumState(GL_CULL_FACE, batch.hidesBacks);
  state->vtkglCullFace(GL_BACK);
  const auto setCuts = [&batch](auto && function) {
    for (int n = 0; n < batch.program.cuts; ++n)
    {
      function(GL_CLIP_DISTANCE0 + static_cast<GLenum>(n));
    }
  };
  setCuts(glEnable);
  batch.arrays->Bind();
  batch.indices->Bind();
  DrawCells(batch, camera, open);
  batch.indices->Release();
  batch.arrays->Release();
  setCuts(glDisable);
  if (batch.picture)
  {
    batch.picture->Deactivate();
  }
}

void
SceneBuffers::DrawOpaque(const Camera & camera)
{
  for (Batch & batch : m_Opaque)
  {
    Draw(batch, camera, nullptr, {});
  }
}

void
SceneBuffers::DrawTranslucent(const Camera & camera, vtkTextureObject * depthBefore, const OpenTiles & open)
{
  for (Batch & batch : m_Translucent)
  {
    Draw(batch, camera, depthBefore, open);
  }
}

} // namespace rhombic
