#ifndef itkFilterDescriptions_h
#define itkFilterDescriptions_h

#include "itkFilterDescription.h"

#include "itkAntiAliasMaskImageFilter.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"
#include "itkFCCBoxSplineDecompositionImageFilter.h"
#include "itkFCCGaussianImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkFCCToCartesianImageFilter.h"
#include "itkTriangleSurfaceFinishFilter.h"
#include "itkTriangleSurfaceSimplificationFilter.h"
#include "itkTriangleSurfaceSmoothingFilter.h"
#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <limits>

/** Every filter of ours. A new one gets a description here and a place in the lists at the end. */
namespace filtertest
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct CartesianToFCC : Description<itk::CartesianToFCCImageFilter<itk::Image<std::int16_t, 3>>>
{
  static constexpr const char * Name = "CartesianToFCC";
  static constexpr itk::SizeValueType MostSamples = 16;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    using Spacing = Filter::SpacingType;
    using Origins = Filter::SliceOriginsType;
    const std::vector<double> noDensities{ 0.0, -1.0, NaN, Infinity };
    const std::vector<Spacing> noSpacings{ Spacing(-1.0), Spacing(NaN), Spacing(Infinity) };
    auto density = MakeParameter("Density",
                                 &Filter::SetDensity,
                                 &Filter::GetDensity,
                                 itk::FCCLattice::NyquistDensity,
                                 0.5,
                                 noDensities,
                                 "default");
    density.refusals.push_back({ [](Filter & filter) { filter.SetDensity(1e30); }, "use a larger OutputSpacing" });
    return { density,
             MakeParameter("OutputSpacing",
                           &Filter::SetOutputSpacing,
                           &Filter::GetOutputSpacing,
                           Spacing(0.0),
                           Spacing(1.5),
                           noSpacings,
                           "set it to zero"),
             MakeParameter("Kernel",
                           &Filter::SetKernel,
                           &Filter::GetKernel,
                           itk::SeparableKernel::CubicBSpline,
                           itk::SeparableKernel::Linear,
                           { static_cast<itk::SeparableKernel>(17) },
                           "use Linear, CubicBSpline or Lanczos4"),
             MakeParameter("SliceOrigins",
                           &Filter::SetSliceOrigins,
                           &Filter::GetSliceOrigins,
                           Origins(),
                           Origins(7),
                           { Origins(7) },
                           "give one for each slice"),
             MakeParameter("OutsideValue",
                           &Filter::SetOutsideValue,
                           &Filter::GetOutsideValue,
                           std::optional<std::int16_t>(),
                           std::optional<std::int16_t>(0)) };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetKernel(static_cast<itk::SeparableKernel>(Integer(random, 0, 2)));
    filter.SetDensity(Uniform(random, 0.4, 1.5));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetDensity(20.0);
  }
};

/** The same from sheared axes or unevenly placed slices, which is other code. */
struct SlantedCartesianToFCC : CartesianToFCC
{
  static constexpr const char * Name = "SlantedCartesianToFCC";

  static void
  AskForParts(Filter & filter)
  {
    filter.SetOutsideValue(0);
  }

  static InputImage::Pointer
  MakeInput(const SizeType & size, Random & random)
  {
    const auto image = CartesianToFCC::MakeInput(size, random);
    auto direction = image->GetDirection();
    const unsigned int slanted = Integer(random, 0, 1) == 0 ? 1 : 2;
    for (unsigned int row = 0; row < 3; ++row)
    {
      direction[row][slanted] += 0.3 * direction[row][0];
    }
    image->SetDirection(direction);
    return image;
  }

  static void
  Vary(Filter & filter, const InputImage & input, Random & random)
  {
    CartesianToFCC::Vary(filter, input, random);
    filter.SetOutsideValue(-77);
    if (Integer(random, 0, 1) == 0)
    {
      Filter::SliceOriginsType origins;
      auto index = input.GetLargestPossibleRegion().GetIndex();
      for (itk::SizeValueType slice = 0; slice < input.GetLargestPossibleRegion().GetSize(2); ++slice, ++index[2])
      {
        itk::ContinuousIndex<double, 3> place(index);
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          place[axis] += Uniform(random, -0.3, 0.3);
        }
        origins.push_back(input.TransformContinuousIndexToPhysicalPoint<double>(place));
      }
      filter.SetSliceOrigins(origins);
    }
  }
};

