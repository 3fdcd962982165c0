#include "rhombicViewPasses.h"

#include "rhombicSceneCheck.h"

#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rhombic
{
namespace
{

constexpr double Reach = 0.06;           // of the mean side of the box around the surfaces
constexpr double Detail = 0.6;           // of the triangles' mean edge
constexpr double MostDetail = 0.25;      // of the reach
constexpr std::size_t OneTriangleIn = 8; // is measured

double
MeanEdge(const Scene & scene)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const SceneSurface & item : scene.surfaces)
  {
    const auto & points = item.surface->GetPoints();
    const auto & triangles = item.surface->GetTriangles();
    for (std::size_t n = 0; n < triangles.size(); n += OneTriangleIn)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto & from = points[triangles[n][k]];
        const auto & to = points[triangles[n][(k + 1) % 3]];
        sum += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        ++count;
      }
    }
  }
  return sum / static_cast<double>(count);
}

// Lengths as shares of the mean side of the picture.
constexpr double OutlineJump = 0.006;
constexpr double PixelsPerOutlineWidth = 1000.0; // of the picture's shorter side

constexpr int PairsOfOneSize = 6; // of points, in each of two balls
constexpr double SmallBall = 0.25;
constexpr int MostLayers = 16;

/** Points in the unit disc along a spiral, for a large and a small ball. */
std::vector<float>
OcclusionPairs()
{
  constexpr double goldenAngle = 2.39996;
  std::vector<float> pairs;
  for (int n = 0; n < 2 * PairsOfOneSize; ++n)
  {
    const double radius = std::sqrt((n / 2 + 0.5) / PairsOfOneSize) * 0.95;
    const double angle = n * goldenAngle;
    for (const double value : { radius * std::cos(angle),
                                radius * std::sin(angle),
                                std::sqrt(1.0 - radius * radius),
                                n % 2 == 0 ? 1.0 : SmallBall })
    {
      pairs.push_back(static_cast<float>(value));
    }
  }
  return pairs;
}

float
MeanSideInMillimetres(const Camera & camera)
{
  return static_cast<float>(0.5 * (camera.width + camera.height) * camera.pixelSize);
}

vtkSmartPointer<vtkTextureObject>
MakeTexture(vtkOpenGLRenderWindow * window)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  return texture;
}

vtkSmartPointer<vtkTextureObject>
MakeColours(int width, int height, int components, int type, unsigned int format, vtkOpenGLRenderWindow * window)
{
  auto texture = MakeTexture(window);
  texture->SetInternalFormat(format);
  texture->Allocate2D(static_cast<unsigned int>(width), static_cast<unsigned int>(height), components, type);
  return texture;
}

vtkSmartPointer<vtkTextureObject>
MakeDepths(int width, int height, vtkOpenGLRenderWindow * window)
{
  auto texture = MakeTexture(window);
  texture->AllocateDepth(
    static_cast<unsigned int>(width), static_cast<unsigned int>(height), vtkTextureObject::Float32);
  return texture;
}

int
TilesAlong(int samples)
{
  return (samples + OpenTiles::Side - 1) / OpenTiles::Side;
}

} // namespace

OcclusionLengths
FindOcclusionLengths(const Scene & scene)
{
  if (scene.surfaces.empty())
  {
    return {};
  }
  const LPSBox box = BoxAround(scene.surfaces);
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach += Reach / 3.0 * (box.highest[axis] - box.lowest[axis]);
  }
  return { static_cast<float>(reach), static_cast<float>(std::min(Detail * MeanEdge(scene), MostDetail * reach)) };
}

ViewPasses::ViewPasses(const Scene & scene, const RenderSettings & settings, vtkOpenGLRenderWindow * window)
  : m_Settings(settings)
  , m_IsTranslucent(IsTranslucent(scene))
  , m_Lengths(FindOcclusionLengths(scene))
  , m_Window(window)
  , m_Framebuffer(vtkSmartPointer<vtkOpenGLFramebufferObject>::New())
  , m_NoArrays(vtkSmartPointer<vtkOpenGLVertexArrayObject>::New())
{
  m_Framebuffer->SetContext(window);
}

Picture
ViewPasses::Draw(SceneBuffers & scene, const Camera & camera)
{
  Allocate(camera);
  m_Framebuffer->Bind();
  DrawOpaque(scene, camera);
  if (HasShades())
  {
    DrawRelief(camera);
    DrawShades(camera);
  }
  if (m_IsTranslucent)
  {
    DrawLayers(scene, camera);
  }
  DrawPixels();
  Picture picture = ReadPixels();
  m_Framebuffer->UnBind();
  return picture;
}

bool
ViewPasses::HasShades() const
{
  return m_Settings.ambientOcclusion || m_Settings.silhouettes;
}

