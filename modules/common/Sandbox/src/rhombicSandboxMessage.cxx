#include "rhombicSandboxMessage.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>

namespace rhombic
{
namespace
{

using Descriptors = std::array<int, 2>;

/** One message of a socket, with space for descriptors. */
struct Packet
{
  explicit Packet(SandboxMessage & message)
    : content{ &message, sizeof(message) }
  {
    header.msg_iov = &content;
    header.msg_iovlen = 1;
    header.msg_control = control;
    header.msg_controllen = sizeof(control);
  }

  iovec content;
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(Descriptors))] = {};
  msghdr header{};
};

} // namespace

MappedMemory
MapFile(int descriptor, int protection)
{
  struct stat status
  {};
  if (fstat(descriptor, &status) != 0)
  {
    throw std::bad_alloc();
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void * const address = size > 0 ? mmap(nullptr, size, protection, MAP_SHARED, descriptor, 0) : nullptr;
  if (address == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  return { { static_cast<std::byte *>(address), [size](std::byte * data) { munmap(data, size); } }, size };
}

void
SendMessage(int socket, const SandboxMessage & message, int file, int slot)
{
  SandboxMessage sent = message;
  Packet packet(sent);
  const Descriptors descriptors{ file, slot };
  const std::size_t size = (file < 0 ? 0 : slot < 0 ? 1 : 2) * sizeof(int);
  packet.header.msg_controllen = size > 0 ? CMSG_SPACE(size) : 0;
  if (cmsghdr * const rights = CMSG_FIRSTHDR(&packet.header))
  {
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(size);
    std::memcpy(CMSG_DATA(rights), descriptors.data(), size);
  }
  while (sendmsg(socket, &packet.header, MSG_NOSIGNAL) < 0 && errno == EINTR)
  {}
}

std::optional<ReceivedMessage>
ReceiveMessage(int socket)
{
  ReceivedMessage received;
  Packet packet(received);
  ssize_t count = 0;
  do
  {
    count = recvmsg(socket, &packet.header, MSG_CMSG_CLOEXEC);
  } while (count < 0 && errno == EINTR);
  const cmsghdr * const rights = count > 0 ? CMSG_FIRSTHDR(&packet.header) : nullptr;
  if (rights != nullptr && rights->cmsg_type == SCM_RIGHTS)
  {
    Descriptors descriptors{ -1, -1 };
    std::memcpy(descriptors.data(), CMSG_DATA(rights), std::min(sizeof(descriptors), rights->cmsg_len - CMSG_LEN(0)));
    received.file = FileDescriptor(descriptors[0]);
    received.slot = FileDescriptor(descriptors[1]);
  }
  received.text.back() = '\0';
  return count == sizeof(SandboxMessage) ? std::optional(std::move(received)) : std::nullopt;
}

} // namespace rhombic
