#include "rhombicSandbox.h"

#include "rhombicChildProcess.h"
#include "rhombicFailure.h"
#include "rhombicSandboxMessage.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <map>
#include <mutex>
#include <new>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

/** The folder of the helpers, which CMake compiles into programs that use the package Rhombic; absent in others. */
extern "C" const char rhombicHelperFolder[] __attribute__((weak));

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const fs::path & path, const std::string & why, FailureKind kind = FailureKind::Unreadable)
{
  throw Failure(kind, "Cannot read " + path.string() + ": " + why + ".");
}

[[noreturn]] void
RefuseDamaged(const fs::path & path, const std::string & why)
{
  Refuse(path, why + "; it is damaged, so copy it again from its source");
}

/** Memory of a fixed size that can be shared with a child, which can't make it smaller while this process reads it.
 * Throws std::bad_alloc. */
FileDescriptor
MakeSlot(std::size_t size)
{
  FileDescriptor slot(memfd_create("slot", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (slot.Get() < 0 || ftruncate(slot.Get(), static_cast<off_t>(size)) != 0 ||
      fcntl(slot.Get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0)
  {
    throw std::bad_alloc();
  }
  return slot;
}

/** Throws Failure when it is no file. */
FileDescriptor
OpenFile(const fs::path & path)
{
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)); // pipes would be waited for
  struct stat status
  {};
  if (file.Get() < 0)
  {
    Refuse(path, std::string(std::strerror(errno)) + "; check that it is there and yours");
  }
  if (fstat(file.Get(), &status) != 0 || !S_ISREG(status.st_mode))
  {
    Refuse(path, "it is a device or pipe; give a file");
  }
  return file;
}

/** The limit of processor time for a piece. */
unsigned int
SecondsOf(const SandboxJob & job)
{
  return job.limits.seconds + static_cast<unsigned int>(job.pieceSize / (4u << 20));
}

/** Looks for the helper in the folder of this program, in that of Rhombic's helpers beside it, and in that of the
 * package Rhombic. */
fs::path
FindHelper(const SandboxJob & job)
{
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::string> folders{ folder.string(), (folder / RHOMBIC_HELPER_FOLDER).lexically_normal().string() };
  if (rhombicHelperFolder != nullptr)
  {
    folders.emplace_back(rhombicHelperFolder);
  }
  for (const fs::path path : folders)
  {
    if (fs::exists(path / job.helper, error))
    {
      return path / job.helper;
    }
  }
  Refuse(job.path,
         job.helper + ", the program that unpacks it, is not in " + Enumerate(folders, "or") +
           "; install Rhombic's programs, or put it beside this program",
         FailureKind::Internal);
}

/** Whether a signal is caused by the process's own code, and not sent from outside. */
bool
IsOwnFault(int signal)
{
  constexpr int faults[] = { SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGXFSZ, SIGXCPU };
  return std::find(std::begin(faults), std::end(faults), signal) != std::end(faults);
}

std::string
NameOfSignal(int signal)
{
  const char * const name = sigabbrev_np(signal);
  return "SIG" + std::string(name == nullptr ? "?" : name);
}

/** Throws the reason for which a helper ended by itself. */
[[noreturn]] void
FailByEnd(const SandboxJob & job, int code)
{
  if (code == SandboxCannotRun)
  {
    Refuse(job.path,
           job.helper + ", the program that unpacks it, can't run, or belongs to another version of Rhombic; "
                        "install Rhombic's programs again",
           FailureKind::Internal);
  }
  if (code < 0 && !IsOwnFault(-code))
  {
    const bool isMemory = -code == SIGKILL; // the signal of the kernel when memory runs out
    Refuse(job.path,
           "its decoder was killed from outside (" + NameOfSignal(-code) + ")" +
             (isMemory ? ", as happens when memory runs out; try again with other programs closed" : "; try again"),
           isMemory ? FailureKind::Memory : FailureKind::Internal);
  }
  if (-code == SIGXCPU)
  {
    RefuseDamaged(job.path, "its decoder took more than " + std::to_string(SecondsOf(job)) + " seconds");
  }
  RefuseDamaged(job.path,
                code < 0 ? "its decoder crashed (" + NameOfSignal(-code) + ")" : "its decoder ended without an answer");
}

} // namespace

/** \class SandboxProcess
 * \brief A helper that runs, and the memory that it shares with this process. */
