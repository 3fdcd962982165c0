#ifndef rhombicRunBenchmark_h
#define rhombicRunBenchmark_h

#include <CLI/CLI.hpp>

#include <functional>

namespace rhombic
{

/** Parses the command line, then runs. Returns the exit code, those of `rhombic --help`; what goes wrong is one
 * sentence on the standard error. */
int
RunBenchmark(CLI::App & parser, int argc, char ** argv, const std::function<void()> & run);

} // namespace rhombic

#endif
