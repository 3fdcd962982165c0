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
  bool isRough;        ///< has detail near the size of a voxel, so other targets apply
  double fineDistance; ///< mean distance relative to marching cubes that mode fine must not exceed
  double leanDistance; ///< the same for mode lean
  double bandLimit;    ///< of a band-limited field, in fractions of Nyquist; 0 for the others
};

/** Sphere, torus, and band-limited fields of 1/4, 1/2 and 3/4 of the Nyquist frequency. */
const std::vector<AccuracyCase> &
GetAccuracyCases();

/** The field of a case in a cube of \a size samples at spacing 1: the shapes fill it, and the seed moves and turns
 * them, or makes the random field. */
std::unique_ptr<ReferenceField>
MakeField(const AccuracyCase & experiment, unsigned int size, std::uint64_t seed);

/** Where the samples of a surface came from. */
enum class SampleSource : unsigned char
{
  Exact,    ///< the field itself
  Resampled ///< a Cartesian volume of spacing 1, through the cubic B-spline
};

/** \class AccuracyResult
 * \brief A mesh of a field: means over the seeds, but sums of counts and the largest of maxima. */
struct AccuracyResult
{
  std::string mesh;         ///< "marching cubes", "marching cubes, fewer samples", or a mode of ours
  bool isReference = false; ///< whether it is marching cubes at full density, which all others are compared with
  SampleSource source = SampleSource::Exact;
  double density = 1.0; ///< samples per h^3
  SurfaceErrors errors;
  itk::SizeValueType nonManifold = 0; ///< edges and points of the whole mesh that are no manifold
  itk::SizeValueType degenerate = 0;  ///< triangles of the whole mesh
};

/** All meshes of one case: marching cubes (vtkFlyingEdges3D) on the Cartesian grid of spacing h = 1 first; then, for
 * either source of samples and each density, marching cubes on a coarser Cartesian grid of that density, and every mode
 * of ours on the lattice. Triangles nearer than 3 h to the border are left out of the errors. */
std::vector<AccuracyResult>
RunAccuracyCase(const AccuracyCase & experiment, unsigned int size, unsigned int seeds);

} // namespace rhombic

#endif
