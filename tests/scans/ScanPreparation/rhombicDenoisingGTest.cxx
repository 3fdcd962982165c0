#include "rhombicDenoising.h"

#include "rhombicFailure.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace
{

using rhombic::Denoising;
using Kind = Denoising::Kind;

constexpr double radius = 12.0;

/** A ball about the origin, 500 in surroundings of -500, with an edge of the width that scanners give it, in noise. */
template <typename TPixel = std::int16_t>
rhombic::Scan
MakeBall(double noise, double slices = 1.0)
{
  using ImageType = itk::Image<TPixel, 3>;
  const auto image = ImageType::New();
  const auto depth = static_cast<itk::SizeValueType>(40.0 / slices);
  image->SetRegions(itk::Size<3>{ { 40, 40, depth } });
  image->Allocate();
  const double spacing[3] = { 1.0, 1.0, slices };
  const double origin[3] = { -19.5, -19.5, -0.5 * slices * static_cast<double>(depth - 1) };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  std::mt19937 random(11);
  std::normal_distribution<double> normal; // times the noise, which may be 0
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = image->template TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const double distance = point.GetVectorFromOrigin().GetNorm();
    it.Set(static_cast<TPixel>(std::lround(500.0 * std::erf(radius - distance) + noise * normal(random))));
  }
  rhombic::Scan scan;
  scan.image = image;
  return scan;
}

struct RadialErrors
{
  double mean = 0.0;
  double rms = 0.0; ///< about the mean
};

/** Of the surface at 0, whose specks of noise are left out. */
RadialErrors
MeasureSurface(const rhombic::Scan & scan, const Denoising & denoising)
{
  rhombic::LatticeSettings settings;
  settings.denoising = denoising;
  const auto volume = rhombic::ScanToLattice(scan, settings, {});
  rhombic::SurfaceRequest request;
  request.name = "ball";
  request.isovalue = 0.0;
  const auto surfaces = rhombic::LatticeToSurfaces(volume, { request }, itk::FCCIsosurfaceMode::Fine, {});
  RadialErrors errors;
  double squares = 0.0;
  std::size_t count = 0;
  for (const auto & point : surfaces[0].surface->GetPoints())
  {
    const double error = std::hypot(point[0], point[1], point[2]) - radius;
    if (std::abs(error) < 0.25 * radius)
    {
      errors.mean += error;
      squares += error * error;
      ++count;
    }
  }
  errors.mean /= static_cast<double>(count);
  errors.rms = std::sqrt(squares / static_cast<double>(count) - errors.mean * errors.mean);
  return errors;
}

rhombic::FailureKind
KindOfFailure(const std::function<void()> & work)
{
  try
  {
    work();
  }
  catch (const rhombic::Failure & failure)
  {
    return failure.GetKind();
  }
  return rhombic::FailureKind::Internal;
}

TEST(Denoising, MakesASmootherBallAndAGaussianASmallerOne)
{
  const auto scan = MakeBall(150.0);
  const auto noisy = MeasureSurface(scan, {});
  const auto gaussian = MeasureSurface(scan, { Kind::Gaussian, 1.2 });
  const auto edges = MeasureSurface(scan, { Kind::EdgePreserving, 1.2, 300.0 });
  EXPECT_LT(gaussian.rms, 0.4 * noisy.rms);
  EXPECT_LT(edges.rms, 0.9 * noisy.rms);

  const auto sharp = MeasureSurface(MakeBall(0.0), {});
  const auto smooth = MeasureSurface(MakeBall(0.0), { Kind::Gaussian, 1.2 });
  EXPECT_NEAR(sharp.mean - smooth.mean, 1.2 * 1.2 / radius, 0.15 * 1.2 * 1.2 / radius);
  const auto kept = MeasureSurface(MakeBall(0.0), { Kind::EdgePreserving, 1.2, 150.0 });
  EXPECT_LT(std::abs(sharp.mean - kept.mean), 0.1 * 1.2 * 1.2 / radius);
}

TEST(Denoising, TakesNoiseOutOfWhatIsFlatAndKeepsThinThings)
{
  // A plate one sample thick in noise.
  auto scan = MakeBall<float>(0.0);
  auto & image = *std::get<itk::Image<float, 3>::Pointer>(scan.image);
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0f, 20.0f);
  for (itk::ImageRegionIteratorWithIndex<itk::Image<float, 3>> it(&image, image.GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    it.Set((it.GetIndex()[0] == 20 ? 400.0f : 0.0f) + noise(random));
  }
  const auto measure = [](const rhombic::ScanImage & of) {
    const auto & field = *std::get<itk::Image<float, 3>::Pointer>(of);
    double flat = 0.0;
    double plate = 0.0;
    for (itk::IndexValueType n = 0; n < 1600; ++n)
    {
      flat += std::pow(field.GetPixel({ { 8, n % 40, n / 40 } }), 2) / 1600.0;
      plate += static_cast<double>(field.GetPixel({ { 20, n % 40, n / 40 } })) / 1600.0;
    }
    return std::make_pair(std::sqrt(flat), plate);
  };
  const auto [noiseBefore, plateBefore] = measure(scan.image);
  const auto [noiseAfter, plateAfter] =
    measure(rhombic::DenoiseScan(scan.image, { Kind::EdgePreserving, 1.0, 50.0 }, 0, {}));
  EXPECT_LT(noiseAfter, 0.4 * noiseBefore);
  EXPECT_GT(plateAfter, 0.95 * plateBefore);
}

