#ifndef rhombicVoxelDecoder_h
#define rhombicVoxelDecoder_h

#include <cstddef>
#include <filesystem>
#include <memory>

namespace rhombic
{

/** A request to decode a file. */
struct VoxelRequest
{
  /** Decodes a file to at most \a size bytes and returns their number. May throw Failure and any other exception. */
  using Function = std::size_t (*)(const std::filesystem::path & path, std::byte * bytes, std::size_t size);

  Function decode = nullptr; ///< a function of the program, or of a library that it loads when it starts
  std::filesystem::path path;
  std::size_t size = 0; ///< the largest number of bytes
};

/** \class VoxelBuffer
 * \brief The bytes of a decoded file.
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

  /** GetSize() bytes, aligned for any number, valid as long as this object, which must not outlive the decoder. */
  virtual const std::byte *
  GetData() const = 0;

  virtual std::size_t
  GetSize() const = 0;
};

/** \class VoxelDecoder
 * \brief Runs the libraries that decode files of pixels and surfaces, which damaged files can crash.
 *
 * InProcessDecoder, which readers have by default, runs them in its own process, IsolatedDecoder in child processes.
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

  /** Decodes one file. Throws Failure: Unreadable, naming the file, when it is damaged or not supported, or when its
   * decoder crashed or took too long; Memory. */
  virtual std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request) = 0;
};

} // namespace rhombic

#endif
