#include "rhombicSystemCallFilter.h"

#include <cerrno>
#include <cstddef>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

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

constexpr unsigned int Forbidden[] = {
  SYS_clone,
  SYS_clone3,
  SYS_execve,
  SYS_execveat,
  SYS_socket,
  SYS_connect,
  SYS_ptrace,
  SYS_kill,
  SYS_process_vm_readv,
  SYS_process_vm_writev,
  SYS_pidfd_getfd,
  SYS_io_uring_setup,
  SYS_unlinkat,
  SYS_renameat,
  SYS_renameat2,
  SYS_linkat,
  SYS_symlinkat,
  SYS_mkdirat,
  SYS_mknodat,
  SYS_fchmod,
  SYS_fchmodat,
  SYS_truncate,
  SYS_openat2,
#if defined(SYS_fork)
  SYS_fork,
  SYS_vfork,
  SYS_unlink,
  SYS_rename,
  SYS_link,
  SYS_symlink,
  SYS_mkdir,
  SYS_rmdir,
  SYS_mknod,
  SYS_chmod,
  SYS_creat,
#endif
};

/** System calls that open files, and the index of the argument with the flags. */
constexpr std::pair<unsigned int, unsigned int> Openings[] = {
  { SYS_openat, 2 },
#if defined(SYS_open)
  { SYS_open, 1 },
#endif
};

} // namespace

void
ForbidAllButDecoding()
{
  if (Architecture == 0)
  {
    return;
  }
  const auto load = [](std::size_t offset) {
    return sock_filter(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned int>(offset)));
  };
  std::vector<sock_filter> program;
  program.push_back(load(offsetof(seccomp_data, arch)));
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, Architecture, 1, 0));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS));
  const sock_filter deny = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM);
  program.push_back(load(offsetof(seccomp_data, nr)));
#if defined(__x86_64__)
  constexpr unsigned int firstOfX32 = 0x40000000; // the same calls have other numbers there
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, firstOfX32, 0, 1));
  program.push_back(deny);
#endif
  for (const unsigned int call : Forbidden)
  {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
    program.push_back(deny);
  }
  constexpr unsigned int writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  for (const auto & [call, flags] : Openings)
  {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4));
    program.push_back(load(offsetof(seccomp_data, args) + flags * sizeof(seccomp_data::args[0])));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writing, 0, 1));
    program.push_back(deny);
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));

  const sock_fprog filter{ static_cast<unsigned short>(program.size()), program.data() };
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

} // namespace rhombic
