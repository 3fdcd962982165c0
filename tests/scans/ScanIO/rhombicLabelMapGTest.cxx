#include "rhombicLabelTable.h"
#include "rhombicLabelMap.h"
#include "rhombicScanTest.h"

#include <cstdlib>
#include <random>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::LabelSummary;
using rhombic::LooksLikeLabelMap;
using rhombic::RequireOverlap;
using rhombic::Scan;
using rhombic::SummarizeLabels;

/** A volume of 12 x 10 x 8 voxels of 2 x 1.5 x 3 mm, filled with one value. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
NewVolume(TPixel value)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { 12, 10, 8 } });
  const double spacing[3] = { 2, 1.5, 3 };
  image->SetSpacing(spacing);
  image->Allocate();
  image->FillBuffer(value);
  return image;
}

template <typename TPixel>
void
FillBlock(itk::Image<TPixel, 3> & image, const itk::Index<3> & begin, const itk::Size<3> & size, TPixel value)
{
  for (std::size_t n = 0; n < size[0] * size[1] * size[2]; ++n)
  {
    const auto x = static_cast<long>(n % size[0]);
    const auto y = static_cast<long>(n / size[0] % size[1]);
    const auto z = static_cast<long>(n / size[0] / size[1]);
    image.SetPixel({ { begin[0] + x, begin[1] + y, begin[2] + z } }, value);
  }
}

/** Label 3 in 24 voxels and label 7 in 4, on two slices. */
template <typename TPixel>
Scan
MakeLabelMap()
{
  auto image = NewVolume<TPixel>(0);
  FillBlock<TPixel>(*image, { { 2, 2, 1 } }, { { 4, 3, 2 } }, 3);
  FillBlock<TPixel>(*image, { { 8, 5, 2 } }, { { 2, 2, 1 } }, 7);
  Scan scan;
  scan.image = image;
  return scan;
}

itk::Matrix<double, 3, 3>
Turned(double angle)
{
  itk::Matrix<double, 3, 3> matrix;
  matrix.SetIdentity();
  matrix[0][0] = matrix[1][1] = std::cos(angle);
  matrix[1][0] = std::sin(angle);
  matrix[0][1] = -matrix[1][0];
  return matrix;
}

TEST(LabelMap, SumsLabelsUp)
{
  rhombic::Label liver;
  liver.value = 3;
  liver.name = "liver";
  liver.colour = { 1, 2, 3 };
  rhombic::Label absent;
  absent.value = 5;
  for (const Scan & scan : { MakeLabelMap<std::uint8_t>(), MakeLabelMap<std::int32_t>(), MakeLabelMap<float>() })
  {
    const std::vector<LabelSummary> summaries = SummarizeLabels(scan, { liver, absent });
    ASSERT_EQ(summaries.size(), 2U);
    EXPECT_EQ(summaries[0].label.name, "liver");
    EXPECT_EQ(summaries[0].label.colour, liver.colour);
    EXPECT_EQ(summaries[0].numberOfVoxels, 24U);
    EXPECT_DOUBLE_EQ(summaries[0].millilitres, 24 * 9 / 1000.0);
    EXPECT_EQ(summaries[1].label.value, 7);
    EXPECT_EQ(summaries[1].label.name, "label 7");
    EXPECT_EQ(summaries[1].label.colour, rhombic::AnatomicalColour("", 7));
    EXPECT_EQ(summaries[1].numberOfVoxels, 4U);
    EXPECT_TRUE(LooksLikeLabelMap(scan));
  }
}

TEST(LabelMap, VolumesCountShearAndUnevenSlices)
{
  Scan scan = MakeLabelMap<std::uint8_t>();
  auto & image = *std::get<itk::Image<std::uint8_t, 3>::Pointer>(scan.image);
  itk::Matrix<double, 3, 3> sheared;
  sheared.SetIdentity();
  sheared[1][2] = 0.6;
  sheared[2][2] = 0.8;
  image.SetDirection(sheared);
  EXPECT_DOUBLE_EQ(SummarizeLabels(scan, {})[0].millilitres, 24 * 9 * 0.8 / 1000);

  // Slices at 0, 1, 3, 6, ... mm: label 3 has 12 voxels in a slice of 1.5 mm and 12 in one of 2.5 mm.
  for (int slice = 0; slice < 8; ++slice)
  {
    itk::Point<double, 3> origin;
    origin.Fill(0);
    origin[1] = slice; // a tilt does not count
    origin[2] = slice * (slice + 1) / 2.0;
    scan.sliceOrigins.push_back(origin);
  }
  EXPECT_DOUBLE_EQ(SummarizeLabels(scan, {})[0].millilitres, (12 * 1.5 + 12 * 2.5) * 3 / 1000);
  EXPECT_DOUBLE_EQ(SummarizeLabels(scan, {})[1].millilitres, 4 * 2.5 * 3 / 1000);
}

