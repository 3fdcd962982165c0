#ifndef rhombicVolumeGeometry_h
#define rhombicVolumeGeometry_h

#include "rhombicMappedVoxels.h"
#include "rhombicScanReader.h"

#include "itkRecyclingMemory.h"
#include "itkImage.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** The geometry of a volume as in ITK, in LPS millimetres. */
struct VolumeGeometry
{
  itk::Size<3> size{};
  itk::Point<double, 3> origin{};
  itk::Vector<double, 3> spacing{};
  itk::Matrix<double, 3, 3> direction{}; ///< columns are the unit vectors along columns, rows and slices

  std::size_t
  GetNumberOfVoxels() const
  {
    return size[0] * size[1] * size[2];
  }
};

/** The geometry of a volume whose voxel (i, j, k) is at origin + i step_0 + j step_1 + k step_2. */
VolumeGeometry
MakeGeometry(const itk::Size<3> & size, const itk::Point<double, 3> & origin, const itk::Vector<double, 3> steps[3]);

/** The geometry of voxels of which only the size is known: their axes are taken for left, posterior and superior.
 * \param voxelSize in mm */
VolumeGeometry
MakeUnplacedGeometry(const itk::Size<3> & size, const std::array<double, 3> & voxelSize);

/** Throws Failure(Geometry) unless all numbers are finite, the spacings are from 1e-9 to 1e9 mm and the axes are
 * linearly independent. Axes whose cosine is more than 1e-3 are refused with Policy::Refuse, and otherwise added to \a
 * notes. \a matrix names the source of the axes in messages, such as "sform". */
void
CheckGeometry(const VolumeGeometry & geometry,
              const std::filesystem::path & path,
              const std::string & matrix,
              ScanReadOptions::Policy onSheared,
              std::vector<std::string> & notes);

/** Whether two grids have one size, and their corners the same places, within a thousandth of a voxel. */
bool
AreSameGrids(const itk::ImageBase<3> & a, const itk::ImageBase<3> & b);

/** An image of this geometry without voxels. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
NewFrame(const VolumeGeometry & geometry)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetLargestPossibleRegion(geometry.size);
  image->SetOrigin(geometry.origin);
  image->SetSpacing(geometry.spacing);
  image->SetDirection(geometry.direction);
  return image;
}

/** An allocated image of this geometry, without initial values.
 * \param store of a scan that does not fit into memory: its pixels are put into a temporary file (see
 * AllocateInTemporaryFile()); by default none */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
NewImage(const VolumeGeometry & geometry, const TemporaryStore & store = {})
{
  auto image = NewFrame<TPixel>(geometry);
  if (!store.what.empty())
  {
    AllocateInTemporaryFile(image, store);
    return image;
  }
  image->SetRegions(geometry.size);
  image->Allocate();
  itk::AdviseHugePages(image->GetBufferPointer(), image->GetPixelContainer()->Size() * sizeof(TPixel));
  return image;
}

} // namespace rhombic

#endif
