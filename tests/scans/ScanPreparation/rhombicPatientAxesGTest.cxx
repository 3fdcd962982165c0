#include "rhombicPatientAxes.h"

#include "rhombicFailure.h"

#include "itkEuler3DTransform.h"
#include "itkImageRegionIterator.h"
#include "itkImageRegionConstIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace
{

using ImageType = itk::Image<float, 3>;

/** Directions of scans: all orders and signs of axes, turned by up to 45 degrees; left-handed ones too. */
itk::Matrix<double, 3, 3>
MakeDirection(std::mt19937 & random)
{
  std::array<unsigned int, 3> order{ 0, 1, 2 };
  std::shuffle(order.begin(), order.end(), random);
  itk::Matrix<double, 3, 3> axes;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    axes[axis][order[axis]] = random() % 2 == 0 ? 1.0 : -1.0;
  }
  const auto turn = itk::Euler3DTransform<double>::New();
  const double quarter = itk::Math::pi_over_4;
  const auto angle = [&] {
    return random() % 4 == 0 ? quarter : std::uniform_real_distribution<>(-quarter, quarter)(random);
  };
  turn->SetRotation(angle(), angle(), angle());
  return turn->GetMatrix() * axes;
}

/** Expects the ordered scan also where no copy fits into memory, slice by slice in a temporary file. */
void
ExpectSameWithoutMemory(const rhombic::Scan & scan, const ImageType & ordered)
{
  try
  {
    const auto large = std::get<ImageType::Pointer>(rhombic::OrderAlongPatient(scan, 1).image);
    ASSERT_EQ(large->GetBufferedRegion(), ordered.GetBufferedRegion());
    EXPECT_EQ(large->GetDirection(), ordered.GetDirection());
    EXPECT_EQ(large->GetOrigin(), ordered.GetOrigin());
    EXPECT_EQ(large->GetSpacing(), ordered.GetSpacing());
    const float * const values = ordered.GetBufferPointer();
    EXPECT_TRUE(
      std::equal(values, values + ordered.GetBufferedRegion().GetNumberOfPixels(), large->GetBufferPointer()));
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find("it is in memory itself"), std::string::npos);
  }
  rhombic::Scan frame = scan;
  const auto noVoxels = ImageType::New();
  noVoxels->CopyInformation(std::get<ImageType::Pointer>(scan.image));
  frame.image = noVoxels;
  const auto planned = std::get<ImageType::Pointer>(rhombic::OrderAlongPatient(frame, 1).image);
  EXPECT_EQ(planned->GetLargestPossibleRegion(), ordered.GetLargestPossibleRegion());
  EXPECT_EQ(planned->GetDirection(), ordered.GetDirection());
}

TEST(PatientAxes, OrderedAxesRunAlongThePatientAndSamplesStay)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial)
  {
    SCOPED_TRACE(trial);
    const auto image = ImageType::New();
    image->SetRegions(itk::Size<3>{ { 2 + random() % 4, 2 + random() % 4, 2 + random() % 4 } });
    const double spacing[] = { 0.5, 1.25, 3.0 };
    const double origin[] = { -20.0, 7.5, 100.0 };
    image->SetSpacing(spacing);
    image->SetOrigin(origin);
    image->SetDirection(MakeDirection(random));
    image->Allocate();
    float value = 0.0f;
    for (itk::ImageRegionIterator<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(++value);
    }
    rhombic::Scan scan;
    scan.image = image;
    const auto ordered = std::get<ImageType::Pointer>(rhombic::OrderAlongPatient(scan).image);
    if (trial < 50)
    {
      ExpectSameWithoutMemory(scan, *ordered);
    }
    ASSERT_EQ(ordered->GetBufferedRegion().GetNumberOfPixels(), image->GetBufferedRegion().GetNumberOfPixels());
    for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(ordered, ordered->GetBufferedRegion()); !it.IsAtEnd();
         ++it)
    {
      const auto position = ordered->TransformIndexToPhysicalPoint<double>(it.GetIndex());
      const auto index = image->TransformPhysicalPointToIndex(position);
      ASSERT_TRUE(image->GetBufferedRegion().IsInside(index));
      EXPECT_LT(position.EuclideanDistanceTo(image->TransformIndexToPhysicalPoint<double>(index)), 1e-9);
      EXPECT_EQ(it.Get(), image->GetPixel(index));
    }
    double sum = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_GE(ordered->GetDirection()[axis][axis], 0.0);
      sum += ordered->GetDirection()[axis][axis];
    }
    EXPECT_GT(sum, 1.7) << "no other order of axes is closer";
  }
}

TEST(PatientAxes, FlatVolumesAreTurnedAndSamplesStay)
{
  using FlatType = itk::Image<std::uint8_t, 3>;
  const auto flat = FlatType::New();
  const double spacing[] = { 0.5, 1.25, 3.0 };
  const double origin[] = { -20.0, 7.5, 100.0 };
  flat->SetRegions(itk::Size<3>{ { 2000, 4001, 3 } });
  flat->SetSpacing(spacing);
  flat->SetOrigin(origin);
  flat->Allocate();
  std::mt19937 random(7);
  std::generate_n(flat->GetBufferPointer(), 2000 * 4001 * 3, [&random] { return static_cast<std::uint8_t>(random()); });
  const rhombic::DeepImage deep = rhombic::MakeDeep(flat);
  const auto & image = *std::get<FlatType::Pointer>(deep.image);
  EXPECT_EQ(image.GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { 2000, 3, 4001 } }));
  itk::ImageRegion<3> slab = image.GetLargestPossibleRegion();
  slab.SetIndex(2, 1234);
  slab.SetSize(2, 5);
  auto & output = const_cast<FlatType &>(image);
  output.SetRequestedRegion(slab);
  output.PropagateRequestedRegion();
  output.UpdateOutputData();
  EXPECT_EQ(image.GetBufferedRegion(), slab);
  for (itk::ImageRegionConstIteratorWithIndex<FlatType> it(&image, slab); !it.IsAtEnd(); ++it)
  {
    const auto position = image.TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const auto index = flat->TransformPhysicalPointToIndex(position);
    ASSERT_LT(position.EuclideanDistanceTo(flat->TransformIndexToPhysicalPoint<double>(index)), 1e-9);
    ASSERT_EQ(it.Get(), flat->GetPixel(index));
  }
  flat->SetRegions(itk::Size<3>{ { 2000, 4001, 2001 } }); // not flat
  EXPECT_EQ(rhombic::MakeDeep(flat).source, nullptr);
  flat->SetRegions(itk::Size<3>{ { 512, 512, 3 } }); // not large
  EXPECT_EQ(rhombic::MakeDeep(flat).source, nullptr);
}

} // namespace
