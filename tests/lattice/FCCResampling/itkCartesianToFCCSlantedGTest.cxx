#include "itkCartesianToFCCImageFilter.h"
#include "itkCartesianToNestedFCCImageFilter.h"

#include "itkCastImageFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMath.h"
#include "itkStreamingImageFilter.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>
#include <random>

namespace
{

using ImageType = itk::Image<float, 3>;
using LatticeType = itk::FCCImage<float>;
using FilterType = itk::CartesianToFCCImageFilter<ImageType>;
using PointType = itk::Point<double, 3>;
using VectorType = itk::Vector<double, 3>;
using FieldType = std::function<double(const PointType &)>;
using Kernel = itk::SeparableKernel;

/** A volume of slices and, where they are unevenly placed, their origins. */
struct Stack
{
  ImageType::Pointer image;
  std::vector<PointType> origins;

  PointType
  PointOf(const itk::Index<3> & index) const
  {
    if (origins.empty())
    {
      return image->TransformIndexToPhysicalPoint<double>(index);
    }
    auto first = image->GetLargestPossibleRegion().GetIndex();
    const auto slice = static_cast<std::size_t>(index[2] - first[2]);
    const PointType corner = image->TransformIndexToPhysicalPoint<double>(first);
    first[0] = index[0];
    first[1] = index[1];
    const auto inPlane = image->TransformIndexToPhysicalPoint<double>(first);
    return origins[slice] + (inPlane - corner);
  }

  void
  Fill(const FieldType & field) const
  {
    for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(static_cast<float>(field(this->PointOf(it.GetIndex()))));
    }
  }

  /** The point's place in samples from the first one, found by walking the slices. */
  itk::ContinuousIndex<double, 3>
  IndexOf(const PointType & point) const
  {
    const auto start = image->GetLargestPossibleRegion().GetIndex();
    const auto count = image->GetLargestPossibleRegion().GetSize(2);
    const auto originOf = [&](itk::IndexValueType k) {
      return this->PointOf({ { start[0], start[1], start[2] + k } });
    };
    auto next = start;
    ++next[0];
    const VectorType a = this->PointOf(next) - this->PointOf(start);
    next = start;
    ++next[1];
    const VectorType b = this->PointOf(next) - this->PointOf(start);
    const VectorType normal = itk::CrossProduct(a, b);
    itk::IndexValueType k = 0;
    const auto fraction = [&] { return ((point - originOf(k)) * normal) / ((originOf(k + 1) - originOf(k)) * normal); };
    while (k + 2 < static_cast<itk::IndexValueType>(count) && fraction() > 1.0)
    {
      ++k;
    }
    const double t = fraction();
    const VectorType inPlane = point - (originOf(k) + (originOf(k + 1) - originOf(k)) * t);
    itk::ContinuousIndex<double, 3> index;
    const double aa = a * a;
    const double ab = a * b;
    const double bb = b * b;
    index[0] = ((inPlane * a) * bb - (inPlane * b) * ab) / (aa * bb - ab * ab);
    index[1] = ((inPlane * b) * aa - (inPlane * a) * ab) / (aa * bb - ab * ab);
    index[2] = static_cast<double>(k) + t;
    return index;
  }

  bool
  IsInside(const PointType & point, const VectorType & margins) const
  {
    const auto index = this->IndexOf(point);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto last = static_cast<double>(image->GetLargestPossibleRegion().GetSize(axis) - 1);
      if (!(index[axis] >= margins[axis] && index[axis] <= last - margins[axis]))
      {
        return false;
      }
    }
    return true;
  }
};

/** Axes, as columns, at angles; left-handed. */
ImageType::DirectionType
Axes(double tilt, double inPlaneShear)
{
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const VectorType x{ std::array<double, 3>{ c, 0.0, -s }.data() };
  const VectorType y{ std::array<double, 3>{ 0.0, -1.0, 0.0 }.data() };
  const VectorType z{ std::array<double, 3>{ s, 0.0, c }.data() };
  const VectorType columns[3] = { x,
                                  y * std::cos(inPlaneShear) + x * std::sin(inPlaneShear),
                                  z * std::cos(tilt) + y * std::sin(tilt) };
  ImageType::DirectionType direction;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[row][axis] = columns[axis][row];
    }
  }
  return direction;
}

