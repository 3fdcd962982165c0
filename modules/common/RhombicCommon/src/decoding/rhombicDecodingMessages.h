#ifndef rhombicDecodingMessages_h
#define rhombicDecodingMessages_h

#include "rhombicVoxelDecoder.h"

#include <cstdint>
#include <optional>
#include <string>

#include <sys/types.h>

namespace rhombic
{

/** \class FileDescriptor
 * \brief Owns a file descriptor: the destructor closes it. */
class FileDescriptor
{
public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor)
    : m_Descriptor(descriptor)
  {}
  FileDescriptor(FileDescriptor && other) noexcept
    : m_Descriptor(other.Release())
  {}
  FileDescriptor &
  operator=(FileDescriptor && other) noexcept
  {
    this->Close();
    m_Descriptor = other.Release();
    return *this;
  }
  ~FileDescriptor()
  {
    this->Close();
  }

  int
  Get() const
  {
    return m_Descriptor;
  }

  int
  Release()
  {
    const int descriptor = m_Descriptor;
    m_Descriptor = -1;
    return descriptor;
  }

  void
  Close();

private:
  int m_Descriptor = -1;
};

/** A request of the program to the server of workers. */
struct ServerRequest
{
  enum class Kind : std::uint32_t
  {
    Start, ///< start a worker with the socket that is sent with the message
    Wait   ///< wait for the end of a worker
  };

  Kind kind = Kind::Start;
  pid_t pid = 0; ///< the worker to wait for
};

struct ServerReply
{
  pid_t pid = 0;  ///< the new worker; negative when it could not be started
  int status = 0; ///< how the worker ended, from waitpid()
};

/** A request of the program to a worker. The text of the message is the file's path; its descriptor is the memory for
 * the decoded bytes, unless that of the previous request is large enough. */
struct WorkerRequest
{
  VoxelRequest::Function decode = nullptr; ///< at the same address in the worker, which is a copy of the program
  std::uint64_t size = 0;                  ///< the largest number of decoded bytes
  std::uint64_t memory = 0;                ///< bytes that the worker may allocate
  std::uint64_t seconds = 0;               ///< processor time that the worker may use
};

/** The reply of a worker. The text of the message is a sentence when it failed. */
struct WorkerReply
{
  static constexpr std::uint32_t Mark = 0x52484d42;

  std::uint32_t mark = Mark;
  std::int32_t failure = 0; ///< a FailureKind; 0 for success
  std::uint64_t size = 0;   ///< bytes written
};

constexpr std::size_t LongestMessageText = 8192;

/** Sends a struct of plain numbers, a text of at most LongestMessageText bytes (the rest is cut off), and a descriptor
 * unless it is negative. False when the other end is closed. */
template <typename TMessage>
bool
SendMessage(int socket, const TMessage & message, const std::string & text = {}, int descriptor = -1);

/** A message of SendMessage(). */
template <typename TMessage>
struct ReceivedMessage
{
  TMessage message;
  std::string text;
  FileDescriptor descriptor;
};

/** Waits for a message. Nothing when the other end is closed or sent something else. */
template <typename TMessage>
std::optional<ReceivedMessage<TMessage>>
ReceiveMessage(int socket);

/** Makes the two ends of a socket that preserves the bounds of messages. False when the system allows none. */
bool
MakeSocketPair(FileDescriptor & first, FileDescriptor & second);

} // namespace rhombic

#endif
