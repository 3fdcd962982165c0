#ifndef rhombicVolumePixels_h
#define rhombicVolumePixels_h

#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include "itkImageIOBase.h"

namespace rhombic
{

/** Reads the pixels of a volume of single numbers whose information \a io has read, converted as ReadScan() says.
 * Throws ITK's exceptions. */
ScanImage
ReadVolumePixels(itk::ImageIOBase & io, const VolumeGeometry & geometry);

} // namespace rhombic

#endif