struct CartesianToNestedFCC : Description<itk::CartesianToNestedFCCImageFilter<itk::Image<float, 3>>>
{
  static constexpr const char * Name = "CartesianToNestedFCC";
  static constexpr itk::SizeValueType MostSamples = 8;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    return { MakeParameter("Antialiasing", &Filter::SetAntialiasing, &Filter::GetAntialiasing, true, false) };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetAntialiasing(Integer(random, 0, 2) > 0);
  }
};

struct FCCToCartesian : Description<itk::FCCToCartesianImageFilter<itk::FCCImage<std::int16_t>>>
{
  static constexpr const char * Name = "FCCToCartesian";
  static constexpr itk::SizeValueType MostSamples = 4;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    using Spacing = Filter::SpacingType;
    using Reference = Filter::ReferenceImageType;
    static const auto reference = itk::Image<float, 3>::New();
    reference->SetRegions(SizeType{ { 5, 6, 7 } });
    const std::vector<Spacing> noSpacings{ Spacing(-1.0), Spacing(NaN), Spacing(Infinity) };
    auto spacing = MakeParameter("OutputSpacing",
                                 &Filter::SetOutputSpacing,
                                 &Filter::GetOutputSpacing,
                                 Spacing(0.0),
                                 Spacing(1.5),
                                 noSpacings,
                                 "set it to zero");
    spacing.refusals.push_back(
      { [](Filter & filter) { filter.SetOutputSpacing(Spacing(1e-9)); }, "use a larger OutputSpacing" });
    return { spacing,
             MakeParameter("ReferenceImage",
                           &Filter::SetReferenceImage,
                           &Filter::GetReferenceImage,
                           static_cast<const Reference *>(nullptr),
                           static_cast<const Reference *>(reference)),
             MakeParameter("DefaultPixelValue",
                           &Filter::SetDefaultPixelValue,
                           &Filter::GetDefaultPixelValue,
                           std::int16_t{ 0 },
                           std::int16_t{ 9 }) };
  }

  static void
  Vary(Filter & filter, const InputImage & input, Random & random)
  {
    filter.SetDefaultPixelValue(-77);
    if (Integer(random, 0, 1) == 0)
    {
      filter.SetOutputSpacing(Filter::SpacingType(Uniform(random, 0.5, 3.0)));
      return;
    }
    const auto reference = MakeFrame<itk::Image<std::uint8_t, 3>>(MakeSize(random), random);
    const auto somewhere = MakePart(input.GetLargestPossibleRegion(), random).GetIndex();
    reference->SetOrigin(input.TransformIndexToPhysicalPoint<double>(somewhere));
    filter.SetReferenceImage(reference);
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetOutputSpacing(Filter::SpacingType(0.4));
  }
};

template <typename TPixel>
struct FCCGaussian : Description<itk::FCCGaussianImageFilter<itk::FCCImage<TPixel>>>
{
  using Superclass = Description<itk::FCCGaussianImageFilter<itk::FCCImage<TPixel>>>;
  using typename Superclass::Filter;
  using typename Superclass::InputImage;
  static constexpr const char * Name = std::is_floating_point_v<TPixel> ? "FCCGaussianOfFloat" : "FCCGaussian";
  static constexpr itk::SizeValueType MostSamples = 26;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    const std::vector<double> noSigmas{ -1.0, NaN, Infinity };
    auto sigma = MakeParameter("Sigma", &Filter::SetSigma, &Filter::GetSigma, 0.0, 1.5, noSigmas, "try 1");
    sigma.refusals.push_back({ [](Filter & filter) { filter.SetSigma(1e9); }, "use at most" });
    return { sigma };
  }

  /** In float, some samples are not finite, which is other code. */
  static typename InputImage::Pointer
  MakeInput(const SizeType & size, Random & random)
  {
    const auto image = Superclass::MakeInput(size, random);
    if constexpr (std::is_floating_point_v<TPixel>)
    {
      const auto last = static_cast<long>(image->GetBufferedRegion().GetNumberOfPixels()) - 1;
      for (unsigned int n = 0; n < 3; ++n)
      {
        image->GetBufferPointer()[Integer(random, 0, last)] = std::numeric_limits<TPixel>::quiet_NaN();
      }
    }
    return image;
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetSigma(Integer(random, 0, 4) == 0 ? 0.0 : Uniform(random, 0.1, 2.0));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetSigma(100.0);
  }
  static constexpr itk::SizeValueType PassesOverRows =
    std::is_floating_point_v<TPixel> ? 3 : 2; // read, made, and read again for samples that are not finite
};

