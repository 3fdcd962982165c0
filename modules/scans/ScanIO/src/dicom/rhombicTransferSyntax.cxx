#include "rhombicTransferSyntax.h"

#include <map>

namespace rhombic
{

TransferSyntax
FindTransferSyntax(const std::string & uid)
{
  static const std::map<std::string, TransferSyntax> known{
    { "", { "little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2", { "implicit little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.1", { "explicit little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.2", { "explicit big endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.1.99", { "deflated explicit little endian", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.50", { "JPEG baseline", PixelCodec::JPEG, true } },
    { "1.2.840.10008.1.2.4.51", { "JPEG extended", PixelCodec::JPEG, true } },
    { "1.2.840.10008.1.2.4.57", { "JPEG lossless", PixelCodec::JPEG, false } },
    { "1.2.840.10008.1.2.4.70", { "JPEG lossless (first-order prediction)", PixelCodec::JPEG, false } },
    { "1.2.840.10008.1.2.4.80", { "JPEG-LS lossless", PixelCodec::JPEGLS, false } },
    { "1.2.840.10008.1.2.4.81", { "JPEG-LS near-lossless", PixelCodec::JPEGLS, true } },
    { "1.2.840.10008.1.2.4.90", { "JPEG 2000 lossless", PixelCodec::JPEG2000, false } },
    { "1.2.840.10008.1.2.4.91", { "JPEG 2000", PixelCodec::JPEG2000, true } },
    { "1.2.840.10008.1.2.4.201", { "high-throughput JPEG 2000 lossless", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.202", { "high-throughput JPEG 2000 lossless", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.203", { "high-throughput JPEG 2000", PixelCodec::Unsupported, true } },
    { "1.2.840.10008.1.2.5", { "RLE lossless", PixelCodec::RunLength, false } },
    { "1.2.840.10008.1.2.8.1", { "deflated frames", PixelCodec::Unsupported, false } },
  };
  const auto found = known.find(uid);
  return found == known.end() ? TransferSyntax{ "unknown", PixelCodec::Unsupported, false } : found->second;
}

} // namespace rhombic