ImageType::Pointer
MakeImage(const itk::Size<3> & size, const ImageType::DirectionType & direction, double sliceStep)
{
  auto image = ImageType::New();
  image->SetRegions(ImageType::RegionType({ { -4, 5, 2 } }, size));
  image->Allocate(true);
  const double spacing[3] = { 0.7, 0.9, sliceStep };
  const double origin[3] = { -30.0, 12.0, 100.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  return image;
}

/** Slices along the image's third axis, at the given distances from each other. */
std::vector<PointType>
PlaceSlices(const ImageType & image, const std::function<double(std::size_t)> & step)
{
  VectorType axis;
  for (unsigned int row = 0; row < 3; ++row)
  {
    axis[row] = image.GetDirection()[row][2];
  }
  std::vector<PointType> origins{ image.TransformIndexToPhysicalPoint<double>(
    image.GetLargestPossibleRegion().GetIndex()) };
  while (origins.size() < image.GetLargestPossibleRegion().GetSize(2))
  {
    origins.push_back(origins.back() + axis * step(origins.size()));
  }
  return origins;
}

double
StepOfBlocks(std::size_t slice)
{
  return slice % 20 < 8 ? 1.0 : (slice % 20 == 10 ? 4.0 : 2.0);
}

enum class Kind
{
  Perpendicular,
  Tilted,
  Sheared,
  Uneven,
  TiltedUneven,
  Shifted
};

const Kind slantedKinds[] = { Kind::Tilted, Kind::Sheared, Kind::Uneven, Kind::TiltedUneven, Kind::Shifted };

Stack
MakeStack(Kind kind, const itk::Size<3> & size)
{
  const double degree = itk::Math::pi / 180.0;
  switch (kind)
  {
    case Kind::Perpendicular:
      return { MakeImage(size, Axes(0.0, 0.0), 1.5), {} };
    case Kind::Tilted:
      return { MakeImage(size, Axes(20.0 * degree, 0.0), 1.5), {} };
    case Kind::Sheared:
      return { MakeImage(size, Axes(-10.0 * degree, 15.0 * degree), 1.5), {} };
    case Kind::Uneven:
    {
      const auto image = MakeImage(size, Axes(0.0, 0.0), 1.5);
      return { image, PlaceSlices(*image, StepOfBlocks) };
    }
    case Kind::TiltedUneven:
    {
      const auto image = MakeImage(size, Axes(20.0 * degree, 0.0), 1.5);
      return { image, PlaceSlices(*image, StepOfBlocks) };
    }
    case Kind::Shifted:
      break;
  }
  const auto image = MakeImage(size, Axes(0.0, 5.0 * degree), 1.5);
  auto origins = PlaceSlices(*image, StepOfBlocks);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-2.0, 2.0);
  const auto direction = image->GetDirection();
  for (PointType & origin : origins)
  {
    const double x = shift(random);
    const double y = shift(random);
    for (unsigned int row = 0; row < 3; ++row)
    {
      origin[row] += x * direction[row][0] + y * direction[row][1];
    }
  }
  return { image, origins };
}

FilterType::Pointer
MakeFilter(const Stack & stack, Kernel kernel = Kernel::CubicBSpline)
{
  auto filter = FilterType::New();
  filter->SetInput(stack.image);
  filter->SetSliceOrigins(stack.origins);
  filter->SetKernel(kernel);
  return filter;
}

/** Root mean square and largest error at the sites in the stack, away from its borders. */
struct Errors
{
  double rms = 0.0;
  double largest = 0.0;
  int count = 0;
};