class SandboxProcess
{
public:
  /** Starts the helper of a job. */
  explicit SandboxProcess(const SandboxJob & job)
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    {
      Refuse(job.path, std::string("no process can be started: ") + std::strerror(errno), KindOfStartError(errno));
    }
    m_Socket = FileDescriptor(ends[0]);
    const FileDescriptor itsEnd(ends[1]);
    ChildSettings settings;
    settings.arguments = { FindHelper(job).string(), RHOMBIC_SANDBOX_VERSION };
    settings.socket = itsEnd.Get();
    m_Process.emplace(settings);
  }

  /** Sends the file of a job. */
  void
  Start(const SandboxJob & job)
  {
    const FileDescriptor file = OpenFile(job.path);
    const std::size_t size = std::max(2 * SizeInSlot(job.pieceSize), job.arguments.size());
    const FileDescriptor newSlot(m_Slot.size < size ? MakeSlot(size) : FileDescriptor());
    m_Slot = m_Slot.size < size ? MapFile(newSlot.Get(), PROT_READ | PROT_WRITE) : m_Slot;
    std::memcpy(m_Slot.data.get(), job.arguments.data(), job.arguments.size());
    SandboxMessage message;
    message.size = job.pieceSize;
    message.arguments = job.arguments.size();
    message.memory = job.limits.memory + 4 * std::uint64_t{ job.pieceSize };
    message.seconds = SecondsOf(job);
    SendMessage(m_Socket.Get(), message, file.Get(), newSlot.Get());
  }

  /** Lets the helper write in the place of the last piece. */
  void
  Continue()
  {
    SendMessage(m_Socket.Get(), { SandboxMessage::Kind::Continue });
  }

  /** Waits for a message about the job. Nothing when the helper has ended, took too long, or has sent nonsense. */
  std::optional<SandboxMessage>
  Receive(const SandboxJob & job)
  {
    pollfd waiting{ m_Socket.Get(), POLLIN, 0 };
    const auto milliseconds =
      static_cast<int>(std::min<std::uint64_t>(std::uint64_t{ SecondsOf(job) } * job.limits.patience * 1000, 1u << 30));
    int ready = 0;
    do
    {
      ready = poll(&waiting, 1, milliseconds);
    } while (ready < 0 && errno == EINTR);
    m_IsLate = ready == 0;
    const auto received = m_IsLate ? std::nullopt : ReceiveMessage(m_Socket.Get());
    const bool isSense = received && received->kind >= SandboxMessage::Kind::Piece &&
                         received->kind <= SandboxMessage::Kind::OutOfMemory && received->offset <= m_Slot.size &&
                         received->size <= std::min(m_Slot.size - received->offset, job.pieceSize);
    return isSense ? std::optional<SandboxMessage>(*received) : std::nullopt;
  }

  /** Whether its memory is small enough to wait for another file. */
  bool
  IsWorthKeeping() const
  {
    constexpr std::size_t largest = 64 << 20;
    return m_Slot.size <= largest;
  }

  SandboxPiece
  GetPiece(const SandboxMessage & message) const
  {
    return { m_Slot.data.get() + message.offset, message.size };
  }

  /** Ends the helper, and throws the reason for its last message or its silence. */
  [[noreturn]] void
  Fail(const SandboxJob & job, const std::optional<SandboxMessage> & message)
  {
    if (message && message->kind == SandboxMessage::Kind::Refused)
    {
      std::string why = message->text.data();
      std::replace_if(
        why.begin(), why.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; }, ' ');
      Refuse(job.path, why);
    }
    if (message)
    {
      RefuseDamaged(job.path,
                    "its decoder wanted more than " + std::to_string(job.limits.memory >> 20) +
                      " MiB besides its content");
    }
    pollfd closed{ m_Socket.Get(), POLLIN, 0 };
    poll(&closed, 1, 0);
    m_Process->Kill(); // no effect if it has ended
    m_Process->Wait();
    if (m_IsLate)
    {
      RefuseDamaged(job.path,
                    "its decoder took more than " + std::to_string(SecondsOf(job) * job.limits.patience) +
                      " seconds on the clock");
    }
    if ((closed.revents & POLLHUP) == 0)
    {
      RefuseDamaged(job.path, "its decoder gave an answer that makes no sense");
    }
    FailByEnd(job, m_Process->GetExitCode());
  }

private:
  std::optional<ChildProcess> m_Process;
  FileDescriptor m_Socket;
  MappedMemory m_Slot;   ///< for the arguments, then for two pieces
  bool m_IsLate = false; ///< whether the last message did not come in time
};

namespace
{

/** Helpers that wait for a file, by the process that has started them (this one may be forked off it) and by name.
 * They end with the process. */
struct IdleHelpers
{
  using Key = std::pair<pid_t, std::string>;
  std::mutex guard;
  std::multimap<Key, std::unique_ptr<SandboxProcess>> processes;
};

IdleHelpers &
GetIdleHelpers()
{
  static IdleHelpers idle;
  return idle;
}

/** Null if there is none. */
std::unique_ptr<SandboxProcess>
TakeIdleHelper(const std::string & name)
{
  const std::lock_guard<std::mutex> lock(GetIdleHelpers().guard);
  auto found = GetIdleHelpers().processes.extract({ getpid(), name });
  return found ? std::move(found.mapped()) : nullptr;
}

void
GiveBackHelper(const std::string & name, std::unique_ptr<SandboxProcess> process)
{
  const std::lock_guard<std::mutex> lock(GetIdleHelpers().guard);
  GetIdleHelpers().processes.emplace(IdleHelpers::Key(getpid(), name), std::move(process));
}

} // namespace

SandboxRun::SandboxRun(const SandboxJob & job)
  : m_Job(job)
  , m_Process(TakeIdleHelper(job.helper))
  , m_HadOtherFiles(m_Process != nullptr)
{
  m_Process = m_Process ? std::move(m_Process) : std::make_unique<SandboxProcess>(job);
  m_Process->Start(job);
}

SandboxRun::~SandboxRun() = default;

std::optional<SandboxPiece>
SandboxRun::Next()
{
  using Kind = SandboxMessage::Kind;
  if (!m_Process)
  {
    return {};
  }
  if (m_HasPiece)
  {
    m_Process->Continue();
  }
  auto message = m_Process->Receive(m_Job);
  const bool hasAnswer = message && message->kind != Kind::OutOfMemory;
  if (!hasAnswer && !m_HasPiece && m_HadOtherFiles)
  {
    m_Process = std::make_unique<SandboxProcess>(m_Job);
    m_Process->Start(m_Job);
    message = m_Process->Receive(m_Job);
  }
  m_HasPiece = message && message->kind == Kind::Piece;
  if (m_HasPiece)
  {
    return m_Process->GetPiece(*message);
  }
  std::unique_ptr<SandboxProcess> process = std::move(m_Process);
  if (!message || message->kind != Kind::Done)
  {
    process->Fail(m_Job, message);
  }
  if (process->IsWorthKeeping())
  {
    GiveBackHelper(m_Job.helper, std::move(process));
  }
  return {};
}

} // namespace rhombic
