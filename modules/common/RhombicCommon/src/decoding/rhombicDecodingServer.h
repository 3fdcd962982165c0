#ifndef rhombicDecodingServer_h
#define rhombicDecodingServer_h

namespace rhombic
{

/** Runs the server process of IsolatedDecoder: starts workers on request and reports how they ended. Returns never; the
 * process ends when the socket is closed. It must have one thread only. */
[[noreturn]] void
RunDecodingServer(int socket);

} // namespace rhombic

#endif
