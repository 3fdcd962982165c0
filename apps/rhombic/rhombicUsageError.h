#ifndef rhombicUsageError_h
#define rhombicUsageError_h

#include "rhombicFailure.h"

#include <CLI/CLI.hpp>

#include <string>

namespace rhombic
{

/** A sentence about settings that \a program refused with \a error. It names the command or option, the nearest one if
 * it is unknown, and the help that lists all.
 * \param command whose settings they are; the program if none is named */
std::string
DescribeUsageError(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error);

/** The failure, with its exit code, of the exception that is being handled. */
Failure
FailureOfException();

} // namespace rhombic

#endif
