#include "rhombicScanPart.h"

#include "rhombicFailure.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanReader.h"
#include "rhombicShapeFields.h"

#include "itkRegionOfInterestImageFilter.h"
#include "itkSmoothingRecursiveGaussianImageFilter.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<float, 3>;

/** The box of a request along the axes of a volume, from its first sample. */
FieldBox
BoxIn(const itk::ImageBase<3> & volume, const ScanPartRequest & request)
{
  FieldBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto samples = volume.GetLargestPossibleRegion().GetSize(axis);
    const double length = volume.GetSpacing()[axis] * static_cast<double>(samples - 1);
    box.lower[axis] = std::max(0.0, request.center[axis] * length - 0.5 * request.edge);
    box.upper[axis] = std::min(length, request.center[axis] * length + 0.5 * request.edge);
    if (!(box.lower[axis] < box.upper[axis]))
    {
      throw Failure(FailureKind::Unreadable, "A part of a scan lies outside of it; choose a center from 0 to 1.");
    }
  }
  return box;
}

/** The samples in and around a box, in float, with the box's axes as the axes of space. */
template <typename TImage>
VolumeType::Pointer
CutOut(const TImage * image, const FieldBox & box)
{
  constexpr double margin = 10.0; // samples: the spline's influence at this distance is below 1e-5
  auto region = image->GetLargestPossibleRegion();
  VolumeType::PointType origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = image->GetSpacing()[axis];
    const double last = static_cast<double>(region.GetSize(axis) - 1);
    const double first = std::max(0.0, std::floor(box.lower[axis] / spacing - margin));
    const double end = std::min(last, std::ceil(box.upper[axis] / spacing + margin));
    origin[axis] = first * spacing;
    region.SetIndex(axis, region.GetIndex(axis) + static_cast<itk::IndexValueType>(first));
    region.SetSize(axis, static_cast<itk::SizeValueType>(end - first) + 1);
  }
  const auto cut = itk::RegionOfInterestImageFilter<TImage, VolumeType>::New();
  cut->SetInput(image);
  cut->SetRegionOfInterest(region);
  cut->Update();
  const VolumeType::Pointer volume = cut->GetOutput();
  volume->DisconnectPipeline();
  volume->SetOrigin(origin);
  VolumeType::DirectionType identity;
  identity.SetIdentity();
  volume->SetDirection(identity);
  return volume;
}

} // namespace

ScanPart
ReadScanPart(const ScanPartRequest & request)
{
  ScanReadOptions options;
  options.onUneven = ScanReadOptions::Policy::Accept; // refused below
  const Scan scan = OrderAlongPatient(ReadVoxels(OpenScan(request.file, options)));
  if (IsSlanted(scan))
  {
    throw Failure(FailureKind::Unreadable,
                  "The slices of " + request.file.string() +
                    " are slanted or uneven, so that their cubic B-spline is not defined; choose another scan.");
  }
  const FieldBox box = BoxIn(GeometryOf(scan.image), request);
  VolumeType::Pointer volume =
    std::visit([&box](const auto & image) { return CutOut(image.GetPointer(), box); }, scan.image);
  if (request.sigma > 0.0)
  {
    const auto smoothing = itk::SmoothingRecursiveGaussianImageFilter<VolumeType, VolumeType>::New();
    smoothing->SetInput(volume);
    smoothing->SetSigma(request.sigma);
    smoothing->Update();
    volume = smoothing->GetOutput();
  }
  float * const values = volume->GetBufferPointer();
  std::transform(values, values + volume->GetBufferedRegion().GetNumberOfPixels(), values, [&request](float value) {
    return static_cast<float>(value - request.isovalue);
  });
  return { MakeInterpolatedField(volume), box };
}

} // namespace rhombic
