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
 * \brief Closes a file descriptor with itself. */
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

/** What the program asks the server of workers. */
struct ServerRequest
{
  enum class Kind : std::uint32_t
  {
    Start, ///< a worker, which gets the socket that comes with it
    Wait   ///< for the end of a worker
  };

  Kind kind = Kind::Start;
  pid_t pid = 0; ///< to wait for
};

struct ServerReply
{
  pid_t pid = 0;  ///< of the new worker; negative when it could not be made
  int status = 0; ///< of the ended worker, as waitpid() has it
};

/** What the program asks a worker, beside the file's path. Memory to write the voxels to comes with it, unless that of
 * the last request is large enough. */
struct WorkerRequest
{
  VoxelRequest::Source source = VoxelRequest::Source::DicomFile;
  std::uint64_t size = 0;    ///< of the voxels, in bytes
  std::uint64_t memory = 0;  ///< bytes that the worker may take besides what it has
  std::uint64_t seconds = 0; ///< of processor time that it may take
};

/** What a worker answers, beside a sentence when it failed. */
struct WorkerReply
{
  static constexpr std::uint32_t Mark = 0x52484d42;

  std::uint32_t mark = Mark;
  std::int32_t failure = 0; ///< a FailureKind; 0: the voxels are there
  std::uint64_t size = 0;   ///< bytes written
};

constexpr std::size_t LongestMessageText = 8192;

/** Sends a struct of plain numbers, a text of at most LongestMessageText (the rest is cut off), and a descriptor unless
 * it is negative. False when there is nobody at the other end. */
template <typename TMessage>
bool
SendMessage(int socket, const TMessage & message, const std::string & text = {}, int descriptor = -1);

/** What SendMessage() sent. */
template <typename TMessage>
struct ReceivedMessage
{
  TMessage message;
  std::string text;
  FileDescriptor descriptor;
};

/** Waits for a message; nothing when the other end is closed or sent something else. */
template <typename TMessage>
std::optional<ReceivedMessage<TMessage>>
ReceiveMessage(int socket);

/** Two ends of a new socket that keeps messages apart; false when there can't be one. */
bool
MakeSocketPair(FileDescriptor & first, FileDescriptor & second);

} // namespace rhombic

#endif