Errors
Measure(const Stack & stack, Kernel kernel, const FieldType & field, const VectorType & margins)
{
  stack.Fill(field);
  const auto filter = MakeFilter(stack, kernel);
  filter->Update();
  const auto * const output = filter->GetOutput();
  Errors errors;
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    if (stack.IsInside(point, margins))
    {
      const double error = std::abs(it.Get() - field(point));
      errors.rms += error * error;
      errors.largest = std::max(errors.largest, error);
      ++errors.count;
    }
  }
  errors.rms = std::sqrt(errors.rms / std::max(1, errors.count));
  return errors;
}

VectorType
Margins(double x, double y, double z)
{
  const double margins[3] = { x, y, z };
  return VectorType(margins);
}

TEST(CartesianToFCCSlanted, PinsItsDefaults)
{
  const auto filter = FilterType::New();
  EXPECT_TRUE(filter->GetSliceOrigins().empty());
  EXPECT_FALSE(filter->GetOutsideValue());
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("OutsideValue: (lowest of the input)"), std::string::npos);
  EXPECT_NE(text.str().find("SliceOrigins: 0"), std::string::npos);
}

TEST(CartesianToFCCSlanted, ReproducesLinearFieldsOfTheWorld)
{
  const auto field = [](const PointType & p) { return 10.0 + 0.5 * p[0] - 0.25 * p[1] + 0.125 * p[2]; };
  for (const Kind kind : slantedKinds)
  {
    const Stack stack = MakeStack(kind, { { 48, 48, 44 } });
    const Errors linear = Measure(stack, Kernel::Linear, field, Margins(0.0, 0.0, 0.0));
    EXPECT_LT(linear.largest, 1e-4) << static_cast<int>(kind);
    EXPECT_GT(linear.count, 10000);
    // Along evenly spaced samples the mirror images bend a slope at the ends; that dies out within a dozen samples.
    const Errors cubic =
      Measure(stack, Kernel::CubicBSpline, field, Margins(12.0, 12.0, stack.origins.empty() ? 12.0 : 0.0));
    EXPECT_LT(cubic.largest, 1e-4) << static_cast<int>(kind);
    EXPECT_GT(cubic.count, 5000);
  }
}

TEST(CartesianToFCCSlanted, LanczosReproducesLinearFieldsAlongUnevenSlices)
{
  const Stack stack = MakeStack(Kind::Uneven, { { 12, 12, 44 } });
  const auto normal = stack.image->GetDirection();
  const auto field = [&](const PointType & p) {
    return normal[0][2] * p[0] + normal[1][2] * p[1] + normal[2][2] * p[2];
  };
  EXPECT_LT(Measure(stack, Kernel::Lanczos4, field, Margins(0.0, 0.0, 0.0)).largest, 1e-4);
}

TEST(CartesianToFCCSlanted, SmoothFieldsComeOutAsFromAPerpendicularStack)
{
  const itk::Size<3> size{ { 48, 48, 44 } };
  std::map<Kind, double> errors;
  for (const Kind kind : { Kind::Perpendicular, Kind::Tilted, Kind::Sheared, Kind::Uneven, Kind::TiltedUneven })
  {
    const Stack stack = MakeStack(kind, size);
    const auto start = stack.image->GetLargestPossibleRegion().GetIndex();
    const PointType centre = stack.PointOf({ { start[0] + 24, start[1] + 24, start[2] + 22 } });
    const auto blob = [centre](const PointType & p) { return std::exp(-(p - centre).GetSquaredNorm() / 72.0); };
    errors[kind] = Measure(stack, Kernel::CubicBSpline, blob, Margins(4.0, 4.0, 4.0)).rms;
  }
  EXPECT_LT(errors[Kind::Perpendicular], 1e-4);
  EXPECT_LT(errors[Kind::Tilted], 1.5 * errors[Kind::Perpendicular]);
  EXPECT_LT(errors[Kind::Sheared], 1.5 * errors[Kind::Perpendicular]);
  EXPECT_LT(errors[Kind::Uneven], 1e-4) << "its longest step is 4 mm, not 1.5";
  EXPECT_LT(errors[Kind::TiltedUneven], 1e-4);
}

