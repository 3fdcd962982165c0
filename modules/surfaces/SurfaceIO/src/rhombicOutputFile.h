#ifndef rhombicOutputFile_h
#define rhombicOutputFile_h

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rhombic
{

/** \class OutputFile
 * \brief Collects small records and writes them in large blocks. Throws Failure(Output) if that fails. */
class OutputFile
{
public:
  /** Empties the file at \a path. Messages name \a target, which the file will become. */
  OutputFile(const std::filesystem::path & path, const std::filesystem::path & target);
  ~OutputFile();

  OutputFile(const OutputFile &) = delete;
  OutputFile &
  operator=(const OutputFile &) = delete;

  const std::filesystem::path &
  GetTarget() const
  {
    return m_Target;
  }

  void
  Append(std::string_view bytes)
  {
    if (m_Block.size() + bytes.size() > BlockSize)
    {
      this->Flush();
    }
    m_Block.insert(m_Block.end(), bytes.begin(), bytes.end());
  }

  /** Appends a number or an array of numbers, little endian. */
  template <typename TRecord>
  void
  AppendBinary(const TRecord & record)
  {
    static_assert(std::is_trivially_copyable_v<TRecord>);
    this->Append({ reinterpret_cast<const char *>(&record), sizeof(record) });
  }

  /** Must be called at the end; the destructor does not report failures. */
  void
  Close();

  /** Whether the file, closed and read again, holds the appended bytes: by its size and the CRC-32 of its bytes. Throws
   * Failure(Output) if it can't be read. */
  bool
  HoldsAppendedBytes() const;

private:
  static constexpr std::size_t BlockSize = std::size_t{ 1 } << 20;

  void
  Flush();

  [[noreturn]] void
  Fail() const;

  /** Length and CRC-32 of bytes in a row. */
  struct Digest
  {
    std::uint64_t size = 0;
    unsigned long checksum = 0;

    void
    Add(const char * bytes, std::size_t count);
  };

  std::filesystem::path m_Path;
  std::filesystem::path m_Target;
  int m_Descriptor;
  std::vector<char> m_Block;
  Digest m_Digest; ///< of the bytes that are written
};

} // namespace rhombic

#endif
