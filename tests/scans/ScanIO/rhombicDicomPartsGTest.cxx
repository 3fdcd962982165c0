// Single steps of reading DICOM, with inputs that fuzzing found (tests/fuzz).

#include "rhombicCompressedFrame.h"
#include "rhombicDicomHeader.h"
#include "rhombicDicomStack.h"
#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <streambuf>

namespace
{

using Limits = std::numeric_limits<double>;

TEST(SlicePlane, OverflowingAndVanishingNumbersMakeNone)
{
  const std::vector<double> axes{ 1, 0, 0, 0, 1, 0 };
  const auto problemOf = [](const std::vector<double> & position,
                            const std::vector<double> & orientation,
                            const std::vector<double> & spacing) {
    std::string problem;
    const auto plane = rhombic::MakeSlicePlane(position, orientation, spacing, problem);
    EXPECT_EQ(plane.has_value(), problem.empty());
    return problem;
  };
  EXPECT_EQ(problemOf({ 1e7, -1e7, 0 }, axes, { 1e-6, 1e7 }), "");
  for (const double number : { 1e8, -1e308, Limits::infinity(), Limits::quiet_NaN() })
  {
    EXPECT_NE(problemOf({ 0, number, 0 }, axes, { 1, 1 }), "") << number;
    EXPECT_NE(problemOf({ 0, 0, 0 }, axes, { 1, number }), "") << number;
    EXPECT_NE(problemOf({ 0, 0, 0 }, { 1, 0, 0, 0, number, 0 }, { 1, 1 }), "") << number;
  }
  EXPECT_NE(problemOf({ 0, 0, 0 }, axes, { 1e-160, 1 }), "");
  EXPECT_NE(problemOf({ 0, 0, 0 }, axes, { Limits::denorm_min(), 1 }), "");
}

TEST(DicomStack, VanishingStepsAreNone)
{
  std::vector<rhombic::DicomSlice> slices(2);
  for (const double z : { 0.0, 1e-300 })
  {
    rhombic::DicomSlice & slice = slices[z > 0 ? 1 : 0];
    slice.file = std::make_shared<rhombic::DicomImageFile>();
    slice.plane = rhombic::MakeSlicePlane({ 0, 0, z }, { 1, 0, 0, 0, 1, 0 }, { 1, 1 }, slice.planeProblem);
  }
  EXPECT_TRUE(HaveDuplicates(slices));
  EXPECT_THROW(StackSlices(slices, {}), rhombic::Failure);
}

TEST(CompressedFrame, RunLengthsOfFractionsOfABytePerPixelAreDamage)
{
  rhombic::DicomPixelFormat format;
  format.columns = 3;
  format.rows = 2;
  for (const unsigned int bits : { 1U, 128U })
  {
    format.bitsAllocated = bits;
    format.bitsStored = bits;
    std::string frame(64, '\0');
    frame[0] = static_cast<char>(bits / 8);
    EXPECT_NE(FindFrameDamage(frame, rhombic::PixelCodec::RunLength, format), "") << bits;
  }
}

TEST(DicomHeader, EndlessItemsAreDamage)
{
  std::string file("\x08\0\x60\0CS\2\0CT\0\x52\x30\x92SQ\0\0\xff\xff\xff\xff", 22);
  for (std::size_t n = 0; n < 1'100'000; ++n)
  {
    file.append("\xfe\xff\0\xe0\0\0\0\0", 8);
  }
  std::istringstream stream(file);
  const auto header = rhombic::ParseDicomHeader(stream, file.size());
  ASSERT_TRUE(header.has_value());
  EXPECT_NE(header->damage.find("items"), std::string::npos) << header->damage;
  EXPECT_LE(header->dataSet.GetItems(0x52009230).size(), std::size_t{ 1 } << 20);
}

/** The damage of a file of one little-endian data set of explicit types. */
std::string
DamageOf(const std::string & file)
{
  std::istringstream stream(file);
  const auto header = rhombic::ParseDicomHeader(stream, file.size());
  return header ? header->damage : "no DICOM";
}

TEST(DicomHeader, ValuesThatReadersWouldTakeDifferentlyAreDamage)
{
  const std::string modality("\x08\0\x60\0CS\2\0CT", 10);
  const std::string pixels("\xe0\x7f\x10\0OW\0\0\2\0\0\0ab", 14);
  const std::string intercept("\x28\0\x52\x10"
                              "DS\2\0-9",
                              10);
  EXPECT_EQ(DamageOf(modality + intercept + intercept + pixels), "");
  EXPECT_EQ(DamageOf(modality + intercept + pixels + std::string("\xfc\xff\xfc\xffOB\0\0\0\0\0\0", 12)), "")
    << "padding";
  EXPECT_EQ(DamageOf(modality + intercept + pixels + std::string(7, '\0')), "") << "bytes that are no elements";
  EXPECT_NE(DamageOf(modality + pixels + intercept).find("after the pixels"), std::string::npos);
  const std::string other("\x28\0\x52\x10"
                          "DS\2\0-8",
                          10);
  EXPECT_NE(DamageOf(modality + intercept + other + pixels).find("twice"), std::string::npos);

  const auto sequence = [](char length, char itemLength) { // of one item with the text of an element
    return std::string("\x30\0\x30\x92SQ\0\0", 8).replace(0, 2, "\0\x52", 2) + std::string{ length, 0, 0, 0 } +
           std::string("\xfe\xff\0\xe0", 4) + std::string{ itemLength, 0, 0, 0 } +
           std::string("\x28\0\x52\x10"
                       "DS\2\0-9",
                       10);
  };
  EXPECT_EQ(DamageOf(modality + sequence(18, 10) + pixels), "");
  EXPECT_NE(DamageOf(modality + sequence(16, 10) + pixels).find("longer than the sequence"), std::string::npos);
  EXPECT_NE(DamageOf(modality + sequence(18, 8) + pixels).find("longer than the item"), std::string::npos);
}

TEST(DicomHeader, EndlessElementsAreDamage)
{
  const std::string start = std::string(128, '\0') + "DICM";
  // A file of zeros, as large as one may be.
  class Zeros : public std::streambuf
  {
  public:
    explicit Zeros(const std::string & begin)
      : m_Buffer(begin + std::string(1 << 20, '\0'))
    {
      this->setg(m_Buffer.data(), m_Buffer.data(), m_Buffer.data() + m_Buffer.size());
      m_Begin = begin;
    }

  protected:
    int_type
    underflow() override
    {
      std::fill(m_Buffer.begin(), m_Buffer.end(), '\0');
      this->setg(m_Buffer.data(), m_Buffer.data(), m_Buffer.data() + m_Buffer.size());
      return 0;
    }
    pos_type
    seekpos(pos_type position, std::ios_base::openmode) override
    {
      m_Buffer.assign(m_Buffer.size(), '\0');
      m_Begin.copy(m_Buffer.data(), m_Begin.size());
      const auto offset = std::min<std::streamoff>(position, static_cast<std::streamoff>(m_Begin.size()));
      this->setg(m_Buffer.data(), m_Buffer.data() + offset, m_Buffer.data() + m_Buffer.size());
      return position;
    }

  private:
    std::string m_Buffer;
    std::string m_Begin;
  };
  Zeros zeros(start);
  std::istream stream(&zeros);
  const auto header = rhombic::ParseDicomHeader(stream, std::uintmax_t{ 20 } << 30);
  ASSERT_TRUE(header.has_value());
  EXPECT_NE(header->damage.find("elements"), std::string::npos) << header->damage;
}

TEST(DicomCodes, OnlyNumbersAndKnownWordsTravelOn)
{
  EXPECT_EQ(rhombic::ModalityOf("CT"), "CT");
  EXPECT_EQ(rhombic::ModalityOf("DOE-JOHN-1970"), "other");
  EXPECT_EQ(rhombic::ModalityOf(""), "");
  EXPECT_EQ(rhombic::ImageTypeOf("ORIGINAL\\PRIMARY\\SW_P_FFE\\T1 MAP"), "ORIGINAL\\PRIMARY\\SW_P_FFE\\T1 MAP");
  const std::string disguised = rhombic::ImageTypeOf("ORIGINAL\\PRIMARY\\DOE JOHN 1970.01.01 A");
  EXPECT_EQ(disguised.rfind("ORIGINAL\\PRIMARY\\other-", 0), 0u) << disguised;
  EXPECT_EQ(disguised.size(), std::string("ORIGINAL\\PRIMARY\\other-abcd").size());
  EXPECT_NE(disguised, rhombic::ImageTypeOf("ORIGINAL\\PRIMARY\\DOE JOHN 1970.01.01 B")) << "still told apart";
  EXPECT_EQ(rhombic::NumberTextOf("12"), "12");
  EXPECT_EQ(rhombic::NumberTextOf("-1.5e2\\3"), "-1.5e2\\3");
  EXPECT_EQ(rhombic::NumberTextOf("JOHN"), "");
  EXPECT_EQ(rhombic::NumberTextOf("12 Main"), "");
  EXPECT_EQ(rhombic::NameCodeOf("12"), "12");
  EXPECT_EQ(rhombic::NameCodeOf("19700101").rfind("other-", 0), 0u);
  EXPECT_EQ(rhombic::NameCodeOf("DOE").rfind("other-", 0), 0u);
}

} // namespace