struct AntiAliasMask : Description<itk::AntiAliasMaskImageFilter>
{
  static constexpr const char * Name = "AntiAliasMask";
  static constexpr bool IsRegional = false;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    return { MakeParameter(
      "ProtectSpecksOnly", &Filter::SetProtectSpecksOnly, &Filter::GetProtectSpecksOnly, false, true) };
  }

  static std::vector<std::string>
  GetResultNames()
  {
    return { "ThinVoxels", "ProtectedVoxels" };
  }

  static InputImage::Pointer
  MakeInput(const SizeType & size, Random & random)
  {
    const auto image = MakeFrame<InputImage>(size, random);
    FillWithGyroid(*image, random, true);
    return image;
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetProtectSpecksOnly(Integer(random, 0, 1) == 0);
  }
};

struct FCCBoxSplineDecomposition : Description<itk::FCCBoxSplineDecompositionImageFilter<itk::FCCImage<std::int16_t>>>
{
  static constexpr const char * Name = "FCCBoxSplineDecomposition";
  static constexpr bool IsRegional = false;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    return { MakeParameter(
      "NumberOfIterations", &Filter::SetNumberOfIterations, &Filter::GetNumberOfIterations, 0u, 3u) };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetNumberOfIterations(static_cast<unsigned int>(Integer(random, 0, 4)));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetNumberOfIterations(20);
  }
  static constexpr itk::SizeValueType PassesOverRows = 21;
};

struct FCCIsosurface : Description<itk::FCCIsosurfaceFilter<itk::FCCImage<float>>>
{
  static constexpr const char * Name = "FCCIsosurface";
  static constexpr bool IsRegional = false;

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    using Values = std::vector<double>;
    auto isovalues = MakeParameter("Isovalues",
                                   &Filter::SetIsovalues,
                                   &Filter::GetIsovalues,
                                   Values{ 0.0 },
                                   Values{ 10.0, 20.0 },
                                   { Values{ NaN }, Values{ 0.0, Infinity } },
                                   "choose one in the range of the samples");
    isovalues.refusals.push_back({ [](Filter & filter) { filter.SetIsovalues({}); }, "at least one" });
    return {
      isovalues,
      MakeParameter("Mode",
                    &Filter::SetMode,
                    &Filter::GetMode,
                    itk::FCCIsosurfaceMode::Lean,
                    itk::FCCIsosurfaceMode::Octahedra,
                    { static_cast<itk::FCCIsosurfaceMode>(17) },
                    "use one of FCCIsosurfaceMode"),
      MakeParameter("ComputeNormals", &Filter::SetComputeNormals, &Filter::GetComputeNormals, true, false),
      MakeParameter("InsideIsBelow", &Filter::SetInsideIsBelow, &Filter::GetInsideIsBelow, false, true),
      MakeParameter("Closed", &Filter::SetClosed, &Filter::GetClosed, true, false),
      MakeParameter(
        "NumberOfStreamDivisions", &Filter::SetNumberOfStreamDivisions, &Filter::GetNumberOfStreamDivisions, 1u, 3u)
    };
  }

  static std::vector<std::string>
  GetResultNames()
  {
    return { "NumberOfUndefinedSamples" };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetMode(static_cast<itk::FCCIsosurfaceMode>(Integer(random, 0, 4)));
    filter.SetIsovalues({ Uniform(random, -30.0, 30.0), 7.0 });
    filter.SetClosed(Integer(random, 0, 1) == 0);
    filter.SetInsideIsBelow(Integer(random, 0, 1) == 0);
    filter.SetNumberOfStreamDivisions(static_cast<unsigned int>(Integer(random, 1, 5)));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetIsovalues({ 0.0, 100.0 });
  }
  static constexpr itk::SizeValueType PassesOverRows = 2 * 2; // points are counted and made for either isovalue
};

