#ifndef rhombicLatticeToSurfaces_h
#define rhombicLatticeToSurfaces_h

#include "rhombicEnclosedParts.h"
#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCIsosurfaceMode.h"

#include <optional>
#include <vector>

namespace rhombic
{

/** An isosurface of a lattice volume. */
struct ExtractedSurface : SceneSurface
{
  std::optional<EnclosedParts> enclosed; ///< for SurfaceRequest::Parts::Enclosed
};

/** Extracts a closed isosurface for each request, in their order; requests on the same side of their isovalues share
 * one pass over the volume. Walls close surfaces where the scan ends: on the outer faces of the lattice, or, if the
 * grid is known, of its voxels. Notes give the number of triangles and the parts left out.
 *
 * \param grid the grid of the scan that the volume was made from; null for slanted scans
 * \param computesNormals whether points get normals, as in itk::FCCIsosurfaceFilter
 *
 * Throws Failure: Usage for a request without an isovalue (see ResolveIsovalues()) and for outermost parts below an
 * isovalue; Empty for a surface without triangles. */
std::vector<ExtractedSurface>
LatticeToSurfaces(const FCCVolume & volume,
                  const std::vector<SurfaceRequest> & requests,
                  itk::FCCIsosurfaceMode mode,
                  const Events & events,
                  const itk::ImageBase<3> * grid = nullptr,
                  bool computesNormals = true);

} // namespace rhombic

#endif
