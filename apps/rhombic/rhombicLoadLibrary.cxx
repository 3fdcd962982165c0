#include "rhombicLoadLibrary.h"
#include "rhombicFailure.h"

#include <dlfcn.h>
#include <sys/resource.h>

#include <string>

namespace rhombic
{

void *
FindInLibrary(const char * library, const char * function, const char * purpose)
{
  void * const handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL); // found by the program's RUNPATH
  void * const found = handle ? dlsym(handle, function) : nullptr;
  if (!found)
  {
    const std::string why = dlerror();
    rlimit limit{};
    const bool needsMemory = why.find("failed to map") != std::string::npos && getrlimit(RLIMIT_AS, &limit) == 0 &&
                             limit.rlim_cur != RLIM_INFINITY;
    throw Failure(needsMemory ? FailureKind::Memory : FailureKind::Internal,
                  std::string("The part of rhombic that ") + purpose + " can't be loaded: " + why +
                    (needsMemory ? "; allow more memory, as by ulimit -v." : "; install rhombic again."));
  }
  return found;
}

} // namespace rhombic
