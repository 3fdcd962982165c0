#ifndef rhombicFuzzFile_h
#define rhombicFuzzFile_h

#include "rhombicFuzzProperty.h"

#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace rhombicfuzz
{

/** \class FuzzFile
 * \brief A file in memory that holds a fuzzer's input, for readers that want a path. */
class FuzzFile
{
public:
  FuzzFile(const std::uint8_t * data, std::size_t size)
    : m_Descriptor(memfd_create("rhombic-fuzz", 0))
  {
    Require(m_Descriptor >= 0, "there is a file in memory");
    Require(write(m_Descriptor, data, size) == static_cast<ssize_t>(size), "the file takes the input");
  }
  ~FuzzFile()
  {
    close(m_Descriptor);
  }
  FuzzFile(const FuzzFile &) = delete;
  FuzzFile &
  operator=(const FuzzFile &) = delete;

  std::filesystem::path
  Path() const
  {
    return "/proc/self/fd/" + std::to_string(m_Descriptor);
  }

private:
  int m_Descriptor;
};

} // namespace rhombicfuzz

#endif
