#ifndef rhombicMeshEstimate_h
#define rhombicMeshEstimate_h

#include "rhombicScanToLattice.h"
#include "rhombicSurfaceRequest.h"

#include "itkFCCIsosurfaceMode.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rhombic
{

/** The surfaces of requests, estimated. */
struct MeshEstimate
{
  double triangles = 0.0;
  double kept = 0.0;                 ///< of the triangles: but for those of surfaces that are only looked at
  SurfaceBytes bytes;                ///< in memory
  std::uintmax_t bits = 0;           ///< of bytes.besideSlab: what can't be in temporary files
  std::uintmax_t temporaryBytes = 0; ///< in temporary files, see PutIntoTemporaryFiles()
};

/** Pairs of neighbouring slices at equal distances, from the first slice of a scan to the last. */
struct SampledSlices
{
  const ScanImage & image;
  std::vector<std::size_t> pairs; ///< for each pair, which slice of the image is its first
  std::size_t depth = 1;          ///< slices of the scan
};

/** Which slices of a scan are the first of the pairs from which meshes are estimated: all, or 6 and more with some 32
 * million voxels. */
std::vector<std::size_t>
FindSlicePairs(const itk::Size<3> & size);

/** Estimates the surfaces of requests with isovalues from edges of voxels that they cross: some 4 % from the number of
 * triangles of scans and phantoms, more where noise is most of the surface.
 * \param lattice what they are extracted from
 * \param mostTriangles of each surface: as ScanSource has it */
MeshEstimate
EstimateMesh(const SampledSlices & sample,
             const std::vector<SurfaceRequest> & requests,
             itk::FCCIsosurfaceMode mode,
             const LatticeSettings & lattice,
             double mostTriangles = 0.0);

/** "some 5.12 million triangles", "some 171 million triangles". */
std::string
DescribeTriangles(double triangles);

/** What is done to surfaces when they have no crossings. */
struct MeshSteps
{
  bool smooths = false;
  bool simplifies = false;
  bool colours = false;
  bool audits = false;
  bool ofWalls = false; ///< that surfaces of labels share: there is more to keep of several sheets
};

/** Counts the memory of steps that need more than the search for crossings. */
void
CountSteps(const MeshSteps & steps, MeshEstimate & mesh);

/** Takes surfaces out of the memory but for what can't be in temporary files. */
void
PutIntoTemporaryFiles(MeshEstimate & mesh);

} // namespace rhombic

#endif
