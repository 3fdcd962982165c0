#ifndef rhombicTriangleCells_h
#define rhombicTriangleCells_h

#include "itkPointBox.h"
#include "rhombicActorTriangles.h"
#include "rhombicCameraMatrices.h"

#include <array>
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

/** \class OpenTiles
 * \brief The depth in each square part of a picture behind which something can still be seen, so that hidden
 * cells of triangles are not drawn. */
struct OpenTiles
{
  static constexpr int Side = 16; ///< samples of a tile's width and height
  static constexpr int Closed = 2;

  int columns = 1;
  int rows = 1;
  double width = 1.0; ///< of the picture, in tiles
  double height = 1.0;
  std::vector<float> depths{ 0.0f }; ///< from the bottom left; Closed where nothing more can be seen

  bool
  MayShow(const itk::PointBox & footprint) const;

  bool
  AllAreClosed() const;
};

} // namespace rhombic

#endif
