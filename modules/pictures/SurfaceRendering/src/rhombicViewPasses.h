#ifndef rhombicViewPasses_h
#define rhombicViewPasses_h

#include "rhombicSceneBuffers.h"

#include <vtkOpenGLFramebufferObject.h>

namespace rhombic
{

/** \class OcclusionLengths
 * \brief Lengths in mm that decide which cavities of a scene are darkened. They belong to the body, so a cavity is as
 * dark when it is enlarged. */
struct OcclusionLengths
{
  float reach = 0.0f;  ///< largest distance of surfaces that take light away
  float detail = 0.0f; ///< pits up to this depth stay bright, as those between the steps of coarsely sampled surfaces
};

/** The reach is 0.06 of the mean side of the box around the surfaces; the detail is 0.6 of the mean length of the
 * triangles' edges, at most a quarter of the reach. 0 without surfaces. */
OcclusionLengths
FindOcclusionLengths(const Scene & scene);

/** \class ViewPasses
 * \brief Draws pictures of a scene into textures, and reads them. */
class ViewPasses
{
public:
  ViewPasses(const Scene & scene, const RenderSettings & settings, vtkOpenGLRenderWindow * window);

  /** Draws opaque surfaces, their shades, translucent layers, and the mean of the samples. */
  Picture
  Draw(SceneBuffers & scene, const Camera & camera);

private:
  using Texture = vtkSmartPointer<vtkTextureObject>;

  /** A texture that a program reads, by the name it has there. */
  struct Input
  {
    const char * name;
    vtkTextureObject * texture;
  };

  void
  Allocate(const Camera & camera);
  void
  DrawOpaque(SceneBuffers & scene, const Camera & camera);
  void
  DrawRelief(const Camera & camera);
  void
  DrawShades(const Camera & camera);
  void
  DrawLayers(SceneBuffers & scene, const Camera & camera);
  OpenTiles
  FindOpenTiles();
  void
  DrawPixels();
  Picture
  ReadPixels() const;

  bool
  HasShades() const;

  /** Draws into these textures from now on. */
  void
  SetTarget(vtkTextureObject * colour, vtkTextureObject * depth = nullptr);

  /** Runs a fragment program for each pixel of the target. \param setUniforms called with the vtkShaderProgram */
  template <typename TSetUniforms>
  void
  Run(const std::string & fragmentShader, const std::vector<Input> & inputs, const TSetUniforms & setUniforms);

  /** Runs a fragment program for each sample in tiles that were open before. */
  void
  RunInOpenTiles(const std::string & fragmentShader, const Input & input);

  void
  RunProgram(vtkShaderProgram * program, const std::vector<Input> & inputs, int vertices);

  RenderSettings m_Settings;
  bool m_IsTranslucent;
  OcclusionLengths m_Lengths;
  vtkOpenGLRenderWindow * m_Window;
  vtkSmartPointer<vtkOpenGLFramebufferObject> m_Framebuffer;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> m_NoArrays;
  int m_Width = 0;
  int m_Height = 0;

  // For each sample:
  Texture m_Colours; ///< of opaque surfaces
  Texture m_Depths;
  Texture m_Layer; ///< one translucent layer
  Texture m_LayerDepths;
  Texture m_DepthsBefore; ///< of the layer before
  Texture m_Layers;       ///< all translucent layers so far, multiplied by alpha
  // For each tile of samples:
  Texture m_Tiles; ///< as OpenTiles
  Texture m_TilesBefore;
  // For each pixel:
  Texture m_Relief;
  Texture m_Shades;
  Texture m_Pixels;
};

} // namespace rhombic

#endif
