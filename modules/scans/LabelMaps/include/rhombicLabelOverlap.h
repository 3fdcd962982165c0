#ifndef rhombicLabelOverlap_h
#define rhombicLabelOverlap_h

#include "rhombicScan.h"

#include "itkMatrixOffsetTransformBase.h"

#include <cstdint>
#include <map>
#include <utility>

namespace rhombic
{

/** A map of the space of one label map to that of another, in LPS mm. */
using AffineMap = itk::MatrixOffsetTransformBase<double, 3, 3>;

/** Volume and place of a label's voxels. */
struct LabelMoments
{
  double volume = 0.0;              ///< in mm^3
  itk::Point<double, 3> centroid{}; ///< in LPS mm
  itk::ImageRegion<3> region;       ///< the smallest that holds all voxels
};

/** The moments of all labels of a map but the background, by their values. Slices may be unevenly spaced. */
std::map<std::int32_t, LabelMoments>
ComputeLabelMoments(const Scan & map);

/** Volumes in mm^3 of labels of two maps, and of their overlaps, on the grid of the first. */
struct LabelOverlap
{
  std::map<std::int32_t, double> first;
  std::map<std::int32_t, double> second;
  std::map<std::pair<std::int32_t, std::int32_t>, double> common; ///< of a label of the first and one of the second

  /** Dice's coefficient of a label of each map: 1 if there is neither. */
  double
  GetDice(std::int32_t inFirst, std::int32_t inSecond) const;

  /** Intersection over union: 1 if there is neither. */
  double
  GetIoU(std::int32_t inFirst, std::int32_t inSecond) const;
};

/** Looks up the nearest voxel of the second map at the centre of each voxel of the first. What lies outside of the
 * first map's grid does not count. The same for any number of threads.
 *
 * \param toSecond maps points of the first map's space to the second's; null for one space */
LabelOverlap
ComputeLabelOverlap(const Scan & first, const Scan & second, const AffineMap * toSecond = nullptr);

} // namespace rhombic

#endif
