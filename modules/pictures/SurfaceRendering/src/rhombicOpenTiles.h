#ifndef rhombicOpenTiles_h
#define rhombicOpenTiles_h

#include "rhombicCameraFit.h"

#include <vector>

namespace rhombic
{

/** The part of a picture, 0 to 1 from the bottom left, that a box may cover, and its depths as OpenGL stores
 * them. */
struct Footprint
{
  float left = 0.0f;
  float right = 1.0f;
  float bottom = 0.0f;
  float top = 1.0f;
  float nearest = 0.0f;
  float farthest = 1.0f;
};

Footprint
FootprintOf(const std::array<float, 3> & lowest, const std::array<float, 3> & highest, const Camera & camera);

/** \class OpenTiles
 * \brief The depth in each square part of a picture behind which something can still be seen, so that cells of
 * triangles that can't be seen are not drawn. */
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
  MayShow(const Footprint & footprint) const;

  bool
  AllAreClosed() const;
};

} // namespace rhombic

#endif
