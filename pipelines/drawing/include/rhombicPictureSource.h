#ifndef rhombicPictureSource_h
#define rhombicPictureSource_h

#include "rhombicScanSource.h"
#include "rhombicSurfaceFinish.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** \class PictureSource
 * \brief What pictures are made of: surfaces of a scan, or surface files. */
struct PictureSource
{
  ScanSource scan; ///< if there are surface files, only its decoder has an effect
  SurfaceSelection surfaces;
  SurfaceFinish finish;                            ///< of each surface; combined with that of its preset
  std::vector<std::filesystem::path> surfaceFiles; ///< files that ReadSurfaces() reads
};

} // namespace rhombic

#endif
