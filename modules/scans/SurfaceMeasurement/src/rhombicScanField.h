#ifndef rhombicScanField_h
#define rhombicScanField_h

#include "rhombicScan.h"

#include "itkSeparableTaps.h"
#include "itkSliceStack.h"

#include <optional>
#include <vector>

namespace rhombic
{

/** \class ScanField
 * \brief The continuous field of a scan, interpolated as itk::CartesianToFCCImageFilter does, also for slanted scans.
 *
 * The scan must outlive it. */
class ScanField
{
public:
  using PointType = itk::Point<double, 3>;

  ScanField(const Scan & scan, itk::SeparableKernel kernel);

  /** The smallest distance between samples along an axis, in mm. */
  double
  GetPitch() const;

  /** Values at points in LPS mm. NaN outside the scan and less than half a voxel inside the outermost samples, where
   * walls close surfaces. */
  std::vector<float>
  Evaluate(const std::vector<PointType> & points, itk::SeparableKernel kernel) const;
  std::vector<float>
  Evaluate(const std::vector<PointType> & points) const
  {
    return this->Evaluate(points, m_Kernel);
  }

private:
  struct Taps;

  Taps
  MakeGridTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const;
  Taps
  MakeStackTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const;

  const Scan & m_Scan;
  itk::SeparableKernel m_Kernel;
  std::optional<itk::SliceStack> m_Stack; ///< for slanted scans
};

} // namespace rhombic

#endif