TEST(LabelMap, RefusesScans)
{
  const auto kind = [](const Scan & scan, const std::string & part) {
    EXPECT_FALSE(LooksLikeLabelMap(scan));
    try
    {
      SummarizeLabels(scan, {});
    }
    catch (const Failure & failure)
    {
      EXPECT_NE(std::string(failure.GetDescription()).find(part), std::string::npos) << failure.GetDescription();
      return failure.GetKind();
    }
    ADD_FAILURE() << "accepted: " << part;
    return FailureKind::Internal;
  };
  Scan halves;
  halves.image = NewVolume<float>(0.5F);
  EXPECT_EQ(kind(halves, "0.5"), FailureKind::Unreadable);
  Scan undefined;
  undefined.image = NewVolume<float>(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(kind(undefined, "nan"), FailureKind::Unreadable);
  Scan large;
  large.image = NewVolume<float>(1e20F);
  EXPECT_EQ(kind(large, "whole number"), FailureKind::Unreadable);

  Scan many;
  auto image = itk::Image<std::int32_t, 3>::New();
  image->SetRegions(itk::Size<3>{ { 16, 16, 17 } });
  image->Allocate();
  for (int n = 0; n < 16 * 16 * 17; ++n)
  {
    image->GetBufferPointer()[n] = n;
  }
  many.image = image;
  EXPECT_EQ(kind(many, "4096"), FailureKind::Unreadable);
}

TEST(LabelMap, IntensitiesDoNotLookLikeLabels)
{
  std::mt19937 random(7);
  auto noise = NewVolume<std::uint8_t>(0);
  for (std::size_t n = 0; n < 12 * 10 * 8; ++n)
  {
    noise->GetBufferPointer()[n] = static_cast<std::uint8_t>(random() % 200);
  }
  Scan scan;
  scan.image = noise;
  EXPECT_FALSE(LooksLikeLabelMap(scan));
  scan.image = NewVolume<std::int16_t>(-1000);
  EXPECT_FALSE(LooksLikeLabelMap(scan));
  scan.image = NewVolume<std::int16_t>(0);
  EXPECT_TRUE(LooksLikeLabelMap(scan)) << "no label at all";
}

TEST(LabelMapOverlap, OfObliqueBoxes)
{
  auto a = NewVolume<std::uint8_t>(1);
  auto b = NewVolume<std::uint8_t>(0);
  const auto overlap = [&] {
    Scan labels, scan;
    labels.image = a;
    scan.image = b;
    return RequireOverlap(scan, labels, "ct", "seg");
  };
  for (const double angle : { 0.3, 1.0, 2.5 })
  {
    a->SetDirection(Turned(angle));
    b->SetDirection(Turned(angle));
    EXPECT_EQ(overlap(), "");
  }

  // The same box with columns and rows swapped.
  const double spacing[3] = { 1.5, 2, 3 };
  b->SetRegions(itk::Size<3>{ { 10, 12, 8 } });
  b->SetSpacing(spacing);
  itk::Matrix<double, 3, 3> swapped;
  swapped[0][1] = swapped[1][0] = swapped[2][2] = 1;
  b->SetDirection(swapped);
  itk::Matrix<double, 3, 3> identity;
  identity.SetIdentity();
  a->SetDirection(identity);
  EXPECT_EQ(overlap(), "");

  // A square turned by 45 degrees in itself: a regular octagon, 2 sqrt(2) - 2 of the square.
  const double cube[3] = { 1, 1, 1 };
  for (auto * const image : { a.GetPointer(), b.GetPointer() })
  {
    image->SetRegions(itk::Size<3>{ { 11, 11, 7 } });
    image->SetSpacing(cube);
    image->SetDirection(identity);
    const double origin[3] = { -5, -5, -5 };
    image->SetOrigin(origin);
  }
  const double angle = std::acos(-1.0) / 4;
  a->SetDirection(Turned(angle));
  const double turnedOrigin[3] = { 0, -5 * std::sqrt(2.0), -5 };
  a->SetOrigin(turnedOrigin);
  EXPECT_EQ(overlap(), "Only 82 % of the box around the labels of seg lie in ct.");
}

TEST(LabelMapOverlap, IsRequired)
{
  const Scan labels = MakeLabelMap<std::uint8_t>();
  Scan scan;
  auto image = NewVolume<std::int16_t>(0);
  scan.image = image;
  EXPECT_EQ(RequireOverlap(scan, labels, "ct", "seg"), "");

  // Only where labels are counts: they begin 3 mm from the edge, and end before the last third.
  const double inside[3] = { 2.9, 2, 2 };
  image->SetOrigin(inside);
  EXPECT_EQ(RequireOverlap(scan, labels, "ct", "seg"), "");
  const double half[3] = { 12, 0, 0 };
  image->SetOrigin(half);
  EXPECT_EQ(RequireOverlap(scan, labels, "ct", "seg"), "Only 50 % of the box around the labels of seg lie in ct.");
  const double away[3] = { 0, 0, 12 };
  image->SetOrigin(away);
  try
  {
    RequireOverlap(scan, labels, "ct", "seg");
    FAIL();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Geometry);
    EXPECT_NE(std::string(failure.GetDescription()).find("seg lie nowhere in ct"), std::string::npos);
  }
}

