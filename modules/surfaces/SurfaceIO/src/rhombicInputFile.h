#ifndef rhombicInputFile_h
#define rhombicInputFile_h

#include "rhombicWording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
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

  /** The file's name without extension: that of a surface without a name. */
  std::string
  GetStem() const
  {
    return m_Path.stem().string();
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

  /** Throws Failure(Unreadable): "Cannot read PATH: FLAW; the file is damaged, so export it again." */
  [[noreturn]] void
  RefuseDamaged(const std::string & flaw) const;

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

  /** Bytes that have not been taken. */
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

/** The beginning of a text file without a byte order mark. */
inline std::string_view
WithoutMark(std::string_view beginning)
{
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return beginning.substr(0, mark.size()) == mark ? beginning.substr(mark.size()) : beginning;
}

/** Removes the next word from a line and returns it; empty if there is none. */
inline std::string_view
TakeWord(std::string_view & line)
{
  constexpr std::string_view blanks = " \t\r\n";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/** The number that a whole word is, perhaps with a plus sign. A float that is too small becomes 0; a float that is
 * too large is none. */
template <typename TNumber>
std::optional<TNumber>
ParseNumber(std::string_view word)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
  {
    word.remove_prefix(1);
  }
  const auto number = ToNumber<TNumber>(word);
  if constexpr (std::is_same_v<TNumber, float>)
  {
    if (!number)
    {
      const auto precise = ToNumber<double>(word);
      return precise && std::abs(*precise) < 1 ? std::optional<float>(static_cast<float>(*precise)) : std::nullopt;
    }
  }
  return number;
}

/** The three numbers that begin a line. Throws Failure(Unreadable) with a reason if there are fewer. */
inline std::array<float, 3>
ParseTriple(std::string_view words, const InputStream & stream, const char * why)
{
  std::array<float, 3> triple;
  for (float & value : triple)
  {
    const auto number = ParseNumber<float>(TakeWord(words));
    if (!number)
    {
      stream.RefuseLine(why);
    }
    value = *number;
  }
  return triple;
}

} // namespace rhombic

#endif
