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
#include <memory>
#include <type_traits>

namespace rhombic
{
namespace
{

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
  Take(std::shared_ptr<std::byte> mapping, std::size_t offset, std::size_t count)
  {
    m_Mapping = std::move(mapping);
    this->SetImportPointer(reinterpret_cast<TPixel *>(m_Mapping.get() + offset), count, false);
  }

protected:
  MappedContainer() = default;
  ~MappedContainer() override = default;

private:
  std::shared_ptr<std::byte> m_Mapping;
};

/** Pages of a file from \a begin on, a multiple of the pages' size. Null when the system does not map them, as beyond a
 * limit of the address space. Memory for changed pages is not reserved. */
std::shared_ptr<std::byte>
MapPages(const std::filesystem::path & path, std::uintmax_t begin, std::size_t size)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
  {
    return nullptr;
  }
  void * const pages =
    mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, file, static_cast<off_t>(begin));
  close(file);
  if (pages == MAP_FAILED)
  {
    return nullptr;
  }
  madvise(pages, size, MADV_SEQUENTIAL); // pages that were used are the first to be dropped
  return { static_cast<std::byte *>(pages), [size](std::byte * address) { munmap(address, size); } };
}

/** Pages of a new file without a name in the folder of temporary files. Throws Failure(Memory), naming the scan. */
std::shared_ptr<std::byte>
MapTemporaryFile(std::size_t size, const std::filesystem::path & scan)
{
  std::error_code folderError;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(folderError);
  const auto fail = [&](const std::string & why) {
    throw Failure(
      FailureKind::Memory,
      "Cannot read " + scan.string() + ": its " + DescribeBytes(size) +
        " of voxels are too large for the memory that is allowed, and can't be put into a temporary file in " +
        (folder.empty() ? "a folder" : folder.string()) + " (" + why +
        "); let TMPDIR name a folder on a disk with more room.");
  };
  if (folderError)
  {
    fail(folderError.message());
  }
  struct statfs system
  {};
  const bool isKnown = statfs(folder.c_str(), &system) == 0;
  if (isKnown && (system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC))
  {
    fail("it is in memory itself");
  }
  std::string name = (folder / "rhombic-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0)
  {
    fail(std::strerror(errno));
  }
  unlink(name.c_str());
  const int error =
    posix_fallocate(file, 0, static_cast<off_t>(size)); // pages without room on the disk end the process
  void * const pages = error != 0 ? MAP_FAILED : mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  const int mapError = errno;
  close(file);
  if (pages == MAP_FAILED)
  {
    fail(std::strerror(error != 0 ? error : mapError));
  }
  madvise(pages, size, MADV_SEQUENTIAL);
  return { static_cast<std::byte *>(pages), [size](std::byte * address) { munmap(address, size); } };
}

/** An image over pages that are mapped; nothing where its pixels are not of the stored type, or there are no pages.
 * \param map maps them, and is called only for the right type */
template <typename TMap>
std::optional<ScanImage>
ImageOverPages(StoredType type, const VolumeGeometry & geometry, std::size_t offset, const TMap & map)
{
  ScanImage image = NewVolumeImage(type, false, geometry);
  const bool isMapped = std::visit(
    [&](auto stored, const auto & mapped) {
      using Pixel = typename std::decay_t<decltype(*mapped)>::PixelType;
      if constexpr (std::is_same_v<decltype(stored), Pixel>)
      {
        if (auto pages = map())
        {
          const auto container = MappedContainer<Pixel>::New();
          container->Take(std::move(pages), offset, geometry.GetNumberOfVoxels());
          mapped->SetRegions(geometry.size);
          mapped->SetPixelContainer(container);
          return true;
        }
      }
      return false;
    },
    type,
    image);
  return isMapped ? std::optional(image) : std::nullopt;
}

} // namespace

std::optional<ScanImage>
NewImageInTemporaryFile(StoredType type, const VolumeGeometry & geometry, const std::filesystem::path & path)
{
  const std::size_t size = geometry.GetNumberOfVoxels() * SizeOf(type);
  return ImageOverPages(type, geometry, 0, [&] { return MapTemporaryFile(size, path); });
}

std::optional<ScanImage>
MapVoxels(const StoredVolume & volume, std::uintmax_t frame)
{
  const std::size_t voxelSize = SizeOf(volume.type);
  const std::size_t size = volume.geometry.GetNumberOfVoxels() * voxelSize;
  const std::uintmax_t offset = volume.voxels.offset + volume.voxels.skip + frame * size;
  const bool isInterleaved = volume.areFramesInterleaved && volume.numberOfFrames > 1;
  if (volume.scaling || volume.voxels.isDeflated || volume.voxels.isSwapped || isInterleaved || offset % voxelSize != 0)
  {
    return std::nullopt;
  }
  const auto inPage = static_cast<std::size_t>(offset % static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE)));
  return ImageOverPages(
    volume.type, volume.geometry, inPage, [&] { return MapPages(volume.voxels.path, offset - inPage, inPage + size); });
}

bool
IsMapped(const ScanImage & image)
{
  return std::visit(
    [](const auto & voxels) {
      using Pixel = typename std::decay_t<decltype(*voxels)>::PixelType;
      return voxels && dynamic_cast<const MappedContainer<Pixel> *>(voxels->GetPixelContainer()) != nullptr;
    },
    image);
}

} // namespace rhombic
