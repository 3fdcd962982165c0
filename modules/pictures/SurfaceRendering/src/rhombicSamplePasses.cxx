#include "rhombicSamplePasses.h"

#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtk_glew.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rhombic
{
namespace
{

constexpr double Reach = 0.06;      // of the mean side of the box around the surfaces
constexpr double Detail = 0.6;      // of the triangles' mean edge
constexpr double MostDetail = 0.25; // of the reach

// Lengths as shares of the mean side of the picture.
constexpr double OutlineJump = 0.006;
constexpr double PixelsPerOutlineWidth = 1000.0; // of the picture's shorter side

constexpr int PairsOfOneSize = 6; // of points, in each of two balls
constexpr double SmallBall = 0.25;

constexpr std::size_t FragmentsOfSample = 2; // expected where little is known

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

/** Of the part of the scene that is seen, in its unit. */
float
MeanSide(const CameraMatrices & camera)
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

/** \class OwnFramebuffer
 * \brief Draws into textures instead of the current framebuffer during the lifetime of this object. */
class OwnFramebuffer
{
public:
  OwnFramebuffer(vtkOpenGLFramebufferObject * framebuffer, vtkOpenGLState * state)
    : m_State(state)
  {
    m_State->PushFramebufferBindings();
    framebuffer->Bind();
  }
  ~OwnFramebuffer()
  {
    m_State->PopFramebufferBindings();
  }

  OwnFramebuffer(const OwnFramebuffer &) = delete;
  OwnFramebuffer &
  operator=(const OwnFramebuffer &) = delete;

private:
  vtkOpenGLState * m_State;
};

/** \class KeptState
 * \brief OpenGL's state of before is there again after the lifetime of this object. Meanwhile nothing is cut off at the
 * edge of a viewport. */
class KeptState
{
public:
  explicit KeptState(vtkOpenGLState * state)
    : m_Blend(state, GL_BLEND)
    , m_DepthTest(state, GL_DEPTH_TEST)
    , m_Culling(state, GL_CULL_FACE)
    , m_Scissor(state, GL_SCISSOR_TEST)
    , m_Multisample(state, GL_MULTISAMPLE)
    , m_DepthMask(state)
    , m_DepthFunc(state)
    , m_ColourMask(state)
    , m_ClearColour(state)
    , m_Viewport(state)
    , m_ScissorBox(state)
    , m_BlendFunc(state)
  {
    state->SetEnumState(GL_SCISSOR_TEST, false);
    state->SetEnumState(GL_MULTISAMPLE, false);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }

private:
  vtkOpenGLState::ScopedglEnableDisable m_Blend;
  vtkOpenGLState::ScopedglEnableDisable m_DepthTest;
  vtkOpenGLState::ScopedglEnableDisable m_Culling;
  vtkOpenGLState::ScopedglEnableDisable m_Scissor;
  vtkOpenGLState::ScopedglEnableDisable m_Multisample;
  vtkOpenGLState::ScopedglDepthMask m_DepthMask;
  vtkOpenGLState::ScopedglDepthFunc m_DepthFunc;
  vtkOpenGLState::ScopedglColorMask m_ColourMask;
  vtkOpenGLState::ScopedglClearColor m_ClearColour;
  vtkOpenGLState::ScopedglViewport m_Viewport;
  vtkOpenGLState::ScopedglScissor m_ScissorBox;
  vtkOpenGLState::ScopedglBlendFuncSeparate m_BlendFunc;
};

/** The format of the current framebuffer's depths, of which only the same can be copied. */
unsigned int
DepthFormatOfFramebuffer()
{
  const auto ask = [](GLenum what) {
    GLint answer = 0;
    glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, what, &answer);
    return answer;
  };
  const GLint bits = ask(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  const bool hasStencil = bits == 24 && ask(GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
  const bool isFloat = ask(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
  return hasStencil   ? GL_DEPTH24_STENCIL8
         : bits == 16 ? GL_DEPTH_COMPONENT16
         : bits == 24 ? GL_DEPTH_COMPONENT24
         : isFloat    ? GL_DEPTH_COMPONENT32F
                      : GL_DEPTH_COMPONENT32;
}

vtkSmartPointer<vtkTextureObject>
MakeDepthsOfFramebuffer(int width, int height, vtkOpenGLRenderWindow * window)
{
  const unsigned int format = DepthFormatOfFramebuffer();
  auto texture = MakeTexture(window);
  if (format == GL_DEPTH24_STENCIL8)
  {
    texture->AllocateDepthStencil(static_cast<unsigned int>(width), static_cast<unsigned int>(height));
    return texture;
  }
  texture->SetInternalFormat(format);
  texture->AllocateDepth(
    static_cast<unsigned int>(width), static_cast<unsigned int>(height), vtkTextureObject::Float32);
  return texture;
}

std::size_t
SamplesOf(const Viewport & part)
{
  return static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height);
}

/** Equal parts, so many that the lists hold each part's share of a number of fragments. */
std::vector<Viewport>
Split(const Viewport & whole, std::size_t fragments)
{
  const bool isWide = whole.width > whole.height;
  const int side = isWide ? whole.width : whole.height;
  const auto count =
    static_cast<int>(std::min(fragments / FragmentLists::Capacity + 1, static_cast<std::size_t>(side)));
  std::vector<Viewport> parts;
  for (int n = 0, begin = 0, end = 0; n < count; ++n, begin = end)
  {
    end = static_cast<int>(std::int64_t{ side } * (n + 1) / count);
    parts.push_back(isWide ? Viewport{ whole.x + begin, whole.y, end - begin, whole.height }
                           : Viewport{ whole.x, whole.y + begin, whole.width, end - begin });
  }
  return parts;
}

} // namespace

OcclusionLengths
FindOcclusionLengths(const ActorBuffers & actors)
{
  const double reach = Reach * actors.MeanSide();
  return { static_cast<float>(reach), static_cast<float>(std::min(Detail * actors.MeanEdge(), MostDetail * reach)) };
}

void
SamplePasses::DrawOpaque(ActorBuffers & actors,
                         const CameraMatrices & camera,
                         const SampleSettings & settings,
                         const Viewport & viewport,
                         vtkOpenGLRenderWindow * window)
{
  Begin(settings, viewport, window);
  m_Lengths = FindOcclusionLengths(actors);
  const KeptState kept(window->GetState());
  CopyFramebuffer(m_Behind, m_BehindDepths);
  {
    const OwnFramebuffer bound(m_Framebuffer, window->GetState());
    TakeDepths();
    actors.DrawOpaque();
    if (HasShades())
    {
      DrawRelief(camera);
      DrawShades(camera);
    }
  }
  DrawPixels(false, false);
  CopyFramebuffer(nullptr, m_WrittenDepths);
  m_HasOpaque = true;
}

void
SamplePasses::DrawTranslucent(ActorBuffers & actors,
                              const SampleSettings & settings,
                              const Viewport & viewport,
                              vtkOpenGLRenderWindow * window)
{
  const bool hasOpaque = m_HasOpaque && window == m_Window && viewport == m_Viewport;
  Begin(settings, viewport, window);
  AllocateLayers();
  const KeptState kept(window->GetState());
  CopyFramebuffer(hasOpaque ? m_Now : m_Behind, hasOpaque ? m_NowDepths : m_BehindDepths);
  {
    const OwnFramebuffer bound(m_Framebuffer, window->GetState());
    if (hasOpaque)
    {
      TakeChanges();
    }
    else
    {
      TakeDepths();
    }
    DrawLayers(actors);
  }
  DrawPixels(true, hasOpaque);
  m_HasOpaque = false;
}

void
SamplePasses::Release()
{
  *this = SamplePasses();
}

bool
SamplePasses::HasShades() const
{
  return m_Settings.ambientOcclusion || m_Settings.silhouettes;
}

void
SamplePasses::Begin(const SampleSettings & settings, const Viewport & viewport, vtkOpenGLRenderWindow * window)
{
  const bool isAllocated = window == m_Window && viewport == m_Viewport && settings.samples == m_Settings.samples;
  if (!isAllocated)
  {
    Release();
    m_Window = window;
    m_Viewport = viewport;
    m_Settings = settings;
    Allocate();
  }
  m_Settings = settings;
}

void
SamplePasses::Allocate()
{
  m_Framebuffer = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  m_Framebuffer->SetContext(m_Window);
  m_CopyTarget = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
  m_CopyTarget->SetContext(m_Window);
  m_NoArrays = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  const auto & [x, y, width, height] = m_Viewport;
  const int columns = width * m_Settings.samples;
  const int rows = height * m_Settings.samples;
  m_Colours = MakeColours(columns, rows, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  m_Depths = MakeDepths(columns, rows, m_Window);
  m_Relief = MakeColours(width, height, 2, VTK_FLOAT, GL_RG32F, m_Window);
  m_Shades = MakeColours(width, height, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  m_Behind = MakeColours(width, height, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  m_BehindDepths = MakeDepthsOfFramebuffer(width, height, m_Window);
  m_WrittenDepths = MakeDepthsOfFramebuffer(width, height, m_Window);
}

void
SamplePasses::AllocateLayers()
{
  if (m_Layers)
  {
    return;
  }
  const auto & [x, y, width, height] = m_Viewport;
  const int columns = width * m_Settings.samples;
  const int rows = height * m_Settings.samples;
  m_Layers = MakeColours(columns, rows, 4, VTK_FLOAT, GL_RGBA16F, m_Window);
  m_Now = MakeColours(width, height, 4, VTK_UNSIGNED_CHAR, GL_RGBA8, m_Window);
  m_NowDepths = MakeDepthsOfFramebuffer(width, height, m_Window);
}

void
SamplePasses::CopyFramebuffer(const Texture & colours, const Texture & depths)
{
  vtkOpenGLState * const state = m_Window->GetState();
  state->PushDrawFramebufferBinding();
  m_CopyTarget->Bind(vtkOpenGLFramebufferObject::GetDrawMode());
  m_CopyTarget->AddColorAttachment(0, colours ? colours : m_Behind);
  m_CopyTarget->AddDepthAttachment(depths);
  m_CopyTarget->ActivateDrawBuffer(0);
  const auto & [x, y, width, height] = m_Viewport;
  state->vtkglBlitFramebuffer(x,
                              y,
                              x + width,
                              y + height,
                              0,
                              0,
                              width,
                              height,
                              GL_DEPTH_BUFFER_BIT | (colours ? GL_COLOR_BUFFER_BIT : 0),
                              GL_NEAREST);
  state->PopDrawFramebufferBinding();
}

void
SamplePasses::TakeDepths()
{
  SetTarget(m_Colours, m_Depths);
  m_Window->GetState()->vtkglDepthFunc(GL_ALWAYS);
  Run(FragmentShader(NoSurfaceFragment, { { "SAMPLES", m_Settings.samples } }),
      { { "depths", m_BehindDepths } },
      [](vtkShaderProgram *) {});
  m_Window->GetState()->vtkglDepthFunc(GL_LESS);
}

void
SamplePasses::TakeChanges()
{
  SetTarget(m_Colours, m_Depths);
  m_Window->GetState()->vtkglDepthFunc(GL_ALWAYS);
  Run(FragmentShader(ChangedFragment, { { "SAMPLES", m_Settings.samples } }),
      { { "depthsNow", m_NowDepths }, { "depthsWritten", m_WrittenDepths } },
      [](vtkShaderProgram *) {});
}

void
SamplePasses::SetTarget(vtkTextureObject * colour, vtkTextureObject * depth)
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
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LESS);
  state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
}

template <typename TSetUniforms>
void
SamplePasses::Run(const std::string & fragmentShader,
                  const std::vector<Input> & inputs,
                  const TSetUniforms & setUniforms)
{
  vtkShaderProgram * const program =
    m_Window->GetShaderCache()->ReadyShaderProgram(VertexShader(WholeTargetVertex).c_str(), fragmentShader.c_str(), "");
  if (!program)
  {
    return; // VTK has reported an error
  }
  setUniforms(program);
  for (const Input & input : inputs)
  {
    input.texture->Activate();
    program->SetUniformi(input.name, input.texture->GetTextureUnit());
  }
  m_NoArrays->Bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  m_NoArrays->Release();
  for (const Input & input : inputs)
  {
    input.texture->Deactivate();
  }
}

void
SamplePasses::DrawRelief(const CameraMatrices & camera)
{
  SetTarget(m_Relief);
  const std::array<float, 3> depthRule{ static_cast<float>(camera.depthOffset),
                                        static_cast<float>(camera.depthFactor),
                                        static_cast<float>(camera.spread) };
  Run(FragmentShader(ReliefFragment, { { "SAMPLES", m_Settings.samples } }),
      { { "depths", m_Depths }, { "colours", m_Colours } },
      [&](vtkShaderProgram * program) { program->SetUniform3f("depthRule", depthRule.data()); });
}

void
SamplePasses::DrawShades(const CameraMatrices & camera)
{
  SetTarget(m_Shades);
  const float side = MeanSide(camera);
  const std::array<float, 2> pixelRule{ static_cast<float>(camera.pixelSize), static_cast<float>(camera.spread) };
  const double line = std::round(std::min(m_Viewport.width, m_Viewport.height) / PixelsPerOutlineWidth);
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
SamplePasses::DrawLayers(ActorBuffers & actors)
{
  SetTarget(m_Layers);
  m_Window->GetState()->vtkglClear(GL_COLOR_BUFFER_BIT);
  m_Window->GetState()->SetEnumState(GL_SCISSOR_TEST, true);
  const Viewport whole{ 0, 0, static_cast<int>(m_Layers->GetWidth()), static_cast<int>(m_Layers->GetHeight()) };
  DrawParts(actors, whole, FragmentsOfSample * SamplesOf(whole));
  m_Window->GetState()->SetEnumState(GL_SCISSOR_TEST, false);
  FragmentLists::End();
}

void
SamplePasses::DrawParts(ActorBuffers & actors, const Viewport & whole, std::size_t expectedFragments)
{
  for (const Viewport & part : Split(whole, expectedFragments))
  {
    m_Window->GetState()->vtkglScissor(part.x, part.y, part.width, part.height);
    FillLists(actors, part);
    const std::size_t fragments = m_Lists.NumberOfFragments();
    if (fragments > FragmentLists::Capacity && SamplesOf(part) > 1)
    {
      DrawParts(actors, part, fragments);
      continue;
    }
    SetTarget(m_Layers);
    Run(ListShader(BlendFragmentsText), {}, [this](vtkShaderProgram * program) { m_Lists.SetUniforms(program); });
  }
}

void
SamplePasses::FillLists(ActorBuffers & actors, const Viewport & part)
{
  SetTarget(m_Layers, m_Depths);
  m_Window->GetState()->vtkglDepthMask(GL_FALSE);
  m_Window->GetState()->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  m_Lists.Begin(part);
  const auto width = static_cast<float>(m_Layers->GetWidth());
  const auto height = static_cast<float>(m_Layers->GetHeight());
  actors.DrawTranslucent(m_Lists,
                         { static_cast<float>(part.x) / width,
                           static_cast<float>(part.y) / height,
                           static_cast<float>(part.x + part.width) / width,
                           static_cast<float>(part.y + part.height) / height });
  m_Window->GetState()->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void
SamplePasses::DrawPixels(bool hasLayers, bool hasChanges)
{
  const auto & [x, y, width, height] = m_Viewport;
  vtkOpenGLState * const state = m_Window->GetState();
  state->vtkglViewport(x, y, width, height);
  state->SetEnumState(GL_BLEND, false);
  state->SetEnumState(GL_CULL_FACE, false);
  state->SetEnumState(GL_DEPTH_TEST, !hasLayers); // without it no depths are written
  state->vtkglDepthMask(!hasLayers);
  state->vtkglDepthFunc(GL_ALWAYS);
  const bool hasRelief = HasShades() && (!hasLayers || hasChanges);
  std::vector<Input> inputs{ { "colours", m_Colours }, { "behind", m_Behind } };
  const auto addIf = [&inputs](bool condition, std::initializer_list<Input> more) {
    for (const Input & input : more)
    {
      if (condition)
      {
        inputs.push_back(input);
      }
    }
  };
  addIf(!hasLayers, { { "depths", m_Depths } });
  addIf(hasLayers, { { "layers", m_Layers } });
  addIf(hasRelief, { { "relief", m_Relief }, { "shades", m_Shades } });
  addIf(hasChanges, { { "now", m_Now }, { "depthsNow", m_NowDepths }, { "depthsWritten", m_WrittenDepths } });
  const ShaderDefines defines{ { "SAMPLES", m_Settings.samples }, { "RELIEF", hasRelief },
                               { "LAYERS", hasLayers },           { "CHANGED", hasChanges },
                               { "DEPTHS", !hasLayers },          { "STRAIGHT", m_Settings.straightAlpha } };
  const std::array<int, 2> origin{ x, y };
  Run(FragmentShader(PixelFragment, defines), inputs, [&](vtkShaderProgram * program) {
    program->SetUniform2i("origin", origin.data());
    if (hasRelief)
    {
      program->SetUniformf("alike", 0.1f * m_Lengths.reach);
      program->SetUniform2f("strengths", m_Settings.strengths.data());
    }
  });
}

} // namespace rhombic
