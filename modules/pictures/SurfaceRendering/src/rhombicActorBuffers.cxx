#include "rhombicActorBuffers.h"

#include "vtkRhombicOpaquePass.h"

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkType.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <vtk_glew.h>

namespace rhombic
{
namespace
{

/** Numbers of actors in a byte, from 1; 0 is the background. */
float
NumberInAByte(std::size_t number)
{
  return static_cast<float>(1 + number % 255) / 255.0f;
}

std::array<float, 3>
Strong(const double * colour, double strength)
{
  return { static_cast<float>(strength * colour[0]),
           static_cast<float>(strength * colour[1]),
           static_cast<float>(strength * colour[2]) };
}

/** Clip planes for points relative to the camera's focal point: negative where the actor is removed. */
std::vector<float>
EquationsOf(vtkPlaneCollection * planes, const CameraMatrices::Matrix & worldFromCentred)
{
  std::vector<float> equations;
  for (int n = 0; planes && n < planes->GetNumberOfItems(); ++n)
  {
    vtkPlane * const plane = planes->GetItem(n);
    const double * const normal = plane->GetNormal();
    const double * const origin = plane->GetOrigin();
    const std::array<double, 4> world{
      normal[0], normal[1], normal[2], -(normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2])
    };
    for (std::size_t column = 0; column < 4; ++column)
    {
      double sum = 0.0;
      for (std::size_t row = 0; row < 4; ++row)
      {
        sum += world[row] * worldFromCentred[4 * row + column];
      }
      equations.push_back(static_cast<float>(sum));
    }
  }
  return equations;
}

vtkSmartPointer<vtkTextureObject>
UploadPicture(vtkImageData * picture, vtkOpenGLRenderWindow * window)
{
  const int * const size = picture->GetDimensions();
  const auto pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  const auto channels = static_cast<std::size_t>(picture->GetNumberOfScalarComponents());
  const auto * const bytes = static_cast<const std::uint8_t *>(picture->GetScalarPointer());
  std::vector<std::uint8_t> texels(4 * pixels, 255);
  for (std::size_t n = 0; n < pixels; ++n)
  {
    std::copy_n(bytes + channels * n, channels, texels.begin() + static_cast<std::ptrdiff_t>(4 * n));
  }
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->Create2DFromRaw(
    static_cast<unsigned int>(size[0]), static_cast<unsigned int>(size[1]), 4, VTK_UNSIGNED_CHAR, texels.data());
  return texture;
}

template <typename TValues>
vtkSmartPointer<vtkOpenGLBufferObject>
UploadValues(const TValues & values, std::size_t size, vtkOpenGLBufferObject::ObjectType type)
{
  auto buffer = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  buffer->Upload(values, size, type);
  return buffer;
}

bool
IsColouredByScalars(vtkActor * actor)
{
  vtkMapper * const mapper = actor->GetMapper();
  int ofCells = 0;
  return mapper->GetScalarVisibility() && vtkMapper::GetAbstractScalars(mapper->GetInput(),
                                                                        mapper->GetScalarMode(),
                                                                        mapper->GetArrayAccessMode(),
                                                                        mapper->GetArrayId(),
                                                                        mapper->GetArrayName(),
                                                                        ofCells) != nullptr;
}

/** The box around the corners of a transformed box. */
itk::PointBox
BoxInWorld(const itk::PointBox & box, const CameraMatrices::Matrix & worldFromModel)
{
  constexpr float largest = std::numeric_limits<float>::max();
  itk::PointBox around{ { largest, largest, largest }, { -largest, -largest, -largest } };
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    std::array<double, 4> point{ 0.0, 0.0, 0.0, 1.0 };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] = (corner >> axis & 1U) != 0 ? box.highest[axis] : box.lowest[axis];
    }
    vtkMatrix4x4::MultiplyPoint(worldFromModel.data(), point.data(), point.data());
    around.Add(
      PointOfActor{ static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
  }
  return around;
}

} // namespace

