#ifndef itkBulkImage_h
#define itkBulkImage_h

#include "rhombicSparseBulk.h"

#include "itkImportImageContainer.h"

#include <cstddef>
#include <memory>
#include <utility>

namespace itk
{

/** \file
 * Arrays of a value for each voxel or site, which may be in temporary files (rhombic::BulkInTemporaryFiles). */

/** A value for each voxel. */
template <typename T>
using VoxelArray = std::unique_ptr<T[], void (*)(void *) noexcept>;

/** Memory is taken for the parts that are used only. \param isZero whether all bytes are 0, else they are undefined */
template <typename T>
VoxelArray<T>
MakeVoxelArray(std::size_t voxels, bool isZero)
{
  return { static_cast<T *>(rhombic::AllocateSparseBulk(voxels * sizeof(T), isZero)), &rhombic::FreeBulk };
}

/** \class BulkImageContainer
 * \brief The pixels of an image in a VoxelArray. */
template <typename TPixel>
class BulkImageContainer : public ImportImageContainer<SizeValueType, TPixel>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(BulkImageContainer);

  using Self = BulkImageContainer;
  using Superclass = ImportImageContainer<SizeValueType, TPixel>;
  using Pointer = SmartPointer<Self>;

  itkNewMacro(Self);
  itkTypeMacro(BulkImageContainer, ImportImageContainer);

  void
  Take(VoxelArray<TPixel> pixels, std::size_t count)
  {
    m_Pixels = std::move(pixels);
    this->SetImportPointer(m_Pixels.get(), count, false);
  }

protected:
  BulkImageContainer() = default;
  ~BulkImageContainer() override = default;

private:
  VoxelArray<TPixel> m_Pixels{ nullptr, &rhombic::FreeBulk };
};

/** Allocates the buffered region of an image, as Allocate() does. The pixels are undefined. */
template <typename TImage>
void
AllocateInBulk(TImage & image)
{
  using Pixel = typename TImage::PixelType;
  const std::size_t count = image.GetBufferedRegion().GetNumberOfPixels();
  const auto container = BulkImageContainer<Pixel>::New();
  container->Take(MakeVoxelArray<Pixel>(count, false), count);
  image.SetPixelContainer(container);
}

} // namespace itk

#endif
