#include "rhombicMappedVoxels.h"

#include "rhombicMemoryBudget.h"
#include "rhombicStoredVolume.h"

#include "itkImportImageContainer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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

template <typename TPixel>
void
PutInto(itk::Image<TPixel, 3> & image, std::unique_ptr<MappedPages> pages, std::size_t offset)
{
  pages->ExpectInOrder();
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

TemporaryStore
VoxelStore(const std::filesystem::path & scan, const std::filesystem::path & folder)
{
  return { folder, "Cannot read " + scan.string() + ": its voxels" };
}

VoxelPlace
FindPlaceToRead(const TemporaryStore & store,
                std::uintmax_t bytes,
                std::uintmax_t working,
                std::uintmax_t maximumMemory)
{
  const std::uintmax_t allowed = MemoryAllowance(maximumMemory);
  if (bytes + working <= allowed && (bytes <= allowed / 2 || !FindObstacle(store, bytes).empty()))
  {
    return VoxelPlace::Memory;
  }
  RequireRoom(store, bytes);
  return VoxelPlace::TemporaryFile;
}

void
AllocateInTemporaryFile(const ScanImage & image, const TemporaryStore & store)
{
  std::visit(
    [&store](const auto & voxels) {
      using Pixel = typename std::decay_t<decltype(*voxels)>::PixelType;
      const std::size_t size = voxels->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(Pixel);
      PutInto(*voxels, MapTemporaryFile(store, size), 0);
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
