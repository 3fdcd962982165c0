#include "rhombicInProcessDecoder.h"

#include <mutex>

namespace rhombic
{
namespace
{

class LocalBuffer : public VoxelBuffer
{
public:
  explicit LocalBuffer(const VoxelRequest & request)
    : m_Bytes(new std::byte[request.size])
    , m_Size(request.decode(request.path, m_Bytes.get(), request.size))
  {}

  const std::byte *
  GetData() const override
  {
    return m_Bytes.get();
  }

  std::size_t
  GetSize() const override
  {
    return m_Size;
  }

private:
  std::unique_ptr<std::byte[]> m_Bytes;
  std::size_t m_Size;
};

} // namespace

unsigned int
InProcessDecoder::GetNumberOfWorkers() const
{
  return 1;
}

std::unique_ptr<VoxelBuffer>
InProcessDecoder::Decode(const VoxelRequest & request)
{
  static std::mutex turn;
  const std::lock_guard<std::mutex> lock(turn);
  return std::make_unique<LocalBuffer>(request);
}

} // namespace rhombic
