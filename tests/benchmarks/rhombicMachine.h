#ifndef rhombicMachine_h
#define rhombicMachine_h

#include <nlohmann/json.hpp>

namespace rhombic
{

/** What figures depend on: {"cpu", "threads", "simd", "compiler", "itk", "vtk", "load"}; simd is the best instruction
 * set that Highway finds, load the mean number of busy threads of the last minute, our own included. */
nlohmann::json
DescribeMachine();

/** Lets ITK and VTK use this many threads. Call it with growing numbers: ITK's pool never shrinks. */
void
UseThreads(unsigned int threads);

} // namespace rhombic

#endif
