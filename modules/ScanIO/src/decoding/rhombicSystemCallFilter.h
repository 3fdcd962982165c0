#ifndef rhombicSystemCallFilter_h
#define rhombicSystemCallFilter_h

namespace rhombic
{

/** From now on this process can start no threads, processes or programs, open no sockets, change nothing in the file
 * system and reach no other process by signals or its memory: these calls fail with EPERM. Without effect on kernels that can't do it, and on processors other than x86-64 and ARM64. Can't be undone. */
void
ForbidAllButDecoding();

} // namespace rhombic

#endif