TEST(Denoising, WithoutEdgesSmoothsAsMuchAsAGaussian)
{
  // Far below its edge, the diffusion is linear; across coarser axes its sigma grows with the root of the spacing.
  for (const double slices : { 1.0, 2.0 })
  {
    const auto scan = MakeBall(0.0, slices);
    const auto sharp = MeasureSurface(scan, {});
    const auto smooth = MeasureSurface(scan, { Kind::EdgePreserving, 1.5, 1e6 });
    const double shrink = 1.5 * 1.5 / radius;
    EXPECT_NEAR(sharp.mean - smooth.mean, shrink * (1.0 + slices) / 2.0, 0.25 * shrink) << slices;
  }
}

TEST(Denoising, KeepsThePixelTypeAndWithoutNoiseTheImage)
{
  const auto scan = MakeBall<float>(10.0);
  EXPECT_EQ(rhombic::DenoiseScan(scan.image, {}, 0, {}), scan.image);
  EXPECT_EQ(rhombic::DenoiseScan(scan.image, { Kind::Gaussian, 1.0 }, 0, {}), scan.image) << "that is the lattice's";
  const auto whole = MakeBall<std::int16_t>(10.0);
  EXPECT_EQ(rhombic::DenoiseScan(whole.image, { Kind::EdgePreserving, 1.0, 50.0 }, 0, {}).index(), whole.image.index());
  const auto volume = rhombic::ScanToLattice(whole, {}, {});
  EXPECT_EQ(rhombic::DenoiseLattice(volume, {}, 0, {}), volume);
  EXPECT_EQ(rhombic::DenoiseLattice(volume, { Kind::Gaussian, 1.0 }, 0, {}).index(), volume.index());
}

TEST(Denoising, ReportsProgress)
{
  const auto scan = MakeBall(10.0);
  for (const Denoising & denoising : { Denoising{ Kind::Gaussian, 1.0 }, Denoising{ Kind::EdgePreserving, 1.0, 50.0 } })
  {
    double last = 0.0;
    rhombic::Events events;
    events.progress = [&](const std::string & step, double fraction) { last = step == "smoothing" ? fraction : last; };
    rhombic::LatticeSettings settings;
    settings.denoising = denoising;
    rhombic::ScanToLattice(scan, settings, events);
    EXPECT_GT(last, 0.9);
  }
}

TEST(Denoising, RefusesWhatItCantDo)
{
  const auto failure = [](const rhombic::Scan & scan, const Denoising & denoising, std::uintmax_t memory = 0) {
    rhombic::LatticeSettings settings;
    settings.denoising = denoising;
    settings.maximumMemory = memory;
    return KindOfFailure([&] { rhombic::ScanToLattice(scan, settings, {}); });
  };
  using rhombic::FailureKind;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto scan = MakeBall(10.0);
  EXPECT_EQ(failure(scan, { Kind::Gaussian, -1.0 }), FailureKind::Usage);
  EXPECT_EQ(failure(scan, { Kind::Gaussian, nan }), FailureKind::Usage);
  EXPECT_EQ(failure(scan, { Kind::Gaussian, 1e7 }), FailureKind::Usage);
  EXPECT_EQ(failure(scan, { Kind::EdgePreserving, 1.0, nan }), FailureKind::Usage);
  EXPECT_EQ(failure(scan, { Kind::EdgePreserving, 100.0, 60.0 }), FailureKind::Usage) << "steps";
  EXPECT_EQ(failure(scan, { Kind::EdgePreserving, 1.0, 60.0 }, 400000), FailureKind::Memory);
  EXPECT_EQ(failure(scan, { Kind::Gaussian, 1.0 }, 260000), FailureKind::Memory) << "for two lattices";
  EXPECT_EQ(failure(scan, { Kind::None }, 260000), FailureKind::Internal) << "but not for one";
  scan.sliceOrigins.resize(40);
  EXPECT_EQ(failure(scan, { Kind::EdgePreserving, 1.0, 60.0 }), FailureKind::Usage) << "uneven slices";
  const auto undefined = MakeBall<float>(10.0);
  std::get<itk::Image<float, 3>::Pointer>(undefined.image)->GetBufferPointer()[7] = static_cast<float>(nan);
  EXPECT_EQ(failure(undefined, { Kind::EdgePreserving, 1.0, 60.0 }), FailureKind::Unreadable);
  const auto volume = rhombic::ScanToLattice(MakeBall(10.0), {}, {});
  EXPECT_EQ(KindOfFailure([&] {
              rhombic::DenoiseLattice(volume, { Kind::EdgePreserving, 1.0, 60.0 }, 0, {});
            }),
            FailureKind::Usage);
}

} // namespace
