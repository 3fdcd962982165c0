#ifndef rhombicLabelPieces_h
#define rhombicLabelPieces_h

#include "rhombicScan.h"

#include <cstdint>
#include <map>
#include <vector>

namespace rhombic
{

using MaskImage = itk::Image<std::uint8_t, 3>;

/** The bounding box of each label, by its value; without the background 0. */
std::map<std::int32_t, itk::ImageRegion<3>>
FindLabelBoxes(const ScanImage & image);

/** \class LabelPieces
 * \brief The pieces of a label: voxels connected through faces, edges or corners. */
class LabelPieces
{
public:
  /** \param box the label's bounding box */
  LabelPieces(const ScanImage & image, std::int32_t value, const itk::ImageRegion<3> & box);

  std::size_t
  GetNumberOfPieces() const
  {
    return m_Boxes.size();
  }

  /** The number of pieces connected through faces alone. */
  std::size_t
  CountFaceConnectedPieces() const;

  /** The number of a piece's voxels in each slice of its box. */
  std::vector<std::size_t>
  CountVoxels(std::size_t piece) const;

  /** The bounding box of a piece. */
  const itk::ImageRegion<3> &
  GetBox(std::size_t piece) const
  {
    return m_Boxes[piece];
  }

  /** A mask of a piece on the scan's grid: its box and \a margin voxels around it. Beyond the scan, the mask continues
   * as it is at the border. */
  MaskImage::Pointer
  MakeMask(std::size_t piece, itk::SizeValueType margin) const;

private:
  using PieceImage = itk::Image<std::uint32_t, 3>;

  PieceImage::Pointer m_Pieces; ///< in the label's box: the number of each voxel's piece, from 1; or 0
  itk::ImageRegion<3> m_ScanRegion;
  std::vector<itk::ImageRegion<3>> m_Boxes; ///< by piece
};

} // namespace rhombic

#endif
