#ifndef rhombicInputFile_h
#define rhombicInputFile_h

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** \class InputFile
 * \brief A regular file of known size, or bytes in its place, read at any offset. */
class InputFile
{
public:
  /** Throws Failure(NotFound) if there is no such file, Failure(Unreadable) if it can't be opened or is no regular
   * file.
   */
  explicit InputFile(const std::filesystem::path & path);

  /** Reads \a bytes, which must outlive this object, in place of the file. */
  InputFile(const std::filesystem::path & path, const std::byte * bytes, std::size_t size)
    : m_Path(path)
    , m_Bytes(bytes)
    , m_Size(size)
  {}
  ~InputFile();

  InputFile(const InputFile &) = delete;
  InputFile &
  operator=(const InputFile &) = delete;

  const std::filesystem::path &
  GetPath() const
  {
    return m_Path;
  }

  std::uintmax_t
  GetSize() const
  {
    return m_Size;
  }

  /** Throws Failure(Unreadable) if the file ends before offset + size. */
  void
  Read(std::uintmax_t offset, void * to, std::size_t size) const;

  /** Throws Failure(Unreadable): "Cannot read PATH: WHY." */
  [[noreturn]] void
  Refuse(const std::string & why) const;

  /** Throws Failure(Unreadable): "Cannot read PATH: WHAT; the file is damaged, so export it again." */
  [[noreturn]] void
  RefuseDamaged(const std::string & what) const;

  /** Throws Failure(Memory) if reading the file takes more \a bytes than half of what is free. */
  void
  RequireMemoryToRead(std::uintmax_t bytes) const;

private:
  std::filesystem::path m_Path;
  int m_Descriptor = -1;
  const std::byte * m_Bytes = nullptr;
  std::uintmax_t m_Size = 0;
};

/** \class InputStream
 * \brief Reads numbers or lines of a file in order, through large blocks. */
class InputStream
{
public:
  /** Reads from \a offset to the end of the file. */
  explicit InputStream(const InputFile & file, std::uintmax_t offset = 0)
    : m_File(file)
    , m_Next(std::min(offset, file.GetSize()))
  {}

  const InputFile &
  GetFile() const
  {
    return m_File;
  }

  /** Bytes that are left. */
  std::uintmax_t
  GetRest() const
  {
    return m_File.GetSize() - m_Next + (m_Block.size() - m_Taken);
  }

  /** Copies the next bytes; throws Failure(Unreadable) if there are fewer. */
  void
  Take(void * to, std::size_t size)
  {
    if (m_Block.size() - m_Taken < size)
    {
      this->Fill(size);
    }
    std::copy_n(m_Block.data() + m_Taken, size, static_cast<char *>(to));
    m_Taken += size;
  }

  template <typename TNumber>
  TNumber
  Take()
  {
    TNumber number;
    this->Take(&number, sizeof(number));
    return number;
  }

  /** Gets the next line without its end, valid until the next call; returns false at the end. Throws
   * Failure(Unreadable) for lines longer than 1 MiB. */
  bool
  TakeLine(std::string_view & line);

  /** Throws Failure(Unreadable): "Cannot read PATH, line N: WHY." */
  [[noreturn]] void
  RefuseLine(const std::string & why) const;

private:
  /** Reads on until the block holds at least \a size bytes that have not been taken. */
  void
  Fill(std::size_t size);

  const InputFile & m_File;
  std::uintmax_t m_Next; ///< first byte of the file that is not in the block
  std::vector<char> m_Block;
  std::size_t m_Taken = 0;
  std::uintmax_t m_LineNumber = 0;
};

} // namespace rhombic

#endif
