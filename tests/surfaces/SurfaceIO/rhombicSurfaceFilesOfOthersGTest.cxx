// Files of other programs: of VTK's writers, and made by hand.

#include "rhombicSurfaceTest.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstring>

namespace
{


class SurfaceFilesOfOthers : public SurfaceTest
{
protected:
  std::vector<SceneSurface>
  Read(const std::string & name, const std::string & bytes)
  {
    WriteBytes(m_Folder / name, bytes);
    return rhombic::ReadSurfaces(m_Folder / name);
  }

  rhombic::FailureKind
  Refused(const std::string & name, const std::string & bytes, const std::string & why)
  {
    return KindOf([&] { this->Read(name, bytes); }, why);
  }
};

/** Reads our STL file with VTK, writes it with one of VTK's writers, and reads that file. */
template <typename TWriter, typename TSetUp>
std::vector<SceneSurface>
ThroughVTK(const fs::path & folder, const std::string & extension, const TSetUp & setUp)
{
  rhombic::WriteSurfaces({ { "sphere", MakeSphere(3) } }, folder / "ours.stl");
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName((folder / "ours.stl").c_str());
  vtkNew<TWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  const fs::path path = folder / ("vtk" + extension);
  writer->SetFileName(path.c_str());
  setUp(*writer);
  writer->Write();
  return ReadSurfaces(path);
}

void
ExpectSphere(const std::vector<SceneSurface> & read, double tolerance)
{
  ASSERT_EQ(read.size(), 1u);
  const auto sphere = MakeSphere(3);
  EXPECT_EQ(read[0].surface->GetNumberOfPoints(), sphere->GetNumberOfPoints());
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*read[0].surface).IsWatertight());
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*read[0].surface),
              ComputeTriangleSurfaceVolume(*sphere),
              tolerance * ComputeTriangleSurfaceVolume(*sphere));
}

TEST_F(SurfaceFilesOfOthers, VTKsWriters)
{
  const auto nothing = [](auto &) {};
  ExpectSphere(ThroughVTK<vtkSTLWriter>(m_Folder, ".stl", [](auto & writer) { writer.SetFileTypeToBinary(); }), 1e-9);
  ExpectSphere(ThroughVTK<vtkSTLWriter>(m_Folder, ".stl", [](auto & writer) { writer.SetFileTypeToASCII(); }), 1e-4);
  for (const bool isBigEndian : { false, true })
  {
    ExpectSphere(ThroughVTK<vtkPLYWriter>(m_Folder,
                                          ".ply",
                                          [&](auto & writer) {
                                            isBigEndian ? writer.SetDataByteOrderToBigEndian()
                                                        : writer.SetDataByteOrderToLittleEndian();
                                          }),
                 1e-9);
  }
  ExpectSphere(ThroughVTK<vtkPLYWriter>(m_Folder, ".ply", [](auto & writer) { writer.SetFileTypeToASCII(); }), 1e-4);
  ExpectSphere(ThroughVTK<vtkOBJWriter>(m_Folder, ".obj", nothing), 1e-4);
}

TEST_F(SurfaceFilesOfOthers, VTKsXMLInAllItsEncodings)
{
  for (int choice = 0; choice < 3 * 2 * 2 * 2 * 2; ++choice)
  {
    SCOPED_TRACE(choice);
    ExpectSphere(ThroughVTK<vtkXMLPolyDataWriter>(m_Folder,
                                                  ".vtp",
                                                  [choice](vtkXMLPolyDataWriter & writer) {
                                                    writer.SetDataMode(choice % 3); // ascii, binary, appended
                                                    writer.SetEncodeAppendedData(choice / 3 % 2);
                                                    writer.SetByteOrder(choice / 6 % 2);
                                                    if (choice / 12 % 2 == 0)
                                                    {
                                                      writer.SetCompressorTypeToNone();
                                                    }
                                                    writer.SetBlockSize(1000); // several a array
                                                    choice / 24 == 0 ? writer.SetHeaderTypeToUInt32()
                                                                     : writer.SetHeaderTypeToUInt64();
                                                  }),
                 1e-7);
  }
  for (const int compressor : { vtkXMLWriterBase::LZ4, vtkXMLWriterBase::LZMA })
  {
    const auto setCompressor = [compressor](auto & writer) { writer.SetCompressorType(compressor); };
    ExpectSphere(ThroughVTK<vtkXMLPolyDataWriter>(m_Folder, ".vtp", setCompressor), 1e-7);
  }
}

