#include "detail/rhombicPictureCodec.h"
#include "rhombicFailure.h"

#include <dlfcn.h>

namespace rhombic
{
namespace
{

const PictureCodec *
LoadPictureCodec()
{
  void * const library = dlopen("rhombic-pictures.so", RTLD_NOW | RTLD_LOCAL); // found by the program's RUNPATH
  void * const function = library ? dlsym(library, "rhombicPictureCodec") : nullptr;
  if (!function)
  {
    throw Failure(FailureKind::Internal,
                  "The part of rhombic that reads and writes pictures can't be loaded: " + std::string(dlerror()) +
                    "; install rhombic again.");
  }
  return reinterpret_cast<const PictureCodec * (*)()>(function)();
}

} // namespace

const PictureCodec &
GetPictureCodec()
{
  static const PictureCodec * const codec = LoadPictureCodec();
  return *codec;
}

} // namespace rhombic
