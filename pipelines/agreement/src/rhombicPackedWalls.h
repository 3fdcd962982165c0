#ifndef rhombicPackedWalls_h
#define rhombicPackedWalls_h

#include "itkLabelWalls.h"

#include <vector>

namespace rhombic
{

/** \class PackedWalls
 * \brief Walls between labels in about half of their memory, for the time in which they are not used.
 *
 * Points, triangles, their labels and their orders are kept exactly, by the lossless codecs of meshoptimizer; normals
 * are not kept. Some 10 million triangles a second. */
class PackedWalls
{
public:
  /** Packs walls, and leaves them empty. */
  explicit PackedWalls(itk::LabelWalls & walls);

  /** Fills empty walls with those that were packed. */
  void
  Unpack(itk::LabelWalls & walls) const;

private:
  /** One block of an array. */
  struct Block
  {
    std::size_t count; ///< of elements
    std::vector<unsigned char> bytes;
  };
  using Blocks = std::vector<Block>;

  Blocks m_Points;
  Blocks m_Triangles;
  Blocks m_Labels;
};

} // namespace rhombic

#endif
