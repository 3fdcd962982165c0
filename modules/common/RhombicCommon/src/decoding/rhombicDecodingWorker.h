#ifndef rhombicDecodingWorker_h
#define rhombicDecodingWorker_h

namespace rhombic
{

/** Runs a worker process of IsolatedDecoder: decodes files on request into the memory that is sent with the request.
 * The process ends when the socket is closed, or after the first failure, as a library that failed may have damaged its
 * own state. */
[[noreturn]] void
RunDecodingWorker(int socket);

} // namespace rhombic

#endif
