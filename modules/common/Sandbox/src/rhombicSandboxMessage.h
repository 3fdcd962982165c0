#ifndef rhombicSandboxMessage_h
#define rhombicSandboxMessage_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <unistd.h>

namespace rhombic
{

/** \class FileDescriptor
 * \brief Owns a file descriptor, if it is not negative. */
class FileDescriptor
{
public:
  explicit FileDescriptor(int descriptor = -1)
    : m_Descriptor(descriptor)
  {}
  FileDescriptor(FileDescriptor && other) noexcept
    : m_Descriptor(std::exchange(other.m_Descriptor, -1))
  {}
  FileDescriptor &
  operator=(FileDescriptor && other) noexcept
  {
    std::swap(m_Descriptor, other.m_Descriptor);
    return *this;
  }
  ~FileDescriptor()
  {
    if (m_Descriptor >= 0)
    {
      close(m_Descriptor);
    }
  }

  int
  Get() const
  {
    return m_Descriptor;
  }

private:
  int m_Descriptor;
};

/** The bytes of an open file, in memory that is shared with whoever else has it. */
struct MappedMemory
{
  std::shared_ptr<std::byte> data; ///< null for an empty file
  std::size_t size = 0;
};

/** \param protection as of mmap(). Throws std::bad_alloc. */
MappedMemory
MapFile(int descriptor, int protection);

/** What a program and its child say to each other. */
struct SandboxMessage
{
  enum class Kind : std::uint64_t
  {
    // to the child
    Start,      ///< unpack a file
    Continue,   ///< a piece was used: the child may write in its place
                // from the child
    Piece,      ///< bytes in the slot are unpacked
    Done,       ///< there is no more, and the child waits for the next file
    Refused,    ///< the file is damaged. The child ends
    OutOfMemory ///< the limit of memory was reached. The child ends
  };

  Kind kind = Kind::Start;
  std::uint64_t offset = 0;      ///< Piece: where it begins in the slot
  std::uint64_t size = 0;        ///< Piece: its bytes; Start: the largest number of them
  std::uint64_t arguments = 0;   ///< Start: the size of the arguments, which are at the beginning of the slot
  std::uint64_t memory = 0;      ///< Start: bytes that the child may allocate
  std::uint64_t seconds = 0;     ///< Start: processor time of the child for each piece
  std::array<char, 4096> text{}; ///< Refused: why; ends with a zero
};

/** A message that was received, with its descriptors. */
struct ReceivedMessage : SandboxMessage
{
  FileDescriptor file; ///< Start
  FileDescriptor slot; ///< Start; none if the slot is still that of the file before
};

/** The size of the place of a piece in the slot, which has two of them: they are aligned for any number. */
constexpr std::size_t
SizeInSlot(std::size_t pieceSize)
{
  return (pieceSize + 63) / 64 * 64;
}

/** The exit code of a helper of another version, as of a program that its libraries keep from starting. */
constexpr int SandboxCannotRun = 127;

/** Sends a message, and descriptors unless they are negative. One to a process that has ended is lost. */
void
SendMessage(int socket, const SandboxMessage & message, int file = -1, int slot = -1);

/** Waits for a message. Nothing when the other end is closed or sent something else. */
std::optional<ReceivedMessage>
ReceiveMessage(int socket);

} // namespace rhombic

#endif
