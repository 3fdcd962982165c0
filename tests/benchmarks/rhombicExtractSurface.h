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

/** All modes there are. */
const std::vector<ExtractionMode> &
GetExtractionModes();

/** "tetrahedra", ... */
const char *
NameOf(ExtractionMode mode);

/** The surface of an image, by as many threads as ITK is set to use. Normals are made also where the mode can't leave
 * them out. For std::int16_t and float.
 * \param closed whether the surface is closed at the image's border; those of VTK end there */
template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image,
               double isovalue,
               ExtractionMode mode,
               bool normals,
               bool closed = false);

} // namespace rhombic

#endif
