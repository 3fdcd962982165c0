#include "rhombicOMEZarrImage.h"

#include "rhombicFailure.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include <blosc.h>
#include <zstd.h>

/** Levels of OME-Zarr images. */
namespace
{

namespace fs = std::filesystem;
using rhombic::FailureKind;
using rhombic::OMEZarrImage;
using rhombic::OMEZarrOptions;
using rhombictest::OMEZarrTestFolder;
using rhombictest::ZarrCodec;

class OMEZarr : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  const fs::path m_Folder = m_TemporaryFolder.Path() / "image.ome.zarr";
};

ZarrCodec
ZstdCodec()
{
  return { "zstd", R"({"id": "zstd", "level": 3})", [](const std::string & bytes) {
            std::string packed(ZSTD_compressBound(bytes.size()), '\0');
            packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
            return packed;
          } };
}

/** \param shuffle 0, by bytes or by bits */
ZarrCodec
BloscCodec(const std::string & inner, int shuffle)
{
  const std::string json =
    R"({"id": "blosc", "cname": ")" + inner + R"(", "clevel": 5, "shuffle": )" + std::to_string(shuffle) + "}";
  return { "blosc", json, [inner, shuffle](const std::string & bytes) {
            std::string packed(bytes.size() + BLOSC_MAX_OVERHEAD, '\0');
            const int size = blosc_compress_ctx(
              5, shuffle, 2, bytes.size(), bytes.data(), packed.data(), packed.size(), inner.c_str(), 0, 1);
            EXPECT_GT(size, 0) << inner;
            packed.resize(static_cast<std::size_t>(std::max(0, size)));
            return packed;
          } };
}

std::vector<ZarrCodec>
AllCodecs()
{
  std::vector<ZarrCodec> codecs = rhombictest::DeflateCodecs();
  codecs.push_back(rhombictest::RawCodec());
  codecs.push_back(ZstdCodec());
  for (const char * const inner : { "blosclz", "lz4", "lz4hc", "zlib", "zstd" })
  {
    codecs.push_back(BloscCodec(inner, static_cast<int>(codecs.size()) % 3));
  }
  return codecs;
}

/** Values of all bits, without NaN. */
template <typename TValue>
std::vector<TValue>
RandomValues(std::size_t count, unsigned int seed)
{
  std::mt19937_64 random(seed);
  std::vector<TValue> values(count);
  for (TValue & value : values)
  {
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof(TValue));
    if constexpr (std::is_floating_point_v<TValue>)
    {
      value = std::isfinite(value) ? value : TValue(bits >> 40);
    }
  }
  return values;
}

template <typename TValue>
std::vector<TValue>
ReadValues(const OMEZarrImage & image, const itk::ImageRegion<3> & region, std::size_t frame = 0)
{
  EXPECT_TRUE(std::holds_alternative<TValue>(image.GetType()));
  std::vector<TValue> values(region.GetNumberOfPixels());
  image.Read(frame, region, values.data());
  return values;
}

template <typename TValue>
std::vector<TValue>
ReadWhole(const fs::path & folder, const OMEZarrOptions & options = {})
{
  const OMEZarrImage image(folder, options);
  return ReadValues<TValue>(image, image.GetSize());
}

/** The kind of the failure of an action, whose sentence contains \a named. */
FailureKind
KindOf(const std::function<void()> & action, const std::string & named)
{
  try
  {
    action();
    ADD_FAILURE() << "no failure that names " << named;
  }
  catch (const rhombic::Failure & failure)
  {
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find(named), std::string::npos) << sentence << " does not contain " << named;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
    return failure.GetKind();
  }
  return FailureKind::Internal;
}

template <typename TValue>
void
ExpectAllCodecs(const fs::path & folder)
{
  unsigned int seed = 0;
  for (const ZarrCodec & codec : AllCodecs())
  {
    for (const bool isBigEndian : { false, true })
    {
      OMEZarrTestFolder zarr;
      zarr.shape = { 7, 6, 5 };
      zarr.chunks = { 3, 4, 2 };
      zarr.codec = codec;
      zarr.isBigEndian = isBigEndian;
      zarr.separator = seed % 2 == 0 ? "." : "/";
      const auto values = RandomValues<TValue>(7 * 6 * 5, ++seed);
      fs::remove_all(folder);
      zarr.Write(folder, values);
      EXPECT_EQ(ReadWhole<TValue>(folder), values) << codec.name;
      EXPECT_EQ(OMEZarrImage(folder).GetEncoding(), codec.name);
    }
  }
}

