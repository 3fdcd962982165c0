#include "rhombicDigest.h"

#include "rhombicWording.h"

#include <itksys/MD5.h>

#include <algorithm>
#include <fstream>

namespace rhombic
{

struct Digest::State
{
  std::unique_ptr<itksysMD5, decltype(&itksysMD5_Delete)> md5{ itksysMD5_New(), itksysMD5_Delete };
};

Digest::Digest()
  : m_State(std::make_unique<State>())
{
  itksysMD5_Initialize(m_State->md5.get());
}

Digest::~Digest() = default;

void
Digest::Add(const void * bytes, std::size_t size)
{
  constexpr std::size_t most = 1u << 30; // the library counts in int
  for (const auto * next = static_cast<const unsigned char *>(bytes); size > 0;)
  {
    const std::size_t count = std::min(size, most);
    itksysMD5_Append(m_State->md5.get(), next, static_cast<int>(count));
    next += count;
    size -= count;
  }
}

std::string
Digest::GetDigits()
{
  std::string digits(32, '0');
  itksysMD5_FinalizeHex(m_State->md5.get(), digits.data());
  return digits;
}

std::string
HashFiles(const std::vector<std::filesystem::path> & files)
{
  Digest digest;
  std::vector<char> block(1u << 20);
  for (const std::filesystem::path & file : files)
  {
    std::ifstream stream(file, std::ios::binary);
    while (stream)
    {
      stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      digest.Add(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
  }
  return digest.GetDigits();
}

std::string
HashFileStates(const std::vector<std::filesystem::path> & files)
{
  std::string states;
  for (const std::filesystem::path & file : files)
  {
    std::error_code error;
    states += file.string() + '\n' + std::to_string(std::filesystem::file_size(file, error)) + ' ' +
              std::to_string(std::filesystem::last_write_time(file, error).time_since_epoch().count()) + '\n';
  }
  return HashText(states);
}

} // namespace rhombic
