#ifndef rhombicPatientMask_h
#define rhombicPatientMask_h

#include "rhombicBlockGrid.h"

#include <vector>

namespace rhombic
{

/** A CT in blocks of whole samples that are about 3 mm wide. */
struct CoarseScan
{
  BlockShape shape{};
  unsigned int longAxis = 2;                        ///< the image axis along the patient
  MaskImage::Pointer occupancy;                     ///< share of a block's samples that are tissue, from 0 to 255
  MaskImage::Pointer share;                         ///< the same, with samples near the threshold counted in part
  itk::Image<std::int16_t, 3>::Pointer mean;        ///< mean of a block's samples, in HU
  std::vector<itk::Vector<double, 3>> sliceOffsets; ///< from slices' positions in the image to the true ones, or empty

  /** The centre of a block, in LPS mm. */
  itk::Point<double, 3>
  PointOf(const itk::Index<3> & index) const;
};

/** The blocks of the patient. */
struct PatientMask
{
  MaskImage::Pointer all;
  MaskImage::Pointer hanging; ///< thin parts of a few ml and more that hang on the others
};

/** Finds what is thick, the lungs between, and thin parts that hang on it. The steps are described at RemoveTable().
 * \param tissue the blocks that are tissue
 * \return null when nothing is thick */
PatientMask
FindPatient(const CoarseScan & coarse, const MaskImage & tissue);

} // namespace rhombic

#endif
