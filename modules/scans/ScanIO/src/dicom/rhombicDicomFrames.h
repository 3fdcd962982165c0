#ifndef rhombicDicomFrames_h
#define rhombicDicomFrames_h

#include "rhombicDicomSlice.h"

#include <nlohmann/json.hpp>

// What the program that unpacks compressed pixels (helper/rhombicUnpackDicom.cxx) must know of a file besides its
// bytes, as JSON: the format of the pixels, and where they are.

namespace rhombic
{

constexpr char DicomHelper[] = "rhombic-unpack-dicom";

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ByteRange, offset, size)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DicomPixelFormat,
                                   transferSyntax,
                                   columns,
                                   rows,
                                   frames,
                                   bitsAllocated,
                                   bitsStored,
                                   highBit,
                                   isSigned)

inline void
to_json(nlohmann::json & json, const DicomImageFile & file)
{
  json = { { "codec", FindTransferSyntax(file.format.transferSyntax).codec },
           { "format", file.format },
           { "fragments", file.fragments } };
  if (file.format.padding)
  {
    json["padding"] = *file.format.padding;
  }
}

/** All but the codec. */
inline void
from_json(const nlohmann::json & json, DicomImageFile & file)
{
  json.at("format").get_to(file.format);
  json.at("fragments").get_to(file.fragments);
  if (json.contains("padding"))
  {
    file.format.padding = json.at("padding").get<std::pair<std::int64_t, std::int64_t>>();
  }
}

} // namespace rhombic

#endif
