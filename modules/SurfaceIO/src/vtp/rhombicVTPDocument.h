#ifndef rhombicVTPDocument_h
#define rhombicVTPDocument_h

#include "rhombicInputFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** An array of a VTP file as its XML element describes it. */
struct VTPArray
{
  std::string section; ///< the element around it: FieldData, Points, Polys, PointData, CellData
  std::string name;
  std::string type;         ///< Float32, Int64, String...
  std::string format;       ///< ascii, binary or appended
  std::uint64_t offset = 0; ///< of what is appended
  std::string text;         ///< between its tags
};

/** Points and polygons with their arrays. */
struct VTPPiece
{
  std::uint64_t points = 0;
  std::uint64_t polygons = 0;
  std::string normals; ///< name of the points' normals, if any
  std::vector<VTPArray> arrays;
};

/** The XML of a VTP file, up to the bytes that may follow it. */
struct VTPDocument
{
  bool isBigEndian = false;
  bool hasLongSizes = false;    ///< the sizes in front of arrays have 64 bits
  bool isCompressed = false;    ///< by zlib
  bool isBase64 = false;        ///< what is appended
  std::uint64_t appendedAt = 0; ///< place in the file that offsets count from
  std::vector<VTPArray> fields;
  std::vector<VTPPiece> pieces;
};

/** Throws Failure(Unreadable) for what is no VTP file, and for parts of the format that are not supported. */
VTPDocument
ParseVTPDocument(const InputFile & file);

} // namespace rhombic

#endif
