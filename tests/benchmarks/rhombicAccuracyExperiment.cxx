#include "rhombicAccuracyExperiment.h"

#include "rhombicBandLimitedField.h"
#include "rhombicFieldSampling.h"
#include "rhombicShapeFields.h"
#include "rhombicVTKIsosurface.h"

#include "itkBSplineInterpolateImageFunction.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkResampleImageFilter.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<float, 3>;
using LatticeType = itk::FCCImage<float>;

constexpr double densities[] = { itk::FCCLattice::NyquistDensity, 0.5 };

AccuracyResult
Judge(const itk::TriangleSurface & surface, const ReferenceField & field, unsigned int size)
{
  constexpr double margin = 3.0; // h from the outermost samples
  const double end = size - 1.0 - margin;
  const auto topology = itk::ComputeTopology(surface);
  AccuracyResult result;
  result.errors = ComputeSurfaceErrors(surface, field, { { margin, margin, margin }, { end, end, end }, 1.0 });
  result.nonManifold = topology.nonManifoldEdges + topology.nonManifoldPoints;
  result.degenerate = topology.degenerateTriangles;
  return result;
}

AccuracyResult
JudgeMarchingCubes(const VolumeType * volume, const ReferenceField & field, unsigned int size)
{
  const auto mesh = ExtractWithVTK(VTKExtractor::FlyingEdges, ShareWithVTK(volume), 0.0, true);
  return Judge(*PolyDataToSurface(mesh), field, size);
}

/** Resamples a volume to the grid of \a geometry, by the cubic B-spline. */
VolumeType::Pointer
Coarsen(const VolumeType * volume, const VolumeType * geometry)
{
  const auto filter = itk::ResampleImageFilter<VolumeType, VolumeType>::New();
  filter->SetInput(volume);
  filter->SetInterpolator(itk::BSplineInterpolateImageFunction<VolumeType, double, double>::New()); // of order 3
  filter->SetOutputParametersFromImage(geometry);
  filter->Update();
  return filter->GetOutput();
}

/** Adds the result of one seed to the sums of mesh number \a mesh, and increments this number. */
void
Add(std::vector<AccuracyResult> & results, std::size_t & mesh, const AccuracyResult & more)
{
  if (mesh == results.size())
  {
    results.push_back(more);
    ++mesh;
    return;
  }
  AccuracyResult & sum = results[mesh++];
  sum.nonManifold += more.nonManifold;
  sum.degenerate += more.degenerate;
  SurfaceErrors & a = sum.errors;
  const SurfaceErrors & b = more.errors;
  a.triangles += b.triangles;
  a.area += b.area;
  a.meanDistance += b.meanDistance;
  a.rmsDistance += b.rmsDistance;
  a.distance99 += b.distance99;
  a.maximumDistance = std::max(a.maximumDistance, b.maximumDistance);
  a.facetNormalError += b.facetNormalError;
  a.vertexNormalError += b.vertexNormalError;
  a.meanQuality += b.meanQuality;
  a.poorFraction += b.poorFraction;
  a.unresolvedFraction += b.unresolvedFraction;
}

void
DivideBy(double seeds, SurfaceErrors & errors)
{
  for (double * const value : { &errors.area,
                                &errors.meanDistance,
                                &errors.rmsDistance,
                                &errors.distance99,
                                &errors.facetNormalError,
                                &errors.vertexNormalError,
                                &errors.meanQuality,
                                &errors.poorFraction,
                                &errors.unresolvedFraction })
  {
    *value /= seeds;
  }
}

} // namespace

const std::vector<AccuracyCase> &
GetAccuracyCases()
{
  static const std::vector<AccuracyCase> cases{ { "sphere", false, 0.55, 1.05, 0.0 },
                                                { "torus", false, 0.55, 1.05, 0.0 },
                                                { "band-limited 0.25", false, 0.65, 1.05, 0.25 },
                                                { "band-limited 0.50", true, 0.75, 1.05, 0.5 },
                                                { "band-limited 0.75", true, 0.85, 1.1, 0.75 } };
  return cases;
}

std::unique_ptr<ReferenceField>
MakeField(const AccuracyCase & experiment, unsigned int size, std::uint64_t seed)
{
  if (experiment.bandLimit > 0.0)
  {
    return std::make_unique<BandLimitedField>(experiment.bandLimit, seed);
  }
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5; };
  const double half = (size - 1) / 2.0;
  const Vector3 center{ half + uniform(), half + uniform(), half + uniform() };
  if (experiment.name == std::string("sphere"))
  {
    return std::make_unique<SphereField>(center, 0.325 * size);
  }
  const Vector3 axis{ uniform(), uniform(), uniform() };
  return std::make_unique<TorusField>(center, axis, 0.27 * size, 0.125 * size);
}

std::vector<AccuracyResult>
RunAccuracyCase(const AccuracyCase & experiment, unsigned int size, unsigned int seeds)
{
  std::vector<AccuracyResult> results;
  for (unsigned int seed = 1; seed <= seeds; ++seed)
  {
    std::size_t meshNumber = 0;
    const auto field = MakeField(experiment, size, seed);
    const auto volume = SampleOnGrid<float>(*field, size, 1.0);
    AccuracyResult result = JudgeMarchingCubes(volume, *field, size);
    result.mesh = "marching cubes";
    result.isReference = true;
    Add(results, meshNumber, result);

    for (const double density : densities)
    {
      const auto resampler = itk::CartesianToFCCImageFilter<VolumeType>::New();
      resampler->SetInput(volume);
      resampler->SetDensity(density);
      resampler->Update();
      const LatticeType::ConstPointer resampledLattice = resampler->GetOutput();
      const auto exactLattice = LatticeType::New();
      exactLattice->CopyInformation(resampledLattice);
      exactLattice->SetRegions(resampledLattice->GetLargestPossibleRegion());
      SampleField(*field, 1.0, exactLattice.GetPointer());

      const double spacing = std::cbrt(1.0 / density);
      const auto exactVolume =
        SampleOnGrid<float>(*field, static_cast<itk::SizeValueType>((size - 1) / spacing) + 1, spacing);
      const VolumeType::ConstPointer resampledVolume = Coarsen(volume, exactVolume);

      for (const SampleSource source : { SampleSource::Exact, SampleSource::Resampled })
      {
        const bool isExact = source == SampleSource::Exact;
        const auto add = [&](AccuracyResult more, const std::string & mesh) {
          more.mesh = mesh;
          more.source = source;
          more.density = density;
          Add(results, meshNumber, more);
        };
        add(JudgeMarchingCubes(isExact ? exactVolume.GetPointer() : resampledVolume.GetPointer(), *field, size),
            "marching cubes, fewer samples");
        for (const ExtractionMode mode : GetExtractionModes())
        {
          const LatticeType * const lattice = isExact ? exactLattice.GetPointer() : resampledLattice.GetPointer();
          add(Judge(*ExtractSurface(lattice, 0.0, mode, true, true), *field, size), NameOf(mode));
        }
      }
    }
  }
  for (AccuracyResult & result : results)
  {
    DivideBy(seeds, result.errors);
  }
  return results;
}

} // namespace rhombic
