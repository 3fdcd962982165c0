#ifndef rhombicDecodingServer_h
#define rhombicDecodingServer_h

namespace rhombic
{

/** What the process does that IsolatedDecoder forks: makes workers as it is asked to on the socket, and says how they
 * ended. Ends with the socket. Must have one thread. */
[[noreturn]] void
RunDecodingServer(int socket);

} // namespace rhombic

#endif