ActorBuffers::Source::Source(vtkActor * actor)
  : mapper(actor->GetMapper())
  , inputTime(mapper->GetInput()->GetMTime())
  , coloursTime(IsColouredByScalars(actor) ? mapper->GetMTime() : 0)
  , isFlat(actor->GetProperty()->GetInterpolation() == VTK_FLAT)
  , isTranslucent(actor->HasTranslucentPolygonalGeometry() != 0)
{
  if (vtkImageData * const picture = PictureOf(actor))
  {
    pictureTime = picture->GetMTime();
  }
}

bool
ActorBuffers::Source::operator==(const Source & other) const
{
  return mapper == other.mapper && inputTime == other.inputTime && coloursTime == other.coloursTime &&
         pictureTime == other.pictureTime && isFlat == other.isFlat && isTranslucent == other.isTranslucent;
}

ActorBuffers::Buffers &
ActorBuffers::Upload(vtkActor * actor)
{
  Buffers & buffers = m_Buffers[actor];
  buffers.isUsed = true;
  const Source source(actor);
  if (buffers.source == source)
  {
    return buffers;
  }
  const ActorTriangles triangles(actor, source.coloursTime > 0, source.isFlat);
  TriangleCells ordered = SortIntoCells(triangles);
  buffers = {};
  buffers.isUsed = true;
  const auto upload = [](const auto & values) {
    return values.size > 0 ? UploadValues(values.data, values.size, vtkOpenGLBufferObject::ArrayBuffer) : nullptr;
  };
  buffers.points = upload(triangles.points);
  buffers.normals = upload(triangles.normals);
  buffers.colours = upload(triangles.colours);
  buffers.places = upload(triangles.texturePositions);
  buffers.indices =
    UploadValues(ordered.triangles.data(), ordered.triangles.size(), vtkOpenGLBufferObject::ElementArrayBuffer);
  buffers.cells = std::move(ordered.cells);
  buffers.origin = triangles.origin;
  buffers.box = triangles.box;
  buffers.areClosed = !source.isTranslucent && triangles.AreClosed();
  buffers.meanEdge = triangles.MeanEdge();
  buffers.triangles = static_cast<double>(triangles.triangles.size);
  if (vtkImageData * const picture = PictureOf(actor))
  {
    buffers.picture = UploadPicture(picture, m_Window);
  }
  buffers.source = Source(actor); // mapping scalars may have changed the mapper
  return buffers;
}

ActorBuffers::Drawing
ActorBuffers::Describe(vtkActor * actor, Buffers & buffers, std::size_t number, const CameraMatrices & camera) const
{
  vtkPlaneCollection * const planes = actor->GetMapper()->GetClippingPlanes();
  vtkProperty * const property = actor->GetProperty();
  Drawing drawing{ actor, &buffers, { camera, actor->GetMatrix(), buffers.origin }, {}, number, false, false };
  SurfaceProgram & program = drawing.program;
  program.isPicture = buffers.picture != nullptr;
  program.isSmooth = buffers.normals != nullptr && !program.isPicture;
  program.isTranslucent = actor->HasTranslucentPolygonalGeometry() != 0;
  program.hasColours = buffers.colours != nullptr && !program.isPicture;
  program.light = m_Look.light;
  program.cuts = planes ? planes->GetNumberOfItems() : 0;
  // Far walls of a translucent surface would hide detail inside.
  const bool showsNearWallsOnly = program.isTranslucent && !program.isPicture && m_Look.light == SurfaceLight::Own;
  const bool hasHiddenBacks = !program.isTranslucent && program.cuts == 0 && buffers.areClosed;
  const bool showsBacksOnly = property->GetFrontfaceCulling() && !property->GetBackfaceCulling(); // as VTK
  drawing.hidesBacks = !showsBacksOnly && (property->GetBackfaceCulling() || showsNearWallsOnly || hasHiddenBacks);
  drawing.hidesFronts = showsBacksOnly;
  return drawing;
}

