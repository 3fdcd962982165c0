#include "itkFCCImage.h"

#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkVector.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using ImageType = itk::FCCImage<float>;
using PointType = ImageType::PointType;

ImageType::DirectionType
Rotation(double angle)
{
  ImageType::DirectionType about_z;
  about_z.SetIdentity();
  about_z[0][0] = about_z[1][1] = std::cos(angle);
  about_z[1][0] = std::sin(angle);
  about_z[0][1] = -about_z[1][0];
  ImageType::DirectionType about_x;
  about_x.SetIdentity();
  about_x[1][1] = about_x[2][2] = std::cos(angle / 2);
  about_x[2][1] = std::sin(angle / 2);
  about_x[1][2] = -about_x[2][1];
  return about_z * about_x;
}

/** An anisotropic, rotated image whose indices do not start at zero. */
ImageType::Pointer
MakeImage()
{
  auto image = ImageType::New();
  image->SetRegions(ImageType::RegionType({ { -2, 3, 5 } }, { { 6, 5, 4 } }));
  image->Allocate(true);
  const double spacing[3] = { 0.5, 0.75, 1.25 };
  const double origin[3] = { -100.0, 20.0, 300.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(Rotation(0.4));
  return image;
}

TEST(FCCImage, KeepsSpacingAndOrigin)
{
  const auto image = MakeImage();
  EXPECT_EQ(image->GetSpacing()[2], 1.25);
  EXPECT_EQ(image->GetOrigin()[0], -100.0);
  EXPECT_NE((dynamic_cast<itk::SpecialCoordinatesImage<float, 3> *>(image.GetPointer())), nullptr);
}

TEST(FCCImage, SamplesLieWhereTheFormulaSays)
{
  const auto image = MakeImage();
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    const double parity = ((index[1] + index[2]) % 2 + 2) % 2;
    const double lattice[3] = { 0.5 * (2.0 * index[0] + parity), 0.75 * index[1], 1.25 * index[2] };
    const auto point = image->TransformIndexToPhysicalPoint<double>(index);
    for (unsigned int row = 0; row < 3; ++row)
    {
      double expected = image->GetOrigin()[row];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        expected += image->GetDirection()[row][axis] * lattice[axis];
      }
      EXPECT_NEAR(point[row], expected, 1e-10);
    }
  }
}

TEST(FCCImage, NearestNeighborsAreEquallyFarInAnIsotropicImage)
{
  auto image = MakeImage();
  image->SetSpacing(ImageType::SpacingType(0.8));
  const ImageType::IndexType center{ { 1, 4, 6 } };
  const auto from = image->TransformIndexToPhysicalPoint<double>(center);
  for (const auto & step : itk::FCCLattice::NearestNeighbors)
  {
    const auto to = image->TransformIndexToPhysicalPoint<double>(center + itk::FCCLattice::OffsetOf(step, 0));
    EXPECT_NEAR(from.EuclideanDistanceTo(to), 0.8 * std::sqrt(2.0), 1e-10);
  }
}

TEST(FCCImage, PointsGoBackToTheirIndices)
{
  const auto image = MakeImage();
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    ImageType::IndexType index;
    EXPECT_TRUE(image->TransformPhysicalPointToIndex(point, index));
    EXPECT_EQ(index, it.GetIndex());
    itk::ContinuousIndex<double, 3> continuous;
    EXPECT_TRUE(image->TransformPhysicalPointToContinuousIndex(point, continuous)) << "every sample is in the extent";
    const double parity = itk::FCCLattice::Parity(index[1], index[2]);
    EXPECT_NEAR(continuous[0], index[0] + parity / 2, 1e-9);
    EXPECT_NEAR(continuous[1], index[1], 1e-9);
    EXPECT_LT(point.EuclideanDistanceTo(image->TransformContinuousIndexToPhysicalPoint<double>(continuous)), 1e-9);
  }
}

TEST(FCCImage, KnowsWhatIsOutside)
{
  const auto image = MakeImage();
  itk::ContinuousIndex<double, 3> continuous;
  ImageType::IndexType index;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto at = [&image](double x, double y, double z) {
    return image->TransformLatticeToPhysicalPoint<double>({ x, y, z });
  };
  EXPECT_FALSE(image->TransformPhysicalPointToContinuousIndex(at(-4.6, 4, 6), continuous));
  EXPECT_TRUE(image->TransformPhysicalPointToIndex(at(-4.6, 4, 6), index)) << "still in a sample's Voronoi cell";
  EXPECT_FALSE(image->TransformPhysicalPointToContinuousIndex(at(7.6, 4, 6), continuous));
  EXPECT_FALSE(image->TransformPhysicalPointToContinuousIndex(at(0, 2.4, 6), continuous));
  EXPECT_FALSE(image->TransformPhysicalPointToContinuousIndex(at(0, 4, 8.6), continuous));
  EXPECT_FALSE(image->TransformPhysicalPointToIndex(at(-6, 4, 6), index));
  EXPECT_FALSE(image->TransformPhysicalPointToIndex(at(0, 1.9, 6), index));
  EXPECT_FALSE(ImageType::IsInsideExtent({ nan, 4, 6 }, image->GetBufferedRegion()));
}

TEST(FCCImage, IteratorsVisitEverySampleOnce)
{
  const auto image = MakeImage();
  float value = 0;
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(value++);
  }
  EXPECT_EQ(value, 6.0f * 5.0f * 4.0f);
  EXPECT_EQ(image->GetBufferPointer()[7], 7.0f) << "storage is dense, rows along i";
}

TEST(FCCImage, KnowsTheComponentsOfItsPixels)
{
  EXPECT_EQ(ImageType::New()->GetNumberOfComponentsPerPixel(), 1u);
  EXPECT_EQ((itk::FCCImage<itk::Vector<float, 4>>::New()->GetNumberOfComponentsPerPixel()), 4u);
}

TEST(FCCImage, ThroughItsBaseClassSamplesSeemToBeElsewhere)
{
  const auto image = MakeImage();
  const itk::ImageBase<3> & base = *image;
  for (const itk::IndexValueType j : { 5, 6 })
  {
    const ImageType::IndexType index{ { 1, j, 7 } };
    const auto point = image->TransformIndexToPhysicalPoint<double>(index);
    EXPECT_GT(point.EuclideanDistanceTo(base.TransformIndexToPhysicalPoint<double>(index)), 0.4);
  }
}

TEST(FCCImage, GraftSharesPixelsAndGeometry)
{
  const auto image = MakeImage();
  image->FillBuffer(3.0f);
  auto other = ImageType::New();
  other->Graft(image.GetPointer());
  EXPECT_EQ(other->GetBufferPointer(), image->GetBufferPointer());
  EXPECT_EQ(other->GetSpacing(), image->GetSpacing());
  EXPECT_EQ(other->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(other->GetDirection(), image->GetDirection());
  EXPECT_EQ(other->GetBufferedRegion(), image->GetBufferedRegion());
}

} // namespace
