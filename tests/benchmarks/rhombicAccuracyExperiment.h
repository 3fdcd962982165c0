#ifndef rhombicAccuracyExperiment_h
#define rhombicAccuracyExperiment_h

#include "rhombicExtractSurface.h"
#include "rhombicReferenceField.h"
#include "rhombicSurfaceErrors.h"

#include "itkTriangleSurfaceTopology.h"

#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** \class AccuracyCase
 * \brief A kind of field. */
struct AccuracyCase
{
  const char * name;
  bool isRough;        ///< whether it has detail near the size of a voxel, so that other targets apply
  double fineDistance; ///< largest mean distance of mode fine, relative to marching cubes
  double leanDistance; ///< largest mean distance of mode lean, relative to marching cubes
  double bandLimit;    ///< of a band-limited field, in fractions of the Nyquist frequency; 0 for the others
};

/** Sphere, torus, and band-limited fields of 1/4, 1/2 and 3/4 of the Nyquist frequency. */
const std::vector<AccuracyCase> &
GetAccuracyCases();

/** The field of a case in a cube of \a size samples at spacing 1. The shapes fill the cube; the seed determines their
 * position and orientation, or the random field. */
std::unique_ptr<ReferenceField>
MakeField(const AccuracyCase & experiment, unsigned int size, std::uint64_t seed);

/** The origin of the samples of a surface. */
enum class SampleSource : unsigned char
{
  Exact,    ///< the field itself
  Resampled ///< a Cartesian volume of spacing 1, through the cubic B-spline
};

/** \class AccuracyResult
 * \brief The errors of a mesh: means over the seeds, except for sums of counts and the largest of the maxima. */
struct AccuracyResult
{
  std::string mesh;         ///< "marching cubes", "marching cubes, fewer samples", or the name of a mode
  bool isReference = false; ///< whether it is marching cubes at full density, the reference of all others
  SampleSource source = SampleSource::Exact;
  double density = 1.0; ///< samples per h^3
  SurfaceErrors errors;
  itk::SizeValueType nonManifold = 0; ///< number of non-manifold edges and points of the whole mesh
  itk::SizeValueType degenerate = 0;  ///< number of degenerate triangles of the whole mesh
};

/** Judges all meshes of one case. The first one is marching cubes (vtkFlyingEdges3D) on the Cartesian grid of spacing
 * h = 1. Then follow, for each density and both sources of samples, marching cubes on a coarser Cartesian grid of that
 * density, and every mode on the lattice. Triangles nearer than 3 h to the border are not judged. */
std::vector<AccuracyResult>
RunAccuracyCase(const AccuracyCase & experiment, unsigned int size, unsigned int seeds);

} // namespace rhombic

#endif
