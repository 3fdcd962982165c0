#ifndef rhombicOMEZarrImage_h
#define rhombicOMEZarrImage_h

#include "rhombicForEachBlock.h"

#include "itkImageRegion.h"
#include "itkPoint.h"
#include "itkVector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

class ZarrArray;

/** Whether a folder holds a Zarr array or group, of version 2 or 3: by the names of its files. */
bool
IsZarr(const std::filesystem::path & folder);

/** Whether a folder holds an image of OME-Zarr, also one that OMEZarrImage refuses: not so for groups of images, whose
 * folders hold them, and arrays alone. */
bool
HoldsOMEZarrImage(const std::filesystem::path & folder);

/** Choices of OMEZarrImage. */
struct OMEZarrOptions
{
  std::size_t level = 0;     ///< of the pyramid; 0 is the finest
  bool followsLinks = false; ///< whether symbolic links in the folder are followed

  /** The size of a voxel of this level along x, y and z, in mm, for images that do not tell it. */
  std::optional<std::array<double, 3>> voxelSize;
};

/** \class OMEZarrImage
 * \brief A level of an image in a folder of OME-Zarr 0.4: volumes in chunks, one file for each.
 *
 * Positions are in mm, in the units that the axes name: scale, then translation, of the level, then of the image.
 * OME-Zarr does not tell how a volume lies in the patient: its axes x, y and z are taken for left, posterior and
 * superior. The three axes of space, in any order, are the last of the array; the fastest one is the first of the
 * volume. Those in front, such as time and channel, count volumes (frames). Other levels of OME-Zarr, and other
 * versions, are refused.
 *
 * Nothing outside of the folder is read. Chunks are unpacked in child processes with limits (SandboxRun); lengths,
 * nesting and numbers of the metadata are limited.
 *
 * Thread safety: any number of threads may read; copies share what they know. */
class OMEZarrImage
{
public:
  /** The type of the stored numbers: any value of that type. */
  using Type = std::variant<std::uint8_t,
                            std::int8_t,
                            std::uint16_t,
                            std::int16_t,
                            std::uint32_t,
                            std::int32_t,
                            std::uint64_t,
                            std::int64_t,
                            float,
                            double>;

  OMEZarrImage() = default;

  /** Reads and checks the metadata. Throws Failure: NotFound when the folder holds no image; Usage for a level that
   * there is not, and for a voxel size that is known; Geometry; Unreadable, naming the file. */
  explicit OMEZarrImage(const std::filesystem::path & folder, const OMEZarrOptions & options = {});

  Type
  GetType() const;

  const itk::Size<3> &
  GetSize() const
  {
    return m_Size;
  }

  /** The position of the first voxel, in LPS mm. */
  const itk::Point<double, 3> &
  GetOrigin() const
  {
    return m_Origin;
  }

  /** The steps from a voxel to the next one along the three axes, in LPS mm. */
  const std::array<itk::Vector<double, 3>, 3> &
  GetSteps() const
  {
    return m_Steps;
  }

  /** Volumes, of all times and channels. */
  std::size_t
  GetNumberOfFrames() const
  {
    return m_NumberOfFrames;
  }

  std::size_t
  GetNumberOfLevels() const
  {
    return m_NumberOfLevels;
  }

  /** The compressor: "raw", "zlib", "gzip", "zstd" or "blosc". */
  const std::string &
  GetEncoding() const;

  /** Assumptions, as the end of a sentence that begins with the path. */
  const std::vector<std::string> &
  GetNotes() const
  {
    return m_Notes;
  }

  /** The number of slices that chunks have: regions of so many, from a multiple of it, read each chunk once. */
  std::size_t
  GetSlicesOfChunks() const;

  /** The memory that reading takes besides its result, in bytes. */
  std::uintmax_t
  GetWorkingMemory() const;

  /** The files of metadata that were read, sorted. */
  const std::vector<std::filesystem::path> &
  GetMetadataFiles() const
  {
    return m_Metadata;
  }

  /** Metadata, and the chunks of a frame that there are, sorted. Throws Failure(Unreadable). */
  std::vector<std::filesystem::path>
  FindFiles(std::size_t frame) const;

  /** Reads the values of a region of a frame, x fastest, in this machine's byte order: only the chunks that it touches,
   * on all threads. Missing chunks are the fill value. Throws Failure(Unreadable), naming the chunk, and what
   * \a progress throws. */
  void
  Read(std::size_t frame,
       const itk::ImageRegion<3> & region,
       void * buffer,
       const ProgressFunction & progress = {}) const;

private:
  std::shared_ptr<const ZarrArray> m_Array;
  std::vector<std::filesystem::path> m_Metadata;
  itk::Size<3> m_Size{};
  itk::Point<double, 3> m_Origin{};
  std::array<itk::Vector<double, 3>, 3> m_Steps{};
  std::size_t m_NumberOfFrames = 1;
  std::size_t m_NumberOfLevels = 1;
  std::vector<std::string> m_Notes;
};

} // namespace rhombic

#endif