TEST_F(OMEZarr, EachTypeByteOrderAndCodec)
{
  ExpectAllCodecs<std::uint8_t>(m_Folder);
  ExpectAllCodecs<std::int8_t>(m_Folder);
  ExpectAllCodecs<std::uint16_t>(m_Folder);
  ExpectAllCodecs<std::int16_t>(m_Folder);
  ExpectAllCodecs<std::uint32_t>(m_Folder);
  ExpectAllCodecs<std::int32_t>(m_Folder);
  ExpectAllCodecs<std::uint64_t>(m_Folder);
  ExpectAllCodecs<std::int64_t>(m_Folder);
  ExpectAllCodecs<float>(m_Folder);
  ExpectAllCodecs<double>(m_Folder);
}

TEST_F(OMEZarr, AnyRegionIsThatPartOfTheWhole)
{
  std::mt19937 random(7);
  for (const ZarrCodec & codec : AllCodecs())
  {
    OMEZarrTestFolder zarr;
    zarr.shape = { 9, 11, 10 };
    zarr.chunks = { 4, 3, 16 };
    zarr.codec = codec;
    const auto values = RandomValues<std::uint16_t>(9 * 11 * 10, 3);
    fs::remove_all(m_Folder);
    const OMEZarrImage image(zarr.Write(m_Folder, values));
    for (int n = 0; n < 60; ++n)
    {
      itk::ImageRegion<3> region;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto size = static_cast<long>(image.GetSize()[axis]);
        const long begin = std::uniform_int_distribution<long>(0, size - 1)(random);
        region.SetIndex(axis, begin);
        region.SetSize(axis, std::uniform_int_distribution<long>(0, size - begin)(random));
      }
      const auto part = ReadValues<std::uint16_t>(image, region);
      for (std::size_t k = 0, i = 0; k < region.GetSize(2); ++k)
      {
        for (std::size_t j = 0; j < region.GetSize(1); ++j)
        {
          for (std::size_t h = 0; h < region.GetSize(0); ++h, ++i)
          {
            const std::size_t z = region.GetIndex(2) + k, y = region.GetIndex(1) + j, x = region.GetIndex(0) + h;
            ASSERT_EQ(part[i], values[(z * 11 + y) * 10 + x]) << region;
          }
        }
      }
    }
  }
}

TEST_F(OMEZarr, ARegionReadsItsOwnChunksOnly)
{
  OMEZarrTestFolder zarr;
  zarr.codec = rhombictest::DeflateCodecs().front();
  const auto values = RandomValues<std::int16_t>(4 * 5 * 6, 1);
  const OMEZarrImage image(zarr.Write(m_Folder, values));
  OMEZarrTestFolder::WriteText(m_Folder / "0/1/1/1", "damaged");
  const itk::ImageRegion<3> first({ { 0, 0, 0 } }, { { 6, 5, 2 } }); // slices of chunks 0/y/x
  EXPECT_EQ(ReadValues<std::int16_t>(image, first), std::vector<std::int16_t>(values.begin(), values.begin() + 60));
  EXPECT_EQ(KindOf([&] { ReadWhole<std::int16_t>(m_Folder); }, (m_Folder / "0/1/1/1").string()),
            FailureKind::Unreadable);
}

