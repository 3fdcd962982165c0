#include "rhombicLoadLibrary.h"
#include "rhombicFailure.h"

#include <dlfcn.h>

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
    throw Failure(FailureKind::Internal,
                  std::string("The part of rhombic that ") + purpose + " can't be loaded: " + dlerror() +
                    "; install rhombic again.");
  }
  return found;
}

} // namespace rhombic