TEST(CartesianToFCCSlanted, BodiesStayWhereTheyAre)
{
  // A ball whose edge is soft enough for the steps of up to 4 mm.
  constexpr double radius = 9.0;
  constexpr double softness = 2.0;
  const double exact = 4.0 / 3.0 * itk::Math::pi * radius * (radius * radius + 1.5 * softness * softness);
  for (const Kind kind : slantedKinds)
  {
    const Stack stack = MakeStack(kind, { { 60, 60, 30 } });
    const auto start = stack.image->GetLargestPossibleRegion().GetIndex();
    const PointType centre = stack.PointOf({ { start[0] + 30, start[1] + 30, start[2] + 15 } });
    stack.Fill([&](const PointType & p) { return 500.0 * std::erfc(((p - centre).GetNorm() - radius) / softness); });
    const auto filter = MakeFilter(stack);
    filter->Update();
    const auto * const output = filter->GetOutput();
    VectorType moment(0.0);
    double mass = 0.0;
    for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto point = output->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      moment += (point - centre) * static_cast<double>(it.Get());
      mass += it.Get();
    }
    EXPECT_LT((moment / mass).GetNorm(), 0.05) << static_cast<int>(kind);
    const VectorType spacing = output->GetSpacing();
    const double volume = mass / 1000.0 * 2.0 * spacing[0] * spacing[1] * spacing[2];
    EXPECT_NEAR(volume / exact, 1.0, 0.005) << static_cast<int>(kind);
  }
}

TEST(CartesianToFCCSlanted, TheLatticeIsPerpendicularAndCoversTheStack)
{
  for (const Kind kind : slantedKinds)
  {
    const Stack stack = MakeStack(kind, { { 20, 14, 44 } });
    const auto filter = MakeFilter(stack);
    filter->UpdateOutputInformation();
    const auto * const output = filter->GetOutput();
    const auto direction = output->GetDirection();
    EXPECT_TRUE((direction.GetVnlMatrix() * direction.GetTranspose()).is_identity(1e-12));
    EXPECT_NEAR(vnl_determinant(direction.GetVnlMatrix().as_matrix()), -1.0, 1e-12) << "left-handed as the input";
    for (unsigned int row = 0; row < 3; ++row)
    {
      EXPECT_NEAR(direction[row][0], stack.image->GetDirection()[row][0], 1e-12);
    }
    const auto region = output->GetLargestPossibleRegion();
    for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(stack.image, stack.image->GetBufferedRegion());
         !it.IsAtEnd();
         ++it)
    {
      const auto lattice = output->TransformPhysicalPointToLattice(stack.PointOf(it.GetIndex()));
      ASSERT_TRUE(LatticeType::IsInsideExtent(lattice, region)) << it.GetIndex();
    }
    const auto shear = kind == Kind::Sheared ? std::cos(itk::Math::pi / 12.0)
                                             : (kind == Kind::Shifted ? std::cos(itk::Math::pi / 36.0) : 1.0);
    EXPECT_NEAR(output->GetSpacing()[0], 0.7 * std::sqrt(3.0) / 2.0, 1e-9);
    EXPECT_NEAR(output->GetSpacing()[1], 0.9 * shear * std::sqrt(3.0) / 2.0, 1e-9);
  }
}

