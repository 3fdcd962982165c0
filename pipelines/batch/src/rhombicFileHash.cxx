#include "rhombicFileHash.h"

#include "rhombicWording.h"

#include <itksys/MD5.h>

#include <array>
#include <fstream>
#include <memory>

namespace fs = std::filesystem;

namespace rhombic
{

std::string
HashFiles(const std::vector<fs::path> & files)
{
  const std::unique_ptr<itksysMD5, decltype(&itksysMD5_Delete)> md5(itksysMD5_New(), itksysMD5_Delete);
  itksysMD5_Initialize(md5.get());
  std::vector<char> block(1u << 20);
  for (const fs::path & file : files)
  {
    std::ifstream stream(file, std::ios::binary);
    while (stream)
    {
      stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      itksysMD5_Append(
        md5.get(), reinterpret_cast<const unsigned char *>(block.data()), static_cast<int>(stream.gcount()));
    }
  }
  std::array<char, 32> digits{};
  itksysMD5_FinalizeHex(md5.get(), digits.data());
  return std::string(digits.begin(), digits.end());
}

std::string
HashFileStates(const std::vector<fs::path> & files)
{
  std::string states;
  for (const fs::path & file : files)
  {
    std::error_code error;
    states += file.string() + '\n' + std::to_string(fs::file_size(file, error)) + ' ' +
              std::to_string(fs::last_write_time(file, error).time_since_epoch().count()) + '\n';
  }
  return HashText(states);
}

} // namespace rhombic
