#ifndef rhombicExtractSurface_h
#define rhombicExtractSurface_h

#include "itkFCCImage.h"
#include "itkFCCIsosurfaceMode.h"
#include "itkTriangleSurface.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

using ExtractionMode = itk::FCCIsosurfaceMode;

/** All modes. */
const std::vector<ExtractionMode> &
GetExtractionModes();

/** "tetrahedra", ... */
const char *
NameOf(ExtractionMode mode);

/** Extracts the surface of an image, on as many threads as ITK is set to use. For std::int16_t and float.
 * \param normals whether to make normals; some modes always make them
 * \param closed whether to close the surface at the image's border; VTK's surfaces end there */
template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image,
               double isovalue,
               ExtractionMode mode,
               bool normals,
               bool closed = false);

} // namespace rhombic

#endif