TEST(CartesianToFCCSlanted, WhatIsBesideTheSlicesGetsTheOutsideValue)
{
  for (const Kind kind : slantedKinds)
  {
    const Stack stack = MakeStack(kind, { { 20, 14, 44 } });
    stack.image->FillBuffer(5.0f);
    const auto filter = MakeFilter(stack);
    filter->SetOutsideValue(-1000.0f);
    filter->Update();
    const auto * const output = filter->GetOutput();
    int outside = 0;
    for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto index = stack.IndexOf(output->TransformIndexToPhysicalPoint<double>(it.GetIndex()));
      // Shifted slices' origins lie on a curve between them, which only passes the same points.
      const double near = kind == Kind::Shifted ? 1.5 : 1e-5;
      const double beside = std::max(std::abs(index[0] - 9.5) - 10.0, std::abs(index[1] - 6.5) - 7.0);
      if (std::abs(beside) > near)
      {
        ASSERT_NEAR(it.Get(), beside > 0.0 ? -1000.0 : 5.0, 1e-4) << it.GetIndex() << static_cast<int>(kind);
        outside += beside > 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(outside, kind == Kind::Uneven ? 0 : 100);
  }
}

/** A site of the last plane that lies beside the slices of a stack that is tilted towards larger y. */
itk::Index<3>
CornerBeside(const LatticeType & lattice)
{
  return { { 0, 0, lattice.GetLargestPossibleRegion().GetUpperIndex()[2] } };
}

TEST(CartesianToFCCSlanted, ByDefaultTheOutsideValueIsTheLowestOfTheInput)
{
  const Stack stack = MakeStack(Kind::TiltedUneven, { { 20, 14, 44 } });
  stack.image->FillBuffer(500.0f);
  const auto first = stack.image->GetLargestPossibleRegion().GetIndex();
  const auto valueAtCorner = [&](const std::optional<float> & outsideValue) {
    const auto filter = MakeFilter(stack);
    filter->SetOutsideValue(outsideValue);
    filter->UpdateOutputInformation();
    const itk::Index<3> corner = CornerBeside(*filter->GetOutput());
    filter->GetOutput()->SetRequestedRegion(LatticeType::RegionType(corner, { { 1, 1, 1 } }));
    filter->Update();
    return filter->GetOutput()->GetPixel(corner);
  };
  EXPECT_EQ(valueAtCorner({}), 500.0f);
  stack.image->SetPixel({ { first[0] + 19, first[1] + 13, first[2] + 43 } }, 20.0f);
  stack.image->SetPixel(first, std::numeric_limits<float>::quiet_NaN());
  stack.image->Modified();
  EXPECT_EQ(valueAtCorner({}), 20.0f) << "far from the region that is asked for";
  for (const float value : { 0.0f, 1.0f, -1024.0f })
  {
    EXPECT_EQ(valueAtCorner(value), value);
  }

  const auto filter = MakeFilter(stack);
  for (const float lowest : { 20.0f, -30.0f })
  {
    stack.image->SetPixel({ { first[0] + 10, first[1] + 7, first[2] + 9 } }, lowest);
    stack.image->Modified();
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetPixel(CornerBeside(*filter->GetOutput())), lowest) << "found anew";
  }
}

TEST(CartesianToFCCSlanted, PrintsSliceOriginsAndOutsideValue)
{
  const auto filter = MakeFilter(MakeStack(Kind::Uneven, { { 6, 6, 8 } }));
  filter->SetOutsideValue(0.0f);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("SliceOrigins: 8, from ["), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("OutsideValue: 0"), std::string::npos);
}

