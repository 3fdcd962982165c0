#ifndef rhombicSystemCallFilter_h
#define rhombicSystemCallFilter_h

namespace rhombic
{

/** Forbids this process to start threads, processes or programs, open sockets, change the file system, and send signals
 * to other processes or access their memory: these system calls fail with EPERM. Can't be undone. Does nothing on
 * kernels without seccomp and on processors other than x86-64 and ARM64. */
void
ForbidAllButDecoding();

} // namespace rhombic

#endif