TEST_F(SurfaceFilesOfOthers, TextSTLWithTwoSolids)
{
  const auto facet = [](const std::string & corners) {
    return "  facet normal 0 0 1\r\n    OUTER loop\r\n" + corners + "    endloop\r\n  endfacet\r\n";
  };
  const std::string square = facet("vertex 0 0 0\r\n vertex 1 0 0\r\n vertex 1 +1.0e0 0\r\n") +
                             facet("vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 -0\n");
  const auto read =
    this->Read("two.stl", "\n solid left part\n" + square + "endsolid left part\n\nsolid\n" + square + "endsolid\n");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].name, "left part");
  EXPECT_EQ(read[1].name, "two");
  EXPECT_EQ(read[0].surface->GetNumberOfPoints(), 4u);
  EXPECT_EQ(read[0].surface->GetNumberOfTriangles(), 2u);
  EXPECT_DOUBLE_EQ(ComputeTriangleSurfaceArea(*read[1].surface), 1.0);

  const auto turned = this->Read("ras.stl", "solid ascii SPACE=RAS\n" + square + "endsolid\n");
  EXPECT_EQ(turned[0].surface->GetBounds(), (std::array<double, 6>{ -1, 0, -1, 0, 0, 0 }));
  for (const std::string lines : { "facet normal 0 0 1\nouter vertex\n", "facet\nfacet vertex 0 0 1\n" })
  {
    EXPECT_EQ(this->Refused("vertex.stl", "solid\n" + lines, "line 3"), rhombic::FailureKind::Unreadable) << lines;
  }
  const auto marked = this->Read("marked.stl", "\xEF\xBB\xBFsolid marked\n" + square + "endsolid marked\n");
  EXPECT_EQ(marked[0].surface->GetNumberOfTriangles(), 2u) << "the mark that Windows programs put before UTF-8";
}

TEST_F(SurfaceFilesOfOthers, BinarySTLThatBeginsLikeText)
{
  rhombic::WriteSurfaces({ { "sphere", MakeSphere(2) } }, m_Folder / "sphere.stl");
  std::string bytes = ReadBytes(m_Folder / "sphere.stl");
  bytes.replace(0, 12, "solid sphere");
  ASSERT_EQ(this->Read("solid.stl", bytes).size(), 1u);
}

TEST_F(SurfaceFilesOfOthers, TextPLYWithPolygonsAndMore)
{
  const auto read =
    this->Read("mixed.ply",
               "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info none\r\n"
               "element vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "property list uchar int neighbours\n"
               "element material 1\nproperty int shine\n"
               "element face 2\nproperty uchar flags\nproperty list uint8 uint32 vertex_index\nend_header\n"
               "0 0 0 255 0 51 0\n1 0 0 255 0 51 2 7 8\n1 1 0 255 0 51 0\n\n0 1 0 255 0 51 0\n0 0 1 255 0 51 0\n"
               "9\n"
               "1 4 0 1 2 3\n0 3 0 1 4");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "mixed");
  EXPECT_EQ(read[0].colour, (rhombic::Colour{ 1, 0, 0.2 }));
  EXPECT_EQ(read[0].surface->GetNumberOfPoints(), 5u);
  EXPECT_EQ(read[0].surface->GetTriangles(), (Surface::TrianglesContainer{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 1, 4 } }));
  EXPECT_FALSE(read[0].surface->HasNormals());
}

TEST_F(SurfaceFilesOfOthers, OBJWithPolygonsGroupsAndAllKindsOfCorners)
{
  WriteBytes(m_Folder / "mine.mtl", "newmtl blue one\nKd 0 0 1\nTr 0.25\nnewmtl red\nKd 1 0 0\nd 0.5\n");
  const std::string text =
    "mtllib mine.mtl\n# a comment\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvn 0 0 1\nvt 0 0\n"
    "s off\nf 1/1 2/1 3/1 4/1\n"
    "o house\nusemtl red\nv 0 0 5\nvn 0 0 -1\nf 1//1 2//1 \\\n -1//1\n"
    "usemtl blue one\nf 1/1/1 2/1/1 5/1/2\n"
    "o house\nusemtl red\nf 2 3 5 # more of the same\n";
  const auto read = this->Read("parts.obj", text);
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0].name, "parts");
  EXPECT_EQ(read[0].surface->GetTriangles(), (Surface::TrianglesContainer{ { 0, 1, 2 }, { 0, 2, 3 } }));
  EXPECT_EQ(read[1].name, "house");
  EXPECT_EQ(read[1].colour, (rhombic::Colour{ 1, 0, 0 }));
  EXPECT_EQ(read[1].opacity, 0.5);
  EXPECT_EQ(read[1].surface->GetNumberOfTriangles(), 2u);
  EXPECT_EQ(read[1].surface->GetNumberOfPoints(), 4u);
  EXPECT_FALSE(read[1].surface->HasNormals()) << "one corner has none";
  EXPECT_EQ(read[2].colour, (rhombic::Colour{ 0, 0, 1 }));
  EXPECT_EQ(read[2].opacity, 0.75);
}

