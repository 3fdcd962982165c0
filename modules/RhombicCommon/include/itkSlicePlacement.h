#ifndef itkSlicePlacement_h
#define itkSlicePlacement_h

#include "itkDataObject.h"
#include "itkMatrix.h"
#include "itkPoint.h"

#include <vector>

namespace itk
{

/** Largest cosine of the angle between axes that count as perpendicular. */
constexpr double AxesTolerance = 1e-6;

/** Whether the columns of an image's direction are perpendicular to each other. */
bool
AreAxesPerpendicular(const Matrix<double, 3, 3> & direction);

/** \class SlicePlacement
 * \brief What the image of a scan lacks: the places of slices that are unevenly spaced, and the value around them.
 *
 * It travels in the MetaDataDictionary of the image, from ScanFileReader to CartesianToFCCImageFilter. ITK's own
 * filters do not pass the dictionary of their input on. */
struct SlicePlacement
{
  /** Positions in LPS mm of the first voxel of each slice; empty for slices at even steps along the third axis. */
  std::vector<Point<double, 3>> origins;

  double outsideValue = 0; ///< the lowest value of the scan
};

/** Puts the placement into the image's MetaDataDictionary, in place of the one before. */
void
SetSlicePlacement(DataObject & image, const SlicePlacement & placement);

/** The placement in the image's MetaDataDictionary; an empty one where there is none. */
SlicePlacement
GetSlicePlacement(const DataObject & image);

} // namespace itk

#endif