void
ActorBuffers::SetActors(const std::vector<vtkActor *> & actors, const CameraMatrices & camera, const ActorLook & look)
{
  m_Look = look;
  m_Window = static_cast<vtkOpenGLRenderWindow *>(look.renderer->GetRenderWindow());
  if (m_LightsOfPrograms != look.lights.declarations)
  {
    m_Programs.clear();
    m_LightsOfPrograms = look.lights.declarations;
  }
  for (auto & [actor, buffers] : m_Buffers)
  {
    buffers.isUsed = false;
  }
  m_Drawings.clear();
  for (vtkActor * const actor : actors)
  {
    Buffers & buffers = Upload(actor);
    if (!buffers.cells.empty())
    {
      m_Drawings.push_back(Describe(actor, buffers, m_Drawings.size(), camera));
    }
  }
  ForgetUnusedActors();
}

void
ActorBuffers::ForgetUnusedActors()
{
  // Actors that are only outside the picture now keep their buffers.
  std::set<vtkProp *> present;
  vtkPropCollection * const props = m_Look.renderer->GetViewProps();
  vtkCollectionSimpleIterator place;
  props->InitTraversal(place);
  while (vtkProp * const prop = props->GetNextProp(place))
  {
    present.insert(prop);
  }
  for (auto entry = m_Buffers.begin(); entry != m_Buffers.end();)
  {
    const bool isKept = entry->second.isUsed || present.count(entry->first) > 0;
    entry = isKept ? std::next(entry) : m_Buffers.erase(entry);
  }
}

int
ActorBuffers::NumberOf(bool translucent) const
{
  return static_cast<int>(std::count_if(m_Drawings.begin(), m_Drawings.end(), [translucent](const Drawing & drawing) {
    return drawing.program.isTranslucent == translucent;
  }));
}

double
ActorBuffers::MeanEdge() const
{
  double sum = 0.0;
  double triangles = 0.0;
  for (const Drawing & drawing : m_Drawings)
  {
    if (!drawing.program.isPicture)
    {
      sum += drawing.buffers->triangles * drawing.buffers->meanEdge * drawing.matrices.scale;
      triangles += drawing.buffers->triangles;
    }
  }
  return triangles > 0.0 ? sum / triangles : 0.0;
}

double
ActorBuffers::MeanSide() const
{
  constexpr float largest = std::numeric_limits<float>::max();
  itk::PointBox around{ { largest, largest, largest }, { -largest, -largest, -largest } };
  for (const Drawing & drawing : m_Drawings)
  {
    if (!drawing.program.isPicture)
    {
      around.Add(BoxInWorld(drawing.buffers->box, drawing.matrices.worldFromModel));
    }
  }
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sum += std::max(static_cast<double>(around.highest[axis]) - static_cast<double>(around.lowest[axis]), 0.0);
  }
  return sum / 3.0;
}

void
ActorBuffers::Release()
{
  m_Drawings.clear();
  m_Buffers.clear();
  m_Programs.clear();
  m_Window = nullptr;
}

vtkShaderProgram *
ActorBuffers::ReadyProgram(const SurfaceProgram & program)
{
  auto & ready = m_Programs[{
    program.isSmooth, program.isTranslucent, program.isPicture, program.hasColours, program.light, program.cuts }];
  vtkOpenGLShaderCache * const cache = m_Window->GetShaderCache();
  if (ready)
  {
    return cache->ReadyShaderProgram(ready);
  }
  ready = cache->ReadyShaderProgram(
    SurfaceVertexShader(program).c_str(), SurfaceFragmentShader(program, m_Look.lights).c_str(), "");
  return ready; // null: VTK has reported an error
}

