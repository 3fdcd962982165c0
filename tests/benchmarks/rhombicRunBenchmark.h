#ifndef rhombicRunBenchmark_h
#define rhombicRunBenchmark_h

#include <CLI/CLI.hpp>

#include <functional>

namespace rhombic
{

/** Parses the command line, then calls \a run. Prints a failure as one sentence on the standard error. Returns the exit
 * code, one of those in `rhombic --help`. */
int
RunBenchmark(CLI::App & parser, int argc, char ** argv, const std::function<void()> & run);

} // namespace rhombic

#endif
