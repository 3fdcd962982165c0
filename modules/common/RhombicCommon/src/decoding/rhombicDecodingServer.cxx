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

/** Ends this process when its parent ends. */
void
EndWithParent(pid_t parent)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
  {
    _exit(0);
  }
}

/** Closes all files of the program but standard streams and one descriptor. An open socket would keep the server of
 * another IsolatedDecoder alive. */
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

/** Replaces the standard streams by /dev/null and the program's signal handlers by the default ones. */
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
  // The socket is closed when the program ends. PR_SET_PDEATHSIG would end this process with the thread that forked it.
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
