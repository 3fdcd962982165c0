#include "rhombicAtomicFile.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicLabelMap.h"
#include "rhombicTextHeader.h"
#include "rhombicStoredVolume.h"
#include "rhombicMappedVoxels.h"
#include "rhombicScanTest.h"

#include <map>
#include <random>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::GeometryOf;
using rhombic::ReadScan;
using rhombic::ScanReadOptions;

/** NRRD and MetaImage files as a test needs them. */
class TextVolume : public ScanTest
{
protected:
  /** A NRRD file of 2x2x2 uint8 with these fields besides, holding "01234567". */
  fs::path
  WriteNRRD(const std::string & fields,
            const std::string & data = "01234567",
            const std::string & name = "a.nrrd") const
  {
    return WriteBytes(m_Folder / name, "NRRD0005\n" + fields + "\n" + data);
  }

  fs::path
  WriteMetaImage(const std::string & fields,
                 const std::string & data = "01234567",
                 const std::string & name = "a.mha") const
  {
    return WriteBytes(m_Folder / name, fields + "ElementDataFile = LOCAL\n" + data);
  }
};

const std::string Bare = "type: uint8\ndimension: 3\nsizes: 2 2 2\n";
const std::string Raw = Bare + "encoding: raw\n";
const std::string Directions = "space directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (5,6,7)\n";
const std::string Meta = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n";
const std::string Placed = "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 5 6 7\nElementSpacing = 2 3 4\n";

ScanReadOptions
Frame(std::size_t frame)
{
  ScanReadOptions options;
  options.frame = frame;
  return options;
}

std::string
TextOf(const rhombic::Scan & scan)
{
  const auto & image = ImageOf<std::uint8_t>(scan);
  return { image.GetBufferPointer(), image.GetBufferPointer() + image.GetBufferedRegion().GetNumberOfPixels() };
}

TEST_F(TextVolume, SpacesOfNRRD)
{
  struct Space
  {
    const char * name;
    double x, y; ///< signs to LPS
    bool isOriented;
  };
  for (const Space & space : { Space{ "left-posterior-superior", 1, 1, true },
                               Space{ "LPS", 1, 1, true },
                               Space{ "right-anterior-superior", -1, -1, true },
                               Space{ "RAS", -1, -1, true },
                               Space{ "left-anterior-superior", 1, -1, true },
                               Space{ "LAS", 1, -1, true },
                               Space{ "3D-right-handed", 1, 1, false },
                               Space{ "scanner-xyz", 1, 1, false } })
  {
    SCOPED_TRACE(space.name);
    const auto scan = ReadScan(this->WriteNRRD(Raw + "space: " + space.name + "\n" + Directions));
    EXPECT_EQ(TextOf(scan), "01234567");
    const auto & geometry = GeometryOf(scan.image);
    const double origin[3] = { 5 * space.x, 6 * space.y, 7 };
    ExpectNear(geometry.GetOrigin(), itk::Point<double, 3>(origin), 1e-12);
    EXPECT_EQ(geometry.GetDirection()[0][0], space.x);
    EXPECT_EQ(geometry.GetDirection()[1][1], space.y);
    EXPECT_EQ(geometry.GetSpacing()[2], 4);
    EXPECT_EQ(scan.isOriented, space.isOriented);
    EXPECT_EQ(scan.notes.size(), space.isOriented ? 0u : 1u);
  }
  const auto micrometres =
    ReadScan(this->WriteNRRD(Raw + "space: LPS\nspace units: \"um\" \"um\" \"um\"\n" + Directions));
  EXPECT_NEAR(GeometryOf(micrometres.image).GetOrigin()[2], 0.007, 1e-12);
  const auto spacings = ReadScan(this->WriteNRRD(Raw + "spacings: 2 3 4\n"));
  EXPECT_EQ(GeometryOf(spacings.image).GetSpacing()[1], 3);
  EXPECT_FALSE(spacings.isOriented);
}

