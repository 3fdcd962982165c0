#ifndef rhombicLatticeToSurfaces_h
#define rhombicLatticeToSurfaces_h

#include "rhombicEnclosedParts.h"
#include "rhombicEvents.h"
#include "rhombicFCCImageFile.h"
#include "rhombicFewerTrianglesInParts.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCIsosurfaceMode.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rhombic
{

/** An isosurface of a lattice volume. */
struct ExtractedSurface : SceneSurface
{
  std::optional<EnclosedParts> enclosed; ///< for SurfaceRequest::Parts::Enclosed
  std::optional<WholeSurface> whole;     ///< of which the surface has fewer triangles, with smooth normals
};

/** For isosurfaces that are only looked at: large ones come in fewer triangles, in slabs, and are never in memory as a
 * whole. Which these are follows from the surfaces alone, so that pictures do not depend on the memory. */
struct SurfaceViewing
{
  /** The distance in mm by which views of a surface in these bounds ({xmin, xmax, ymin, ...} in LPS mm) do not change.
   */
  std::function<double(const std::array<double, 6> & bounds)> findUnseen;
  itk::SizeValueType mostPoints = 2'000'000; ///< of surfaces that keep all triangles
  std::uintmax_t maximumMemory = 0;          ///< bytes for surfaces; 0: half of the free memory
};

/** Extracts a closed isosurface for each request, in their order; requests on the same side of their isovalues share
 * one pass over the volume. Walls close surfaces where the scan ends: on the outer faces of the lattice, or, if the
 * grid is known, of its voxels. Notes give the number of triangles and the parts left out.
 *
 * \param grid the grid of the scan that the volume was made from; null for slanted scans
 * \param computesNormals whether points get normals, as in itk::FCCIsosurfaceFilter
 * \param viewing not null for surfaces that are only looked at, of requests for all parts
 *
 * Throws Failure: Memory for a large surface that even in fewer triangles is more than is allowed; Usage for a request
 * without an isovalue (see ResolveIsovalues()) and for outermost parts below an isovalue; Empty for a surface without
 * triangles. */
std::vector<ExtractedSurface>
LatticeToSurfaces(const FCCVolume & volume,
                  const std::vector<SurfaceRequest> & requests,
                  itk::FCCIsosurfaceMode mode,
                  const Events & events,
                  const itk::ImageBase<3> * grid = nullptr,
                  bool computesNormals = true,
                  const SurfaceViewing * viewing = nullptr);

} // namespace rhombic

#endif
