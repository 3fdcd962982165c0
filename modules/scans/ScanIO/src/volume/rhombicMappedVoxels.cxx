#include "rhombicMappedVoxels.h"

#include "rhombicStoredVolume.h"

#include "itkImportImageContainer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

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

} // namespace

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
  ScanImage image = NewVolumeImage(volume.type, false, volume.geometry);
  const bool isMapped = std::visit(
    [&](auto stored, const auto & mapped) {
      using Pixel = typename std::decay_t<decltype(*mapped)>::PixelType;
      if constexpr (std::is_same_v<decltype(stored), Pixel>)
      {
        if (auto pages = MapPages(volume.voxels.path, offset - inPage, inPage + size))
        {
          const auto container = MappedContainer<Pixel>::New();
          container->Take(std::move(pages), inPage, size / voxelSize);
          mapped->SetRegions(volume.geometry.size);
          mapped->SetPixelContainer(container);
          return true;
        }
      }
      return false;
    },
    volume.type,
    image);
  return isMapped ? std::optional(image) : std::nullopt;
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
