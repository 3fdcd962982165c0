#include "detail/rhombicPictureCodec.h"
#include "rhombicLoadLibrary.h"

namespace rhombic
{

const PictureCodec &
GetPictureCodec()
{
  using Function = const PictureCodec * (*)();
  static const PictureCodec * const codec = reinterpret_cast<Function>(
    FindInLibrary("rhombic-pictures.so", "rhombicPictureCodec", "reads and writes pictures"))();
  return *codec;
}

} // namespace rhombic
