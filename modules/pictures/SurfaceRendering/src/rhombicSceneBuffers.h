#ifndef rhombicSceneBuffers_h
#define rhombicSceneBuffers_h

#include "rhombicCameraFit.h"
#include "rhombicShaders.h"
#include "rhombicTriangleCells.h"

#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <vector>

namespace rhombic
{

/** \class SceneBuffers
 * \brief A scene in the memory of OpenGL, to be drawn from any number of cameras. The scene must outlive it. */
class SceneBuffers
{
public:
  /** Uploads all points, normals, triangles and pictures. */
  SceneBuffers(const Scene & scene, const RenderSettings & settings, vtkOpenGLRenderWindow * window);

  /** Draws the opaque surfaces. */
  void
  DrawOpaque(const Camera & camera);

  /** Draws the parts of translucent surfaces and planes that are behind a depth.
   * \param open where a layer can be seen */
  void
  DrawTranslucent(const Camera & camera, vtkTextureObject * depthBefore, const OpenTiles & open);

private:
  /** Triangles with the same program and colour. */
  struct Batch
  {
    SurfaceProgram program;
    std::array<float, 4> colour{};                      ///< as SurfaceFragmentShader() takes it
    float backward = 0.0f;                              ///< as SurfaceVertexShader() takes it
    std::array<float, 2> shine{};                       ///< strengths of highlights
    std::vector<ClipPlane> cuts;                        ///< of this surface
    vtkSmartPointer<vtkTextureObject> picture;          ///< of a plane
    vtkSmartPointer<vtkOpenGLBufferObject> points;      ///< and next
    vtkSmartPointer<vtkOpenGLBufferObject> normals;     ///< none when faceted
    vtkSmartPointer<vtkOpenGLBufferObject> indices;     ///< of the triangles' points
    vtkSmartPointer<vtkOpenGLVertexArrayObject> arrays; ///< for the program
    std::vector<TriangleCell> cells;
    bool hidesBacks = false; ///< backs of triangles can't be seen or are not shown
  };

  void
  AddSurface(const SceneSurface & item, std::size_t number, const std::vector<ClipPlane> & cuts);
  void
  AddPlane(const ScenePlane & plane);
  static void
  Upload(const itk::TriangleSurface * surface, Batch & batch);
  void
  Draw(Batch & batch, const Camera & camera, vtkTextureObject * depthBefore, const OpenTiles & open);
  void
  SetUniforms(const Batch & batch, const Camera & camera, vtkTextureObject * depthBefore, vtkShaderProgram * program);
  static void
  DrawCells(const Batch & batch, const Camera & camera, const OpenTiles & open);

  vtkOpenGLRenderWindow * m_Window;
  std::array<float, 4> m_Light;
  std::array<float, 2> m_MatteShine;
  std::array<float, 2> m_GlossyShine;
  std::vector<Batch> m_Opaque;
  std::vector<Batch> m_Translucent;
};

/** Whether every edge is shared by two triangles that run along it in opposite directions, and the volume is positive:
 * then backs of triangles can't be seen from outside. */
bool
IsClosed(const itk::TriangleSurface * surface);

} // namespace rhombic

#endif
