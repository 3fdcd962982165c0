#ifndef rhombicNIfTIAffine_h
#define rhombicNIfTIAffine_h

#include "rhombicNIfTIHeader.h"
#include "rhombicScan.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <filesystem>

namespace rhombic
{

/** The geometry of a NIfTI volume: by the sform if its code is set, else by the qform, else along the LPS axes from the
 * origin. Fills affine, isOriented and notes of \a scan. Throws Failure(Geometry) when numbers are not finite, voxels
 * have no size or axes lie in one plane; another affine of the file is never used instead. */
VolumeGeometry
PlaceNIfTIVolume(const NIfTIHeader & header,
                 const itk::Size<3> & size,
                 const std::filesystem::path & path,
                 ScanReadOptions::Policy onSheared,
                 Scan & scan);

} // namespace rhombic

#endif
