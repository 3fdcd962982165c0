// `rhombicFuzzSeeds FOLDER` writes the inputs that fuzzing begins with to FOLDER/<target>/.

#include "../scans/ScanIO/rhombicDicomTestFile.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTemporaryFolder.h"

#include <cstdlib>
#include <cstring>
#include <iterator>

namespace fs = std::filesystem;

namespace
{

void
WriteSeed(const fs::path & path, const std::string & bytes)
{
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file)
  {
    std::fprintf(stderr, "Cannot write %s\n", path.c_str());
    std::exit(1);
  }
}

fs::path
MakeFolder(const fs::path & path)
{
  fs::create_directories(path);
  return path;
}

template <typename TNumber>
std::string
BytesOf(TNumber number)
{
  std::string bytes(sizeof(number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(number));
  return bytes;
}

/** An element of explicit little endian with a long (SQ) or short length. */
std::string
Element(std::uint32_t tag, const std::string & type, const std::string & value)
{
  const auto size = static_cast<std::uint32_t>(value.size());
  return BytesOf<std::uint32_t>(tag << 16 | tag >> 16) + type +
         (type == "SQ" ? std::string(2, '\0') + BytesOf(size) : BytesOf(static_cast<std::uint16_t>(size))) + value;
}

std::string
Item(const std::string & value)
{
  return BytesOf<std::uint32_t>(0xe000fffe) + BytesOf(static_cast<std::uint32_t>(value.size())) + value;
}

/** The functional groups of a frame of an enhanced image. */
std::string
FrameItem(const std::string & position)
{
  return Item(Element(0x00209111, "SQ", Item(Element(0x00209056, "SH", "1 "))) +
              Element(0x00209113, "SQ", Item(Element(0x00200032, "DS", position))) +
              Element(0x00209116, "SQ", Item(Element(0x00200037, "DS", "1\\0\\0\\0\\1\\0 "))) +
              Element(0x00289110, "SQ", Item(Element(0x00280030, "DS", "1\\1 "))) +
              Element(0x00289145, "SQ", Item(Element(0x00281052, "DS", "0 ") + Element(0x00281053, "DS", "1 "))));
}

void
WriteDicomHeaders(const fs::path & folder)
{
  const DicomTestFile slice(2, 2);
  slice.Write(folder / "slice");
  slice.Write(folder / "big-endian", "1.2.840.10008.1.2.2");
  slice.Write(folder / "deflated", "1.2.840.10008.1.2.1.99");

  DicomTestFile nested(2, 2);
  nested.SetNestedSequences(0x00081140, 6);
  nested.Write(folder / "nested");

  DicomTestFile compressed(2, 2);
  compressed.SetFragments({ "first", "second", "" });
  compressed.Write(folder / "compressed", "1.2.840.10008.1.2.5");

  DicomTestFile enhanced(1, 1);
  enhanced.SetText(0x00280008, "IS", "2");
  enhanced.SetText(0x52009229, "SQ", FrameItem("0\\0\\0 "));
  enhanced.SetText(0x52009230, "SQ", FrameItem("0\\0\\0 ") + FrameItem("0\\0\\1 "));
  enhanced.SetPixels(std::vector<std::int16_t>{ 1, 2 });
  enhanced.Write(folder / "enhanced");

  DicomTestFile segmentation = enhanced;
  segmentation.SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4");
  segmentation.SetText(0x00620001, "CS", "BINARY");
  segmentation.SetText(0x00620002, "SQ", Item(Element(0x00620004, "US", BytesOf<std::uint16_t>(1))));
  segmentation.SetShort(0x00280100, 1);
  segmentation.Write(folder / "segmentation");

  // Without preamble, implicit little endian.
  const auto implicit = [](std::uint32_t tag, const std::string & value) {
    return BytesOf<std::uint32_t>(tag << 16 | tag >> 16) + BytesOf(static_cast<std::uint32_t>(value.size())) + value;
  };
  WriteSeed(folder / "implicit",
            implicit(0x00080060, "CT") + implicit(0x00280010, BytesOf<std::uint16_t>(1)) +
              implicit(0x00280011, BytesOf<std::uint16_t>(1)) + implicit(0x52009230, Item(implicit(0x00200032, "0 "))) +
              implicit(0x7fe00010, "ab"));
}

/** For rhombicDicomSeriesFuzz.cxx, where zeros are slices of an even stack and larger numbers change something. */
void
WriteDicomSeries(const fs::path & folder)
{
  constexpr std::size_t header = 2;
  constexpr std::size_t sliceSize = 19;
  constexpr std::size_t z = 10;
  const std::string even = BytesOf<std::uint16_t>(8) + std::string(9 * sliceSize, '\0');
  WriteSeed(folder / "even", even);

  std::string uneven = even;
  uneven[header + 2 * sliceSize + z] = '\xe8'; // 0.08 mm further
  WriteSeed(folder / "uneven", uneven);

  std::string tilted = even;
  for (std::size_t n = 0; n < 9; ++n)
  {
    tilted[header + n * sliceSize + z - 1] = static_cast<char>(0xe0 + n);
  }
  WriteSeed(folder / "tilted", tilted);

  std::string otherSeries = even;
  otherSeries[header + 5 * sliceSize + 2] = '\1';
  otherSeries[header + 6 * sliceSize + 2] = '\1';
  WriteSeed(folder / "two-series", otherSeries);
}

void
WriteCompressedFrames(const fs::path & folder)
{
  const auto format = [](char codec, char bits, char stored, std::uint16_t columns, std::uint16_t rows) {
    return std::string{ codec, bits, stored } + BytesOf(columns) + BytesOf(rows);
  };
  const std::string jpeg("\xff\xd8\xff\xdb\0\3x\xff\xc3\0\x0b\x08\0\2\0\3\1\1\x11\0\xff\xda\0\2x\xff\xd9", 27);
  WriteSeed(folder / "jpeg", format(1, 1, 8, 3, 2) + jpeg);
  std::string jpegLS = jpeg;
  jpegLS[8] = '\xf7';
  WriteSeed(folder / "jpeg-ls", format(2, 1, 8, 3, 2) + jpegLS);
  const std::string size("\0\0\0\3\0\0\0\2", 8);
  WriteSeed(folder / "jpeg-2000",
            format(3, 2, 16, 3, 2) + std::string("\xff\x4f\xff\x51\0\x29\0\0", 8) + size + std::string(8, '\0') + size +
              std::string(8, '\0') + std::string("\0\1\x0f\1\1\xff\xd9", 7));
  std::string table = BytesOf<std::uint32_t>(2) + BytesOf<std::uint32_t>(64) + BytesOf<std::uint32_t>(66);
  table.resize(64);
  WriteSeed(folder / "run-lengths", format(4, 2, 16, 3, 2) + table + "\xfbx\5abcdef");
}

void
WriteLabelTables(const fs::path & folder)
{
  WriteSeed(folder / "itk-snap",
            "0# ITK-SnAP Label Description File\n1 255 0 0 1 1 1 \"liver\"\n2 0 9 0 .5 1 0 \"\"\n");
  WriteSeed(folder / "slicer", "1# Color table file\n0 background 0 0 0 0\n1 left kidney 185 102 83 255\n");
  WriteSeed(folder / "slicer-csv",
            "0LabelValue,Name,Color_R,Color_G,Color_B,Color_A\n1,\"a \"\"b\"\", c\",1,2,3,255\n2,spleen\n");
  WriteSeed(folder / "freesurfer", "0#No. Label Name: R G B A\n2 Left-Cerebral-White-Matter 245 245 245 0\n");
  WriteSeed(folder / "bids", "0index\tname\tcolor\n1\tGrey Matter\t#ff53bb\n2\t\xc3\xa4\tn/a\n");
  WriteSeed(
    folder / "caret",
    "2<?xml version=\"1.0\"?><CaretExtension><VolumeInformation><LabelTable><Label Key=\"1\" Red=\"1\" Green=\"0\" "
    "Blue=\".5\" Alpha=\"1\"><![CDATA[liver]]></Label></LabelTable></VolumeInformation></CaretExtension>");
  WriteSeed(folder / "segments",
            "3Segment0_Name=liver\nSegment0_LabelValue=1\nSegment0_Layer=0\nSegment0_Color=0.5 0 1\nSegment1_ID=a\n");
}

void
WritePresets(const fs::path & folder)
{
  WriteSeed(folder / "flow",
            "name: x\ndescription: d\nsurfaces:\n"
            "  - {name: a, isovalue: -500.5, side: below, parts: enclosed, colour: \"#0000ff\", opacity: 0.25}\n"
            "  - {name: b, isovalue: otsu}\n");
  WriteSeed(folder / "block", "name: x\nsurfaces:\n- name: &n a\n  isovalue: 1e3\n- name: *n\n  isovalue: .5\n");
}

void
WritePipelineFiles(const fs::path & folder)
{
  WriteSeed(folder / "pipeline",
            "description: d\noptions: {preset: ct-bone}\noutputs:\n- page: page.png\n  view: left\n- mesh: a.stl\n"
            "  labels: false\n  report: a.json\n- picture: \"a b.png\"\n  view: [left, right]\n- agreement: a.tsv\n");
}

void
WriteManifests(const fs::path & folder)
{
  WriteSeed(folder / "manifest",
            "case\tscan\tlabels\treference\toptions\none\ta.nii\tb.nii\t\t--series=1b\ntwo\tb.nii\t\ta.nii\t\n");
}

void
WriteJournals(const fs::path & folder)
{
  WriteSeed(folder / "journal",
            R"({"case":"one","folder":"one","status":"done","code":0,"seconds":1.5,"peakMemory":1048576,)"
            R"("input":{"md5":"a","stamp":"b"},"steps":[{"output":"p.png","seconds":1.0}],)"
            R"("outputs":[{"name":"p.png","bytes":5,"kind":"page","output":"p.png","md5":"c","surfaces":["d"]}],)"
            R"("measures":[{"surface":"bone","surface_id":"d","volume_ml":1.25}],)"
            R"("agreement":[{"output":"a.tsv","label":"liver","status":"compared",)"
            R"("volume_difference_ml":1,"volume_difference_percent":2,"dice":0.9,"iou":0.8,"hd_mm":4,"hd95_mm":2.5,)"
            R"("masd_mm":0.5,"assd_mm":0.5,"nsd":null,"centroid_shift_mm":1}]})"
            "\n"
            R"({"case":"two","folder":"two","status":"failed","code":4,"cause":"c","failedOutputs":["p.png"]})"
            "\n{\"case\":\"cut");
}

void
WriteAffineFiles(const fs::path & folder)
{
  WriteSeed(
    folder / "affine",
    "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters: 1 0 0 0 1 0 "
    "0 0.5 1 2 -3 4\nFixedParameters: 0 0 0\n");
  WriteSeed(folder / "euler",
            "Transform: Euler3DTransform_float_3_3\nParameters: 0.1 0 0 1 2 3\nFixedParameters: 5 6 7 0\n");
}

void
WriteOMEZarr(const fs::path & folder)
{
  const std::string attributes =
    R"({"multiscales":[{"version":"0.4","axes":[{"name":"z","type":"space","unit":"millimeter"},)"
    R"({"name":"y","type":"space","unit":"millimeter"},{"name":"x","type":"space","unit":"millimeter"}],)"
    R"("datasets":[{"path":"0","coordinateTransformations":[{"type":"scale","scale":[3,2,1]},)"
    R"({"type":"translation","translation":[1,2,3]}]}]}]})";
  const std::string array =
    R"({"zarr_format":2,"shape":[2,2,2],"chunks":[2,2,2],"dtype":"|u1","compressor":null,"fill_value":0,)"
    R"("order":"C","filters":null,"dimension_separator":"/"})";
  WriteSeed(folder / "image", attributes + '\0' + array + '\0' + "12345678");
}

void
WriteNIfTI(const fs::path & folder)
{
  std::string header(352, '\0');
  const auto put = [&header](std::size_t offset, const std::string & bytes) {
    header.replace(offset, bytes.size(), bytes);
  };
  put(0, BytesOf<std::int32_t>(348));
  for (std::size_t n = 0; n < 8; ++n)
  {
    put(40 + 2 * n, BytesOf<std::int16_t>(n == 0 ? 3 : n < 4 ? 2 : 1));
    put(76 + 4 * n, BytesOf(1.F));
  }
  put(70, BytesOf<std::int16_t>(4));
  put(72, BytesOf<std::int16_t>(16));
  put(108, BytesOf(352.F));
  put(123, "\2");
  put(254, BytesOf<std::int16_t>(1));
  for (std::size_t row = 0; row < 3; ++row)
  {
    put(280 + 20 * row, BytesOf(1.F));
  }
  put(344, std::string("n+1\0", 4));
  WriteSeed(folder / "volume.nii", header + std::string(16, '\1'));
}

/** One tetrahedron or two, as we write them and as others might. */
void
WriteSurfaceFiles(const fs::path & folder)
{
  const auto surface = itk::TriangleSurface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface->GetNormals() = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  const rhombictest::TemporaryFolder temporary;
  char kind = '\0';
  for (const std::string extension : { ".stl", ".ply", ".obj", ".glb", ".3mf" })
  {
    std::vector<rhombic::SceneSurface> scene(kind == 0 ? 1 : 2, { "a b", surface });
    scene.back().opacity = 0.5;
    const fs::path path = temporary.Path() / ("seed" + extension);
    rhombic::WriteSurfaces(scene, path);
    std::ifstream file(path, std::ios::binary);
    WriteSeed(folder / ("ours" + extension),
              std::string(1, kind++) + std::string(std::istreambuf_iterator<char>(file), {}));
  }
  const std::string corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-3 0\nendloop\nendfacet\n";
  WriteSeed(folder / "text.stl",
            std::string(1, 0) + "solid a\nfacet normal 0 0 1\nouter loop\n" + corners + "endsolid a\n");
  WriteSeed(
    folder / "text.ply",
    "\1ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty "
    "uchar red\nelement face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 "
    "1\n4 0 1 2 3\n");
  WriteSeed(
    folder / "big-endian.ply",
    "\1ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\nproperty ushort z\n"
    "element face 1\nproperty list uint uchar vertex_indices\nend_header\n" +
      std::string("\0\0\0\0\1\0\0\0\0\1\0\0\0\0\0\3\0\1\2", 19));
  WriteSeed(folder / "corners.obj",
            "\2v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\ng x\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -1//-1 -2//1 "
            "\\\n-3//1\n");
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc != 2)
  {
    std::fputs("Name the folder to write to\n", stderr);
    return 1;
  }
  const fs::path folder = argv[1];
  WriteDicomHeaders(MakeFolder(folder / "rhombicDicomHeaderFuzz"));
  WriteDicomSeries(MakeFolder(folder / "rhombicDicomSeriesFuzz"));
  WriteCompressedFrames(MakeFolder(folder / "rhombicCompressedFrameFuzz"));
  WriteLabelTables(MakeFolder(folder / "rhombicLabelTableFuzz"));
  WritePresets(MakeFolder(folder / "rhombicPresetFuzz"));
  WriteSurfaceFiles(MakeFolder(folder / "rhombicSurfaceFileFuzz"));
  WriteNIfTI(MakeFolder(folder / "rhombicNIfTIFuzz"));
  WritePipelineFiles(MakeFolder(folder / "rhombicPipelineFileFuzz"));
  WriteManifests(MakeFolder(folder / "rhombicManifestFuzz"));
  WriteJournals(MakeFolder(folder / "rhombicJournalFuzz"));
  WriteAffineFiles(MakeFolder(folder / "rhombicAffineFileFuzz"));
  WriteOMEZarr(MakeFolder(folder / "rhombicOMEZarrFuzz"));
}
