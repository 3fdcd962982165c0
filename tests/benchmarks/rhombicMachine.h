#ifndef rhombicMachine_h
#define rhombicMachine_h

#include <nlohmann/json.hpp>

namespace rhombic
{

/** The machine and libraries: {"cpu", "threads", "simd", "compiler", "itk", "vtk", "load"}. "simd" is the best
 * instruction set that Highway finds, "load" the mean number of busy threads in the last minute, including this
 * program's. */
nlohmann::json
DescribeMachine();

/** Sets the number of threads of ITK and VTK. Numbers must not decrease from call to call: ITK's pool never shrinks. */
void
UseThreads(unsigned int threads);

} // namespace rhombic

#endif