/** A glTF file of the given JSON and buffer. */
std::string
MakeGLB(std::string json, std::string buffer)
{
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  const auto number = [](std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char *>(&small), sizeof(small));
  };
  return "glTF" + number(2) + number(28 + json.size() + buffer.size()) + number(json.size()) + "JSON" + json +
         number(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

template <typename TNumber>
std::string
BytesOf(std::initializer_list<TNumber> numbers)
{
  return { reinterpret_cast<const char *>(numbers.begin()), numbers.size() * sizeof(TNumber) };
}

/** A right-angled triangle in metres: points interleaved with normals, then indices of two bytes. */
struct HandMadeGLB
{
  std::string nodes = R"([{"name":"corner","mesh":0}])";
  std::string more;   ///< of the primitive
  std::string beside; ///< of the file
  std::string indexType = "5123";
  std::string indexCount = "3";
  std::string positionCount = "4";
  std::string indices = BytesOf<std::uint16_t>({ 0, 1, 2, 3 });

  std::string
  Make() const
  {
    const std::string vertices = BytesOf<float>({ 0, 0, 0, 0, 1, 0, //
                                                  1, 0, 0, 0, 1, 0, 0, 0, -1, 0, 1, 0, 1, 0, -1, 0, 1, 0 });
    return MakeGLB(
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
        R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":0)" + more +
        R"(}]}],"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0.2158605,0.5]}}],)" +
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" + positionCount +
        R"(,"type":"VEC3"},{"bufferView":0,"byteOffset":12,"componentType":5126,"count":4,"type":"VEC3"},)" +
        R"({"bufferView":1,"componentType":)" + indexType + R"(,"count":)" + indexCount +
        R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":96,"byteStride":24},)" +
        R"({"buffer":0,"byteOffset":96,"byteLength":8}],"buffers":[{"byteLength":104}])" + beside + "}",
      vertices + indices);
  }
};

using Points = Surface::PointsContainer;
using Triangles = Surface::TrianglesContainer;

TEST_F(SurfaceFilesOfOthers, GLBInterleavedAndInMetres)
{
  const auto read = this->Read("hand.glb", HandMadeGLB().Make());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "corner");
  EXPECT_NEAR(read[0].colour[2], 0.5, 0.002) << "sRGB";
  EXPECT_EQ(read[0].opacity, 1.0) << "opaque without alphaMode BLEND";
  EXPECT_EQ(read[0].surface->GetPoints(), (Points{ { 0, 0, 0 }, { 1000, 0, 0 }, { 0, 1000, 0 }, { 1000, 1000, 0 } }));
  EXPECT_EQ(read[0].surface->GetTriangles(), (Triangles{ { 0, 1, 2 } }));
  EXPECT_EQ(read[0].surface->GetNormals()[0], (Surface::NormalType{ 0, 0, 1 })) << "up is to the head";
}

TEST_F(SurfaceFilesOfOthers, GLBNodesMoveTurnAndMirror)
{
  HandMadeGLB file;
  file.nodes = R"([{"children":[1],"translation":[1,2,3]},)"
               R"({"mesh":0,"scale":[2,2,2],"rotation":[0,0.7071067811865476,0,0.7071067811865476]}])";
  auto read = this->Read("turned.glb", file.Make());
  // A quarter turn about y takes x to -z, which is to the patient's back.
  const auto & point = read[0].surface->GetPoints()[1];
  EXPECT_NEAR(point[0], 1000, 1e-3);
  EXPECT_NEAR(point[1], -1000, 1e-3);
  EXPECT_NEAR(point[2], 2000, 1e-3);
  EXPECT_NEAR(read[0].surface->GetNormals()[1][2], 1, 1e-6);

  file.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
  read = this->Read("mirrored.glb", file.Make());
  EXPECT_EQ(read[0].surface->GetPoints()[1], (Surface::PointType{ -1000, 0, 0 }));
  EXPECT_EQ(read[0].surface->GetTriangles(), (Triangles{ { 0, 2, 1 } })) << "still seen from above";
  EXPECT_EQ(read[0].surface->GetNormals()[0], (Surface::NormalType{ 0, 0, 1 }));
}

