#ifndef rhombicCoarseScan_h
#define rhombicCoarseScan_h

#include "rhombicBlockGrid.h"
#include "rhombicBlockSamples.h"
#include "rhombicScan.h"

namespace rhombic
{

/** A CT in blocks of whole samples that are about 2 mm wide. */
struct CoarseScan
{
  BlockShape shape{};
  unsigned int longAxis = 2;                 ///< the image axis along the patient
  MaskImage::Pointer occupancy;              ///< share of a block's samples that are tissue, from 0 to 255
  MaskImage::Pointer hardness;               ///< share of a block's samples that are harder than skin, from 0 to 255
  itk::Image<std::int16_t, 3>::Pointer mean; ///< mean of a block's samples, in HU
  std::vector<itk::Vector<double, 3>> sliceOffsets; ///< from slices' positions in the image to the true ones, or empty

  /** The centre of a block, in LPS mm. */
  itk::Point<double, 3>
  PointOf(const itk::Index<3> & index) const;

  std::size_t
  NumberOfBlocks() const
  {
    return occupancy->GetBufferedRegion().GetNumberOfPixels();
  }

  /** The volume of a number of blocks. */
  double
  Millilitres(std::size_t blocks) const;
};

/** Divides a CT into blocks. \a tissue and \a hard are the lowest values of tissue and of hard samples, in HU. */
CoarseScan
MakeCoarseScan(const Scan & scan, double tissue, double hard);

} // namespace rhombic

#endif
