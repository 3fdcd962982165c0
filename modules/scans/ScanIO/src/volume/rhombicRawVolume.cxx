#include "rhombicStoredVolume.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkByteSwapper.h"
#include "itkImageIOBase.h"

namespace rhombic
{
namespace
{

/** The stored type of a type of components; nothing for those that are no numbers here. */
template <typename... TStored>
std::optional<StoredType>
FindStoredType(itk::IOComponentEnum type, const std::variant<TStored...> *)
{
  std::optional<StoredType> found;
  ((itk::ImageIOBase::MapPixelType<TStored>::CType == type ? void(found = TStored()) : void()), ...);
  return found;
}

} // namespace

StoredVolume
DescribeRawVolume(const std::filesystem::path & path, const ScanReadOptions & options)
{
  const RawLayout & layout = options.raw.value();
  const auto type = FindStoredType(layout.type, static_cast<const StoredType *>(nullptr));
  const auto count = ProductOf({ layout.size[0], layout.size[1], layout.size[2], sizeof(double) });
  FailIf(!type || !count || *count == 0,
         FailureKind::Usage,
         "Cannot read " + path.string() +
           " as bare voxels: ScanReadOptions::raw has no size or type of voxels that a volume can have.");
  FailIf(!options.voxelSize,
         FailureKind::Usage,
         "Cannot read " + path.string() +
           " as bare voxels: it does not tell how large they are; give their size with ScanReadOptions::voxelSize.");
  const std::uintmax_t needed = *count / sizeof(double) * SizeOf(*type);
  const std::uintmax_t size = std::filesystem::file_size(path);
  RefuseVolumeIf(size != needed,
                 path,
                 "it has " + std::to_string(size) + " bytes, and " + FormatProduct(layout.size, 10) + " voxels of " +
                   std::to_string(SizeOf(*type)) + " bytes have " + std::to_string(needed) +
                   "; correct ScanReadOptions::raw, or copy the file again");
  StoredVolume volume;
  volume.type = *type;
  volume.geometry = MakeUnplacedGeometry({ { layout.size[0], layout.size[1], layout.size[2] } }, *options.voxelSize);
  volume.matrix = "voxel size";
  volume.encoding = "raw";
  volume.voxels.path = path;
  volume.voxels.isSwapped = layout.isBigEndian != itk::ByteSwapper<int>::SystemIsBigEndian();
  volume.isOriented = false;
  volume.note = "holds bare voxels; their axes are taken for left, posterior and superior, so that left and right are "
                "a guess";
  return volume;
}

} // namespace rhombic
