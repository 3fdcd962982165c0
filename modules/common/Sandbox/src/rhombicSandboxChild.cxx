#include "rhombicSandboxChild.h"

#include "rhombicSandboxMessage.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <new>
#include <optional>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

#if defined(__x86_64__)
constexpr unsigned int Architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned int Architecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned int Architecture = 0;
#endif

constexpr unsigned int Allowed[] = {
  SYS_read,         SYS_pread64,        SYS_write,       SYS_writev,      SYS_lseek,        SYS_fstat,
  SYS_newfstatat,   SYS_close,          SYS_sendmsg,     SYS_recvmsg,     SYS_brk,          SYS_mmap,
  SYS_munmap,       SYS_mremap,         SYS_mprotect,    SYS_madvise,     SYS_exit,         SYS_exit_group,
  SYS_futex,        SYS_getpid,         SYS_gettid,      SYS_getrusage,   SYS_getrandom,    SYS_clock_gettime,
  SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_sched_yield, SYS_sigaltstack, SYS_rt_sigreturn,
#ifdef __SANITIZE_ADDRESS__
  SYS_pipe2, // UndefinedBehaviorSanitizer writes to a pipe to learn whether memory can be read
#endif
};

/** Adds the rule that a system call is allowed; if \a argument is given, only with this first argument. */
void
Allow(std::vector<sock_filter> & rules, unsigned int call, std::optional<unsigned int> argument = {})
{
  const unsigned char toNextRule = argument ? 4 : 1;
  rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, toNextRule));
  if (argument)
  {
    rules.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args)));
    rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, *argument, 1, 0));
    rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  }
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
}

/** Allows this process only the system calls that computing takes, and messages through sockets that are open: it can't
 * open, make or change files, start processes or threads, use the network, or signal other processes. Other calls fail
 * with EPERM. Does nothing where the kernel or the architecture has no such filters. */
void
ForbidAllButUnpacking()
{
  if (Architecture == 0)
  {
    return;
  }
  std::vector<sock_filter> rules;
  rules.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)));
  rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, Architecture, 1, 0));
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  rules.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)));
  for (const unsigned int call : Allowed)
  {
    Allow(rules, call);
  }
  Allow(rules, SYS_prlimit64, 0); // this process
  Allow(rules, SYS_tgkill, static_cast<unsigned int>(getpid()));
  rules.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));

  const sock_fprog filter{ static_cast<unsigned short>(rules.size()), rules.data() };
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

void
Limit(int resource, rlim_t value)
{
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

/** Allows this process \a seconds of processor time from now on. */
void
LimitTime(std::uint64_t seconds)
{
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::clock() / CLOCKS_PER_SEC) + 1 + seconds);
}

/** Allows this process to allocate \a bytes. Sanitizers of memory and threads keep all memory for themselves. */
void
LimitMemory([[maybe_unused]] std::uint64_t bytes)
{
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  Limit(RLIMIT_DATA, bytes);
#endif
}

/** Sets what all files have in common: limits, standard output and standard error that are memory for TakePrinted(),
 * and a malloc() that keeps freed memory, as codecs allocate the same large blocks for each file. */
void
PrepareProcess()
{
  constexpr rlim_t mostOutput = 1 << 20;
  constexpr rlim_t mostFiles = 64;
  constexpr int largestKept = 64 << 20;
  mallopt(M_MMAP_THRESHOLD, largestKept);
  mallopt(M_TRIM_THRESHOLD, largestKept);
  Limit(RLIMIT_FSIZE, mostOutput);
  Limit(RLIMIT_NOFILE, mostFiles);
  dup2(memfd_create("printed", 0), STDOUT_FILENO);
  dup2(STDOUT_FILENO, STDERR_FILENO);
  ForbidAllButUnpacking(); // forbids threads, too: OpenJPEG's would slow down other children
}

/** The first line that libraries have printed. */
std::string
TakePrinted()
{
  std::fflush(nullptr);
  std::string text(SandboxMessage().text.size() / 2, '\0');
  const ssize_t count = pread(STDOUT_FILENO, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text.substr(0, text.find('\n'));
}

SandboxMessage
Refusal(const std::string & why)
{
  SandboxMessage answer{ SandboxMessage::Kind::Refused };
  why.copy(answer.text.data(), answer.text.size() - 1);
  return answer;
}

/** Unpacks a file into \a slot, or into the one that comes with the file and takes its place. Returns the last message
 * about the file. */
SandboxMessage
Unpack(const ReceivedMessage & start, SandboxFunction function, MappedMemory & slot)
{
  SandboxMessage answer{ SandboxMessage::Kind::Done };
  try
  {
    const MappedMemory file = MapFile(start.file.Get(), PROT_READ);
    slot = start.slot.Get() < 0 ? slot : MapFile(start.slot.Get(), PROT_READ | PROT_WRITE);
    const std::string arguments(reinterpret_cast<const char *>(slot.data.get()), start.arguments);
    LimitMemory(start.memory);
    SandboxOutput output(slot.data.get(), start.size, start.seconds);
    function({ file.data.get(), file.size, arguments }, output);
  }
  catch (const SandboxRefusal & refusal)
  {
    answer = Refusal(refusal.what());
  }
  catch (const std::bad_alloc &)
  {
    answer.kind = SandboxMessage::Kind::OutOfMemory;
  }
  catch (const std::exception & error)
  {
    answer = Refusal(error.what() + std::string("; copy it again from its source"));
  }
  return answer;
}

} // namespace

SandboxOutput::SandboxOutput(std::byte * slot, std::size_t size, std::uint64_t seconds)
  : m_Slot(slot)
  , m_Size(size)
  , m_Seconds(seconds)
{
  LimitTime(seconds);
}

std::byte *
SandboxOutput::GetBuffer() const
{
  return m_Slot + m_Delivered % 2 * SizeInSlot(m_Size);
}

void
SandboxOutput::Deliver(std::size_t size)
{
  if (const std::string printed = TakePrinted(); !printed.empty())
  {
    throw SandboxRefusal("it is damaged (" + printed + "); copy it again from its source");
  }
  const auto offset = static_cast<std::uint64_t>(this->GetBuffer() - m_Slot);
  SendMessage(STDIN_FILENO, { SandboxMessage::Kind::Piece, offset, size });
  ++m_Delivered;
  if (m_Delivered > 1 && !ReceiveMessage(STDIN_FILENO)) // the next piece takes the place of the last but one
  {
    std::_Exit(0);
  }
  LimitTime(m_Seconds);
}

int
RunSandboxChild(int argc, char ** argv, SandboxFunction function)
{
  if (argc != 2 || std::string(argv[1]) != RHOMBIC_SANDBOX_VERSION)
  {
    std::fputs("This program unpacks files for programs of Rhombic " RHOMBIC_SANDBOX_VERSION ", which start it.\n",
               stderr);
    return SandboxCannotRun;
  }
  PrepareProcess();
  MappedMemory slot;
  SandboxMessage answer{ SandboxMessage::Kind::Done };
  while (answer.kind == SandboxMessage::Kind::Done)
  {
    const auto received = ReceiveMessage(STDIN_FILENO);
    if (!received)
    {
      break;
    }
    if (received->kind == SandboxMessage::Kind::Start) // others are about the previous file
    {
      answer = Unpack(*received, function, slot);
      SendMessage(STDIN_FILENO, answer);
    }
  }
  return 0;
}

} // namespace rhombic
