#include "rhombicOutputFile.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "The binary formats are little endian; this machine's numbers would have to be turned round."
#endif

namespace rhombic
{

OutputFile::OutputFile(const std::filesystem::path & path, const std::filesystem::path & target)
  : m_Path(path)
  , m_Target(target)
  , m_Descriptor(open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC))
{
  if (m_Descriptor < 0)
  {
    this->Fail();
  }
  m_Block.reserve(BlockSize);
}

OutputFile::~OutputFile()
{
  if (m_Descriptor >= 0)
  {
    close(m_Descriptor);
  }
}

void
OutputFile::Close()
{
  this->Flush();
  const int descriptor = m_Descriptor;
  m_Descriptor = -1;
  if (close(descriptor) != 0)
  {
    this->Fail();
  }
}

void
OutputFile::Digest::Add(const char * bytes, std::size_t count)
{
  size += count;
  checksum = crc32_z(checksum, reinterpret_cast<const Bytef *>(bytes), count);
}

bool
OutputFile::HoldsAppendedBytes() const
{
  std::ifstream file(m_Path, std::ios::binary);
  std::vector<char> block(BlockSize);
  Digest digest;
  while (file)
  {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.Add(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof())
  {
    this->Fail();
  }
  return digest.size == m_Digest.size && digest.checksum == m_Digest.checksum;
}

void
OutputFile::Flush()
{
  m_Digest.Add(m_Block.data(), m_Block.size());
  for (std::size_t done = 0; done < m_Block.size();)
  {
    const ssize_t written = write(m_Descriptor, m_Block.data() + done, m_Block.size() - done);
    if (written < 0 && errno != EINTR)
    {
      this->Fail();
    }
    done += written < 0 ? 0 : static_cast<std::size_t>(written);
  }
  m_Block.clear();
}

void
OutputFile::Fail() const
{
  throw Failure(FailureKind::Output,
                "Cannot write " + m_Target.string() + ": " + std::strerror(errno) +
                  "; free some space there or choose another folder.");
}

} // namespace rhombic