void
ActorBuffers::SetUniforms(const Drawing & drawing, const FragmentLists * lists, vtkShaderProgram * program) const
{
  const ActorMatrices & matrices = drawing.matrices;
  program->SetUniform3f("centre", matrices.centre.data());
  program->SetUniformMatrix4x4("clipFromCentred", const_cast<float *>(matrices.clipFromCentred.data()));
  program->SetUniformMatrix4x4("viewFromCentred", const_cast<float *>(matrices.viewFromCentred.data()));
  program->SetUniformMatrix3x3("viewFromNormal", const_cast<float *>(matrices.viewFromNormal.data()));
  program->SetUniformf("handedness", matrices.handedness);
  const bool isPicture = drawing.program.isPicture;
  double factor = 0.0;
  double units = 0.0;
  drawing.actor->GetMapper()->GetRelativeCoincidentTopologyPolygonOffsetParameters(factor, units);
  const float backward[2] = { static_cast<float>(vtkRhombicOpaquePass::OffsetUnit * units),
                              static_cast<float>(vtkRhombicOpaquePass::OffsetUnit * factor) };
  program->SetUniform2f("backward", backward);
  if (lists)
  {
    lists->SetUniforms(program);
    program->SetUniformi("actor", static_cast<int>(drawing.number));
  }
  const auto equations = EquationsOf(drawing.actor->GetMapper()->GetClippingPlanes(), matrices.worldFromCentred);
  if (!equations.empty())
  {
    program->SetUniform4fv("cuts", drawing.program.cuts, equations.data());
  }
  vtkProperty * const front = drawing.actor->GetProperty();
  const bool hasBack = drawing.actor->GetBackfaceProperty() && !drawing.program.hasColours; // as VTK
  vtkProperty * const back = hasBack ? drawing.actor->GetBackfaceProperty() : front;
  if (isPicture)
  {
    program->SetUniformi("picture", drawing.buffers->picture->GetTextureUnit());
    program->SetUniformf("opacity", static_cast<float>(front->GetOpacity()));
    return;
  }
  std::vector<float> colours;
  std::vector<float> ambients;
  std::vector<float> diffuses;
  std::vector<float> speculars;
  for (vtkProperty * const property : { front, back })
  {
    const auto add = [](std::vector<float> & values, const std::array<float, 3> & tuple) {
      values.insert(values.end(), tuple.begin(), tuple.end());
    };
    constexpr std::array<double, 3> white{ 1.0, 1.0, 1.0 };
    add(colours, Strong(property->GetDiffuseColor(), 1.0));
    colours.push_back(drawing.program.isTranslucent ? static_cast<float>(property->GetOpacity())
                                                    : NumberInAByte(drawing.number));
    add(ambients,
        Strong(drawing.program.hasColours ? white.data() : property->GetAmbientColor(), property->GetAmbient()));
    add(diffuses, Strong(white.data(), property->GetDiffuse()));
    add(speculars, Strong(property->GetSpecularColor(), property->GetSpecular()));
    speculars.push_back(static_cast<float>(property->GetSpecularPower()));
  }
  program->SetUniform4fv("colours", 2, colours.data());
  if (m_Look.light == SurfaceLight::Renderer)
  {
    program->SetUniform3fv("ambients", 2, ambients.data());
    program->SetUniform3fv("diffuses", 2, diffuses.data());
    program->SetUniform4fv("speculars", 2, speculars.data());
    program->SetUniformi("ambientIsMapped", drawing.program.hasColours);
    program->SetUniformi("isLit", front->GetLighting() && m_Look.lights.complexity > 0);
    m_Look.renderer->UpdateLightingUniforms(program);
    return;
  }
  const auto gloss = static_cast<float>(std::clamp(front->GetSpecular(), 0.0, 1.0));
  std::array<float, 2> shine = m_Look.own.matteShine;
  for (std::size_t n = 0; n < 2; ++n)
  {
    shine[n] += gloss * (m_Look.own.glossyShine[n] - shine[n]);
  }
  program->SetUniform4f("light", m_Look.own.strengths.data());
  program->SetUniform2f("shine", shine.data());
}

