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
 * \brief What is measured on. */
struct BenchInput
{
  itk::Image<std::int16_t, 3>::ConstPointer volume;
  double isovalue = 0.0; ///< in units of the pixels
  double density = 0.0;  ///< lattice sites per voxel
};

/** \class BenchSettings
 * \brief How it is measured. */
struct BenchSettings
{
  unsigned int threads = 1;
  unsigned int repeats = 7;     ///< pairs of which the median is taken
  unsigned int slowRepeats = 1; ///< the same where the reference takes minutes
};

/** \class BenchResult
 * \brief One line of the report: how a piece of work compares with the reference for it. */
struct BenchResult
{
  std::string section;
  std::string candidate;
  std::string reference;
  unsigned int threads = 1;
  PairedTimes times;
  std::optional<double> target; ///< the ratio it must reach
  nlohmann::json details;       ///< what else is worth knowing: sizes of meshes, differences
};

/** Every extraction mode against vtkFlyingEdges3D and vtkMarchingCubes. */
std::vector<BenchResult>
MeasureExtraction(const BenchInput & input, const BenchSettings & settings);

/** Every kernel against itk::ResampleImageFilter with the interpolator of the same kernel. */
std::vector<BenchResult>
MeasureResampling(const BenchInput & input, const BenchSettings & settings);

/** Cubic B-spline resampling and extraction together against vtkFlyingEdges3D alone. */
std::vector<BenchResult>
MeasurePipeline(const BenchInput & input, const BenchSettings & settings);

/** Extraction against no more than reading its input and writing its output once. */
std::vector<BenchResult>
MeasureFloor(const BenchInput & input, const BenchSettings & settings);

/** Samples and their neighbours by iterator: itk::FCCConstNeighborhoodIterator, in one thread, against
 * itk::ConstNeighborhoodIterator over as many samples, and against a loop written by hand without borders. */
std::vector<BenchResult>
MeasureNeighbors(const BenchInput & input, const BenchSettings & settings);

/** \class MemoryResult
 * \brief Memory of one extraction in MiB. */
struct MemoryResult
{
  std::string candidate;
  unsigned int threads = 1;
  double volume = 0.0; ///< the volume's samples
  double mesh = 0.0;   ///< the arrays of the result
  double extra = 0.0;  ///< the most that was in use besides these two
};

/** Every extraction mode and vtkFlyingEdges3D. Nothing where the system does not let it be measured. */
std::vector<MemoryResult>
MeasureMemory(const BenchInput & input, const BenchSettings & settings);

} // namespace rhombic

#endif