/** What filters of surfaces have in common. */
template <typename TFilter>
struct SurfaceDescription
{
  using Filter = TFilter;
  using InputImage = itk::TriangleSurface;

  static constexpr bool ChecksOnOneThread = true;

  static void
  SetWhatHasNoDefault(Filter &)
  {}

  static std::vector<std::string>
  GetResultNames()
  {
    return {};
  }

  /** A rough ball with a speck beside it. */
  static itk::TriangleSurface::Pointer
  MakeInput(const SizeType & size, Random & random)
  {
    const auto surface = itk::example::MakeSphere(20.0, size[0] < 30 ? 3 : 6);
    for (auto & point : surface->GetPoints())
    {
      const auto factor = static_cast<float>(Uniform(random, 0.999, 1.001));
      std::transform(point.begin(), point.end(), point.begin(), [factor](float x) { return x * factor; });
    }
    itk::example::Append(*surface, *itk::example::MakeSphere(1.0, 2), { 30.0f, 0.0f, 0.0f });
    return surface;
  }
};

struct SurfaceSimplification : SurfaceDescription<itk::TriangleSurfaceSimplificationFilter>
{
  static constexpr const char * Name = "SurfaceSimplification";

  static void
  SetWhatHasNoDefault(Filter & filter)
  {
    filter.SetTargetTriangles(100);
  }

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    auto target = MakeParameter("TargetTriangles",
                                &Filter::SetTargetTriangles,
                                &Filter::GetTargetTriangles,
                                itk::SizeValueType{ 0 },
                                itk::SizeValueType{ 100 });
    auto error = MakeParameter(
      "MaximumError", &Filter::SetMaximumError, &Filter::GetMaximumError, Infinity, 0.1, { 0.0, -1.0, NaN }, "above 0");
    return { target, error };
  }

  static std::vector<std::string>
  GetResultNames()
  {
    return { "TrianglesBefore", "TrianglesAfter", "PlacesTakenBack" };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetMaximumError(Uniform(random, 0.05, 0.2));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetTargetTriangles(2'000);
    filter.SetMaximumError(0.5);
  }
};

struct SurfaceSmoothing : SurfaceDescription<itk::TriangleSurfaceSmoothingFilter>
{
  static constexpr const char * Name = "SurfaceSmoothing";

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    return { MakeParameter("Iterations", &Filter::SetIterations, &Filter::GetIterations, 20u, 5u),
             MakeParameter("MaximumMove",
                           &Filter::SetMaximumMove,
                           &Filter::GetMaximumMove,
                           0.0,
                           0.3,
                           { -1.0, NaN, Infinity },
                           "give a number from 0") };
  }

  static std::vector<std::string>
  GetResultNames()
  {
    return { "MeanMove", "LargestMove", "PointsAtLimit", "PointsOnBorder" };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetMaximumMove(Uniform(random, 0.05, 0.2));
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetMaximumMove(0.5);
  }
};

struct SurfaceFinish : SurfaceDescription<itk::TriangleSurfaceFinishFilter>
{
  static constexpr const char * Name = "SurfaceFinish";

  static std::vector<Parameter<Filter>>
  GetParameters()
  {
    return { MakeParameter("Spacing",
                           &Filter::SetSpacing,
                           &Filter::GetSpacing,
                           1.0,
                           0.5,
                           { 0.0, -1.0, NaN, Infinity },
                           "give that of the lattice"),
             MakeParameter("MinimumVolume",
                           &Filter::SetMinimumVolume,
                           &Filter::GetMinimumVolume,
                           0.0,
                           1.0,
                           { -1.0, NaN, Infinity },
                           "must be 0 ml or more"),
             MakeParameter("KeepLargestPart", &Filter::SetKeepLargestPart, &Filter::GetKeepLargestPart, false, true),
             MakeParameter("FillCavities", &Filter::SetFillCavities, &Filter::GetFillCavities, false, true),
             MakeParameter(
               "Smoothing", &Filter::SetSmoothing, &Filter::GetSmoothing, 0.0, 0.5, { -1.0, 2.0, NaN }, "0 to 1"),
             MakeParameter("MaximumError",
                           &Filter::SetMaximumError,
                           &Filter::GetMaximumError,
                           0.0,
                           0.1,
                           { -1.0, NaN, Infinity },
                           "must be above 0"),
             MakeParameter("MaximumTriangles",
                           &Filter::SetMaximumTriangles,
                           &Filter::GetMaximumTriangles,
                           itk::SizeValueType{ 0 },
                           itk::SizeValueType{ 100 }) };
  }

