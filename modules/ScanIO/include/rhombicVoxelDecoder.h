#ifndef rhombicVoxelDecoder_h
#define rhombicVoxelDecoder_h

#include <cstddef>
#include <filesystem>
#include <memory>

namespace rhombic
{

/** A request to unpack all frames of a DICOM file with compressed pixels, by GDCM. */
struct VoxelRequest
{
  std::filesystem::path path;
  std::size_t size = 0; ///< bytes of the unpacked voxels, in this machine's byte order
};

/** \class VoxelBuffer
 * \brief Unpacked voxels.
 *
 * Thread safety: any number of threads may read it at once. */
class VoxelBuffer
{
public:
  VoxelBuffer() = default;
  virtual ~VoxelBuffer() = default;
  VoxelBuffer(const VoxelBuffer &) = delete;
  VoxelBuffer &
  operator=(const VoxelBuffer &) = delete;

  /** VoxelRequest::size bytes, aligned for any number, valid as long as this object, which must not outlive the
   * decoder. */
  virtual const std::byte *
  GetData() const = 0;
};

/** \class VoxelDecoder
 * \brief Runs the libraries that unpack voxels, which damaged files can crash.
 *
 * The readers run them in their own process by default, IsolatedDecoder in child processes.
 *
 * Thread safety: any number of threads may call Decode() at once. */
class VoxelDecoder
{
public:
  VoxelDecoder() = default;
  virtual ~VoxelDecoder() = default;
  VoxelDecoder(const VoxelDecoder &) = delete;
  VoxelDecoder &
  operator=(const VoxelDecoder &) = delete;

  /** The number of requests that are worked on at the same time. */
  virtual unsigned int
  GetNumberOfWorkers() const = 0;

  /** Unpacks the voxels of one file. Throws Failure: Unreadable, naming the file, when it is damaged, not supported, of
   * another size, or when its decoder crashed or took too long; Memory. */
  virtual std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request) = 0;
};

} // namespace rhombic

#endif
