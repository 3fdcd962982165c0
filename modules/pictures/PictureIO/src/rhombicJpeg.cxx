#include "rhombicFailure.h"
#include "rhombicPictureIO.h"

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <cstdlib>
#include <jpeglib.h>
#include <memory>

namespace rhombic
{
namespace
{

/** libjpeg's functions for errors, and the place where coding goes on after one. */
struct JpegErrors
{
  jpeg_error_mgr manager; // first, as libjpeg knows this object by its address
  std::jmp_buf afterError;
};

[[noreturn]] void
LeaveJpeg(j_common_ptr common)
{
  std::longjmp(reinterpret_cast<JpegErrors *>(common->err)->afterError, 1);
}

void
KeepMessage(j_common_ptr /*common*/)
{}

/** Encodes a picture in memory that \a bytes then owns. No object in here may need a destructor, as errors of libjpeg
 * leave by longjmp(). Returns whether it worked. */
bool
Compress(const Picture & picture, int quality, bool halvesColour, unsigned char ** bytes, unsigned long * size)
{
  jpeg_compress_struct writer{};
  JpegErrors errors{};
  writer.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = LeaveJpeg;
  errors.manager.output_message = KeepMessage;
  if (setjmp(errors.afterError) != 0)
  {
    *bytes = writer.next_scanline == 0 ? *bytes : nullptr; // which libjpeg may have freed for a larger block
    jpeg_destroy_compress(&writer);
    return false;
  }
  jpeg_create_compress(&writer);
  jpeg_mem_dest(&writer, bytes, size);
  writer.image_width = static_cast<JDIMENSION>(picture.width);
  writer.image_height = static_cast<JDIMENSION>(picture.height);
  writer.input_components = 3;
  writer.in_color_space = JCS_RGB;
  jpeg_set_defaults(&writer);
  jpeg_set_quality(&writer, quality, TRUE);
  writer.optimize_coding = TRUE; // the same pixels in fewer bytes
  writer.comp_info[0].h_samp_factor = writer.comp_info[0].v_samp_factor = halvesColour ? 2 : 1;
  jpeg_start_compress(&writer, TRUE);
  while (writer.next_scanline < writer.image_height)
  {
    auto * row = const_cast<JSAMPROW>(picture.At(0, static_cast<int>(writer.next_scanline))); // is only read
    jpeg_write_scanlines(&writer, &row, 1);
  }
  jpeg_finish_compress(&writer);
  jpeg_destroy_compress(&writer);
  return true;
}

} // namespace

std::string
EncodeJpeg(const Picture & picture, int quality, bool halvesColour)
{
  unsigned char * bytes = nullptr;
  unsigned long size = 0;
  const bool isEncoded = picture.channels == 3 && Compress(picture, quality, halvesColour, &bytes, &size);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(bytes, &std::free);
  if (!isEncoded)
  {
    throw Failure(FailureKind::Output,
                  "A picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                    " pixels can't be encoded as JPEG; try one of 1 to 65500 pixels a side, without alpha.");
  }
  return { reinterpret_cast<const char *>(bytes), size };
}

} // namespace rhombic
