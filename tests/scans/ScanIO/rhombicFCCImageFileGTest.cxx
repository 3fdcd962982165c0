#include "rhombicFCCImageFile.h"

#include "rhombicFailure.h"
#include "rhombicGermanNumbers.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstring>
#include <fstream>
#include <limits>
#include <locale>
#include <numeric>

#include <sys/stat.h>

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::FCCVolume;

template <typename TPixel>
typename itk::FCCImage<TPixel>::Pointer
MakeImage()
{
  auto image = itk::FCCImage<TPixel>::New();
  image->SetRegions(itk::ImageRegion<3>({ { -2, 3, 1 } }, { { 5, 4, 3 } }));
  image->Allocate();
  std::iota(image->GetBufferPointer(), image->GetBufferPointer() + 60, TPixel(3));
  const double spacing[3] = { 0.1, 1.0 / 3.0, 2.5 };
  const double origin[3] = { -123.456, 1e-3, 7.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  typename itk::FCCImage<TPixel>::DirectionType direction;
  direction.SetIdentity();
  direction[0][0] = direction[1][1] = std::cos(1.0);
  direction[1][0] = std::sin(1.0);
  direction[0][1] = -std::sin(1.0);
  image->SetDirection(direction);
  return image;
}

template <typename TPixel>
class FCCImageFileTypes : public testing::Test
{};
using PixelTypes = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float>;
TYPED_TEST_SUITE(FCCImageFileTypes, PixelTypes);

TYPED_TEST(FCCImageFileTypes, ComesBackBitForBit)
{
  const rhombictest::TemporaryFolder folder;
  const auto path = folder.Path() / "volume.fcc.nrrd";
  const auto image = MakeImage<TypeParam>();
  rhombic::WriteFCCImage(image, path);
  EXPECT_TRUE(rhombic::IsFCCImageFile(path));
  const FCCVolume volume = rhombic::ReadFCCImage(path);
  const auto read = std::get<typename itk::FCCImage<TypeParam>::Pointer>(volume);
  EXPECT_EQ(read->GetBufferedRegion(), image->GetBufferedRegion());
  EXPECT_EQ(read->GetSpacing(), image->GetSpacing());
  EXPECT_EQ(read->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(read->GetDirection(), image->GetDirection());
  EXPECT_EQ(std::memcmp(read->GetBufferPointer(), image->GetBufferPointer(), 60 * sizeof(TypeParam)), 0);
}

std::string
ContentOf(const std::filesystem::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

FailureKind
KindOfReading(const std::filesystem::path & path)
{
  try
  {
    rhombic::ReadFCCImage(path);
  }
  catch (const Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find(path.filename().string()), std::string::npos);
    return failure.GetKind();
  }
  ADD_FAILURE() << path << " was read";
  return FailureKind::Internal;
}

TEST(FCCImageFile, RefusesWhatIsDamagedOrSomethingElse)
{
  const rhombictest::TemporaryFolder folder;
  const auto path = folder.Path() / "volume.fcc.nrrd";
  EXPECT_EQ(KindOfReading(path), FailureKind::NotFound);
  rhombic::WriteFCCImage(MakeImage<std::int16_t>(), path);
  const std::string whole = ContentOf(path);

  const auto refuses = [&](const std::string & content) {
    std::ofstream(path, std::ios::binary) << content;
    EXPECT_EQ(KindOfReading(path), FailureKind::Unreadable);
  };
  const auto replace = [&](const std::string & from, const std::string & to) {
    std::string changed = whole;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  const std::string key = "lattice direction:=";
  const auto begin = whole.find(key) + key.size();
  const std::string direction = whole.substr(begin, whole.find('\n', begin) - begin);
  refuses("");
  refuses("not a NRRD file\n");
  refuses(whole.substr(0, whole.size() - 1));
  refuses(whole + "x");
  refuses(whole.substr(0, 200));
  refuses(replace("fcc parity rows", "something else"));
  refuses(replace("int16", "block"));
  refuses(replace("int16", "double"));
  refuses(replace("encoding: raw", "encoding: gzip"));
  refuses(replace("sizes: 5 4 3", "sizes: 5 4 18446744073709551615"));
  refuses(replace("sizes: 5 4 3", "sizes: 5 4 0"));
  refuses(replace("sizes: 5 4 3", "sizes: 5 4"));
  refuses(replace("lattice spacing:=0.1", "lattice spacing:=-1"));
  refuses(replace("lattice spacing:=0.1", "lattice spacing:=nan"));
  refuses(replace("endian: little", "endian: big"));
  refuses(replace("sizes: 5 4 3", "sizes: 5 4 3 3"));
  refuses(replace("lattice origin:=-123.456", "lattice origin:=inf"));
  refuses(replace("lattice spacing:=0.1", "lattice spacing:=1e308"));
  for (const char * const wrong : { "nan", "inf", "1e100", "0" })
  {
    refuses(replace(direction, std::string(wrong) + " 0 0 0 1 0 0 0 1"));
  }
  refuses(replace("lattice start:=-2", "lattice start:=9223372036854775807"));
  refuses("NRRD0005\n" + std::string(100000, 'x'));
  EXPECT_FALSE(rhombic::IsFCCImageFile(folder.Path()));
  ASSERT_EQ(mkfifo((folder.Path() / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(rhombic::IsFCCImageFile(folder.Path() / "pipe")) << "without waiting for a writer";
}

template <typename TPixel>
void
ExpectTheSame(const std::string & name)
{
  const rhombictest::TemporaryFolder folder;
  const auto path = folder.Path() / "volume.fcc.nrrd";
  const auto image = MakeImage<TPixel>();
  rhombic::WriteFCCImage(image, path);
  std::string content = ContentOf(path);
  const auto replace = [&content](const std::string & after, const std::string & to) {
    const auto begin = content.find(after) + after.size();
    content.replace(begin, content.find('\n', begin) - begin, to);
  };
  replace("\ntype: ", name);
  replace("\nencoding: ", "RAW");
  replace("\nendian: ", "Little");
  std::ofstream(path, std::ios::binary) << content;
  const auto read = std::get<typename itk::FCCImage<TPixel>::Pointer>(rhombic::ReadFCCImage(path));
  EXPECT_EQ(std::memcmp(read->GetBufferPointer(), image->GetBufferPointer(), 60 * sizeof(TPixel)), 0) << name;
}

TEST(FCCImageFile, TheReaderKnowsAllNamesThatNRRDHasForATypeInAnyCase)
{
  for (const char * const name : { "uchar", "unsigned char", "uint8", "uint8_t", "UCHAR" })
  {
    ExpectTheSame<std::uint8_t>(name);
  }
  for (const char * const name : { "short", "short int", "signed short", "signed short int", "int16", "int16_t" })
  {
    ExpectTheSame<std::int16_t>(name);
  }
  for (const char * const name : { "ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t" })
  {
    ExpectTheSame<std::uint16_t>(name);
  }
  for (const char * const name : { "int", "signed int", "int32", "int32_t" })
  {
    ExpectTheSame<std::int32_t>(name);
  }
  ExpectTheSame<float>("Float");
}

TEST(FCCImageFile, DoesNotDependOnTheLocale)
{
  const rhombictest::TemporaryFolder folder;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8"); // has no effect where it is not installed
  const std::locale streams = std::locale::global(std::locale(std::locale::classic(), new rhombictest::GermanNumbers));
  rhombic::WriteFCCImage(MakeImage<float>(), folder.Path() / "volume.nrrd");
  const auto volume = rhombic::ReadFCCImage(folder.Path() / "volume.nrrd");
  std::locale::global(streams);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(std::get<itk::FCCImage<float>::Pointer>(volume)->GetOrigin()[0], -123.456);
}

/** The message of WriteFCCImage() for a volume that it must refuse. */
std::string
RefusalOf(const FCCVolume & volume)
{
  const rhombictest::TemporaryFolder folder;
  std::string description;
  try
  {
    rhombic::WriteFCCImage(volume, folder.Path() / "volume.nrrd");
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Output);
    description = failure.GetDescription();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.Path()));
  return description;
}

TEST(FCCImageFile, WhatHoldsNoWholeImageIsNotWritten)
{
  const auto image = MakeImage<float>();
  EXPECT_NE(RefusalOf(itk::FCCImage<float>::Pointer()).find("a null pointer; give"), std::string::npos);
  EXPECT_NE(RefusalOf(itk::FCCImage<float>::New()).find("the image has no samples; give"), std::string::npos);

  const auto unallocated = itk::FCCImage<float>::New();
  unallocated->SetRegions(image->GetBufferedRegion());
  EXPECT_NE(RefusalOf(unallocated).find("were never allocated; call its Allocate()"), std::string::npos);

  image->SetLargestPossibleRegion({ { { -2, 3, 1 } }, { { 5, 4, 4 } } });
  EXPECT_NE(RefusalOf(image).find("in its buffer; update the whole"), std::string::npos);
  image->ReleaseData();
  EXPECT_NE(RefusalOf(image).find("in its buffer; update the whole"), std::string::npos);
}

TEST(FCCImageFile, GeometryThatCannotBeReadBackIsNotWritten)
{
  using Image = itk::FCCImage<float>;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto refusalWith = [](const auto & change) {
    const auto image = MakeImage<float>();
    change(*image);
    return RefusalOf(image);
  };
  for (const double wrong : { nan, infinity, -infinity })
  {
    const std::string origin = refusalWith([wrong](Image & image) { image.SetOrigin(Image::PointType(wrong)); });
    EXPECT_NE(origin.find("the image's lattice origin or start is out of range; set"), std::string::npos) << origin;
  }
  const auto spacing = refusalWith([](Image & image) { image.SetSpacing(Image::SpacingType(-0.5)); });
  EXPECT_NE(spacing.find("lattice spacing is not positive or out of range; set"), std::string::npos) << spacing;
  const auto direction = refusalWith([](Image & image) {
    auto matrix = image.GetDirection();
    matrix[2][2] = 1e-9;
    image.SetDirection(matrix);
  });
  EXPECT_NE(direction.find("lattice direction is singular or out of range; set"), std::string::npos) << direction;
  const auto start = refusalWith([](Image & image) {
    image.SetRegions(Image::RegionType({ { itk::IndexValueType{ 1 } << 50, 0, 0 } }, { { 5, 4, 3 } }));
  });
  EXPECT_NE(start.find("origin or start is out of range"), std::string::npos) << start;
}

TEST(FCCImageFile, LeavesNothingBehindWhenItCannotWrite)
{
  const rhombictest::TemporaryFolder folder;
  EXPECT_THROW(rhombic::WriteFCCImage(MakeImage<float>(), folder.Path() / "missing" / "volume.nrrd"), Failure);
  EXPECT_THROW(rhombic::WriteFCCImage(MakeImage<float>(), folder.Path()), Failure);
  EXPECT_TRUE(std::filesystem::is_empty(folder.Path()));
}

} // namespace
