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
  unsigned int longAxis = 2;                        ///< the image axis along the patient
  MaskImage::Pointer occupancy;                     ///< share of a block's samples that are tissue: 0 none, 255 all
  MaskImage::Pointer hardness;                      ///< share that is harder than skin
  itk::Image<std::int16_t, 3>::Pointer mean;        ///< of a block's samples, in HU
  std::vector<itk::Vector<double, 3>> sliceOffsets; ///< from a slice's place in the image to its true one; may be empty

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

/** \a tissue and \a hard are the lowest values of what counts as such. */
CoarseScan
MakeCoarseScan(const Scan & scan, double tissue, double hard);

} // namespace rhombic

#endif