void
ViewPasses::Allocate(const Camera & camera)
{
  if (camera.width == m_Width && camera.height == m_Height)
  {
    return;
  }
  m_Width = camera.width;
  m_Height = camera.height;
  const int columns = m_Width * m_Settings.samples;
  const int rows = m_Height * m_Settings.samples;
  m_Colours = MakeColours(columns, rows, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  m_Depths = MakeDepths(columns, rows, m_Window);
  if (m_IsTranslucent)
  {
    m_Layer = MakeColours(columns, rows, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
    m_LayerDepths = MakeDepths(columns, rows, m_Window);
    m_DepthsBefore = MakeDepths(columns, rows, m_Window);
    m_Layers = MakeColours(columns, rows, 4, VTK_FLOAT, GL_RGBA16F, m_Window);
    m_Tiles = MakeColours(TilesAlong(columns), TilesAlong(rows), 1, VTK_FLOAT, GL_R32F, m_Window);
    m_TilesBefore = MakeColours(TilesAlong(columns), TilesAlong(rows), 1, VTK_FLOAT, GL_R32F, m_Window);
  }
  if (HasShades())
  {
    m_Relief = MakeColours(m_Width, m_Height, 2, VTK_FLOAT, GL_RG32F, m_Window);
    m_Shades = MakeColours(m_Width, m_Height, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  }
  m_Pixels = MakeColours(m_Width, m_Height, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
}

void
ViewPasses::SetTarget(vtkTextureObject * colour, vtkTextureObject * depth)
{
  m_Framebuffer->AddColorAttachment(0, colour);
  m_Framebuffer->RemoveDepthAttachment();
  if (depth)
  {
    m_Framebuffer->AddDepthAttachment(depth);
  }
  m_Framebuffer->ActivateDrawBuffer(0);
  const auto width = static_cast<int>(colour->GetWidth());
  const auto height = static_cast<int>(colour->GetHeight());
  vtkOpenGLState * const state = m_Window->GetState();
  state->vtkglViewport(0, 0, width, height);
  state->SetEnumState(GL_DEPTH_TEST, depth != nullptr);
  state->SetEnumState(GL_BLEND, false);
  state->SetEnumState(GL_CULL_FACE, false);
  state->SetEnumState(GL_SCISSOR_TEST, false);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
}

template <typename TSetUniforms>
void
ViewPasses::Run(const std::string & fragmentShader, const std::vector<Input> & inputs, const TSetUniforms & setUniforms)
{
  vtkShaderProgram * const program =
    m_Window->GetShaderCache()->ReadyShaderProgram(VertexShader(WholeTargetVertex).c_str(), fragmentShader.c_str(), "");
  if (!program)
  {
    return; // VTK has reported an error
  }
  setUniforms(program);
  RunProgram(program, inputs, 3);
}

void
ViewPasses::RunInOpenTiles(const std::string & fragmentShader, const Input & input)
{
  vtkShaderProgram * const program =
    m_Window->GetShaderCache()->ReadyShaderProgram(VertexShader(OpenTilesVertex).c_str(), fragmentShader.c_str(), "");
  if (!program)
  {
    return; // VTK has reported an error
  }
  const std::array<int, 2> size{ m_Width * m_Settings.samples, m_Height * m_Settings.samples };
  program->SetUniform2i("size", size.data());
  const auto tiles = m_TilesBefore->GetWidth() * m_TilesBefore->GetHeight();
  RunProgram(program, { input, { "tiles", m_TilesBefore } }, static_cast<int>(6 * tiles));
}

void
ViewPasses::RunProgram(vtkShaderProgram * program, const std::vector<Input> & inputs, int vertices)
{
  for (const Input & input : inputs)
  {
    input.texture->Activate();
    program->SetUniformi(input.name, input.texture->GetTextureUnit());
  }
  m_NoArrays->Bind();
  glDrawArrays(GL_TRIANGLES, 0, vertices);
  m_NoArrays->Release();
  for (const Input & input : inputs)
  {
    input.texture->Deactivate();
  }
}

void
ViewPasses::DrawOpaque(SceneBuffers & scene, const Camera & camera)
{
  SetTarget(m_Colours, m_Depths);
  m_Window->GetState()->vtkglClearDepth(1.0);
  m_Window->GetState()->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  scene.DrawOpaque(camera);
}

void
ViewPasses::DrawRelief(const Camera & camera)
{
  SetTarget(m_Relief);
  const std::array<float, 3> depthRule{ static_cast<float>(camera.DepthOffset()),
                                        static_cast<float>(camera.DepthFactor()),
                                        static_cast<float>(camera.spread) };
  Run(FragmentShader(ReliefFragment, { { "SAMPLES", m_Settings.samples } }),
      { { "depths", m_Depths }, { "colours", m_Colours } },
      [&](vtkShaderProgram * program) { program->SetUniform3f("depthRule", depthRule.data()); });
}

void
ViewPasses::DrawShades(const Camera & camera)
{
  SetTarget(m_Shades);
  const float side = MeanSideInMillimetres(camera);
  const std::array<float, 2> pixelRule{ static_cast<float>(camera.pixelSize), static_cast<float>(camera.spread) };
  const double line = std::round(std::min(m_Width, m_Height) / PixelsPerOutlineWidth);
  const auto pairs = OcclusionPairs();
  const int numberOfPairs = 2 * PairsOfOneSize;
  const ShaderDefines defines{ { "OCCLUSION", m_Settings.ambientOcclusion },
                               { "OUTLINES", m_Settings.silhouettes },
                               { "PAIRS", numberOfPairs } };
  Run(FragmentShader(ShadeFragment, defines), { { "relief", m_Relief } }, [&](vtkShaderProgram * program) {
    program->SetUniform2f("pixelRule", pixelRule.data());
    program->SetUniformf("reach", m_Lengths.reach);
    program->SetUniformf("detail", m_Lengths.detail);
    program->SetUniformf("jump", std::max(static_cast<float>(OutlineJump) * side, 2.0f * m_Lengths.detail));
    program->SetUniformi("line", std::max(static_cast<int>(line), 1));
    program->SetUniform4fv("pairs", numberOfPairs, pairs.data());
  });
}

void
ViewPasses::DrawLayers(SceneBuffers & scene, const Camera & camera)
{
  vtkOpenGLState * const state = m_Window->GetState();
  SetTarget(m_Layers, m_DepthsBefore);
  state->vtkglClearDepth(0.0); // everything is behind
  state->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  SetTarget(m_TilesBefore); // all are open
  state->vtkglClear(GL_COLOR_BUFFER_BIT);
  OpenTiles open;
  for (int layer = 0; layer < MostLayers && !open.AllAreClosed(); ++layer)
  {
    SetTarget(m_Layer, m_LayerDepths);
    state->vtkglDepthFunc(GL_ALWAYS);
    RunInOpenTiles(FragmentShader(NoLayerFragment), { "depths", m_Depths });
    state->vtkglDepthFunc(GL_LESS);
    m_DepthsBefore->Activate();
    scene.DrawTranslucent(camera, m_DepthsBefore, open);
    m_DepthsBefore->Deactivate();
    SetTarget(m_Layers);
    state->SetEnumState(GL_BLEND, true);
    state->vtkglBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    RunInOpenTiles(FragmentShader(LayerFragment), { "layer", m_Layer });
    open = FindOpenTiles();
    std::swap(m_LayerDepths, m_DepthsBefore);
    std::swap(m_Tiles, m_TilesBefore);
  }
}

OpenTiles
ViewPasses::FindOpenTiles()
{
  SetTarget(m_Tiles);
  Run(FragmentShader(OpenTileFragment),
      { { "depths", m_Depths }, { "layerDepths", m_LayerDepths }, { "tiles", m_TilesBefore } },
      [](vtkShaderProgram *) {});
  OpenTiles open;
  open.columns = static_cast<int>(m_Tiles->GetWidth());
  open.rows = static_cast<int>(m_Tiles->GetHeight());
  open.width = static_cast<double>(m_Width) * m_Settings.samples / OpenTiles::Side;
  open.height = static_cast<double>(m_Height) * m_Settings.samples / OpenTiles::Side;
  open.depths.resize(static_cast<std::size_t>(open.columns) * static_cast<std::size_t>(open.rows));
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, open.columns, open.rows, GL_RED, GL_FLOAT, open.depths.data());
  return open;
}

void
ViewPasses::DrawPixels()
{
  SetTarget(m_Pixels);
  std::vector<Input> inputs{ { "colours", m_Colours } };
  if (HasShades())
  {
    inputs.push_back({ "relief", m_Relief });
    inputs.push_back({ "shades", m_Shades });
  }
  if (m_IsTranslucent)
  {
    inputs.push_back({ "layers", m_Layers });
  }
  const Colour colour = BackgroundOf(m_Settings);
  std::array<float, 4> background{};
  if (m_Settings.style != PictureStyle::Transparent)
  {
    background = { static_cast<float>(colour[0]), static_cast<float>(colour[1]), static_cast<float>(colour[2]), 1.0f };
  }
  const bool isPaper = m_Settings.style != PictureStyle::Clinic;
  const ShaderDefines defines{ { "SAMPLES", m_Settings.samples },
                               { "RELIEF", HasShades() },
                               { "LAYERS", m_IsTranslucent } };
  const std::array<float, 2> strengths{ isPaper ? 1.0f : 1.3f, isPaper ? 0.8f : 0.7f };
  Run(FragmentShader(PixelFragment, defines), inputs, [&](vtkShaderProgram * program) {
    program->SetUniform4f("background", background.data());
    if (HasShades())
    {
      program->SetUniformf("alike", 0.1f * m_Lengths.reach);
      program->SetUniform2f("strengths", strengths.data());
    }
  });
}

Picture
ViewPasses::ReadPixels() const
{
  const bool hasAlpha = m_Settings.style == PictureStyle::Transparent;
  Picture picture(m_Width, m_Height, hasAlpha ? 4 : 3);
  const std::size_t rowBytes = static_cast<std::size_t>(m_Width) * static_cast<std::size_t>(picture.channels);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, m_Width, m_Height, hasAlpha ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
  auto * const first = picture.pixels.data();
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(m_Height) - 1; top < bottom; ++top, --bottom)
  {
    std::swap_ranges(first + top * rowBytes, first + (top + 1) * rowBytes, first + bottom * rowBytes);
  }
  return picture;
}

} // namespace rhombic