TEST_F(SurfaceFilesOfOthers, GLBStripsFansAndNoIndices)
{
  HandMadeGLB file;
  file.indexCount = "4";
  file.more = R"(,"mode":5)";
  EXPECT_EQ(this->Read("strip.glb", file.Make())[0].surface->GetTriangles(), (Triangles{ { 0, 1, 2 }, { 2, 1, 3 } }));
  file.more = R"(,"mode":6)";
  EXPECT_EQ(this->Read("fan.glb", file.Make())[0].surface->GetTriangles(), (Triangles{ { 0, 1, 2 }, { 0, 2, 3 } }));
  std::string text = file.Make();
  text.replace(text.find("\"indices\":2"), 11, "\"targets\":0");
  EXPECT_EQ(this->Read("plain.glb", text)[0].surface->GetTriangles(), (Triangles{ { 0, 1, 2 }, { 0, 2, 3 } }));
  file.indexType = "5121";
  file.indices = BytesOf<std::uint8_t>({ 3, 1, 2, 0, 0, 0, 0, 0 });
  file.more.clear();
  file.indexCount = "3";
  EXPECT_EQ(this->Read("bytes.glb", file.Make())[0].surface->GetTriangles(), (Triangles{ { 3, 1, 2 } }));
}

TEST_F(SurfaceFilesOfOthers, GLBThatIsDamagedOrNotSupported)
{
  using Kind = rhombic::FailureKind;
  const auto expectRefused = [this](const std::string & why, const auto & change) {
    HandMadeGLB file;
    change(file);
    EXPECT_EQ(this->Refused("bad.glb", file.Make(), why), Kind::Unreadable) << why;
  };
  expectRefused("corner at point 4", [](auto & file) { file.indices = BytesOf<std::uint16_t>({ 0, 1, 4, 0 }); });
  expectRefused("beyond its buffer", [](auto & file) { file.positionCount = "5"; });
  expectRefused("beyond its buffer", [](auto & file) { file.positionCount = "4294967295"; });
  expectRefused("whole number", [](auto & file) { file.positionCount = "-4"; });
  expectRefused("no whole numbers", [](auto & file) {
    file.indexType = "5126";
    file.indexCount = "2";
  });
  expectRefused("does not exist", [](auto & file) {
    file.indexType = "0";
    file.indexCount = "2";
  });
  expectRefused("itself", [](auto & file) { file.nodes = R"([{"mesh":0,"children":[0]}])"; });
  expectRefused("JSON", [](auto & file) { file.nodes = R"([{"mesh":7}])"; });
  expectRefused("JSON", [](auto & file) { file.nodes = R"([{"mesh":0,)"; });
  expectRefused("KHR_draco",
                [](auto & file) { file.beside = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"; });
  expectRefused("no triangles", [](auto & file) { file.more = R"(,"mode":1)"; });
}

TEST_F(SurfaceFilesOfOthers, DamagedFilesGetASentence)
{
  using Kind = rhombic::FailureKind;
  std::mt19937 random(3);
  std::string garbage(5000, '\0');
  std::generate(garbage.begin(), garbage.end(), [&random] { return static_cast<char>(random()); });
  for (const std::string extension : Extensions)
  {
    const std::string name = "file" + extension;
    EXPECT_EQ(KindOf([&] { ReadSurfaces(m_Folder / ("missing" + extension)); }, "missing"), Kind::NotFound);
    fs::create_directory(m_Folder / ("folder" + extension));
    EXPECT_EQ(KindOf([&] { ReadSurfaces(m_Folder / ("folder" + extension)); }, "folder"), Kind::Unreadable);
    EXPECT_EQ(this->Refused(name, "", name), Kind::Unreadable);
    EXPECT_EQ(this->Refused(name, "Dear colleague,\nplease find attached\n", name), Kind::Unreadable);
    EXPECT_EQ(this->Refused(name, garbage, name), Kind::Unreadable);
    EXPECT_EQ(this->Refused(name, std::string(100000, '\0'), name), Kind::Unreadable);

    rhombic::WriteSurfaces({ { "sphere", MakeSphere(2) } }, m_Folder / ("whole" + extension));
    const std::string whole = ReadBytes(m_Folder / ("whole" + extension));
    // The first lines of an OBJ file may be a valid smaller surface.
    const std::size_t longest = extension == ".obj" ? whole.find("\nf ") : whole.size() - 1;
    for (int n = 0; n < 60; ++n)
    {
      EXPECT_EQ(this->Refused(name, whole.substr(0, random() % longest), name), Kind::Unreadable);
    }
  }
  EXPECT_EQ(KindOf([&] { ReadSurfaces(m_Folder / "file.xyz"); }, ".glb"), Kind::Usage);
}

TEST_F(SurfaceFilesOfOthers, TextPLYWithMoreNumbersThanPropertiesIsRefused)
{
  using Kind = rhombic::FailureKind;
  const std::string head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  EXPECT_EQ(this->Refused("a.ply", head + "0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "more numbers"), Kind::Unreadable);
  EXPECT_EQ(this->Refused("b.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 2\n", "more numbers"), Kind::Unreadable);
}

TEST_F(SurfaceFilesOfOthers, IndicesOutOfRangeAreRefused)
{
  using Kind = rhombic::FailureKind;
  const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(this->Refused("a.ply", ply + "3 0 1 3\n", "point 3"), Kind::Unreadable);
  EXPECT_EQ(this->Refused("a.ply", ply + "3 0 1 -1\n", "line 13"), Kind::Unreadable);
  EXPECT_EQ(this->Refused("a.ply", ply + "2 0 1\n", "three corners"), Kind::Unreadable);
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const std::string face : { "f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1//1 2//1 3//1", "f 1 2", "f a b c" })
  {
    EXPECT_EQ(this->Refused("a.obj", obj + face + "\n", "line 4"), Kind::Unreadable) << face;
  }
  EXPECT_EQ(this->Read("a.obj", obj + "f 1 2 3\n").size(), 1u);
}

TEST_F(SurfaceFilesOfOthers, PromisesOfSizeAreCheckedBeforeMemoryIsAsked)
{
  using Kind = rhombic::FailureKind;
  EXPECT_EQ(this->Refused(
              "a.ply",
              "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n",
              "more elements"),
            Kind::Unreadable);
  std::string stl(84, '\0');
  std::memset(stl.data() + 80, 0x7f, 4);
  EXPECT_EQ(this->Refused("a.stl", stl, "84 bytes"), Kind::Unreadable);
  EXPECT_EQ(
    this->Refused("a.vtp",
                  "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"4000000000\" "
                  "NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" Name=\"Points\" format=\"ascii\">0 0 0"
                  "</DataArray></Points></Piece></PolyData></VTKFile>",
                  "a.vtp"),
    Kind::Unreadable);
}

/** VTK's reader takes the digits at the beginning of a number, and -inf for a large number. */
TEST_F(SurfaceFilesOfOthers, CountsOfVTPAreWholeNumbers)
{
  const auto fileWith = [](const std::string & points, const std::string & polygons, const std::string & components) {
    return "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints = '" + points +
           "' NumberOfPolys=\"" + polygons + "\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"" +
           components +
           "\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Polys>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 1 2 3 2 0 3</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray></Polys></Piece>"
           "</PolyData></VTKFile>";
  };
  EXPECT_EQ(this->Read("a.vtp", fileWith("4", "4", "3")).front().surface->GetNumberOfTriangles(), 4u);
  for (const std::string wrong : { "4.5", "1e-300", "1.0", "-inf", "", "-4", "4 4", "x" })
  {
    EXPECT_EQ(this->Refused("a.vtp", fileWith(wrong, "4", "3"), "NumberOfPoints"), rhombic::FailureKind::Unreadable);
    EXPECT_EQ(this->Refused("a.vtp", fileWith("4", wrong, "3"), "NumberOfPolys"), rhombic::FailureKind::Unreadable);
    EXPECT_EQ(this->Refused("a.vtp", fileWith("4", "4", wrong), "NumberOfComponents"),
              rhombic::FailureKind::Unreadable);
  }
}

/** VTK's reader takes the digits at the beginning of a word, and leaves out what follows. */
TEST_F(SurfaceFilesOfOthers, WordsOfVTPInTextAreNumbersOfTheirType)
{
  const auto fileWith = [](const std::string & coordinate, const std::string & corner, const std::string & offset) {
    return "<!-- don't <DataArray type=\"Int32\"> --><VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><FieldData>"
           "<Array type=\"String\" Name=\"n\" NumberOfTuples=\"1\" format=\"ascii\">-61 200 0</Array>"
           "<DataArray type=\"Float64\" Name=\"a\" NumberOfTuples=\"3\">nan 1e-300 -5</DataArray>"
           "<DataArray type=\"UInt64\" Name=\"c\" NumberOfTuples=\"2\">18446744073709551615 0</DataArray></FieldData>"
           "<Piece NumberOfPoints='4' NumberOfPolys='4'><Points><DataArray type='Float32' NumberOfComponents='3'>"
           "0 0 0 1 0 0 0 +1 0\t0 0\n" +
           coordinate +
           "<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\"><Value index=\"0\">0</Value>"
           "<Value index=\"1\">1.5</Value></InformationKey></DataArray></Points><Polys>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 1 2 3 2 0 " +
           corner + "</DataArray><DataArray format = \"ascii\" type = 'UInt8' Name=\"offsets\">3 6 9 " + offset +
           "</DataArray></Polys></Piece></PolyData></VTKFile>";
  };
  for (const std::string right : { "1", "+1.5", "1e3", ".5", "1.", "-1e-60", "1 " })
  {
    EXPECT_EQ(this->Read("a.vtp", fileWith(right, "3", "12")).front().surface->GetNumberOfTriangles(), 4u) << right;
  }
  for (const std::string wrong : { "0x10", "1e40", "1.5.7", "1,5", "1e5d", "1 junk", "+-1", "1e", "&#49;", "-inf" })
  {
    EXPECT_EQ(this->Refused("a.vtp", fileWith(wrong, "3", "12"), "Float32"), rhombic::FailureKind::Unreadable);
  }
  for (const std::string wrong : { "3.5", "3.0", "0x3", "3e0", "4294967299", "3 junk", "99999999999999999999" })
  {
    EXPECT_EQ(this->Refused("a.vtp", fileWith("1", wrong, "12"), "Int32"), rhombic::FailureKind::Unreadable);
  }
  for (const std::string wrong : { "12.5", "-12", "268", "12;" })
  {
    EXPECT_EQ(this->Refused("a.vtp", fileWith("1", "3", wrong), "UInt8"), rhombic::FailureKind::Unreadable);
  }
}

/** VTK's reader runs in a child process: whatever the damage, there is a surface or a sentence. */
TEST_F(SurfaceFilesOfOthers, AnyDamageOfVTPEndsInASurfaceOrASentence)
{
  std::mt19937 random(8);
  int refused = 0;
  for (const int mode : { vtkXMLWriter::Ascii, vtkXMLWriter::Appended })
  {
    ThroughVTK<vtkXMLPolyDataWriter>(m_Folder, ".vtp", [mode](auto & writer) { writer.SetDataMode(mode); });
    const std::string whole = ReadBytes(m_Folder / "vtk.vtp");
    for (int n = 0; n < 100; ++n)
    {
      std::string bytes = whole;
      const std::size_t place = random() % (bytes.size() - 8);
      n % 2 == 0 ? bytes.replace(place, 1, 1, static_cast<char>(random())) : bytes.erase(place, random() % 8 + 1);
      try
      {
        EXPECT_EQ(this->Read("damaged.vtp", bytes).size(), 1u);
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Unreadable) << failure.GetDescription();
        EXPECT_NE(std::string(failure.GetDescription()).find("damaged.vtp: "), std::string::npos)
          << failure.GetDescription();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 50);
}

TEST_F(SurfaceFilesOfOthers, PLYWhoseDivisionNoLongerFitsIsOneSurface)
{
  rhombic::WriteSurfaces(MakeScene(), m_Folder / "scene.ply");
  std::string bytes = ReadBytes(m_Folder / "scene.ply");
  const auto place = bytes.find("\"points\":258");
  bytes.replace(place, 12, "\"points\":257");
  const auto read = this->Read("changed.ply", bytes);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "changed");
  EXPECT_EQ(read[0].surface->GetNumberOfTriangles(), 512u + 128u + 32u);
}

} // namespace
