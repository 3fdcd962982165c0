#ifndef rhombicDigest_h
#define rhombicDigest_h

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rhombic
{

/** \class Digest
 * \brief The MD5 of bytes: tells contents apart, but does not prove who made them.
 *
 * Thread safety: one thread per object. */
class Digest
{
public:
  Digest();
  ~Digest();

  /** Adds bytes behind those before. */
  void
  Add(const void * bytes, std::size_t size);

  /** Adds the bytes of a text. */
  void
  Add(std::string_view text)
  {
    this->Add(text.data(), text.size());
  }

  /** 32 hexadecimal digits. Nothing can be added after it. */
  std::string
  GetDigits();

private:
  struct State;
  std::unique_ptr<State> m_State;
};

/** The digest of the contents of files, one after the other. A file that can't be read counts as empty. */
std::string
HashFiles(const std::vector<std::filesystem::path> & files);

/** A hash of the paths, sizes and times of change of files: when it is the same, so are their contents. */
std::string
HashFileStates(const std::vector<std::filesystem::path> & files);

} // namespace rhombic

#endif
