#ifndef rhombicUsageError_h
#define rhombicUsageError_h

#include <CLI/CLI.hpp>

#include <string>

namespace rhombic
{

/** What is wrong with the command line that \a program refused with \a error: a sentence that names the command or
 * option, one that is near if it is unknown, and where the right ones are listed. */
std::string
DescribeUsageError(const CLI::App & program, const CLI::ParseError & error);

} // namespace rhombic

#endif
