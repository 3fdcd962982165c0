#ifndef rhombicZarrArray_h
#define rhombicZarrArray_h

#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicOMEZarrImage.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace rhombic
{

/** Throws Failure(Unreadable): "Cannot read PATH: WHY." */
[[noreturn]] inline void
RefuseZarr(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** Whether there is anything of this name below \a folder, of which \a parts are the folders and the last name. Throws
 * Failure(Unreadable) when one of them can't be looked at, or is a symbolic link and links are not followed. */
bool
ExistsInZarr(const std::filesystem::path & folder, const std::filesystem::path & parts, bool followsLinks);

/** A JSON file of metadata: an object. Throws Failure(Unreadable) for other files, for more than 16 MiB, and for more
 * than 64 levels of nesting. */
nlohmann::json
ReadZarrMetadata(const std::filesystem::path & folder, const std::filesystem::path & name, bool followsLinks);

/** Numbers of the axes of an array, in the order of their storage, the last one fastest. */
constexpr std::size_t MostZarrAxes = 5;
using ZarrNumbers = std::array<std::size_t, MostZarrAxes>;

/** The type of the numbers in an array: any value of that type. */
using ZarrType = OMEZarrImage::Type;

/** \class ZarrArray
 * \brief An array of numbers in chunks, each of which is a file (Zarr version 2).
 *
 * Thread safety: any number of threads may read. */
class ZarrArray
{
public:
  ZarrArray() = default;

  /** Reads and checks the metadata of the array in \a root / \a name. Throws Failure(Unreadable). */
  ZarrArray(const std::filesystem::path & root, const std::filesystem::path & name, bool followsLinks);

  ZarrType
  GetType() const
  {
    return m_Type;
  }

  /** Bytes of a value. */
  std::size_t
  GetValueSize() const
  {
    return m_ValueSize;
  }

  std::size_t
  GetNumberOfAxes() const
  {
    return m_NumberOfAxes;
  }

  /** The sizes of all axes; 1 for those in front that the array lacks. */
  const ZarrNumbers &
  GetShape() const
  {
    return m_Shape;
  }

  /** The sizes of a chunk. */
  const ZarrNumbers &
  GetChunk() const
  {
    return m_Chunk;
  }

  /** "raw", "zlib", ... */
  const std::string &
  GetEncoding() const
  {
    return m_Encoding;
  }

  /** Memory besides the result while a region is read, in bytes. */
  std::uintmax_t
  GetWorkingMemory() const;

  /** The files of chunks that there are, of those that a region touches. Throws Failure(Unreadable). */
  std::vector<std::filesystem::path>
  FindChunks(const ZarrNumbers & begin, const ZarrNumbers & size) const;

  /** Reads the values of a region, the last axis fastest, in this machine's byte order; chunks that are missing are the
   * fill value. Throws Failure(Unreadable), naming the chunk that is damaged, or missing without a fill value, and what
   * \a progress throws. */
  void
  Read(const ZarrNumbers & begin,
       const ZarrNumbers & size,
       std::byte * buffer,
       const ProgressFunction & progress = {}) const;

private:
  /** The part of a region that lies in a chunk. */
  struct Part
  {
    ZarrNumbers chunk;   ///< the number of the chunk along each axis
    ZarrNumbers inChunk; ///< where the part begins in the chunk
    ZarrNumbers inRegion;
    ZarrNumbers size;
  };

  void
  TakeType(const nlohmann::json & metadata);
  void
  TakeSizes(const nlohmann::json & metadata);
  void
  TakeFill(const nlohmann::json & metadata);
  void
  TakeCodec(const nlohmann::json & metadata);

  [[noreturn]] void
  Refuse(const std::string & why) const;

  std::size_t
  GetChunkBytes() const;

  /** The first and the number of chunks along each axis that a region touches. */
  std::pair<ZarrNumbers, ZarrNumbers>
  FindTouched(const ZarrNumbers & begin, const ZarrNumbers & size) const;

  /** Part \a n of a region, of its touched chunks. */
  Part
  FindPart(std::size_t n, const ZarrNumbers & begin, const ZarrNumbers & size) const;

  std::filesystem::path
  NameOf(const ZarrNumbers & chunk) const;

  void
  ReadPart(const Part & part, const ZarrNumbers & size, std::byte * buffer) const;
  void
  ReadRaw(const std::filesystem::path & path, const Part & part, const ZarrNumbers & size, std::byte * buffer) const;
  void
  ReadPacked(const std::filesystem::path & path, const Part & part, const ZarrNumbers & size, std::byte * buffer) const;
  void
  Fill(const Part & part, const ZarrNumbers & size, std::byte * buffer) const;

  std::filesystem::path m_Root;
  std::filesystem::path m_Name; ///< of the array's folder, below the root
  bool m_FollowsLinks = false;
  ZarrType m_Type;
  std::size_t m_ValueSize = 0;
  bool m_IsSwapped = false;
  std::size_t m_NumberOfAxes = 0;
  ZarrNumbers m_Shape{};
  ZarrNumbers m_Chunk{};
  std::optional<std::vector<std::byte>> m_Fill; ///< the value, in this machine's byte order
  std::string m_Encoding;
  std::string m_Separator;
};

} // namespace rhombic

#endif