void
ActorBuffers::DrawCells(const Drawing & drawing, const PicturePart & part)
{
  // Mesa's software keeps triangles in memory until a thread draws them, some 60 bytes for each: on a busy machine
  // those of a whole scene.
  constexpr GLsizei mostWaiting = 3 << 19;
  // The nearest first, so that fewer samples are computed that others hide later.
  std::array<std::vector<const TriangleCell *>, 64> slabs;
  for (const TriangleCell & cell : drawing.buffers->cells)
  {
    const itk::PointBox footprint = FootprintOf(cell.box, drawing.matrices);
    if (part.Meets(footprint))
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
      if (m_Waiting > mostWaiting)
      {
        DrawRanges(firsts, counts);
        glFinish();
        m_Waiting = 0;
      }
      if (counts.empty() || cell->firstTriangle != end)
      {
        counts.push_back(0);
        firsts.push_back(reinterpret_cast<const void *>(12 * cell->firstTriangle)); // OpenGL takes offsets as pointers
      }
      counts.back() += static_cast<GLsizei>(3 * cell->numberOfTriangles);
      m_Waiting += static_cast<GLsizei>(3 * cell->numberOfTriangles);
      end = cell->firstTriangle + cell->numberOfTriangles;
    }
  }
  DrawRanges(firsts, counts);
}

void
ActorBuffers::DrawRanges(std::vector<const void *> & firsts, std::vector<int> & counts)
{
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(), static_cast<GLsizei>(counts.size()));
  firsts.clear();
  counts.clear();
}

void
ActorBuffers::BindArrays(const Drawing & drawing, vtkShaderProgram * program)
{
  Buffers & buffers = *drawing.buffers;
  if (buffers.program != program)
  {
    buffers.program = program;
    buffers.arrays = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
    buffers.arrays->Bind();
    buffers.arrays->AddAttributeArray(program, buffers.points, "point", 0, 12, VTK_FLOAT, 3, false);
    if (drawing.program.isSmooth)
    {
      buffers.arrays->AddAttributeArray(program, buffers.normals, "normal", 0, 12, VTK_FLOAT, 3, false);
    }
    if (drawing.program.hasColours)
    {
      buffers.arrays->AddAttributeArray(program, buffers.colours, "pointColour", 0, 4, VTK_UNSIGNED_CHAR, 4, true);
    }
    if (drawing.program.isPicture)
    {
      buffers.arrays->AddAttributeArray(program, buffers.places, "place", 0, 8, VTK_FLOAT, 2, false);
    }
  }
  buffers.arrays->Bind();
}

void
ActorBuffers::Draw(const Drawing & drawing, const FragmentLists * lists, const PicturePart & part)
{
  vtkShaderProgram * const program = ReadyProgram(drawing.program);
  if (!program)
  {
    return;
  }
  const Buffers & buffers = *drawing.buffers;
  if (buffers.picture)
  {
    buffers.picture->Activate();
  }
  SetUniforms(drawing, lists, program);
  vtkOpenGLState * const state = m_Window->GetState();
  state->SetEnumState(GL_CULL_FACE, drawing.hidesBacks || drawing.hidesFronts);
  state->vtkglCullFace(drawing.hidesBacks ? GL_BACK : GL_FRONT);
  glFrontFace(drawing.matrices.isMirrored ? GL_CW : GL_CCW);
  const auto setCuts = [&drawing](auto && function) {
    for (int n = 0; n < drawing.program.cuts; ++n)
    {
      function(GL_CLIP_DISTANCE0 + static_cast<GLenum>(n));
    }
  };
  setCuts(glEnable);
  BindArrays(drawing, program);
  buffers.indices->Bind();
  DrawCells(drawing, part);
  buffers.indices->Release();
  buffers.arrays->Release();
  setCuts(glDisable);
  glFrontFace(GL_CCW);
  if (buffers.picture)
  {
    buffers.picture->Deactivate();
  }
}

void
ActorBuffers::DrawOpaque()
{
  for (const Drawing & drawing : m_Drawings)
  {
    if (!drawing.program.isTranslucent)
    {
      Draw(drawing, nullptr, {});
    }
  }
}

void
ActorBuffers::DrawTranslucent(const FragmentLists & lists, const PicturePart & part)
{
  for (const Drawing & drawing : m_Drawings)
  {
    if (drawing.program.isTranslucent)
    {
      Draw(drawing, &lists, part);
    }
  }
}

} // namespace rhombic
