#ifndef itkSlicePlacement_h
#define itkSlicePlacement_h

#include "itkImageBase.h"

#include <ostream>
#include <vector>

namespace itk
{

/** Largest cosine of the angle between axes that count as perpendicular. */
constexpr double AxesTolerance = 1e-6;

/** Whether the columns of an image's direction are perpendicular to each other. */
bool
AreAxesPerpendicular(const Matrix<double, 3, 3> & direction);

/** \class SlicePlacement
 * \brief What the image of a scan with unevenly spaced slices lacks: their places.
 *
 * It travels in the MetaDataDictionary of the image, from ScanFileReader to CartesianToFCCImageFilter. ITK's own
 * filters do not pass the dictionary of their input on. */
struct SlicePlacement
{
  /** Positions in LPS mm of the first voxel of each slice; empty for slices at even steps along the third axis. */
  std::vector<Point<double, 3>> origins;

  /** The geometry of the scan's image, which has its slices at even steps; null where there are no origins. */
  ImageBase<3>::ConstPointer grid;
};

/** Puts the placement into the image's MetaDataDictionary, in place of the one before. */
void
SetSlicePlacement(DataObject & image, const SlicePlacement & placement);

/** The placement in the image's MetaDataDictionary; an empty one where there is none. */
SlicePlacement
GetSlicePlacement(const DataObject & image);

/** \class SlicePlacingFilter
 * \brief Base of filters whose output lies where the slices of their input do, however these are spaced. */
class SlicePlacingFilter
{
protected:
  SlicePlacingFilter() = default;
  virtual ~SlicePlacingFilter() = default;
};

/** Whether an image, or any image that its samples are made from in its pipeline, has a SlicePlacement with origins.
 * What a SlicePlacingFilter makes lies where its geometry says, whatever it is made from; an input with the name
 * ReferenceImage lends its geometry only. */
bool
IsFromUnevenSlices(const DataObject & image);

/** The positions in LPS mm of the first sample of each slice of an image; empty for slices at even steps.
 *
 * The image may be cropped, padded or resampled within its slices, and flipped; its slices must be adjacent slices of
 * the scan.
 *
 * \param scan where the slices of the scan lie, for an image without a SlicePlacement of its own
 *
 * Throws ExceptionObject when the slices are not adjacent ones of the scan, and when their places are unknown: when
 * there are no origins, but IsFromUnevenSlices(). */
std::vector<Point<double, 3>>
FindSliceOrigins(const ImageBase<3> & image, const SlicePlacement & scan);

/** Prints the number of slice origins, the first and the last. */
void
PrintSliceOrigins(std::ostream & os, const std::vector<Point<double, 3>> & origins);

} // namespace itk

#endif
