#ifndef rhombicExperimentRun_h
#define rhombicExperimentRun_h

#include "rhombicComparison.h"

#include "itkTriangleSurface.h"

namespace rhombic
{

/** The figures of an experiment, and the surfaces of its first field. */
struct ExperimentRun
{
  ExperimentResult result;
  itk::TriangleSurface::Pointer truth;
  std::vector<itk::TriangleSurface::Pointer> surfaces; ///< of the rows
  std::vector<itk::SizeValueType> samples;
};

ExperimentRun
RunExperiment(const Experiment & experiment, unsigned int repeats, const Events & events);

} // namespace rhombic

#endif
