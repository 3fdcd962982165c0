#include "rhombicMappedVoxels.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicStoredVolume.h"

#include "itkImportImageContainer.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

/** \class MappedPages
 * \brief Pages of a file in the address space. */
class MappedPages
{
public:
  /** Takes over the open \a file. \a flags of mmap(). The address is null when the system does not map them, as beyond
   * a limit of the address space. */
  MappedPages(int file, std::uintmax_t begin, std::size_t size, int flags)
    : m_File(file)
    , m_Size(size)
    , m_IsShared((flags & MAP_SHARED) != 0)
  {
    void * const pages = mmap(nullptr, size, PROT_READ | PROT_WRITE, flags, file, static_cast<off_t>(begin));
    if (pages != MAP_FAILED)
    {
      m_Address = static_cast<std::byte *>(pages);
      madvise(pages, size, MADV_SEQUENTIAL); // pages that were used are the first to be dropped
    }
  }

  ~MappedPages()
  {
    if (m_Address != nullptr)
    {
      munmap(m_Address, m_Size);
    }
    close(m_File);
  }

  MappedPages(const MappedPages &) = delete;
  MappedPages &
  operator=(const MappedPages &) = delete;

  std::byte *
  GetAddress() const
  {
    return m_Address;
  }

  bool
  IsShared() const
  {
    return m_IsShared;
  }

  /** Takes them out of the process; those that were changed and are not shared stay. Pages of a file that is larger
   * than the free memory are dropped by the system, too, as they could not stay until they are read again. */
  void
  Drop() const
  {
    for (const auto & [begin, size] : this->FindUnchanged())
    {
      madvise(m_Address + begin, size, MADV_DONTNEED);
    }
    if (m_Size > FreeMemory())
    {
      if (m_IsShared)
      {
        fdatasync(m_File); // only pages that are on the disk can be dropped
      }
      posix_fadvise(m_File, 0, 0, POSIX_FADV_DONTNEED);
    }
  }

private:
  /** Runs of pages that are in memory as the file has them: their first byte and their size. None where the system does
   * not tell which these are. */
  std::vector<std::pair<std::size_t, std::size_t>>
  FindUnchanged() const
  {
    if (m_IsShared)
    {
      return { { 0, m_Size } };
    }
    constexpr std::uint64_t isPresent = std::uint64_t{ 1 } << 63, isOfFile = std::uint64_t{ 1 } << 61;
    constexpr std::size_t atOnce = 1 << 16; // pages
    const auto pageSize = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t count = (m_Size + pageSize - 1) / pageSize;
    std::vector<std::pair<std::size_t, std::size_t>> runs;
    std::vector<std::uint64_t> entries(std::min(count, atOnce));
    std::ifstream pagemap("/proc/self/pagemap", std::ios::binary);
    pagemap.seekg(static_cast<std::streamoff>(reinterpret_cast<std::uintptr_t>(m_Address) / pageSize * 8));
    for (std::size_t first = 0; first < count; first += atOnce)
    {
      const std::size_t part = std::min(atOnce, count - first);
      if (!pagemap.read(reinterpret_cast<char *>(entries.data()), static_cast<std::streamsize>(part * 8)))
      {
        return {};
      }
      for (std::size_t n = 0; n < part; ++n)
      {
        const std::size_t begin = (first + n) * pageSize;
        if ((entries[n] & isPresent) == 0 || (entries[n] & isOfFile) == 0)
        {
          continue;
        }
        if (!runs.empty() && runs.back().first + runs.back().second == begin)
        {
          runs.back().second += pageSize;
        }
        else
        {
          runs.emplace_back(begin, pageSize);
        }
      }
    }
    return runs;
  }

  const int m_File;
  const std::size_t m_Size;
  const bool m_IsShared;
  std::byte * m_Address = nullptr;
};

/** \class MappedContainer
 * \brief The pixels of an image in a mapped file. */
template <typename TPixel>
class MappedContainer : public itk::ImportImageContainer<itk::SizeValueType, TPixel>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MappedContainer);

  using Self = MappedContainer;
  using Superclass = itk::ImportImageContainer<itk::SizeValueType, TPixel>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);
  itkTypeMacro(MappedContainer, ImportImageContainer);

  void
  Take(std::unique_ptr<MappedPages> pages, std::size_t offset, std::size_t count)
  {
    m_Pages = std::move(pages);
    this->SetImportPointer(reinterpret_cast<TPixel *>(m_Pages->GetAddress() + offset), count, false);
  }

  const MappedPages &
  GetPages() const
  {
    return *m_Pages;
  }

protected:
  MappedContainer() = default;
  ~MappedContainer() override = default;

private:
  std::unique_ptr<MappedPages> m_Pages;
};

/** Pages of a file from \a begin on, a multiple of the pages' size. Null when the system does not map them. Memory for
 * changed pages is not reserved. */
std::unique_ptr<MappedPages>
MapPages(const std::filesystem::path & path, std::uintmax_t begin, std::size_t size)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  auto pages = file < 0 ? nullptr : std::make_unique<MappedPages>(file, begin, size, MAP_PRIVATE | MAP_NORESERVE);
  return pages && pages->GetAddress() != nullptr ? std::move(pages) : nullptr;
}

/** The folder of temporary files; empty if there is none. */
std::filesystem::path
TemporaryFolder()
{
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? std::filesystem::path() : folder;
}

