#ifndef rhombicDecodingWorker_h
#define rhombicDecodingWorker_h

namespace rhombic
{

/** What a worker of IsolatedDecoder does: unpacks voxels as it is asked to on the socket, into memory that comes with
 * the request. Ends with the socket, or after the first failure, because a library that failed may have damaged its own
 * state. */
[[noreturn]] void
RunDecodingWorker(int socket);

} // namespace rhombic

#endif
