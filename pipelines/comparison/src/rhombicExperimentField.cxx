#include "rhombicComparisonSteps.h"

#include "rhombicFailure.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanReader.h"
#include "rhombicShapeFields.h"
#include "rhombicWording.h"

#include "itkRegionOfInterestImageFilter.h"
#include "itkSmoothingRecursiveGaussianImageFilter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <variant>

namespace rhombic
{
namespace
{

/** A number from 0 to below 1. */
double
Uniform(std::mt19937_64 & random)
{
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

/** A sphere or torus that nearly fills a cube of \a size samples at spacing 1. The seed determines position and axis.
 */
void
AddShape(bool isSphere, unsigned int size, std::uint64_t seed, FieldCase & made)
{
  constexpr unsigned int bisections = 6; // sides about half of h
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return Uniform(random) - 0.5; };
  const double half = (size - 1) / 2.0;
  const Vector3 center{ half + uniform(), half + uniform(), half + uniform() };
  if (isSphere)
  {
    made.field = MakeSphereField(center, 0.325 * size);
    made.truth = MakeBisectedSphere(center, 0.325 * size, bisections);
    return;
  }
  const Vector3 axis{ uniform(), uniform(), uniform() };
  made.field = MakeTorusField(center, axis, 0.27 * size, 0.125 * size);
}

/** The seed shifts the object against the lattice, by up to about its spacing. */
FieldCase
MakeSilhouettes(const FieldRequest & request, std::uint64_t seed)
{
  constexpr double spacingOfTruth = 0.012;
  constexpr double leastMargin = 0.07;
  constexpr double shift = 0.08;
  std::mt19937_64 random(seed);
  if (request.object != "hand" && request.object != "quadruped")
  {
    throw Failure(FailureKind::Unreadable, "Silhouettes need an object: hand or quadruped.");
  }
  FieldCase made;
  made.isObject = true;
  static std::map<std::string, itk::TriangleSurface::Pointer> objects;
  itk::TriangleSurface::Pointer & object = objects[request.object];
  if (!object)
  {
    object = MakeTrueSurface(request.object == "hand" ? MakeHand() : MakeQuadruped(),
                             { { -1.3, -0.7, -0.4 }, { 1.3, 0.7, 2.2 } },
                             spacingOfTruth);
  }
  made.truth = itk::TriangleSurface::New();
  made.truth->GetPoints() = object->GetPoints();
  made.truth->GetTriangles() = object->GetTriangles();
  made.gap = request.object == "hand" ? PointsInGapOfHand() : std::vector<GapPoint>();
  const double cosine = std::cos(request.turn * 3.14159265358979324 / 180.0);
  const double sine = std::sin(request.turn * 3.14159265358979324 / 180.0);
  const auto turn = [&](auto & p) {
    using Coordinate = std::decay_t<decltype(p[0])>;
    p = { static_cast<Coordinate>(cosine * p[0] - sine * p[1]),
          static_cast<Coordinate>(sine * p[0] + cosine * p[1]),
          p[2] };
  };
  std::for_each(made.truth->GetPoints().begin(), made.truth->GetPoints().end(), turn);
  std::for_each(made.gap.begin(), made.gap.end(), [&](GapPoint & p) { turn(p.point); });
  made.field = MakeSilhouetteField(*made.truth, request.pixels);
  const auto bounds = made.truth->GetBounds();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double before = leastMargin + shift * Uniform(random);
    made.box.lower[axis] = bounds[2 * axis] - before;
    made.box.upper[axis] = bounds[2 * axis + 1] + 2.0 * leastMargin + shift - before;
  }
  return made;
}

using VolumeType = itk::Image<float, 3>;

/** The box of a request along the axes of a volume, in mm from its first sample. It is shortened where the volume ends.
 */
FieldBox
BoxIn(const itk::ImageBase<3> & volume, const FieldRequest & request)
{
  const double edge = request.spacing * request.size;
  FieldBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto samples = volume.GetLargestPossibleRegion().GetSize(axis);
    const double length = volume.GetSpacing()[axis] * static_cast<double>(samples - 1);
    box.lower[axis] = std::max(0.0, request.center[axis] * length - 0.5 * edge);
    box.upper[axis] = std::min(length, request.center[axis] * length + 0.5 * edge);
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

/** The cubic B-spline through the smoothed voxels of a part of a scan, minus the isovalue, in mm along the scan's axes,
 * in the order of the patient's. The seed shifts the part by up to half of h along each axis. Throws Failure: those of
 * OpenScan(), and Unreadable for slanted and uneven stacks of slices. */
FieldCase
MakeScanCase(const FieldRequest & request, std::uint64_t seed)
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
  FieldCase made;
  made.box = BoxIn(GeometryOf(scan.image), request);
  VolumeType::Pointer volume =
    std::visit([&made](const auto & image) { return CutOut(image.GetPointer(), made.box); }, scan.image);
  if (request.sigma > 0.0)
  {
    const auto smoothing = itk::SmoothingRecursiveGaussianImageFilter<VolumeType, VolumeType>::New();
    smoothing->SetInput(volume);
    smoothing->SetSigma(request.spacing * request.sigma);
    smoothing->Update();
    volume = smoothing->GetOutput();
  }
  float * const values = volume->GetBufferPointer();
  std::transform(values, values + volume->GetBufferedRegion().GetNumberOfPixels(), values, [&request](float value) {
    return static_cast<float>(value - request.isovalue);
  });
  made.field = MakeInterpolatedField(volume);
  made.isClosed = false;
  made.spacing = request.spacing;
  std::mt19937_64 random(seed);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double shift = 0.5 * request.spacing * Uniform(random);
    made.box.lower[axis] += shift;
    made.box.upper[axis] += shift - 0.5 * request.spacing;
  }
  return made;
}

} // namespace

FieldCase
MakeFieldCase(const FieldRequest & request, std::uint64_t seed)
{
  if (request.kind == "silhouettes")
  {
    return MakeSilhouettes(request, seed);
  }
  if (request.kind == "scan")
  {
    return MakeScanCase(request, seed);
  }
  FieldCase made;
  const double edge = request.size - 1.0;
  made.box = { { 0.0, 0.0, 0.0 }, { edge, edge, edge } };
  made.isClosed = request.kind == "sphere" || request.kind == "torus";
  if (made.isClosed)
  {
    AddShape(request.kind == "sphere", request.size, seed, made);
  }
  else if (request.kind == "gyroid")
  {
    made.field = MakeGyroidField(edge / 3.0);
  }
  else if (request.kind == "waves")
  {
    made.field = MakeBandLimitedField(request.bandLimit, seed);
  }
  else if (request.kind == "marschner-lobb" || request.kind == "corner")
  {
    made.box = { { -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 } };
    made.spacing = 2.0 / edge;
    made.field = request.kind == "corner" ? MakeCornerField(0.513) : MakeMarschnerLobbField();
  }
  else
  {
    throw Failure(
      FailureKind::Unreadable,
      DescribeUnknown("field",
                      request.kind,
                      { "sphere", "torus", "gyroid", "waves", "marschner-lobb", "corner", "silhouettes", "scan" },
                      "see pipelines/comparison/README.md"));
  }
  return made;
}

} // namespace rhombic
