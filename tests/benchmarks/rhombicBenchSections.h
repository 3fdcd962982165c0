#ifndef rhombicBenchSections_h
#define rhombicBenchSections_h

#include "rhombicPairedTimes.h"

#include "itkImage.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class BenchInput
 * \brief The volume to measure with. */
struct BenchInput
{
  itk::Image<std::int16_t, 3>::ConstPointer volume;
  bool isScan = false;   ///< or a gyroid
  double isovalue = 0.0; ///< in units of the pixels
  double density = 0.0;  ///< lattice sites per voxel
};

/** \class BenchSettings
 * \brief The number of threads and of runs. */
struct BenchSettings
{
  unsigned int threads = 1;
  unsigned int repeats = 7;     ///< number of pairs of runs
  unsigned int slowRepeats = 1; ///< number of pairs where the reference takes minutes
};

/** \class BenchResult
 * \brief One line of the report: the times of a candidate and of its reference. */
struct BenchResult
{
  std::string section;
  std::string candidate;
  std::string reference;
  unsigned int threads = 1;
  PairedTimes times;
  std::optional<double> target; ///< the ratio to reach
  nlohmann::json details;       ///< sizes of meshes, differences
};

/** Compares every extraction mode with vtkFlyingEdges3D and vtkMarchingCubes. */
std::vector<BenchResult>
MeasureExtraction(const BenchInput & input, const BenchSettings & settings);

/** Compares every kernel with itk::ResampleImageFilter with the interpolator of the same kernel. */
std::vector<BenchResult>
MeasureResampling(const BenchInput & input, const BenchSettings & settings);

/** Compares cubic B-spline resampling and extraction together with vtkFlyingEdges3D alone. */
std::vector<BenchResult>
MeasurePipeline(const BenchInput & input, const BenchSettings & settings);

/** Compares extraction with reading its input and writing its output once. */
std::vector<BenchResult>
MeasureFloor(const BenchInput & input, const BenchSettings & settings);

/** Compares itk::FCCConstNeighborhoodIterator with itk::ConstNeighborhoodIterator over as many samples, and with a
 * hand-written loop without borders, on one thread. */
std::vector<BenchResult>
MeasureNeighbors(const BenchInput & input, const BenchSettings & settings);

/** \class MemoryResult
 * \brief Memory of one extraction in MiB. */
struct MemoryResult
{
  std::string candidate;
  unsigned int threads = 1;
  double volume = 0.0; ///< of the volume's samples
  double mesh = 0.0;   ///< of the mesh's arrays
  double extra = 0.0;  ///< the largest amount in use besides these two
};

/** Measures every extraction mode and vtkFlyingEdges3D. No results where ResetPeakMemory() does not work. */
std::vector<MemoryResult>
MeasureMemory(const BenchInput & input, const BenchSettings & settings);

} // namespace rhombic

#endif