TEST_F(OMEZarr, AMissingChunkIsTheFillValue)
{
  OMEZarrTestFolder zarr;
  zarr.shape = zarr.chunks = { 2, 2, 2 };
  const auto readWith = [&](const std::string & fill, auto value) {
    zarr.fill = fill;
    zarr.Write(m_Folder, std::vector<decltype(value)>(8));
    fs::remove_all(m_Folder / "0/0");
    return ReadWhole<decltype(value)>(m_Folder);
  };
  EXPECT_EQ(readWith("-7", std::int16_t()), std::vector<std::int16_t>(8, -7));
  EXPECT_EQ(readWith("255", std::uint8_t()), std::vector<std::uint8_t>(8, 255));
  EXPECT_EQ(readWith("18446744073709551615", std::uint64_t()),
            std::vector<std::uint64_t>(8, std::numeric_limits<std::uint64_t>::max()));
  EXPECT_EQ(readWith("0.5", float()), std::vector<float>(8, 0.5f));
  EXPECT_TRUE(std::isnan(readWith("\"NaN\"", double()).front()));
  EXPECT_EQ(readWith("\"-Infinity\"", float()).front(), -std::numeric_limits<float>::infinity());
  EXPECT_EQ(KindOf([&] { readWith("null", std::uint8_t()); }, (m_Folder / "0/0/0/0").string()),
            FailureKind::Unreadable);
  for (const std::string fill : { "256", "-1", "0.5", "\"NaN\"", "[]", "true" })
  {
    EXPECT_EQ(KindOf([&] { readWith(fill, std::uint8_t()); }, "fill_value"), FailureKind::Unreadable) << fill;
  }
}

TEST_F(OMEZarr, ADamagedChunkIsRefusedByItsName)
{
  const auto values = RandomValues<std::uint16_t>(4 * 5 * 6, 5);
  for (const ZarrCodec & codec : AllCodecs())
  {
    OMEZarrTestFolder zarr;
    zarr.codec = codec;
    zarr.Write(m_Folder, values);
    const fs::path chunk = m_Folder / "0/1/0/1";
    const std::string packed = codec.pack(std::string(2 * 3 * 4 * 2, 'x'));
    for (const std::string & bytes : { std::string(),
                                       packed.substr(0, packed.size() - 1),
                                       packed + "x",
                                       packed.substr(0, 1),
                                       codec.pack(std::string(2 * 3 * 4 * 2 - 1, 'x')),
                                       codec.pack(std::string(2 * 3 * 4 * 2 + 1, 'x')) })
    {
      OMEZarrTestFolder::WriteText(chunk, bytes);
      EXPECT_EQ(KindOf([&] { ReadWhole<std::uint16_t>(m_Folder); }, chunk.string()), FailureKind::Unreadable)
        << codec.name << bytes.size();
    }
    OMEZarrTestFolder::WriteText(chunk, packed);
    EXPECT_NO_THROW(ReadWhole<std::uint16_t>(m_Folder)) << codec.name;
    fs::remove(chunk);
    fs::create_directory(chunk);
    EXPECT_EQ(KindOf([&] { ReadWhole<std::uint16_t>(m_Folder); }, chunk.string()), FailureKind::Unreadable);
    fs::remove_all(m_Folder);
  }
}

/** Any bytes in a chunk are read, or refused by the chunk's name. */
TEST_F(OMEZarr, ChunksOfAnyBytesDoNoHarm)
{
  std::mt19937 random(11);
  for (const ZarrCodec & codec : AllCodecs())
  {
    OMEZarrTestFolder zarr;
    zarr.shape = zarr.chunks = { 8, 8, 8 };
    zarr.codec = codec;
    std::vector<std::uint16_t> values(512);
    std::iota(values.begin(), values.end(), 0);
    const OMEZarrImage image(zarr.Write(m_Folder, values));
    const fs::path chunk = m_Folder / "0/0/0/0";
    std::ifstream file(chunk, std::ios::binary);
    const std::string sound((std::istreambuf_iterator<char>(file)), {});
    for (int n = 0; n < 40; ++n)
    {
      std::string bytes = sound;
      for (int changes = 1 + n % 3; changes > 0; --changes)
      {
        const bool isHeader = random() % 2 == 0; // where codecs keep their sizes
        bytes[random() % (isHeader ? std::min<std::size_t>(bytes.size(), 32) : bytes.size())] =
          static_cast<char>(random());
      }
      OMEZarrTestFolder::WriteText(chunk, bytes);
      try
      {
        ReadValues<std::uint16_t>(image, image.GetSize());
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), FailureKind::Unreadable);
        EXPECT_NE(std::string(failure.GetDescription()).find(chunk.string()), std::string::npos);
      }
    }
    fs::remove_all(m_Folder);
  }
}

