#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCToCartesianImageFilter.h"
#include "itkRefusal.h"
#include "itkScanFileReader.h"
#include "itkTriangleSurfaceMeasures.h"
#include "rhombicScan.h"

#include "itkCastImageFilter.h"
#include "itkClampImageFilter.h"
#include "itkConstantPadImageFilter.h"
#include "itkCurvatureAnisotropicDiffusionImageFilter.h"
#include "itkDiscreteGaussianImageFilter.h"
#include "itkExtractImageFilter.h"
#include "itkFlipImageFilter.h"
#include "itkGradientAnisotropicDiffusionImageFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkIntensityWindowingImageFilter.h"
#include "itkMeanImageFilter.h"
#include "itkMedianImageFilter.h"
#include "itkPermuteAxesImageFilter.h"
#include "itkRegionOfInterestImageFilter.h"
#include "itkResampleImageFilter.h"
#include "itkShiftScaleImageFilter.h"
#include "itkShrinkImageFilter.h"
#include "itkSmoothingRecursiveGaussianImageFilter.h"
#include "itkThresholdImageFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

/** Filters of ITK between a scan and CartesianToFCCImageFilter: bodies keep their volumes, or the scan is refused. */
namespace
{

using ScanImage = itk::Image<float, 3>;
using PointType = itk::Point<double, 3>;
using VectorType = itk::Vector<double, 3>;

constexpr double Air = -1000.0;
constexpr double Tissue = 40.0;
constexpr double Edge = (Air + Tissue) / 2.0;
constexpr double Radius = 35.0; // mm

enum class Stack
{
  Tilted,
  Uneven,
  TiltedUneven,
  Gap
};

std::ostream &
operator<<(std::ostream & os, Stack stack)
{
  const char * const names[] = { "Tilted", "Uneven", "TiltedUneven", "Gap" };
  return os << names[static_cast<int>(stack)];
}

/** Heights of 70 mm and more of slices. */
std::vector<double>
HeightsOf(Stack stack)
{
  std::vector<double> heights{ 0.0 };
  while (heights.back() < 85.0)
  {
    const double step = stack == Stack::Gap      ? (heights.size() == 30 ? 6.0 : 1.5)
                        : stack == Stack::Tilted ? 1.5
                                                 : (heights.size() < 40 ? 1.2 : 2.4);
    heights.push_back(heights.back() + step);
  }
  return heights;
}

/** A scan of \a field, in columns and rows of 1.5 mm; tilted by 20 degrees, or unevenly spaced, or both. */
rhombic::Scan
MakeScan(Stack stack, const std::function<double(const PointType &)> & field)
{
  const std::vector<double> heights = HeightsOf(stack);
  const bool isTilted = stack == Stack::Tilted || stack == Stack::TiltedUneven;
  const double slope = isTilted ? std::tan(20.0 * itk::Math::pi / 180.0) : 0.0;
  const auto image = ScanImage::New();
  image->SetRegions(itk::Size<3>{ { 60, 64, heights.size() } });
  image->Allocate();
  const PointType origin(std::array<double, 3>{ -44.0, -48.0 - slope * heights.back() / 2.0, 0.0 }.data());
  image->SetOrigin(origin);
  const double meanStep = heights.back() / static_cast<double>(heights.size() - 1);
  const double length = std::hypot(1.0, slope);
  image->SetSpacing(std::array<double, 3>{ 1.5, 1.5, meanStep * length }.data());
  auto direction = image->GetDirection();
  direction[1][2] = slope / length;
  direction[2][2] = 1.0 / length;
  image->SetDirection(direction);
  rhombic::Scan scan;
  std::vector<PointType> origins;
  for (const double height : heights)
  {
    origins.push_back(origin + VectorType(std::array<double, 3>{ 0.0, slope * height, height }.data()));
  }
  for (itk::ImageRegionIteratorWithIndex<ScanImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto index = it.GetIndex();
    const double offset[3] = { 1.5 * static_cast<double>(index[0]), 1.5 * static_cast<double>(index[1]), 0.0 };
    it.Set(static_cast<float>(field(origins[static_cast<std::size_t>(index[2])] + VectorType(offset))));
  }
  if (stack != Stack::Tilted)
  {
    scan.sliceOrigins = origins;
  }
  scan.image = image;
  rhombic::AttachPlacement(scan);
  return scan;
}

/** From air to tissue around 0, over some millimetres. */
double
SoftEdge(double depth)
{
  return Edge + (Tissue - Edge) * std::tanh(depth / 3.0);
}

/** A ball in the middle of the stack. */
double
Ball(const PointType & point)
{
  const PointType centre(std::array<double, 3>{ 0.0, 0.0, 43.0 }.data());
  return SoftEdge(Radius - (point - centre).GetNorm());
}

constexpr double BallVolume = 4.0 / 3.0 * itk::Math::pi * Radius * Radius * Radius;

template <typename TImage>
double
VolumeOf(TImage * image, const rhombic::Scan * scan, double isovalue = Edge)
{
  using LatticeFilter = itk::CartesianToFCCImageFilter<TImage>;
  const auto lattice = LatticeFilter::New();
  lattice->SetInput(image);
  if (scan != nullptr)
  {
    lattice->SetScan(*scan);
  }
  const auto surface = itk::FCCIsosurfaceFilter<typename LatticeFilter::OutputImageType>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(isovalue);
  surface->Update();
  return itk::ComputeTriangleSurfaceVolume(*surface->GetOutput());
}

/** A filter of ITK, and the isovalue behind it. */
struct Between
{
  std::string name;
  std::function<double(ScanImage * image, const rhombic::Scan * scan)> volume;
};

template <typename TFilter>
Between
Make(
  const std::string & name,
  const std::function<void(TFilter &)> & set = [](TFilter &) {},
  double isovalue = Edge)
{
  return { name, [=](ScanImage * image, const rhombic::Scan * scan) {
            const auto filter = TFilter::New();
            filter->SetInput(image);
            set(*filter);
            return VolumeOf(filter->GetOutput(), scan, isovalue);
          } };
}

ScanImage::RegionType
Cropped(const itk::ImageBase<3> & image)
{
  auto region = image.GetLargestPossibleRegion();
  region.ShrinkByRadius(itk::Size<3>{ { 2, 1, 3 } });
  return region;
}

/** Filters that keep the slices of a scan, or crop or flip them. */
std::vector<Between>
KeepingSlices()
{
  using ShortImage = itk::Image<short, 3>;
  using ByteImage = itk::Image<unsigned char, 3>;
  using Median = itk::MedianImageFilter<ScanImage, ScanImage>;
  using Curvature = itk::CurvatureAnisotropicDiffusionImageFilter<ScanImage, ScanImage>;
  using Gradient = itk::GradientAnisotropicDiffusionImageFilter<ScanImage, ScanImage>;
  using Gaussian = itk::DiscreteGaussianImageFilter<ScanImage, ScanImage>;
  using Recursive = itk::SmoothingRecursiveGaussianImageFilter<ScanImage, ScanImage>;
  using Linear = itk::ShiftScaleImageFilter<ScanImage, ScanImage>;
  using Window = itk::IntensityWindowingImageFilter<ScanImage, ByteImage>;
  using Clamp = itk::ClampImageFilter<ScanImage, ShortImage>;
  using Threshold = itk::ThresholdImageFilter<ScanImage>;
  using Region = itk::RegionOfInterestImageFilter<ScanImage, ScanImage>;
  using Extract = itk::ExtractImageFilter<ScanImage, ScanImage>;
  using Flip = itk::FlipImageFilter<ScanImage>;
  using Shrink = itk::ShrinkImageFilter<ScanImage, ScanImage>;
  return {
    { "None", [](ScanImage * image, const rhombic::Scan * scan) { return VolumeOf(image, scan); } },
    Make<itk::CastImageFilter<ScanImage, ShortImage>>("Cast"),
    Make<itk::CastImageFilter<ScanImage, ScanImage>>("CastToTheSame", [](auto & cast) { cast.InPlaceOff(); }),
    Make<Median>("Median"),
    Make<itk::MeanImageFilter<ScanImage, ScanImage>>("Mean"),
    Make<Curvature>("CurvatureAnisotropicDiffusion",
                    [](Curvature & filter) {
                      filter.SetNumberOfIterations(2);
                      filter.SetTimeStep(0.04);
                    }),
    Make<Gradient>("GradientAnisotropicDiffusion",
                   [](Gradient & filter) {
                     filter.SetNumberOfIterations(2);
                     filter.SetTimeStep(0.04);
                   }),
    Make<Gaussian>("DiscreteGaussian", [](Gaussian & filter) { filter.SetVariance(1.0); }),
    Make<Recursive>("SmoothingRecursiveGaussian", [](Recursive & filter) { filter.SetSigma(1.0); }),
    Make<Linear>(
      "ShiftScale",
      [](Linear & filter) {
        filter.SetShift(3000.0);
        filter.SetScale(0.5);
      },
      (Edge + 3000.0) * 0.5),
    Make<Window>(
      "IntensityWindowing",
      [](Window & filter) {
        filter.SetWindowMinimum(Air);
        filter.SetWindowMaximum(Tissue);
        filter.SetOutputMinimum(50);
        filter.SetOutputMaximum(250);
      },
      150.0),
    Make<Clamp>("Clamp", [](Clamp & filter) { filter.SetBounds(-900, 0); }),
    Make<Threshold>("Threshold",
                    [](Threshold & filter) {
                      filter.ThresholdBelow(-950.0f);
                      filter.SetOutsideValue(-2000.0f);
                    }),
    Make<Region>("RegionOfInterest", [](Region & filter) { filter.SetRegionOfInterest(Cropped(*filter.GetInput())); }),
    Make<Extract>("ExtractImage",
                  [](Extract & filter) {
                    filter.SetDirectionCollapseToSubmatrix();
                    filter.SetExtractionRegion(Cropped(*filter.GetInput()));
                  }),
    Make<Flip>("FlipAlongRows",
               [](Flip & filter) {
                 filter.SetFlipAxes(std::array<bool, 3>{ { true, false, false } }.data());
                 filter.FlipAboutOriginOff();
               }),
    Make<Flip>("FlipSlices",
               [](Flip & filter) {
                 filter.SetFlipAxes(std::array<bool, 3>{ { false, false, true } }.data());
                 filter.FlipAboutOriginOff();
               }),
    Make<Shrink>(
      "ShrinkInSlices",
      [](Shrink & filter) {
        filter.SetShrinkFactors(itk::FixedArray<unsigned int, 3>(std::array<unsigned int, 3>{ { 2, 2, 1 } }.data()));
      }),
  };
}

/** Filters behind which the slices are not those of the scan. */
std::vector<Between>
ChangingSlices()
{
  using Shrink = itk::ShrinkImageFilter<ScanImage, ScanImage>;
  using Permute = itk::PermuteAxesImageFilter<ScanImage>;
  using Pad = itk::ConstantPadImageFilter<ScanImage, ScanImage>;
  using Resample = itk::ResampleImageFilter<ScanImage, ScanImage>;
  return {
    Make<Shrink>("ShrinkSlices", [](Shrink & filter) { filter.SetShrinkFactor(2, 2); }),
    Make<Permute>("PermuteAxes",
                  [](Permute & filter) {
                    filter.SetOrder(std::array<unsigned int, 3>{ { 2, 0, 1 } }.data());
                  }),
    Make<Pad>("PadSlices",
              [](Pad & filter) {
                filter.SetPadLowerBound(itk::Size<3>{ { 0, 0, 2 } });
                filter.SetConstant(static_cast<float>(Air));
              }),
    Make<Resample>("Resample",
                   [](Resample & filter) {
                     const ScanImage & image = *filter.GetInput();
                     auto spacing = image.GetSpacing();
                     auto size = image.GetLargestPossibleRegion().GetSize();
                     spacing[2] /= 1.5;
                     size[2] = size[2] * 3 / 2;
                     filter.SetOutputParametersFromImage(&image);
                     filter.SetOutputSpacing(spacing);
                     filter.SetSize(size);
                     filter.SetDefaultPixelValue(static_cast<float>(Air));
                   }),
  };
}

ScanImage *
ImageOf(const rhombic::Scan & scan)
{
  return std::get<ScanImage::Pointer>(scan.image);
}

class FiltersBeforeLattice : public testing::TestWithParam<Stack>
{
protected:
  const rhombic::Scan m_Scan = MakeScan(GetParam(), Ball);
  const bool m_IsUneven = GetParam() != Stack::Tilted;
};

TEST_P(FiltersBeforeLattice, KeepTheVolumeOfABody)
{
  for (const Between & between : KeepingSlices())
  {
    EXPECT_NEAR(between.volume(ImageOf(m_Scan), &m_Scan) / BallVolume, 1.0, 0.005) << between.name;
  }
}

TEST_P(FiltersBeforeLattice, AreRefusedWithoutTheScanWhereSlicesAreUneven)
{
  for (const Between & between : KeepingSlices())
  {
    double volume = 0.0;
    const std::string refusal = Refusal([&] { volume = between.volume(ImageOf(m_Scan), nullptr); });
    if (m_IsUneven && between.name != "None")
    {
      EXPECT_NE(refusal.find("call SetScan(reader->GetScan())"), std::string::npos) << between.name << ' ' << refusal;
    }
    else
    {
      EXPECT_EQ(refusal, "") << between.name;
      EXPECT_NEAR(volume / BallVolume, 1.0, 0.005) << between.name;
    }
  }
}

TEST_P(FiltersBeforeLattice, AreRefusedWhereTheyChangeUnevenSlices)
{
  for (const Between & between : ChangingSlices())
  {
    double volume = 0.0;
    const std::string refusal = Refusal([&] { volume = between.volume(ImageOf(m_Scan), &m_Scan); });
    if (m_IsUneven)
    {
      EXPECT_NE(refusal.find("is not the next slice of the scan"), std::string::npos) << between.name << ' ' << refusal;
    }
    else
    {
      EXPECT_EQ(refusal, "") << between.name;
      EXPECT_NEAR(volume / BallVolume, 1.0, 0.01) << between.name;
    }
  }
}

TEST_P(FiltersBeforeLattice, ImagesThatAreMadeFromALatticeAreEven)
{
  const auto lattice = itk::CartesianToFCCImageFilter<ScanImage>::New();
  lattice->SetInput(ImageOf(m_Scan));
  lattice->SetScan(m_Scan);
  const auto back = itk::FCCToCartesianImageFilter<itk::FCCImage<float>>::New();
  back->SetInput(lattice->GetOutput());
  const auto cast = itk::CastImageFilter<ScanImage, ScanImage>::New();
  cast->SetInput(back->GetOutput());
  EXPECT_NEAR(VolumeOf(back->GetOutput(), nullptr) / BallVolume, 1.0, 0.005);
  EXPECT_NEAR(VolumeOf(cast->GetOutput(), nullptr) / BallVolume, 1.0, 0.005);
  back->SetReferenceImage(ImageOf(m_Scan));
  EXPECT_NEAR(VolumeOf(back->GetOutput(), nullptr) / BallVolume, 1.0, 0.005) << "on the even grid of the scan";
}

TEST_P(FiltersBeforeLattice, AScanThatOnlyLendsItsGridDoesNotMakeAnImageUneven)
{
  const rhombic::Scan even = MakeScan(Stack::Tilted, Ball);
  const auto resample = itk::ResampleImageFilter<ScanImage, ScanImage>::New();
  resample->SetInput(ImageOf(even));
  resample->SetReferenceImage(ImageOf(m_Scan));
  resample->UseReferenceImageOn();
  resample->SetDefaultPixelValue(static_cast<float>(Air));
  EXPECT_NEAR(VolumeOf(resample->GetOutput(), nullptr) / BallVolume, 1.0, 0.01);
  resample->SetInput(ImageOf(m_Scan));
  resample->SetReferenceImage(ImageOf(even));
  const std::string refusal = Refusal([&] { VolumeOf(resample->GetOutput(), nullptr); });
  EXPECT_EQ(refusal.find("whose places a filter in between has left out") != std::string::npos, m_IsUneven) << refusal;
}

TEST_P(FiltersBeforeLattice, ABodyThatIsCutByTheFieldOfViewEndsThere)
{
  const auto cylinder = [](const PointType & point) { return SoftEdge(30.0 - std::hypot(point[0], point[2] - 43.0)); };
  const rhombic::Scan scan = MakeScan(GetParam(), cylinder);
  const double volume = itk::Math::pi * 30.0 * 30.0 * 64 * 1.5; // a shear keeps it
  for (const Between & between : KeepingSlices())
  {
    if (between.name != "RegionOfInterest" && between.name != "ExtractImage") // which cut it
    {
      EXPECT_NEAR(between.volume(ImageOf(scan), &scan) / volume, 1.0, 0.01) << between.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stacks,
                         FiltersBeforeLattice,
                         testing::Values(Stack::Tilted, Stack::Uneven, Stack::TiltedUneven, Stack::Gap),
                         testing::PrintToStringParamName());

TEST(FiltersBeforeLattice, TheNestedLatticeRefusesUnevenSlices)
{
  const rhombic::Scan scan = MakeScan(Stack::Uneven, Ball);
  const auto median = itk::MedianImageFilter<ScanImage, ScanImage>::New();
  median->SetInput(ImageOf(scan));
  const auto nested = itk::CartesianToNestedFCCImageFilter<ScanImage>::New();
  for (ScanImage * const image : { ImageOf(scan), median->GetOutput() })
  {
    nested->SetInput(image);
    EXPECT_NE(Refusal([&] { nested->UpdateOutputInformation(); }).find("unevenly spaced"), std::string::npos);
  }
}

TEST(FiltersBeforeLattice, AnImageOfItsOwnIsTakenAsItIs)
{
  const rhombic::Scan scan = MakeScan(Stack::Uneven, Ball);
  const auto cast = itk::CastImageFilter<ScanImage, ScanImage>::New();
  cast->InPlaceOff();
  cast->SetInput(ImageOf(scan));
  cast->Update();
  const ScanImage::Pointer image = cast->GetOutput();
  EXPECT_NE(Refusal([&] { VolumeOf(image.GetPointer(), nullptr); }), "");
  image->DisconnectPipeline();
  EXPECT_EQ(Refusal([&] { VolumeOf(image.GetPointer(), nullptr); }), "");
}

/** The volume of an image without a pipeline, whose slices and outside value are given to the lattice filter. */
double
VolumeGivenAll(ScanImage & image, const rhombic::Scan & scan, double isovalue)
{
  image.Update();
  const auto alone = ScanImage::New();
  alone->Graft(&image);
  const float * const begin = alone->GetBufferPointer();
  const auto lattice = itk::CartesianToFCCImageFilter<ScanImage>::New();
  lattice->SetInput(alone);
  lattice->SetSliceOrigins(scan.sliceOrigins);
  lattice->SetOutsideValue(*std::min_element(begin, begin + alone->GetPixelContainer()->Size()));
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<float>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(isovalue);
  surface->Update();
  return itk::ComputeTriangleSurfaceVolume(*surface->GetOutput());
}

// What ScanFileReader, a filter of ITK and the lattice filter make of the tilted and unevenly spaced scans.
TEST(FiltersBeforeLattice, RealScansKeepTheirVolumes)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  struct Real
  {
    const char * path;
    double isovalue;
    double volume; // ml, from slices at their true positions, and with air around them; 0: not known
    double change; // of the volume by the median at most; more in a few noisy slices
  };
  const Real reals[] = {
    { "ct_head_tilt_varspacing_dicom_rle", -300.5, 3422.5, 0.005 },
    { "nifti_awkward/shear.nii.gz", -300.5, 556.4, 0.006 },
    { "dicom_awkward_dicom2nifti/failing/gantrytilting/001", -897.5, 0.0, 0.05 },
    { "dicom_awkward_dicom2nifti/failing/sliceincrement/001", -897.5, 0.0, 0.05 },
    { "dicom_awkward_dicom2nifti/failing/sliceincrement/002", -897.5, 152.6, 0.05 },
  };
  for (const Real & real : reals)
  {
    SCOPED_TRACE(real.path);
    const auto reader = itk::ScanFileReader<ScanImage>::New();
    reader->SetFileName((std::filesystem::path(scans) / real.path).string());
    reader->AcceptGapsOn();
    reader->AcceptUnevenOn();
    reader->UpdateOutputInformation();
    const double volume = VolumeOf(reader->GetOutput(), nullptr, real.isovalue);
    EXPECT_GT(volume, 0.0);
    EXPECT_NEAR(volume / 1000.0, real.volume > 0.0 ? real.volume : volume / 1000.0, 0.1);
    const auto cast = itk::CastImageFilter<ScanImage, ScanImage>::New();
    cast->InPlaceOff();
    cast->SetInput(reader->GetOutput());
    EXPECT_DOUBLE_EQ(VolumeOf(cast->GetOutput(), &reader->GetScan(), real.isovalue), volume);
    const auto median = itk::MedianImageFilter<ScanImage, ScanImage>::New();
    median->SetInput(reader->GetOutput());
    const double behind = VolumeOf(median->GetOutput(), &reader->GetScan(), real.isovalue);
    EXPECT_DOUBLE_EQ(behind, VolumeGivenAll(*median->GetOutput(), reader->GetScan(), real.isovalue));
    EXPECT_NEAR(behind, volume, real.change * volume);
  }
}

TEST(FiltersBeforeLattice, AScanThatWasNotReadIsRefused)
{
  const auto lattice = itk::CartesianToFCCImageFilter<ScanImage>::New();
  EXPECT_NE(Refusal([&] { lattice->SetScan(rhombic::Scan()); }).find("UpdateOutputInformation()"), std::string::npos);
}

} // namespace
