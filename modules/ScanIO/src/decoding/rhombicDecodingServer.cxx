#include "rhombicDecodingServer.h"

#include "rhombicDecodingMessages.h"
#include "rhombicDecodingWorker.h"

#include <cerrno>
#include <csignal>
#include <set>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

/** A process that outlives the one that made it is of no use. */
void
EndWithParent(pid_t parent)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
  {
    _exit(0);
  }
}

/** What the program has open is not for its decoders; the socket of another one's server would keep that alive. */
void
CloseAllBut(int descriptor)
{
  const auto kept = static_cast<unsigned int>(descriptor);
  if (kept > STDERR_FILENO + 1)
  {
    close_range(STDERR_FILENO + 1, kept - 1, 0);
  }
  close_range(kept + 1, ~0U, 0);
}

/** The terminal stays the program's alone, and so do the handlers of its signals. */
void
LeaveTerminal()
{
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    dup2(nothing, standard);
  }
  close(nothing);
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ })
  {
    std::signal(signal, SIG_DFL);
  }
}

pid_t
StartWorker(int serverSocket, FileDescriptor socket)
{
  const pid_t server = getpid();
  const pid_t worker = fork();
  if (worker == 0)
  {
    close(serverSocket);
    EndWithParent(server);
    RunDecodingWorker(socket.Get());
  }
  return worker;
}

int
WaitFor(pid_t pid)
{
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
  {}
  return status;
}

} // namespace

void
RunDecodingServer(int socket)
{
  // The socket's end says when the program has ended. The signal for that would come with the end of the thread that
  // made this process.
  CloseAllBut(socket);
  LeaveTerminal();
  std::set<pid_t> workers;
  while (auto request = ReceiveMessage<ServerRequest>(socket))
  {
    ServerReply reply;
    reply.pid = request->message.pid;
    if (request->message.kind == ServerRequest::Kind::Start)
    {
      reply.pid = StartWorker(socket, std::move(request->descriptor));
      workers.insert(reply.pid);
    }
    else
    {
      reply.status = WaitFor(request->message.pid);
      workers.erase(request->message.pid);
    }
    SendMessage(socket, reply);
  }
  workers.erase(-1);
  for (const pid_t worker : workers)
  {
    kill(worker, SIGKILL);
    WaitFor(worker);
  }
  _exit(0);
}

} // namespace rhombic