TEST_F(OMEZarr, PositionsAreInMillimetres)
{
  OMEZarrTestFolder zarr;
  zarr.axes = R"([{"name": "z", "type": "space", "unit": "nanometer"}, {"name": "y", "type": "space", "unit": "meter"},
                  {"name": "x", "unit": "micrometer"}])";
  zarr.transformations = R"([{"type": "scale", "scale": [500, 0.25, 2]},
                             {"type": "translation", "translation": [1000, -1, 5]}])";
  zarr.imageTransformations = R"([{"type": "identity"}, {"type": "scale", "scale": [2, 1, 10]},
                                  {"type": "translation", "translation": [0, 0, 7]}])";
  const OMEZarrImage image(zarr.Write(m_Folder, std::vector<float>(120)));
  EXPECT_EQ(image.GetSize(), (itk::Size<3>{ { 6, 5, 4 } }));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double steps[] = { 0.02, 250, 0.001 };
    const double origin[] = { 0.057, -1000, 0.002 };
    EXPECT_DOUBLE_EQ(image.GetSteps()[axis][axis], steps[axis]);
    EXPECT_DOUBLE_EQ(image.GetSteps()[axis].GetNorm(), steps[axis]);
    EXPECT_DOUBLE_EQ(image.GetOrigin()[axis], origin[axis]);
  }
  ASSERT_EQ(image.GetNotes().size(), 1u);
  EXPECT_NE(image.GetNotes().front().find("left and right are a guess"), std::string::npos);
}

TEST_F(OMEZarr, ScalesBeyondAllNumbersAreRefused)
{
  OMEZarrTestFolder zarr;
  for (const char * const transformations :
       { R"([{"type": "scale", "scale": [1, 1, 1e200]}, {"type": "scale", "scale": [1, 1, 1e200]}])",
         R"([{"type": "scale", "scale": [1, 1, 1e200]}])",
         R"([{"type": "scale", "scale": [1, 1, 1e-200]}])",
         R"([{"type": "scale", "scale": [1, 1, 0]}])",
         R"([{"type": "scale", "scale": [1, 1, -1]}])",
         R"([{"type": "scale", "scale": [1, 1, 2]}, {"type": "translation", "translation": [0, 0, 1e308]},
             {"type": "translation", "translation": [0, 0, 1e308]}])" })
  {
    zarr.transformations = transformations;
    zarr.Write(m_Folder, std::vector<float>(120));
    EXPECT_EQ(KindOf([&] { OMEZarrImage image(m_Folder); }, "axis x"), FailureKind::Geometry) << transformations;
    std::filesystem::remove_all(m_Folder / "0");
  }
}

TEST_F(OMEZarr, AxesOfSpaceInAnyOrder)
{
  OMEZarrTestFolder zarr;
  zarr.axes = R"([{"name": "y", "type": "space", "unit": "mm"}, {"name": "x", "type": "space", "unit": "mm"},
                  {"name": "z", "type": "space", "unit": "mm"}])";
  zarr.transformations =
    R"([{"type": "scale", "scale": [4, 3, 2]}, {"type": "translation", "translation": [40, 30, 20]}])";
  const OMEZarrImage image(zarr.Write(m_Folder, std::vector<float>(120)));
  EXPECT_EQ(image.GetSize(), (itk::Size<3>{ { 6, 5, 4 } }));
  EXPECT_EQ(image.GetSteps()[0], (itk::Vector<double, 3>(std::array<double, 3>{ 0.0, 0.0, 2.0 }.data())))
    << "the last axis of the array";
  EXPECT_EQ(image.GetSteps()[1], (itk::Vector<double, 3>(std::array<double, 3>{ 3.0, 0.0, 0.0 }.data())));
  EXPECT_EQ(image.GetSteps()[2], (itk::Vector<double, 3>(std::array<double, 3>{ 0.0, 4.0, 0.0 }.data())));
  EXPECT_EQ(image.GetOrigin(), (itk::Point<double, 3>(std::array<double, 3>{ 30.0, 40.0, 20.0 })));
}