TEST(CartesianToFCCSlanted, AnyThreadsAndAnyRegionGiveTheSameBytes)
{
  std::mt19937 random(29);
  for (const Kind kind : slantedKinds)
  {
    for (const Kernel kernel : { Kernel::Linear, Kernel::CubicBSpline, Kernel::Lanczos4 })
    {
      const Stack stack = MakeStack(kind, { { 30, 26, 44 } });
      stack.Fill([&](const PointType &) { return static_cast<double>(random() % 1000); });
      const auto whole = MakeFilter(stack, kernel);
      whole->SetNumberOfWorkUnits(1);
      whole->Update();
      const auto all = whole->GetOutput()->GetLargestPossibleRegion();
      const auto many = MakeFilter(stack, kernel);
      many->SetNumberOfWorkUnits(3);
      many->Update();
      ASSERT_EQ(std::memcmp(whole->GetOutput()->GetBufferPointer(),
                            many->GetOutput()->GetBufferPointer(),
                            all.GetNumberOfPixels() * sizeof(float)),
                0);
      for (int trial = 0; trial < 5; ++trial)
      {
        LatticeType::RegionType region;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto begin = random() % all.GetSize(axis);
          region.SetIndex(axis, static_cast<itk::IndexValueType>(begin));
          region.SetSize(axis, 1 + random() % std::min<std::size_t>(20, all.GetSize(axis) - begin));
        }
        // Its output holds no more than what is asked for.
        const auto source = itk::CastImageFilter<ImageType, ImageType>::New();
        source->SetInput(stack.image);
        source->InPlaceOff();
        const auto part = MakeFilter(stack, kernel);
        part->SetInput(source->GetOutput());
        part->GetOutput()->SetRequestedRegion(region);
        part->Update();
        for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(part->GetOutput(), region); !it.IsAtEnd(); ++it)
        {
          ASSERT_EQ(it.Get(), whole->GetOutput()->GetPixel(it.GetIndex())) << region;
        }
      }
      LatticeType::RegionType one;
      one.SetSize({ { 1, 1, 1 } });
      one.SetIndex({ { 5, 5, 5 } });
      const auto part = MakeFilter(stack, kernel);
      part->SetOutsideValue(0.0f); // or else the lowest of the whole input
      part->GetOutput()->SetRequestedRegion(one);
      part->Update();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LE(stack.image->GetRequestedRegion().GetSize(axis), 13u);
      }
    }
  }
}

// The value outside is that of a sample which most parts do not need.
TEST(CartesianToFCCSlanted, PartsHaveTheDefaultOutsideValueOfTheWhole)
{
  constexpr float lowest = -77.0f;
  for (const Kind kind : slantedKinds)
  {
    SCOPED_TRACE(static_cast<int>(kind));
    const Stack stack = MakeStack(kind, { { 20, 14, 44 } });
    stack.image->FillBuffer(500.0f);
    stack.image->SetPixel(stack.image->GetLargestPossibleRegion().GetUpperIndex(), lowest);
    const auto whole = MakeFilter(stack, Kernel::Linear);
    whole->Update();
    const LatticeType & expected = *whole->GetOutput();
    const auto all = expected.GetLargestPossibleRegion();
    // Its output holds no more than what is asked for.
    const auto source = itk::CastImageFilter<ImageType, ImageType>::New();
    source->SetInput(stack.image);
    source->InPlaceOff();
    int outside = 0;
    const auto compare = [&](const LatticeType & part, const LatticeType::RegionType & region) {
      for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(&part, region); !it.IsAtEnd(); ++it)
      {
        ASSERT_EQ(it.Get(), expected.GetPixel(it.GetIndex())) << it.GetIndex() << region;
        outside += it.Get() == lowest ? 1 : 0;
      }
    };
    for (const unsigned int axis : { 0u, 1u, 2u })
    {
      for (const bool isLast : { false, true })
      {
        auto region = all;
        region.SetSize(axis, 1);
        region.SetIndex(axis, isLast ? all.GetUpperIndex()[axis] : 0);
        const auto part = MakeFilter(stack, Kernel::Linear);
        part->SetInput(source->GetOutput());
        part->GetOutput()->SetRequestedRegion(region);
        part->Update();
        compare(*part->GetOutput(), region);
      }
    }
    for (const unsigned int divisions : { 1u, 2u, 3u, 7u, 1000u })
    {
      const auto streamed = MakeFilter(stack, Kernel::Linear);
      streamed->SetInput(source->GetOutput());
      const auto streaming = itk::StreamingImageFilter<LatticeType, LatticeType>::New();
      streaming->SetInput(streamed->GetOutput());
      streaming->SetNumberOfStreamDivisions(divisions);
      streaming->Update();
      compare(*streaming->GetOutput(), all);
    }
    EXPECT_GT(outside, kind == Kind::Uneven ? 0 : 100);
  }
}

