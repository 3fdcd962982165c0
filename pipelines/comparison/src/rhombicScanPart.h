#ifndef rhombicScanPart_h
#define rhombicScanPart_h

#include "rhombicComparedMethod.h"

#include <array>
#include <filesystem>

namespace rhombic
{

/** What part of a scan becomes a field. */
struct ScanPartRequest
{
  std::filesystem::path file;
  double isovalue = 0.0;
  std::array<double, 3> center{ 0.5, 0.5, 0.5 }; ///< of the part, in fractions of the scan along the patient's axes
  double edge = 0.0;                             ///< length of the part along each axis, in mm
  double sigma = 0.0;                            ///< of the Gaussian that smooths the scan before, in mm; 0: none
};

/** A field and the box in which it is known, in mm along the scan's axes, in the order of the patient's. */
struct ScanPart
{
  ReferenceField field;
  FieldBox box{};
};

/** The cubic B-spline through the smoothed voxels of a part of a scan, minus an isovalue. The part is shortened where
 * the scan ends. Throws Failure: those of OpenScan(), and Unreadable for slanted and uneven stacks of slices. */
ScanPart
ReadScanPart(const ScanPartRequest & request);

} // namespace rhombic

#endif