TEST_F(OMEZarr, TimesAndChannelsAreFrames)
{
  OMEZarrTestFolder zarr;
  zarr.shape = { 3, 2, 4, 5, 6 };
  zarr.chunks = { 2, 2, 3, 3, 3 };
  zarr.codec = rhombictest::DeflateCodecs().front();
  const std::string space = zarr.axes.substr(1);
  zarr.axes = R"([{"name": "t", "type": "time", "unit": "second"}, {"name": "c", "type": "channel"}, )" + space;
  zarr.transformations = R"([{"type": "scale", "scale": [9, 1, 4, 3, 2]}])";
  const auto values = RandomValues<std::uint16_t>(720, 4);
  const OMEZarrImage image(zarr.Write(m_Folder, values));
  ASSERT_EQ(image.GetNumberOfFrames(), 6u);
  for (std::size_t frame = 0; frame < 6; ++frame)
  {
    EXPECT_EQ(ReadValues<std::uint16_t>(image, image.GetSize(), frame),
              std::vector<std::uint16_t>(values.begin() + 120 * frame, values.begin() + 120 * (frame + 1)));
  }
  EXPECT_DOUBLE_EQ(image.GetSteps()[2][2], 0.004);
}

TEST_F(OMEZarr, LevelsOfThePyramid)
{
  OMEZarrTestFolder zarr;
  const auto fine = RandomValues<std::uint16_t>(120, 1);
  zarr.Write(m_Folder, fine);
  zarr.shape = { 2, 2, 3 };
  const auto coarse = RandomValues<std::uint16_t>(12, 2);
  zarr.WriteArray(m_Folder / "1", coarse);
  OMEZarrTestFolder::WriteText(m_Folder / ".zattrs", zarr.Attributes(2));
  OMEZarrOptions options;
  EXPECT_EQ(OMEZarrImage(m_Folder).GetNumberOfLevels(), 2u);
  EXPECT_EQ(ReadWhole<std::uint16_t>(m_Folder), fine);
  options.level = 1;
  EXPECT_EQ(ReadWhole<std::uint16_t>(m_Folder, options), coarse);
  options.level = 2;
  EXPECT_EQ(KindOf([&] { OMEZarrImage(m_Folder, options); }, "2 levels"), FailureKind::Usage);
}

TEST_F(OMEZarr, AnUnknownVoxelSizeIsAskedFor)
{
  OMEZarrTestFolder zarr;
  zarr.axes = R"([{"name": "z"}, {"name": "y"}, {"name": "x"}])";
  zarr.transformations =
    R"([{"type": "scale", "scale": [2, 1, 1]}, {"type": "translation", "translation": [3, 0, 0]}])";
  zarr.Write(m_Folder, std::vector<float>(120));
  EXPECT_EQ(KindOf([&] { OMEZarrImage image(m_Folder); }, "OMEZarrOptions::voxelSize"), FailureKind::Geometry);
  OMEZarrOptions options;
  options.voxelSize = { 0.1, 0.2, 0.3 };
  const OMEZarrImage image(m_Folder, options);
  EXPECT_DOUBLE_EQ(image.GetSteps()[0][0], 0.1);
  EXPECT_DOUBLE_EQ(image.GetSteps()[1][1], 0.2);
  EXPECT_DOUBLE_EQ(image.GetSteps()[2][2], 0.3);
  EXPECT_DOUBLE_EQ(image.GetOrigin()[2], 0.45) << "1.5 voxels";
  zarr.transformations = "null";
  zarr.Write(m_Folder, std::vector<float>(120));
  EXPECT_EQ(KindOf([&] { OMEZarrImage without(m_Folder); }, "scale"), FailureKind::Geometry);
  EXPECT_DOUBLE_EQ(OMEZarrImage(m_Folder, options).GetSteps()[2][2], 0.3);
  OMEZarrTestFolder().Write(m_Folder, std::vector<float>(120));
  EXPECT_EQ(KindOf([&] { OMEZarrImage known(m_Folder, options); }, "can't be given"), FailureKind::Usage);
}

struct Replacement
{
  std::string old;
  std::string text;
  std::string named; ///< in the sentence
};