TEST_F(TextVolume, ShearIsKeptOrRefused)
{
  const auto nrrd =
    this->WriteNRRD(Raw + "space: LPS\nspace directions: (1,0,0) (0.3,1,0) (0,0,1)\nspace origin: (0,0,0)\n");
  const auto meta =
    this->WriteMetaImage(Meta + "TransformMatrix = 1 0 0 0.3 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\n");
  ScanReadOptions refusing;
  refusing.onTilted = ScanReadOptions::Policy::Refuse;
  for (const auto & path : { nrrd, meta })
  {
    const auto scan = ReadScan(path);
    EXPECT_EQ(TextOf(scan), "01234567");
    ASSERT_EQ(scan.notes.size(), 1u);
    EXPECT_NE(scan.notes[0].find("16.7 degrees"), std::string::npos) << scan.notes[0];
    itk::Point<double, 3> point;
    GeometryOf(scan.image).TransformIndexToPhysicalPoint(itk::Index<3>{ { 1, 1, 1 } }, point);
    const double expected[3] = { 1.3, 1, 1 };
    ExpectNear(point, itk::Point<double, 3>(expected), 1e-12);
    EXPECT_EQ(KindOfReading(path, "sheared", refusing), FailureKind::Geometry);
  }
}

TEST_F(TextVolume, GeometryThatMakesNoSenseIsRefused)
{
  for (const std::string directions : { "(1,0,0) (0,1,0) (0,0,0)",
                                        "(1,0,0) (0,1,0) (1,1,0)",
                                        "(1,0,0) (0,1,0) (0,0,nan)",
                                        "(1,0,0) (0,1,0)",
                                        "(1,0) (0,1) (1,0)",
                                        "(1,0,0) (0,1,0) (0,0,1",
                                        "(1,0,0) (0,1,0) ((0,0,1)",
                                        "(1,0,0) (0,1,0) (0,0,x)" })
  {
    const auto path = this->WriteNRRD(Raw + "space: LPS\nspace directions: " + directions + "\n");
    EXPECT_EQ(KindOfReading(path, "space directions"), FailureKind::Geometry) << directions;
  }
  for (const std::string origin : { ": (7,-8,9)", "(7,-8,9", "(7,(-8,9)" })
  {
    EXPECT_EQ(KindOfReading(this->WriteNRRD(Raw + "space origin: " + origin + "\n"), "space origin"),
              FailureKind::Geometry)
      << origin << ", also where it is not needed";
  }
  EXPECT_EQ(KindOfReading(this->WriteNRRD(Raw + "spacings: 1 2(3\n"), "spacings"), FailureKind::Geometry);
  for (const std::string matrix : { "1 0 0 0 1 0 0 0 0", "1 0 0 0 1 0 1 1 0", "1 0 0 0 1 0 0 0 inf", "1 0 0", "a b c" })
  {
    const auto path = this->WriteMetaImage(Meta + "TransformMatrix = " + matrix + "\n");
    EXPECT_EQ(KindOfReading(path, "a.mha"), FailureKind::Geometry) << matrix;
  }
}

