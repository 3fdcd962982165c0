#include "rhombicInProcessDecoder.h"

#include "rhombicDicomDecoding.h"

#include <mutex>
#include <vector>

namespace rhombic
{
namespace
{

class VectorBuffer : public VoxelBuffer
{
public:
  explicit VectorBuffer(std::size_t size)
    : m_Bytes(size)
  {}

  const std::byte *
  GetData() const override
  {
    return m_Bytes.data();
  }

  std::byte *
  GetData()
  {
    return m_Bytes.data();
  }

private:
  std::vector<std::byte> m_Bytes;
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
  auto buffer = std::make_unique<VectorBuffer>(request.size);
  static std::mutex turn;
  const std::lock_guard<std::mutex> lock(turn);
  DecodeDicomFile(request.path, buffer->GetData(), request.size);
  return buffer;
}

} // namespace rhombic