TEST_F(OMEZarr, WhatIsNotSupportedIsRefused)
{
  const OMEZarrTestFolder zarr;
  const auto expect = [&](const fs::path & name, const Replacement & change) {
    fs::remove_all(m_Folder);
    zarr.Write(m_Folder, std::vector<std::uint16_t>(120));
    std::ifstream file(m_Folder / name, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto place = text.find(change.old);
    ASSERT_NE(place, std::string::npos) << change.old;
    OMEZarrTestFolder::WriteText(m_Folder / name, text.replace(place, change.old.size(), change.text));
    const FailureKind kind = KindOf([&] { ReadWhole<std::uint16_t>(m_Folder); }, change.named);
    EXPECT_TRUE(kind == FailureKind::Unreadable || kind == FailureKind::Geometry) << change.text;
  };
  for (const Replacement & change :
       std::vector<Replacement>{ { "\"C\"", "\"F\"", "order" },
                                 { "<u2", "<c8", "type" },
                                 { "<u2", "|u2", "byte order" },
                                 { "null,", R"({"id": "lzma"},)", "compressor" },
                                 { "null,", R"("zlib",)", "compressor" },
                                 { "null,", R"({},)", "compressor" },
                                 { R"("filters": null)", R"("filters": [{"id": "delta"}])", "filters" },
                                 { R"("zarr_format": 2)", R"("zarr_format": 3)", "zarr_format" },
                                 { "\"/\"", "\"-\"", "dimension_separator" },
                                 { "[4, 5, 6]", "[4, 5]", "numbers of axes" },
                                 { "[4, 5, 6]", "[0, 5, 6]", "shape" },
                                 { "[4, 5, 6]", "[-4, 5, 6]", "shape" },
                                 { "[4, 5, 6]", "[4.5, 5, 6]", "shape" },
                                 { "[4, 5, 6]", "[1, 1, 1, 4, 5, 6]", "shape" },
                                 { "[4, 5, 6]", "[2147483647, 2147483647, 2147483647]", "larger than any volume" },
                                 { "[2, 3, 4]", "[2147483647, 2147483647, 2147483647]", "larger than any volume" },
                                 { "[4, 5, 6]", "[400000, 300, 400]", "chunks" },
                                 { "[2, 3, 4]", "[0, 3, 4]", "chunks" },
                                 { "{", "[", "JSON" } })
  {
    expect("0/.zarray", change);
  }
  for (const Replacement & change :
       std::vector<Replacement>{ { "\"0.4\"", "\"0.5\"", "0.5" },
                                 { "\"0\"", "\"../other\"", "path" },
                                 { "\"0\"", "\"/etc\"", "path" },
                                 { "\"0\"", "\"nothing\"", "missing" },
                                 { "\"0\"", "7", "path" },
                                 { "\"z\"", "\"depth\"", "x, y and z" },
                                 { "\"z\"", "\"x\"", "x, y and z" },
                                 { "\"space\"", "\"channel\"", "no volume" },
                                 { "micrometer", "second", "unit" },
                                 { "[4, 3, 2]", "[4, 3]", "coordinateTransformations" },
                                 { "[4, 3, 2]", "[4, 3, 0]", "scale" },
                                 { "[4, 3, 2]", "[4, 3, -2]", "scale" },
                                 { "[4, 3, 2]", "\"scale.zarr\"", "coordinateTransformations" },
                                 { "\"scale\"", "\"affine\"", "coordinateTransformations" },
                                 { "\"datasets\"", "\"levels\"", "levels" },
                                 { "\"axes\"", "\"axis\"", "axes" } })
  {
    expect(".zattrs", change);
  }
}

TEST_F(OMEZarr, FoldersWithoutAnImageSayWhatTheyHold)
{
  OMEZarrTestFolder zarr;
  zarr.Write(m_Folder, std::vector<float>(120));
  EXPECT_TRUE(rhombic::HoldsOMEZarrImage(m_Folder));
  EXPECT_FALSE(rhombic::HoldsOMEZarrImage(m_Folder / "0"));
  EXPECT_FALSE(rhombic::HoldsOMEZarrImage(m_Folder / "0/0"));
  const auto kindOf = [this](const fs::path & folder, const std::string & named) {
    return KindOf([&] { OMEZarrImage image(folder); }, named);
  };
  EXPECT_EQ(kindOf(m_Folder / "0", "levels of a pyramid"), FailureKind::NotFound);
  OMEZarrTestFolder::WriteText(m_Folder / ".zattrs", R"({"bioformats2raw.layout": 3})");
  EXPECT_EQ(kindOf(m_Folder, (m_Folder / "0").string()), FailureKind::NotFound);
  OMEZarrTestFolder::WriteText(m_Folder / ".zattrs", "{}");
  EXPECT_EQ(kindOf(m_Folder, "multiscales"), FailureKind::NotFound);
  OMEZarrTestFolder::WriteText(m_Folder / "zarr.json", "{}");
  EXPECT_TRUE(rhombic::IsZarr(m_Folder));
  EXPECT_TRUE(rhombic::HoldsOMEZarrImage(m_Folder)) << "the failure tells the version";
  EXPECT_EQ(kindOf(m_Folder, "version 3"), FailureKind::Unreadable);
  EXPECT_FALSE(rhombic::IsZarr(m_Folder.parent_path()));
}

TEST_F(OMEZarr, MetadataIsLimited)
{
  OMEZarrTestFolder zarr;
  zarr.Write(m_Folder, std::vector<float>(120));
  const auto kindOf = [&](const std::string & text, const std::string & named) {
    OMEZarrTestFolder::WriteText(m_Folder / ".zattrs", text);
    return KindOf([&] { OMEZarrImage image(m_Folder); }, named);
  };
  EXPECT_EQ(kindOf(std::string(1 << 25, ' '), "16 MiB"), FailureKind::Unreadable);
  EXPECT_EQ(kindOf("{\"a\": " + std::string(1000000, '['), "levels deep"), FailureKind::Unreadable);
  EXPECT_EQ(kindOf("", "JSON"), FailureKind::Unreadable);
}

TEST_F(OMEZarr, SymbolicLinksAreFollowedOnlyIfAsked)
{
  OMEZarrTestFolder zarr;
  const auto values = RandomValues<std::uint16_t>(120, 1);
  zarr.Write(m_Folder, values);
  const fs::path chunk = m_Folder / "0/1/1/1", other = m_Folder.parent_path() / "other";
  fs::rename(chunk, other);
  fs::create_symlink(other, chunk);
  EXPECT_EQ(KindOf([&] { ReadWhole<std::uint16_t>(m_Folder); }, "symbolic link"), FailureKind::Unreadable);
  OMEZarrOptions options;
  options.followsLinks = true;
  EXPECT_EQ(ReadWhole<std::uint16_t>(m_Folder, options), values);
  fs::remove(other);
  EXPECT_EQ(KindOf([&] { ReadWhole<std::uint16_t>(m_Folder, options); }, chunk.string()), FailureKind::Unreadable)
    << "a link to nothing is no missing chunk";
  fs::rename(m_Folder / "0", m_Folder.parent_path() / "array");
  fs::create_directory_symlink(m_Folder.parent_path() / "array", m_Folder / "0");
  EXPECT_EQ(KindOf([&] { OMEZarrImage image(m_Folder); }, "symbolic link"), FailureKind::Unreadable);
}

/** Any metadata gives an image or a Failure. */
TEST_F(OMEZarr, AnyMetadataIsReadOrRefused)
{
  std::mt19937 random(5);
  OMEZarrTestFolder zarr;
  zarr.Write(m_Folder, std::vector<std::uint16_t>(120));
  std::size_t numberRead = 0;
  for (const fs::path name : { ".zattrs", "0/.zarray" })
  {
    const std::string sound = name == ".zattrs" ? zarr.Attributes() : zarr.ArrayMetadata<std::uint16_t>();
    for (int n = 0; n < 1000; ++n)
    {
      const std::string letters = "0123456789.-[]{}\",:eznul ";
      std::string text = sound;
      for (int changes = 1 + n % 3; changes > 0; --changes)
      {
        text[random() % text.size()] = letters[random() % letters.size()];
      }
      OMEZarrTestFolder::WriteText(m_Folder / name, text);
      try
      {
        const OMEZarrImage image(m_Folder);
        ++numberRead;
        if (image.GetSize()[0] * image.GetSize()[1] * image.GetSize()[2] < 10000)
        {
          std::vector<double> values(image.GetSize()[0] * image.GetSize()[1] * image.GetSize()[2]);
          image.Read(0, image.GetSize(), values.data());
        }
      }
      catch (const rhombic::Failure &)
      {}
    }
    OMEZarrTestFolder::WriteText(m_Folder / name, sound);
  }
  EXPECT_GT(numberRead, 100u);
}

} // namespace
