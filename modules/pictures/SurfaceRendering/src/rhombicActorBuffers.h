#ifndef rhombicActorBuffers_h
#define rhombicActorBuffers_h

#include "rhombicCameraMatrices.h"
#include "rhombicFragmentLists.h"
#include "rhombicShaders.h"
#include "rhombicTriangleCells.h"

#include <vtkOpenGLBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <map>
#include <memory>
#include <tuple>
#include <vector>

class vtkMapper;
class vtkOpenGLRenderer;

namespace rhombic
{

/** Strengths of the surfaces' own light. */
struct OwnLight
{
  std::array<float, 4> strengths{};   ///< of key, fill, sky and rim
  std::array<float, 2> matteShine{};  ///< of wide and narrow highlights, of an actor without specular light
  std::array<float, 2> glossyShine{}; ///< of an actor whose specular strength is 1
};

/** \class ActorLook
 * \brief How actors are lit in one picture. */
struct ActorLook
{
  SurfaceLight light = SurfaceLight::Own;
  OwnLight own;
  RendererLights lights;
  vtkOpenGLRenderer * renderer = nullptr;
};

/** \class ActorBuffers
 * \brief The triangles of actors in the memory of OpenGL. They are uploaded anew when the actor's polydata, its colours
 * or its interpolation have changed. */
class ActorBuffers
{
public:
  /** The actors of one picture. Uploads what has changed, and forgets actors that the renderer has no more. */
  void
  SetActors(const std::vector<vtkActor *> & actors, const CameraMatrices & camera, const ActorLook & look);

  /** The number of actors that are translucent, or of those that are not. */
  int
  NumberOf(bool translucent) const;

  /** Draws the opaque actors. */
  void
  DrawOpaque();

  /** Adds the fragments of translucent actors in a part of the picture to the part's lists. */
  void
  DrawTranslucent(const FragmentLists & lists, const PicturePart & part);

  /** The mean length of the actors' edges, 0 without triangles, and the mean side of the box around the actors, in the
   * unit of the scene. Pictures do not count. */
  double
  MeanEdge() const;
  double
  MeanSide() const;

  /** Frees everything; the context is current. */
  void
  Release();

private:
  /** What decides what is uploaded for an actor. Times may become earlier, so they are compared one by one. */
  struct Source
  {
    Source() = default;
    explicit Source(vtkActor * actor);

    bool
    operator==(const Source & other) const;

    vtkMapper * mapper = nullptr;
    vtkMTimeType inputTime = 0;
    vtkMTimeType coloursTime = 0; ///< of the mapper with its table; 0 without scalars
    vtkMTimeType pictureTime = 0;
    bool isFlat = false;
    bool isTranslucent = false;
  };

  /** The triangles of one actor. */
  struct Buffers
  {
    Source source;                                      ///< of what was uploaded
    vtkSmartPointer<vtkOpenGLBufferObject> points;      ///< and next
    vtkSmartPointer<vtkOpenGLBufferObject> normals;     ///< none when faceted
    vtkSmartPointer<vtkOpenGLBufferObject> colours;     ///< none without scalars
    vtkSmartPointer<vtkOpenGLBufferObject> places;      ///< none without a texture
    vtkSmartPointer<vtkOpenGLBufferObject> indices;     ///< of the triangles' points
    vtkSmartPointer<vtkOpenGLVertexArrayObject> arrays; ///< for the program
    vtkShaderProgram * program = nullptr;               ///< of the arrays
    vtkSmartPointer<vtkTextureObject> picture;
    std::vector<TriangleCell> cells;
    Vector3 origin{}; ///< of the coordinates of points
    itk::PointBox box{};
    bool areClosed = false; ///< only of opaque actors
    double meanEdge = 0.0;  ///< length
    double triangles = 0.0;
    bool isUsed = false; ///< in this picture
  };

  /** An actor in one picture. */
  struct Drawing
  {
    vtkActor * actor;
    Buffers * buffers;
    ActorMatrices matrices;
    SurfaceProgram program;
    std::size_t number;
    bool hidesBacks; ///< backs of triangles can't be seen or are not shown
    bool hidesFronts;
  };

  Buffers &
  Upload(vtkActor * actor);
  Drawing
  Describe(vtkActor * actor, Buffers & buffers, std::size_t number, const CameraMatrices & camera) const;
  void
  ForgetUnusedActors();
  vtkShaderProgram *
  ReadyProgram(const SurfaceProgram & program);
  static void
  BindArrays(const Drawing & drawing, vtkShaderProgram * program);
  void
  Draw(const Drawing & drawing, const FragmentLists * lists, const PicturePart & part);
  void
  SetUniforms(const Drawing & drawing, const FragmentLists * lists, vtkShaderProgram * program) const;
  void
  DrawCells(const Drawing & drawing, const PicturePart & part);
  void
  DrawRanges(std::vector<const void *> & firsts, std::vector<int> & counts);

  std::map<vtkActor *, Buffers> m_Buffers;
  std::vector<Drawing> m_Drawings;
  std::map<std::tuple<bool, bool, bool, bool, SurfaceLight, int>, vtkSmartPointer<vtkShaderProgram>> m_Programs;
  std::string m_LightsOfPrograms;
  int m_Waiting = 0; ///< indices of triangles that may not be drawn yet
  ActorLook m_Look;
  vtkOpenGLRenderWindow * m_Window = nullptr;
};

} // namespace rhombic

#endif