  static std::vector<std::string>
  GetResultNames()
  {
    return { "Notes" };
  }

  static void
  Vary(Filter & filter, const InputImage &, Random & random)
  {
    filter.SetSmoothing(Uniform(random, 0.1, 0.3));
    filter.SetMaximumError(Uniform(random, 0.05, 0.2));
    filter.KeepLargestPartOn();
  }

  static void
  MakeSlow(Filter & filter)
  {
    filter.SetSmoothing(0.5);
    filter.SetMaximumTriangles(2'000);
  }
};

using SurfaceFilters = testing::Types<SurfaceSimplification, SurfaceSmoothing, SurfaceFinish>;
using ImageFilters = testing::Types<CartesianToFCC,
                                    SlantedCartesianToFCC,
                                    CartesianToNestedFCC,
                                    FCCToCartesian,
                                    FCCGaussian<std::int16_t>,
                                    FCCGaussian<float>,
                                    AntiAliasMask,
                                    FCCBoxSplineDecomposition>;
using Filters = testing::Types<CartesianToFCC,
                               SlantedCartesianToFCC,
                               CartesianToNestedFCC,
                               FCCToCartesian,
                               FCCGaussian<std::int16_t>,
                               FCCGaussian<float>,
                               AntiAliasMask,
                               FCCBoxSplineDecomposition,
                               FCCIsosurface>;
using AllFilters = testing::Types<CartesianToFCC,
                                  SlantedCartesianToFCC,
                                  CartesianToNestedFCC,
                                  FCCToCartesian,
                                  FCCGaussian<std::int16_t>,
                                  FCCGaussian<float>,
                                  AntiAliasMask,
                                  FCCBoxSplineDecomposition,
                                  FCCIsosurface,
                                  SurfaceSimplification,
                                  SurfaceSmoothing,
                                  SurfaceFinish>;

struct FilterNames
{
  template <typename TDescription>
  static std::string
  GetName(int)
  {
    return TDescription::Name;
  }
};

/** A filter with parameters of its own, and an input for it. */
template <typename TDescription>
struct Example
{
  using Filter = typename TDescription::Filter;
  using InputImage = typename TDescription::InputImage;

  typename InputImage::Pointer input;
  std::function<void(Filter &)> vary;                   ///< sets the parameters
  std::function<typename Filter::Pointer()> makeFilter; ///< the same each time, without an input
};

template <typename TDescription>
Example<TDescription>
MakeExample(unsigned int seed, const SizeType & size)
{
  Random random(seed);
  Example<TDescription> example;
  example.input = TDescription::MakeInput(size, random);
  example.vary = [input = example.input, settings = random()](typename TDescription::Filter & filter) {
    Random again(settings);
    TDescription::Vary(filter, *input, again);
  };
  example.makeFilter = [vary = example.vary] {
    const auto filter = TDescription::Filter::New();
    vary(*filter);
    return filter;
  };
  return example;
}

template <typename TDescription>
Example<TDescription>
MakeExample(unsigned int seed)
{
  Random random(seed);
  const SizeType size = MakeSize(random);
  return MakeExample<TDescription>(static_cast<unsigned int>(random()), size);
}

/** What the example's filter makes, alone. */
template <typename TDescription>
std::string
MakeOutput(const Example<TDescription> & example)
{
  const auto filter = example.makeFilter();
  filter->SetInput(example.input);
  return UpdatedOutput(*filter);
}

} // namespace filtertest

#endif
