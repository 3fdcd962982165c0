#include "rhombicDecodingMessages.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include <sys/socket.h>
#include <unistd.h>

namespace rhombic
{

void
FileDescriptor::Close()
{
  if (m_Descriptor >= 0)
  {
    close(this->Release());
  }
}

bool
MakeSocketPair(FileDescriptor & first, FileDescriptor & second)
{
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
  {
    return false;
  }
  first = FileDescriptor(ends[0]);
  second = FileDescriptor(ends[1]);
  return true;
}

template <typename TMessage>
bool
SendMessage(int socket, const TMessage & message, const std::string & text, int descriptor)
{
  std::string sentText = text.substr(0, LongestMessageText);
  TMessage sentMessage = message;
  iovec parts[2] = { { &sentMessage, sizeof(sentMessage) }, { sentText.data(), sentText.size() } };
  msghdr header{};
  header.msg_iov = parts;
  header.msg_iovlen = 2;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  if (descriptor >= 0)
  {
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    cmsghdr * const rights = CMSG_FIRSTHDR(&header);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(rights), &descriptor, sizeof(int));
  }
  ssize_t sent = 0;
  do
  {
    sent = sendmsg(socket, &header, MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(sizeof(sentMessage) + sentText.size());
}

template <typename TMessage>
std::optional<ReceivedMessage<TMessage>>
ReceiveMessage(int socket)
{
  ReceivedMessage<TMessage> received;
  std::vector<char> text(LongestMessageText);
  iovec parts[2] = { { &received.message, sizeof(received.message) }, { text.data(), text.size() } };
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr header{};
  header.msg_iov = parts;
  header.msg_iovlen = 2;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  ssize_t count = 0;
  do
  {
    count = recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
  } while (count < 0 && errno == EINTR);
  const cmsghdr * const rights = count > 0 ? CMSG_FIRSTHDR(&header) : nullptr;
  if (rights != nullptr && rights->cmsg_level == SOL_SOCKET && rights->cmsg_type == SCM_RIGHTS)
  {
    int descriptor = -1;
    std::memcpy(&descriptor, CMSG_DATA(rights), sizeof(int));
    received.descriptor = FileDescriptor(descriptor);
  }
  if (count < static_cast<ssize_t>(sizeof(TMessage)))
  {
    return {};
  }
  received.text.assign(text.data(), static_cast<std::size_t>(count) - sizeof(TMessage));
  return received;
}

template bool
SendMessage(int, const ServerRequest &, const std::string &, int);
template bool
SendMessage(int, const ServerReply &, const std::string &, int);
template bool
SendMessage(int, const WorkerRequest &, const std::string &, int);
template bool
SendMessage(int, const WorkerReply &, const std::string &, int);
template std::optional<ReceivedMessage<ServerRequest>>
ReceiveMessage(int);
template std::optional<ReceivedMessage<ServerReply>>
ReceiveMessage(int);
template std::optional<ReceivedMessage<WorkerRequest>>
ReceiveMessage(int);
template std::optional<ReceivedMessage<WorkerReply>>
ReceiveMessage(int);

} // namespace rhombic
