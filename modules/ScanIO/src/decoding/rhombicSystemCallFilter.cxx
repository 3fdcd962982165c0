#include "rhombicSystemCallFilter.h"

#include <cerrno>
#include <cstddef>
#include <vector>

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
  SYS_clone, SYS_clone3, SYS_execve, SYS_execveat, SYS_socket, SYS_connect, SYS_ptrace,
#if defined(SYS_fork)
  SYS_fork,  SYS_vfork,
#endif
};

} // namespace

void
ForbidThreadsProgramsAndSockets()
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
  program.push_back(load(offsetof(seccomp_data, nr)));
  for (const unsigned int call : Forbidden)
  {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));

  const sock_fprog filter{ static_cast<unsigned short>(program.size()), program.data() };
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

} // namespace rhombic
