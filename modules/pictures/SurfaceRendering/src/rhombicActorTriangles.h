#ifndef rhombicActorTriangles_h
#define rhombicActorTriangles_h

#include "itkPointBox.h"
#include "rhombicVector3.h"

#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <vector>

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkProp;
class vtkUnsignedCharArray;

namespace rhombic
{

/** \class ArrayView
 * \brief Values in somebody else's memory. */
template <typename TValue>
struct ArrayView
{
  const TValue * data = nullptr;
  std::size_t size = 0;

  const TValue *
  begin() const
  {
    return data;
  }
  const TValue *
  end() const
  {
    return data + size;
  }
  const TValue &
  operator[](std::size_t n) const
  {
    return data[n];
  }
};

using PointOfActor = std::array<float, 3>;
using TriangleOfActor = std::array<std::uint32_t, 3>;

/** \class ActorTriangles
 * \brief The triangles of an actor as OpenGL takes them. Triangles are left out that have points which are not finite
 * or not there. */
class ActorTriangles
{
public:
  /** Polygons and strips become triangles. Points that have several normals or colours, of their cells, are repeated.
   * The polydata of the actor's mapper is up to date, see CanDraw().
   * \param withColours whether the mapper's scalars colour the actor
   * \param isFlat whether normals of points are left out */
  ActorTriangles(vtkActor * actor, bool withColours, bool isFlat);

  Vector3 origin{}; ///< of the coordinates of points
  ArrayView<PointOfActor> points;
  ArrayView<PointOfActor> normals;                  ///< for each point; empty: faceted
  ArrayView<std::array<std::uint8_t, 4>> colours;   ///< for each point, red to alpha; empty: those of the property
  ArrayView<std::array<float, 2>> texturePositions; ///< for each point; empty: no texture
  ArrayView<TriangleOfActor> triangles;
  itk::PointBox box; ///< around all points that are finite

  /** Whether every edge is shared by two triangles that run along it in opposite directions, and the volume is
   * positive: then backs of triangles can't be seen from outside. */
  bool
  AreClosed() const;

  /** The mean length of edges, of one triangle in eight. 0 without triangles. */
  double
  MeanEdge() const;

private:
  bool
  TakeArrays(vtkPolyData * polyData, bool isFlat);
  void
  CopyArrays(vtkPolyData * polyData, bool isFlat, vtkUnsignedCharArray * mapped, bool areOfCells);
  void
  KeepTrianglesWithPoints();

  vtkSmartPointer<vtkPolyData> m_PolyData; // owns arrays that are taken
  std::vector<PointOfActor> m_Points;
  std::vector<PointOfActor> m_Normals;
  std::vector<std::array<std::uint8_t, 4>> m_Colours;
  std::vector<std::array<float, 2>> m_TexturePositions;
  std::vector<TriangleOfActor> m_Triangles;
};

/** The actor, if \a prop is one that the passes draw, otherwise null: an actor of VTK's own class with a
 * vtkPolyDataMapper, of polygons or strips alone, as surfaces without edges, with flat, Gouraud or Phong interpolation,
 * at most six clipping planes, a matrix that can be inverted, colours of points or cells if any, and no texture or
 * program of its own. An unlit translucent actor may have a texture of bytes. Brings the mapper's input up to date. */
vtkActor *
CanDraw(vtkProp * prop);

/** The picture of an unlit actor's texture: bytes with 3 or 4 components. Null if there is none. */
vtkImageData *
PictureOf(vtkActor * actor);

} // namespace rhombic

#endif
