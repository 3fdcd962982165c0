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
 * \brief A scan between its samples, as itk::CartesianToFCCImageFilter sees it, slanted or not.
 *
 * Immutable after construction, so thread safe; the scan must outlive it. */
class ScanField
{
public:
  using PointType = itk::Point<double, 3>;

  ScanField(const Scan & scan, itk::SeparableKernel kernel);

  /** The smallest distance between samples along an axis, in mm. */
  double
  GetPitch() const;

  /** Values at points in LPS mm. Not a number at points less than half a sample inside the outermost samples: there,
   * surfaces are closed by walls that are none of the patient. */
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
  MakeTaps(const std::vector<PointType> & points, itk::SeparableKernel kernel) const;

  const Scan & m_Scan;
  itk::SeparableKernel m_Kernel;
  std::optional<itk::SliceStack> m_Stack; ///< of slanted scans
};

} // namespace rhombic

#endif
