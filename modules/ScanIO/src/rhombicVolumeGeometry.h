#ifndef rhombicVolumeGeometry_h
#define rhombicVolumeGeometry_h

#include "rhombicScanReader.h"

#include "itkImage.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** Where the voxels of a volume are, in LPS millimetres, in ITK's terms. */
struct VolumeGeometry
{
  itk::Size<3> size{};
  itk::Point<double, 3> origin{};
  itk::Vector<double, 3> spacing{};
  itk::Matrix<double, 3, 3> direction{}; ///< columns are the unit vectors along columns, rows and slices
};

/** The geometry of a volume whose voxel (i, j, k) is at origin + i step_0 + j step_1 + k step_2. */
VolumeGeometry
MakeGeometry(const itk::Size<3> & size, const itk::Point<double, 3> & origin, const itk::Vector<double, 3> steps[3]);

/** Throws Failure(Geometry) unless all numbers are finite, spacings from 1e-9 to 1e9 mm and the axes independent. Axes
 * that are not perpendicular within 1e-3 (the cosine) are refused too with Policy::Refuse, and otherwise noted. \a
 * matrix names where the axes come from: "sform". */
void
CheckGeometry(const VolumeGeometry & geometry,
              const std::filesystem::path & path,
              const std::string & matrix,
              ScanReadOptions::Policy onSheared,
              std::vector<std::string> & notes);

/** An image of this geometry, its pixels not set. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
NewImage(const VolumeGeometry & geometry)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(geometry.size);
  image->SetOrigin(geometry.origin);
  image->SetSpacing(geometry.spacing);
  image->SetDirection(geometry.direction);
  image->Allocate();
  return image;
}

} // namespace rhombic

#endif