[[noreturn]] void
RefuseTemporaryFile(std::uintmax_t size, const std::filesystem::path & scan, const std::string & why)
{
  const std::string folder = TemporaryFolder().string();
  throw Failure(
    FailureKind::Memory,
    "Cannot read " + scan.string() + ": its " + DescribeBytes(size) +
      " of voxels are too large for the memory that is allowed, and can't be put into a temporary file in " +
      (folder.empty() ? "a folder" : folder) + " (" + why + "); let TMPDIR name a folder on a disk with more room.");
}

/** Maps a new file without a name in the folder of temporary files. Throws Failure(Memory), naming the scan. */
std::unique_ptr<MappedPages>
MapTemporaryFile(std::size_t size, const std::filesystem::path & scan)
{
  RequireRoomForTemporaryFile(size, scan);
  std::string name = (TemporaryFolder() / "rhombic-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0)
  {
    RefuseTemporaryFile(size, scan, std::strerror(errno));
  }
  unlink(name.c_str());
  auto pages = std::make_unique<MappedPages>(file, 0, size, MAP_SHARED);
  if (pages->GetAddress() == nullptr)
  {
    RefuseTemporaryFile(size, scan, "a limit of the address space, as ulimit -v, forbids it");
  }
  // Pages without room on the disk would end the process.
  if (const int error = posix_fallocate(file, 0, static_cast<off_t>(size)); error != 0)
  {
    RefuseTemporaryFile(size, scan, std::strerror(error));
  }
  return pages;
}

template <typename TPixel>
void
PutInto(itk::Image<TPixel, 3> & image, std::unique_ptr<MappedPages> pages, std::size_t offset)
{
  const itk::ImageRegion<3> & region = image.GetLargestPossibleRegion();
  const auto container = MappedContainer<TPixel>::New();
  container->Take(std::move(pages), offset, region.GetNumberOfPixels());
  image.SetRegions(region);
  image.SetPixelContainer(container);
}

/** The place of a frame's first voxel in its file. */
std::uintmax_t
OffsetOf(const StoredVolume & volume, std::uintmax_t frame)
{
  const std::uintmax_t size = volume.geometry.GetNumberOfVoxels() * SizeOf(volume.type);
  return volume.voxels.offset + volume.voxels.skip + frame * size;
}

/** The pages of a mapped image; null for others. */
const MappedPages *
FindPages(const ScanImage & image)
{
  return std::visit(
    [](const auto & voxels) -> const MappedPages * {
      using Pixel = typename std::decay_t<decltype(*voxels)>::PixelType;
      const auto * const container =
        voxels ? dynamic_cast<const MappedContainer<Pixel> *>(voxels->GetPixelContainer()) : nullptr;
      return container ? &container->GetPages() : nullptr;
    },
    image);
}

} // namespace

void
RequireRoomForTemporaryFile(std::uintmax_t size, const std::filesystem::path & scan)
{
  const std::filesystem::path folder = TemporaryFolder();
  struct statfs system
  {};
  if (folder.empty() || statfs(folder.c_str(), &system) != 0)
  {
    RefuseTemporaryFile(size, scan, "which is not there");
  }
  if (system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC)
  {
    RefuseTemporaryFile(size, scan, "it is in memory itself");
  }
  const std::uintmax_t free = std::uintmax_t{ system.f_bavail } * static_cast<std::uintmax_t>(system.f_bsize);
  if (free < size)
  {
    RefuseTemporaryFile(size, scan, "where " + DescribeBytes(free) + " are free");
  }
}

void
AllocateInTemporaryFile(const ScanImage & image, const std::filesystem::path & scan)
{
  std::visit(
    [&scan](const auto & voxels) {
      using Pixel = typename std::decay_t<decltype(*voxels)>::PixelType;
      const std::size_t size = voxels->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(Pixel);
      PutInto(*voxels, MapTemporaryFile(size, scan), 0);
    },
    image);
}

bool
CanBeMapped(const StoredVolume & volume, std::uintmax_t frame)
{
  const bool isPixel = std::visit(
    [](auto stored, const auto & voxels) {
      return std::is_same_v<decltype(stored), typename std::decay_t<decltype(*voxels)>::PixelType>;
    },
    volume.type,
    NewVolumeImage(volume.type, false, volume.geometry));
  const bool isInterleaved = volume.areFramesInterleaved && volume.numberOfFrames > 1;
  return isPixel && !volume.scaling && !volume.voxels.isDeflated && !volume.voxels.isSwapped && !isInterleaved &&
         OffsetOf(volume, frame) % SizeOf(volume.type) == 0;
}

std::optional<ScanImage>
MapVoxels(const StoredVolume & volume, std::uintmax_t frame)
{
  const std::size_t size = volume.geometry.GetNumberOfVoxels() * SizeOf(volume.type);
  const std::uintmax_t offset = OffsetOf(volume, frame);
  const auto inPage = static_cast<std::size_t>(offset % static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE)));
  auto pages = MapPages(volume.voxels.path, offset - inPage, inPage + size);
  if (!pages)
  {
    return std::nullopt;
  }
  const ScanImage image = NewVolumeImage(volume.type, false, volume.geometry);
  std::visit([&](const auto & voxels) { PutInto(*voxels, std::move(pages), inPage); }, image);
  return image;
}

bool
IsMapped(const ScanImage & image)
{
  return FindPages(image) != nullptr;
}

VoxelPlace
PlaceOf(const ScanImage & image)
{
  const MappedPages * const pages = FindPages(image);
  return pages == nullptr ? VoxelPlace::Memory : pages->IsShared() ? VoxelPlace::TemporaryFile : VoxelPlace::File;
}

void
DropPages(const ScanImage & image)
{
  if (const MappedPages * const pages = FindPages(image))
  {
    pages->Drop();
  }
}

} // namespace rhombic