TEST_F(TextVolume, HeadersThatMakeNoSenseAreRefused)
{
  for (const std::string & fields : { std::string("type: uint8\n"),
                                      std::string("dimension: 3\nsizes: 2 2 2\nencoding: raw\n"),
                                      "type: block\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n" + Directions,
                                      std::string("type: uint8\ndimension: 3\nsizes: 2 2\nencoding: raw\n"),
                                      std::string("type: uint8\ndimension: 3\nsizes: 2 0 2\nencoding: raw\n"),
                                      std::string("type: uint8\ndimension: 3\nsizes: 2 -2 2\nencoding: raw\n"),
                                      std::string("type: uint8\ndimension: 2\nsizes: 2 2\nencoding: raw\n"),
                                      std::string("type: uint16\ndimension: 3\nsizes: 2 2 1\nencoding: raw\n"),
                                      Raw + "type: uint8\n",
                                      Raw + "byte skip: 1\n",
                                      Raw + "byte skip: -2\n",
                                      Raw + "line skip: 1\n",
                                      Raw + "kinds: RGB-color domain domain\n",
                                      Raw + "spacings:\n",
                                      Raw + "spacings:1 2 3\n",
                                      std::string("type: uint8\ndimension: (3\nsizes: 2 2 2\nencoding: raw\n"),
                                      std::string("type: uint8\ndimension:3\nsizes: 2 2 2\nencoding: raw\n"),
                                      Raw + "data file: LIST\n",
                                      Raw + "data file: ../a.raw\n",
                                      Raw + "data file: /etc/passwd\n",
                                      Raw + "data file: missing.raw\n",
                                      Bare + "encoding: bzip2\n",
                                      std::string("type: uint8\ndimension: 3\nsizes: 2147483647 2147483647 2147483647\n"
                                                  "encoding: raw\n") })
  {
    EXPECT_EQ(KindOfReading(this->WriteNRRD(fields), "a.nrrd"), FailureKind::Unreadable) << fields;
  }
  for (const std::string & fields :
       { std::string("NDims = 3\n"),
         std::string("NDims = 3\nDimSize = 2 2\nElementType = MET_UCHAR\n"),
         std::string("NDims = (3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"),
         std::string("NDims = 3\nDimSize = 2 2 -2\nElementType = MET_UCHAR\n"),
         std::string("NDims = 3\nDimSize = 2000000000 2000000000 2000000000\nElementType = MET_UCHAR\n"),
         std::string("NDims = 3\nDimSize = 2 2 3\nElementType = MET_UCHAR\n"),
         std::string("NDims = 3\nDimSize = 2 2 2\nElementType = MET_NONE\n"),
         Meta + "ElementNumberOfChannels = 3\n",
         Meta + "ElementSpacing = 1 2 3\nElementSpacing = 3 2 1\n",
         Meta + "HeaderSize = -7\n",
         Meta + "CompressedData = True\n",
         Meta + "CompressedData = True\nCompressedDataSize = 5000\n",
         Meta + "ElementToIntensityFunctionSlope = nan\n" })
  {
    EXPECT_EQ(KindOfReading(this->WriteMetaImage(fields), "a.mha"), FailureKind::Unreadable) << fields;
  }
  for (const std::string file : { "/etc/passwd", "../a.raw", "LIST", "a%d.raw 1 2 1", "missing.raw" })
  {
    const auto path = WriteBytes(m_Folder / "b.mhd", Meta + "ElementDataFile = " + file + "\n");
    EXPECT_EQ(KindOfReading(path, "b.mhd"), FailureKind::Unreadable) << file;
  }
}

TEST_F(TextVolume, EncodingsAndPlacesOfData)
{
  const std::string space = "space: LPS\n" + Directions;
  WriteBytes(m_Folder / "a.raw", "head01234567");
  fs::create_directory(m_Folder / "below");
  WriteBytes(m_Folder / "below/a.raw", "line\n01234567");
  struct Case
  {
    std::string fields;
    std::string data;
    const char * encoding;
  };
  for (const Case & test : { Case{ Raw + space, "01234567 and more", "raw" },
                             Case{ Raw + space + "data file: a.raw\nbyte skip: 4\n", "", "raw" },
                             Case{ Raw + space + "data file: a.raw\nbyte skip: -1\n", "", "raw" },
                             Case{ Raw + space + "datafile: below/a.raw\nline skip: 1\n", "", "raw" },
                             Case{ Bare + space + "encoding: gzip\n", Gzipped("01234567"), "gzip" },
                             Case{ Bare + space + "encoding: gz\nbyte skip: 2\n", Gzipped("ab01234567"), "gzip" } })
  {
    const auto scan = ReadScan(this->WriteNRRD(test.fields, test.data));
    EXPECT_EQ(TextOf(scan), "01234567") << test.fields;
    EXPECT_EQ(scan.encoding, test.encoding);
  }
  EXPECT_EQ(TextOf(ReadScan(this->WriteNRRD(Raw + space, "01234567", "LOUD.NRRD"))), "01234567");
  EXPECT_EQ(TextOf(ReadScan(this->WriteMetaImage(Meta + Placed, "01234567", "LOUD.MHA"))), "01234567");
  EXPECT_EQ(TextOf(ReadScan(this->WriteMetaImage(Meta + Placed + "HeaderSize = -1\n", "more01234567"))), "01234567");
  for (const std::string encoding : { "txt", "ascii", "hex", "bzip2" })
  {
    EXPECT_EQ(KindOfReading(this->WriteNRRD(Bare + space + "encoding: " + encoding + "\n", "48 49 50 51 52 53 54 55"),
                            "encoding '" + encoding + "' is not supported"),
              FailureKind::Unreadable);
  }
  EXPECT_EQ(KindOfReading(this->WriteMetaImage(Meta + Placed + "BinaryData = False\n", "48 49 50 51 52 53 54 55\n"),
                          "its voxels are text"),
            FailureKind::Unreadable);

  std::string damaged = Gzipped("01234567");
  damaged[damaged.size() - 6] = static_cast<char>(damaged[damaged.size() - 6] ^ 1);
  EXPECT_EQ(KindOfReading(this->WriteNRRD(Bare + space + "encoding: gzip\n", damaged), "damaged"),
            FailureKind::Unreadable);
  const std::string twice = Gzipped(std::string(7, 'x'));
  EXPECT_EQ(KindOfReading(this->WriteNRRD(Bare + space + "encoding: gzip\n", twice), "cut off"),
            FailureKind::Unreadable);
}

