#ifndef rhombicTransferSyntax_h
#define rhombicTransferSyntax_h

#include <string>

namespace rhombic
{

/** What the pixels of a DICOM transfer syntax are packed with. */
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
  std::string name; ///< in a few words, or the UID when it is not known
  PixelCodec codec = PixelCodec::Unsupported;
  bool isLossy = false; ///< whether the values may differ from those that the scanner made
};

/** An empty UID is taken for a syntax without compression. */
TransferSyntax
FindTransferSyntax(const std::string & uid);

} // namespace rhombic

#endif
