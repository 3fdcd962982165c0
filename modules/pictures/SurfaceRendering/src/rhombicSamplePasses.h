#ifndef rhombicSamplePasses_h
#define rhombicSamplePasses_h

#include "rhombicActorBuffers.h"
#include "rhombicFragmentLists.h"

#include <vtkOpenGLFramebufferObject.h>

namespace rhombic
{

/** \class OcclusionLengths
 * \brief Lengths, in the unit of the scene, that decide which cavities are darkened. They belong to the body, so a
 * cavity is as dark when it is enlarged. */
struct OcclusionLengths
{
  float reach = 0.0f;  ///< largest distance of surfaces that take light away
  float detail = 0.0f; ///< pits up to this depth stay bright, as those between the steps of coarsely sampled surfaces
};

/** The reach is 0.06 of the mean side of the box around the surfaces; the detail is 0.6 of the mean length of the
 * triangles' edges, at most a quarter of the reach. 0 without surfaces. */
OcclusionLengths
FindOcclusionLengths(const ActorBuffers & actors);

/** How samples become pixels. */
struct SampleSettings
{
  int samples = 2; ///< along each side of a pixel, 1 to 4
  bool ambientOcclusion = true;
  bool silhouettes = true;
  bool straightAlpha = false;                   ///< pixels are not multiplied by alpha
  std::array<float, 2> strengths{ 1.0f, 0.8f }; ///< of ambient occlusion and silhouettes
};

/** \class SamplePasses
 * \brief Draws actors with several samples for each pixel, and puts the pixels into the current framebuffer. What is
 * there already, in front or behind, is respected by its depth in each pixel. */
class SamplePasses
{
public:
  /** Draws opaque actors with their shades: colours and depths. */
  void
  DrawOpaque(ActorBuffers & actors,
             const CameraMatrices & camera,
             const SampleSettings & settings,
             const Viewport & viewport,
             vtkOpenGLRenderWindow * window);

  /** Draws translucent layers: colours. If DrawOpaque() has drawn the same viewport since the last call, its samples
   * are kept where depths have not changed since, so that the edges of opaque actors behind layers are smooth. */
  void
  DrawTranslucent(ActorBuffers & actors,
                  const SampleSettings & settings,
                  const Viewport & viewport,
                  vtkOpenGLRenderWindow * window);

  /** Frees everything; the context is current. */
  void
  Release();

private:
  using Texture = vtkSmartPointer<vtkTextureObject>;

  /** A texture that a program reads, by the name it has there. */
  struct Input
  {
    const char * name;
    vtkTextureObject * texture;
  };

  void
  Begin(const SampleSettings & settings, const Viewport & viewport, vtkOpenGLRenderWindow * window);
  void
  Allocate();
  void
  AllocateLayers();
  void
  CopyFramebuffer(const Texture & colours, const Texture & depths);
  void
  TakeDepths();
  void
  TakeChanges();
  void
  DrawRelief(const CameraMatrices & camera);
  void
  DrawShades(const CameraMatrices & camera);
  void
  DrawLayers(ActorBuffers & actors);
  void
  DrawParts(ActorBuffers & actors, const Viewport & whole, std::size_t expectedFragments);
  void
  FillLists(ActorBuffers & actors, const Viewport & part);
  void
  DrawPixels(bool hasLayers, bool hasChanges);

  bool
  HasShades() const;

  /** Draws into these textures from now on. */
  void
  SetTarget(vtkTextureObject * colour, vtkTextureObject * depth = nullptr);

  /** Runs a fragment program for each pixel of the target. \param setUniforms called with the vtkShaderProgram */
  template <typename TSetUniforms>
  void
  Run(const std::string & fragmentShader, const std::vector<Input> & inputs, const TSetUniforms & setUniforms);

  SampleSettings m_Settings;
  Viewport m_Viewport;
  OcclusionLengths m_Lengths;
  bool m_HasOpaque = false; ///< samples of DrawOpaque()
  vtkOpenGLRenderWindow * m_Window = nullptr;
  vtkSmartPointer<vtkOpenGLFramebufferObject> m_Framebuffer;
  vtkSmartPointer<vtkOpenGLFramebufferObject> m_CopyTarget;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> m_NoArrays;

  FragmentLists m_Lists; ///< of a part of the samples

  // For each sample:
  Texture m_Colours; ///< of opaque surfaces
  Texture m_Depths;
  Texture m_Layers; ///< of translucent surfaces, multiplied by alpha
  // For each pixel:
  Texture m_Relief;
  Texture m_Shades;
  Texture m_Behind; ///< the framebuffer before DrawOpaque()
  Texture m_BehindDepths;
  Texture m_WrittenDepths; ///< the framebuffer after DrawOpaque()
  Texture m_Now;           ///< the framebuffer before DrawTranslucent()
  Texture m_NowDepths;
};

} // namespace rhombic

#endif
