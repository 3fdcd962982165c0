#ifndef rhombicVTPDocument_h
#define rhombicVTPDocument_h

#include "rhombicInputFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** The XML element of an array. */
struct VTPArray
{
  std::string section; ///< the element around it: FieldData, Points, Polys, PointData, CellData
  std::string name;
  std::string type;         ///< Float32, Int64, String...
  std::string format;       ///< ascii, binary or appended
  std::uint64_t offset = 0; ///< begin of appended data, from VTPDocument::appendedAt
  std::string text;         ///< between its tags
};

/** Points and polygons with their arrays. */
struct VTPPiece
{
  std::uint64_t points = 0;
  std::uint64_t polygons = 0;
  std::string normals; ///< name of the array of normals, if any
  std::vector<VTPArray> arrays;
};

/** The XML of a VTP file up to the appended data. */
struct VTPDocument
{
  bool isBigEndian = false;
  bool hasLongSizes = false;    ///< sizes in front of arrays have 64 bits
  bool isCompressed = false;    ///< whether arrays are compressed by zlib
  bool isBase64 = false;        ///< appended data are base64
  std::uint64_t appendedAt = 0; ///< byte of the file from which offsets count; 0 if there are no appended data
  std::vector<VTPArray> fields;
  std::vector<VTPPiece> pieces;
};

/** Throws Failure(Unreadable) if the file is no VTP file or uses parts of the format that are not supported. */
VTPDocument
ParseVTPDocument(const InputFile & file);

} // namespace rhombic

#endif
