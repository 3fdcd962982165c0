#include "detail/rhombicPictureCodec.h"

/** What rhombic looks for in this library. */
extern "C" const rhombic::PictureCodec *
rhombicPictureCodec()
{
  return &rhombic::GetPictureCodec();
}