TEST_F(TextVolume, CompressedMetaImageIsReadToItsEndWhateverItsHeaderSays)
{
  std::string bytes;
  for (int i = 0; i < 4096; ++i)
  {
    bytes.push_back(static_cast<char>(i * i * 31 % 251));
  }
  const std::string packed = Gzipped(bytes); // MetaIO takes zlib and gzip streams
  const std::string fields = "ObjectType = Image\nNDims = 4\nDimSize = 16 8 8 4\nElementType = MET_UCHAR\n"
                             "CompressedData = True\nCompressedDataSize = " +
                             std::to_string(packed.size() - 100) + "\n";
  const auto path = this->WriteMetaImage(fields, packed);
  EXPECT_EQ(KindOfReading(path, "4 volumes"), FailureKind::Unreadable);
  EXPECT_EQ(TextOf(ReadScan(path, Frame(0))), bytes.substr(0, 1024));
  const auto scan = ReadScan(path, Frame(3));
  EXPECT_EQ(TextOf(scan), bytes.substr(3072));
  EXPECT_EQ(scan.encoding, "zlib");
  const auto cut = this->WriteMetaImage(fields, packed.substr(0, packed.size() - 1), "cut.mha");
  EXPECT_EQ(KindOfReading(cut, "cut.mha", Frame(0)), FailureKind::Unreadable);
}

TEST_F(TextVolume, CompressedMetaImageOfEitherByteOrder)
{
  NIfTITestFile values;
  for (const bool isBigEndian : { false, true })
  {
    values.isBigEndian = isBigEndian;
    const std::string order = isBigEndian ? "True" : "False";
    const std::string fields = "NDims = 3\nDimSize = 2 1 1\nElementType = MET_SHORT\nCompressedData = True\n"
                               "BinaryDataByteOrderMSB = " +
                               order + "\n";
    const std::string packed = Gzipped(values.Values(std::vector<std::int16_t>{ -3000, 7 }));
    const auto scan = ReadScan(this->WriteMetaImage(fields, packed));
    EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 0 } }), -3000);
    EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 1, 0, 0 } }), 7);
    const auto contradiction =
      this->WriteMetaImage(fields + "ElementByteOrderMSB = " + (isBigEndian ? "False" : "True") + "\n", packed);
    EXPECT_EQ(KindOfReading(contradiction, "byte order"), FailureKind::Unreadable);
  }
}

TEST_F(TextVolume, MetaImageScalingAndOrientation)
{
  const auto scan = ReadScan(this->WriteMetaImage(
    Meta + Placed + "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -10\n"));
  EXPECT_EQ(ImageOf<float>(scan).GetPixel({ { 1, 1, 1 } }), 2 * 55 - 10);
  EXPECT_EQ(scan.scaling, "slope 2, intercept -10");
  EXPECT_TRUE(scan.isOriented);
  const auto bare = ReadScan(this->WriteMetaImage(Meta + "ElementSpacing = 2 3 4\n"));
  EXPECT_FALSE(bare.isOriented);
  EXPECT_EQ(GeometryOf(bare.image).GetSpacing()[1], 3);
  EXPECT_EQ(bare.notes.size(), 1u);
}