class RealLabelMaps : public testing::Test
{
protected:
  void
  SetUp() override
  {
    const char * const folder = std::getenv("RHOMBIC_SCANS");
    if (folder == nullptr)
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set";
    }
    m_Scans = folder;
  }

  fs::path m_Scans;
};

TEST_F(RealLabelMaps, OfTotalSegmentator)
{
  const fs::path folder = m_Scans / "ct_body_totalseg_nifti";
  const fs::path labelsPath = folder / "example_seg_fast_force_split.nii.gz";
  const Scan labels = rhombic::ReadScan(labelsPath);
  const Scan scan = rhombic::ReadScan(folder / "example_ct.nii.gz");
  EXPECT_TRUE(LooksLikeLabelMap(labels));
  EXPECT_FALSE(LooksLikeLabelMap(scan));
  EXPECT_EQ(RequireOverlap(scan, labels, "ct", "seg"), "");

  const std::vector<LabelSummary> summaries = SummarizeLabels(labels, *rhombic::FindLabelTable(labelsPath));
  EXPECT_EQ(summaries.size(), 61U);
  for (const LabelSummary & summary : summaries)
  {
    EXPECT_NE(summary.label.name.substr(0, 6), "label ");
  }
  EXPECT_EQ(summaries[4].label.name, "liver");
  EXPECT_EQ(summaries[4].numberOfVoxels, 41692U);
  EXPECT_NEAR(summaries[4].millilitres, 1125.684, 1e-3);
}

TEST_F(RealLabelMaps, OfAFrog)
{
  const fs::path path = m_Scans / "frog_labels_metaimage" / "frogtissue.mhd";
  const Scan labels = rhombic::ReadScan(path);
  EXPECT_TRUE(LooksLikeLabelMap(labels));
  EXPECT_FALSE(rhombic::FindLabelTable(path).has_value());
  const std::vector<LabelSummary> summaries = SummarizeLabels(labels, {});
  ASSERT_EQ(summaries.size(), 25U);
  EXPECT_EQ(summaries.back().label.value, 29);
  EXPECT_EQ(summaries.back().label.name, "label 29");
  EXPECT_EQ(summaries[12].numberOfVoxels, 440722U) << "label 13, all of it though CompressedDataSize is too small";
  EXPECT_EQ(summaries[9].label.value, 10);
  EXPECT_EQ(summaries[9].numberOfVoxels, 204672U);
  EXPECT_NEAR(summaries[9].millilitres, 307.008, 1e-3);
}

TEST_F(RealLabelMaps, AreToldFromScans)
{
  for (const char * const path : { "frog_labels_metaimage/HeadMRVolume.mhd",
                                   "ct_head_ge8800_dicom",
                                   "ct_mr_dicom2stl_nifti/ct_example.nii.gz",
                                   "ct_mr_dicom2stl_nifti/mri_t1_example.nii.gz",
                                   "ct_body_totalseg_nifti/ct_aorta_cropped.nii.gz" })
  {
    EXPECT_FALSE(LooksLikeLabelMap(rhombic::ReadScan(m_Scans / path))) << path;
  }
  EXPECT_TRUE(LooksLikeLabelMap(rhombic::ReadScan(m_Scans / "ct_body_totalseg_nifti/example_seg_dicom.nii.gz")));
}

} // namespace
