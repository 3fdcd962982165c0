#ifndef rhombicZip_h
#define rhombicZip_h

#include "rhombicInputFile.h"
#include "rhombicOutputFile.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** A file in a ZIP archive. */
struct ZipPart
{
  std::string name;
  std::uint16_t method = 0; ///< 0: stored, 8: deflated
  std::uint32_t checksum = 0;
  std::uint32_t packedSize = 0;
  std::uint32_t size = 0;
  std::uint32_t begin = 0; ///< of the part's header in the archive
};

/** \class ZipWriter
 * \brief Appends a ZIP archive of deflated parts to a file, one part after another (PKWARE, "APPNOTE.TXT", 6.3.9). The
 * parts have no dates: the same bytes at any time. Archives and parts are below 4 GiB; Failure(Output) otherwise. */
class ZipWriter
{
public:
  explicit ZipWriter(OutputFile & file);
  ~ZipWriter();

  /** Begins a part. */
  void
  Begin(const std::string & name);

  /** Adds bytes to the part. */
  void
  Append(std::string_view bytes);

  /** Ends the last part, and the archive. */
  void
  Close();

private:
  struct Deflater;

  void
  AppendToFile(std::string_view bytes);
  void
  Deflate(int flush);
  void
  End();

  OutputFile & m_File;
  std::uint64_t m_Size = 0; ///< of the archive so far
  std::vector<ZipPart> m_Parts;
  std::unique_ptr<Deflater> m_Deflater;
};

/** \class ZipReader
 * \brief Reads the parts of a ZIP archive. Throws Failure(Unreadable) for a damaged one, and for one with encrypted
 * parts, of other methods or beyond 4 GiB. */
class ZipReader
{
public:
  explicit ZipReader(const InputFile & file);

  /** The part of this name, in upper or lower case; null if there is none. */
  const ZipPart *
  Find(std::string_view name) const;

  /** Calls \a use for the bytes of a part in order, block by block. Their CRC-32 is compared at the end. Throws
   * Failure(Unreadable), also for a part that unpacks to a hundred times its size or more. */
  void
  Unpack(const ZipPart & part, const std::function<void(std::string_view bytes)> & use) const;

private:
  /** Calls \a use for unpacked blocks; \a packed begins with the part's bytes. */
  void
  Inflate(const ZipPart & part, InputStream & packed, const std::function<void(std::string_view bytes)> & use) const;

  const InputFile & m_File;
  std::vector<ZipPart> m_Parts;
};

} // namespace rhombic

#endif
