#ifndef rhombicLabelPieces_h
#define rhombicLabelPieces_h

#include "rhombicScan.h"

#include <cstdint>
#include <map>
#include <vector>

namespace rhombic
{

using MaskImage = itk::Image<std::uint8_t, 3>;

/** The box around each label's voxels, by the label's value, without the background 0. */
std::map<std::int32_t, itk::ImageRegion<3>>
FindLabelBoxes(const ScanImage & image);

/** \class LabelPieces
 * \brief The pieces of a label: voxels connected through faces, edges or corners. */
class LabelPieces
{
public:
  /** \param box around the label's voxels */
  LabelPieces(const ScanImage & image, std::int32_t value, const itk::ImageRegion<3> & box);

  std::size_t
  GetNumberOfPieces() const
  {
    return m_Boxes.size();
  }

  /** How many there would be if voxels were connected through faces only. */
  std::size_t
  CountFaceConnectedPieces() const;

  /** Voxels of a piece in each slice of its box. */
  std::vector<std::size_t>
  CountVoxels(std::size_t piece) const;

  /** The box around a piece's voxels. */
  const itk::ImageRegion<3> &
  GetBox(std::size_t piece) const
  {
    return m_Boxes[piece];
  }

  /** 1 for the piece's voxels, 0 elsewhere, in its box and \a margin voxels around it, on the scan's grid. Beyond the
   * scan's borders it is as at the borders. */
  MaskImage::Pointer
  MakeMask(std::size_t piece, itk::SizeValueType margin) const;

private:
  using PieceImage = itk::Image<std::uint32_t, 3>;

  PieceImage::Pointer m_Pieces; // by voxel of the label's box: 0 or the piece's place in the list below, from 1
  itk::ImageRegion<3> m_Whole;
  std::vector<itk::ImageRegion<3>> m_Boxes;
};

} // namespace rhombic

#endif