TEST_F(TextVolume, LayersAndFramesOfNRRD)
{
  const std::string segments = "type: uint8\ndimension: 4\nsizes: 2 2 2 2\nkinds: list domain domain domain\n"
                               "space: LPS\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (5,6,7)\n"
                               "encoding: raw\nSegment0_Name:=Liver\n";
  const auto layers = this->WriteNRRD(segments, "aAbBcCdDeEfFgGhH", "a.seg.nrrd");
  const auto both = ReadScan(layers);
  ASSERT_EQ(both.furtherLayers.size(), 1u);
  const auto & lower = *std::get<itk::Image<std::uint16_t, 3>::Pointer>(both.image);
  const auto & upper = *std::get<itk::Image<std::uint16_t, 3>::Pointer>(both.furtherLayers[0]);
  EXPECT_EQ(std::string(lower.GetBufferPointer(), lower.GetBufferPointer() + 8), "abcdefgh");
  EXPECT_EQ(std::string(upper.GetBufferPointer(), upper.GetBufferPointer() + 8), "ABCDEFGH");
  EXPECT_EQ(KindOfReading(layers, "ScanReadOptions::frame", Frame(2)), FailureKind::Usage);
  EXPECT_EQ(TextOf(ReadScan(layers, Frame(0))), "abcdefgh");
  const auto second = ReadScan(layers, Frame(1));
  EXPECT_EQ(TextOf(second), "ABCDEFGH");
  EXPECT_EQ(GeometryOf(second.image).GetSpacing()[1], 3);
  EXPECT_EQ(GeometryOf(second.image).GetOrigin()[2], 7);
  EXPECT_TRUE(second.isOriented);

  const auto series = [this](const std::string & kind) {
    const std::string fields = "type: uint8\ndimension: 4\nsizes: 2 2 2 2\nkinds: domain domain domain " + kind +
                               "\nspace: LPS\nspace directions: (2,0,0) (0,3,0) (0,0,4) none\nspace origin: (5,6,7)\n"
                               "encoding: raw\n";
    return this->WriteNRRD(fields, "abcdefghABCDEFGH");
  };
  EXPECT_EQ(KindOfReading(series("list"), "2 volumes"), FailureKind::Unreadable);
  rhombic::ScanReadOptions first;
  first.onSeveralFrames = rhombic::ScanReadOptions::Policy::Accept;
  EXPECT_EQ(TextOf(ReadScan(series("list"), first)), "abcdefgh");
  EXPECT_EQ(ReadScan(series("list"), first).numberOfFrames, 2u);
  EXPECT_EQ(TextOf(ReadScan(series("list"), Frame(1))), "ABCDEFGH");
  EXPECT_EQ(TextOf(ReadScan(series("list"), Frame(0))), "abcdefgh");
  EXPECT_EQ(KindOfReading(series("time"), "kind time", Frame(0)), FailureKind::Unreadable);
  EXPECT_EQ(KindOfReading(series("vector"), "kind vector", Frame(0)), FailureKind::Unreadable);
  const auto plain = this->WriteNRRD("type: uint8\ndimension: 4\nsizes: 2 2 2 2\nencoding: raw\n", "abcdefghABCDEFGH");
  EXPECT_EQ(TextOf(ReadScan(plain, Frame(1))), "ABCDEFGH");
}

TEST_F(TextVolume, SegmentsOfSeveralLayersAreOneSegmentation)
{
  const std::string fields = "type: uint8\ndimension: 4\nsizes: 2 2 2 2\nkinds: list domain domain domain\n"
                             "space: LPS\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (5,6,7)\n"
                             "encoding: raw\nSegment0_Name:=kidney\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
                             "Segment1_Name:=tumour\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n"
                             "Segment2_Name:=liver\nSegment2_LabelValue:=2\nSegment2_Layer:=1\n";
  // Pairs of the two layers by voxel: the tumour is inside the kidney, the liver beside both.
  const std::string pairs{ 1, 0, 1, 1, 1, 0, 1, 0, 0, 0, 0, 2, 0, 2, 0, 0 };
  const auto scan = ReadScan(this->WriteNRRD(fields, pairs, "a.seg.nrrd"));
  const auto labels = rhombic::SummarizeLabels(scan, scan.labels);
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels[0].label.name, "kidney");
  EXPECT_EQ(labels[0].numberOfVoxels, 4u);
  EXPECT_EQ(labels[1].label.name, "tumour");
  EXPECT_EQ(labels[1].label.value, 2);
  EXPECT_EQ(labels[1].numberOfVoxels, 1u);
  EXPECT_EQ(labels[2].label.name, "liver");
  EXPECT_EQ(labels[2].label.value, 3);
  EXPECT_EQ(labels[2].numberOfVoxels, 2u);
  ASSERT_EQ(scan.furtherLayers.size(), 1u);
  const auto & first = *std::get<itk::Image<std::uint16_t, 3>::Pointer>(scan.image);
  EXPECT_EQ(first.GetBufferPointer()[5], 3) << "the liver shares the layer of the kidney, which it does not overlap";
}