TEST(CartesianToFCCSlanted, EvenSliceOriginsChangeNothingInside)
{
  const Stack plain = MakeStack(Kind::Perpendicular, { { 20, 22, 24 } });
  std::mt19937 random(31);
  plain.Fill([&](const PointType &) { return static_cast<double>(random() % 1000); });
  const Stack given{ plain.image, PlaceSlices(*plain.image, [](std::size_t) { return 1.5; }) };
  const auto regular = MakeFilter(plain);
  regular->Update();
  const auto slanted = MakeFilter(given);
  slanted->Update();
  const auto * const output = slanted->GetOutput();
  ASSERT_EQ(output->GetLargestPossibleRegion(), regular->GetOutput()->GetLargestPossibleRegion());
  EXPECT_LT((output->GetOrigin() - regular->GetOutput()->GetOrigin()).GetNorm(), 1e-9);
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(output, output->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    if (plain.IsInside(output->TransformIndexToPhysicalPoint<double>(it.GetIndex()), Margins(-0.49, -0.49, -1.0)))
    {
      ASSERT_NEAR(it.Get(), regular->GetOutput()->GetPixel(it.GetIndex()), 2e-3);
    }
  }
}

TEST(CartesianToFCCSlanted, IntegersAndStacksOfFewSlices)
{
  using Int16Image = itk::Image<std::int16_t, 3>;
  for (const itk::SizeValueType slices : { 1u, 2u, 3u, 5u })
  {
    const Stack stack = MakeStack(Kind::TiltedUneven, { { 9, 8, slices } });
    stack.image->FillBuffer(117.0f);
    const auto cast = itk::CastImageFilter<ImageType, Int16Image>::New();
    cast->SetInput(stack.image);
    const auto filter = itk::CartesianToFCCImageFilter<Int16Image>::New();
    filter->SetInput(cast->GetOutput());
    filter->SetSliceOrigins(stack.origins);
    filter->SetOutsideValue(-5);
    filter->Update();
    const auto * const output = filter->GetOutput();
    std::size_t inside = 0;
    for (std::size_t n = 0; n < output->GetBufferedRegion().GetNumberOfPixels(); ++n)
    {
      const auto value = output->GetBufferPointer()[n];
      ASSERT_TRUE(value == 117 || value == -5) << value;
      inside += value == 117 ? 1 : 0;
    }
    EXPECT_GT(inside, 9 * 8 * slices / 2);
  }
}

TEST(CartesianToFCCSlanted, RefusesOriginsThatMakeNoStack)
{
  const Stack stack = MakeStack(Kind::Uneven, { { 6, 6, 8 } });
  const auto messageOf = [&](const std::vector<PointType> & origins) -> std::string {
    const auto filter = MakeFilter({ stack.image, origins });
    try
    {
      filter->Update();
    }
    catch (const itk::ExceptionObject & error)
    {
      return error.GetDescription();
    }
    return "";
  };
  EXPECT_EQ(messageOf(stack.origins), "");
  auto origins = stack.origins;
  origins.pop_back();
  EXPECT_NE(messageOf(origins).find("one for each slice"), std::string::npos) << messageOf(origins);
  origins = stack.origins;
  std::swap(origins[3], origins[4]);
  EXPECT_NE(messageOf(origins).find("sort the slices"), std::string::npos) << messageOf(origins);
  origins = stack.origins;
  origins[3] = origins[4];
  EXPECT_NE(messageOf(origins), "");
  origins = stack.origins;
  origins[7][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf(origins), "");
}

TEST(CartesianToFCCSlanted, TheNestedLatticeIsRefusedForShearedInputs)
{
  const auto nested = itk::CartesianToNestedFCCImageFilter<ImageType>::New();
  nested->SetInput(MakeStack(Kind::Tilted, { { 6, 6, 8 } }).image);
  try
  {
    nested->Update();
    FAIL();
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("CartesianToFCCImageFilter"), std::string::npos);
  }
  nested->SetInput(MakeStack(Kind::Perpendicular, { { 6, 6, 8 } }).image);
  EXPECT_NO_THROW(nested->Update());
}

} // namespace
