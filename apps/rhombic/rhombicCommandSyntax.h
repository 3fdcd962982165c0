#ifndef rhombicCommandSyntax_h
#define rhombicCommandSyntax_h

#include "rhombicPipelineFile.h"

namespace rhombic
{

/** The settings of the commands render, mesh and resample, for pipeline files. */
CommandSyntax
GetCommandSyntax();

} // namespace rhombic

#endif
