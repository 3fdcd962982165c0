#ifndef rhombicTransferSyntax_h
#define rhombicTransferSyntax_h

#include <string>

namespace rhombic
{

/** The compression of the pixels in a DICOM transfer syntax. */
enum class PixelCodec
{
  None,
  JPEG,
  JPEGLS,
  JPEG2000,
  RunLength,
  Unsupported
};

/** A transfer syntax of DICOM (PS3.5, annex A). */
struct TransferSyntax
{
  std::string name; ///< in a few words
  PixelCodec codec = PixelCodec::Unsupported;
  bool isLossy = false; ///< whether values may differ from the original ones
};

/** An empty UID is taken for a syntax without compression. */
TransferSyntax
FindTransferSyntax(const std::string & uid);

} // namespace rhombic

#endif
