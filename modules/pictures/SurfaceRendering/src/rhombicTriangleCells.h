#ifndef rhombicTriangleCells_h
#define rhombicTriangleCells_h

#include "itkPointBox.h"
#include "rhombicActorTriangles.h"
#include "rhombicCameraMatrices.h"

#include <vector>

namespace rhombic
{

/** Consecutive triangles, and the box around them. */
struct TriangleCell
{
  itk::PointBox box;
  std::size_t firstTriangle;
  std::size_t numberOfTriangles;
};

/** The triangles of an actor, ordered by cells of a grid. */
struct TriangleCells
{
  std::vector<TriangleOfActor> triangles;
  std::vector<TriangleCell> cells; ///< none is empty
};

/** Orders triangles by cells of some hundreds, so that neighbours follow each other. Then parts of the actor can be
 * drawn alone, and OpenGL uses points again that were just transformed. */
TriangleCells
SortIntoCells(const ActorTriangles & actor);

/** The part of a picture, 0 to 1 from the left and from the bottom, that a box may cover, and its depths as OpenGL
 * stores them. */
itk::PointBox
FootprintOf(const itk::PointBox & box, const ActorMatrices & matrices);

/** A part of a picture, 0 to 1 from the left and from the bottom. */
struct PicturePart
{
  float left = 0.0f;
  float bottom = 0.0f;
  float right = 1.0f;
  float top = 1.0f;

  bool
  Meets(const itk::PointBox & footprint) const;
};

} // namespace rhombic

#endif