TEST_F(TextVolume, VolumesOnTheLatticeAreNoScans)
{
  EXPECT_EQ(KindOfReading(this->WriteNRRD(Raw + "lattice:=fcc parity rows\n"), "give the scan it was made from"),
            FailureKind::Unreadable);
  EXPECT_NO_THROW(ReadScan(this->WriteNRRD(Raw + "lattice:=cubic\n")));
}

TEST_F(TextVolume, KeyValuesOfNRRD)
{
  const auto path = this->WriteNRRD(Raw + "# a comment\nSegment0_Name:=Liver: left\nnote:=two\\nlines \\\\ slash\n");
  const std::map<std::string, std::string> expected{ { "Segment0_Name", "Liver: left" },
                                                     { "note", "two\nlines \\ slash" } };
  EXPECT_EQ(rhombic::ReadNRRDHeader(path).keyValues, expected);
  EXPECT_THROW(rhombic::ReadNRRDHeader(WriteBytes(m_Folder / "b.nrrd", "NRRD0005\n" + std::string(1 << 25, 'x'))),
               rhombic::Failure);
}

TEST_F(TextVolume, NRRDOfEitherByteOrder)
{
  NIfTITestFile values;
  for (const bool isBigEndian : { false, true })
  {
    values.isBigEndian = isBigEndian;
    const std::string bytes = values.Values(std::vector<std::int16_t>{ -3000, 7 });
    for (const bool isPacked : { false, true })
    {
      const std::string fields =
        "type: int16\ndimension: 3\nsizes: 2 1 1\nendian: " + std::string(isBigEndian ? "big" : "little") +
        "\nencoding: " + (isPacked ? "gzip" : "raw") + "\n";
      const auto scan = ReadScan(this->WriteNRRD(fields, isPacked ? Gzipped(bytes) : bytes));
      EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 0 } }), -3000);
      EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 1, 0, 0 } }), 7);
    }
  }
}

TEST_F(TextVolume, MemoryIsLimited)
{
  ScanReadOptions options;
  options.maximumMemory = 7;
  const std::string placed = "space: LPS\n" + Directions;
  EXPECT_EQ(KindOfReading(this->WriteNRRD(Bare + placed + "encoding: gzip\n", Gzipped("01234567")), "raw", options),
            FailureKind::Memory);
  const auto scan = ReadScan(this->WriteNRRD(Raw + placed), options);
  EXPECT_TRUE(rhombic::IsMapped(scan.image)) << "raw voxels stay in their file";
  EXPECT_EQ(TextOf(scan), TextOf(ReadScan(this->WriteNRRD(Raw + placed))));
}

/** A program ends with a sentence when a file that is mapped loses its bytes. */
TEST_F(TextVolume, MappedFilesThatBecomeShorterAreUnreadable)
{
  ScanReadOptions options;
  options.maximumMemory = 7;
  const fs::path path = this->WriteNRRD(Raw + "space: LPS\n" + Directions);
  const auto use = [&] {
    rhombic::RemoveTemporaryFilesOnSignals();
    const auto scan = ReadScan(path, options);
    fs::resize_file(path, 0);
    std::exit(TextOf(scan).empty() ? 1 : 0);
  };
  EXPECT_EXIT(use(), testing::ExitedWithCode(4), "rhombic: An input file became shorter.*try again");
}

/** Any header gives a description or a Failure. */
TEST_F(TextVolume, AnyHeaderIsParsedOrRefused)
{
  std::mt19937 random(1);
  const std::string letters = "0123456789.-+eE() ,:=\n#naifxz%/";
  const std::string nrrd = "NRRD0005\n" + Raw + "kinds: domain domain domain\nspace: LPS\n" + Directions + "\n01234567";
  const std::string meta = Meta + Placed + "ElementDataFile = LOCAL\n01234567";
  int parsed = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const bool isNRRD = i % 2 == 0;
    std::string bytes = isNRRD ? nrrd : meta;
    for (unsigned int change = 0; change <= random() % 4; ++change)
    {
      bytes[random() % bytes.size()] = letters[random() % letters.size()];
    }
    const auto path = WriteBytes(m_Folder / (isNRRD ? "a.nrrd" : "a.mha"), bytes);
    try
    {
      isNRRD ? rhombic::ReadNRRDVolume(path) : rhombic::ReadMetaImageVolume(path);
      ++parsed;
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_NE(failure.GetKind(), FailureKind::Internal) << failure.GetDescription();
    }
  }
  EXPECT_GT(parsed, 100);
  EXPECT_LT(parsed, 900);
}

} // namespace
