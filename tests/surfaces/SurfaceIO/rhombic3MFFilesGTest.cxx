// 3MF files: what is in ours, and those that other programs might write or that are damaged.

#include "rhombicSurfaceTest.h"

#include "itkTriangleSurfaceMeasures.h"

#include <Model/COM/NMR_DLLInterfaces.h>
#include <chrono>
#include <zlib.h>

namespace
{

class ThreeMFFiles : public SurfaceTest
{
protected:
  const fs::path m_Path = m_Folder / "file.3mf";
};

template <typename TNumber>
void
Put(std::string & bytes, TNumber number)
{
  bytes.append(reinterpret_cast<const char *>(&number), sizeof(number));
}

/** A ZIP archive, part by part: with stored parts, their sizes before them, and a comment, as ours have not. */
std::string
StoredZip(const std::vector<std::pair<std::string, std::string>> & parts)
{
  std::string archive, list;
  for (const auto & [name, text] : parts)
  {
    std::string common;
    common += std::string("\x14\0\0\0\0\0\x12\x34\x56\x78", 10); // version, flags, method, time and date
    Put(common, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef *>(text.data()), text.size())));
    Put(common, static_cast<std::uint32_t>(text.size()));
    Put(common, static_cast<std::uint32_t>(text.size()));
    Put(common, static_cast<std::uint16_t>(name.size()));
    Put(common, std::uint16_t{ 4 }); // extra field
    list += "PK\1\2" + std::string("\x14\0", 2) + common + std::string(10, '\0');
    Put(list, static_cast<std::uint32_t>(archive.size()));
    list += name + "xtra";
    archive += "PK\3\4" + common + name + "xtra" + text;
  }
  std::string end = std::string("PK\5\6\0\0\0\0", 8);
  Put(end, static_cast<std::uint16_t>(parts.size()));
  Put(end, static_cast<std::uint16_t>(parts.size()));
  Put(end, static_cast<std::uint32_t>(list.size()));
  Put(end, static_cast<std::uint32_t>(archive.size()));
  return archive + list + end + std::string("\x07\0comment", 9);
}

const std::string relationships =
  "<Relationships><Relationship Id='a' Type='thumbnail' Target='/a.png'/><Relationship Id='b' Target='/3D/Any.model' "
  "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";

const std::string tetrahedron =
  "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='+1e0' z='0'/><vertex "
  "x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/><triangle "
  "v1='1' v2='2' v3='3'/><triangle v1='2' v2='0' v3='3' pid='7'/></triangles></mesh>";

/** A package with a model of these attributes, resources and items. */
std::string
Package(const std::string & attributes, const std::string & resources, const std::string & items)
{
  return StoredZip({ { "3d/any.MODEL",
                       "<?xml version='1.0'?><model " + attributes + "><resources>" + resources +
                         "</resources><build>" + items + "</build></model>" },
                     { "_rels/.rels", relationships } });
}

/** lib3mf, of the 3MF Consortium, reads our file without a warning. */
TEST_F(ThreeMFFiles, TheConsortiumsLibraryReadsOurs)
{
  auto scene = MakeScene();
  scene.resize(2);
  rhombic::WriteSurfaces(scene, m_Path);
  NMR::PLib3MFModel * model = nullptr;
  NMR::PLib3MFModelReader * reader = nullptr;
  NMR::PLib3MFModelResourceIterator * objects = nullptr;
  ASSERT_EQ(NMR::lib3mf_createmodel(&model), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_model_queryreader(model, "3mf", &reader), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_reader_setstrictmodeactive(reader, true), LIB3MF_OK);
  ASSERT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, m_Path.c_str()), LIB3MF_OK);
  DWORD warnings = 1;
  EXPECT_EQ(NMR::lib3mf_reader_getwarningcount(reader, &warnings), LIB3MF_OK);
  EXPECT_EQ(warnings, 0u);
  ASSERT_EQ(NMR::lib3mf_model_getmeshobjects(model, &objects), LIB3MF_OK);
  for (const SceneSurface & item : scene)
  {
    BOOL hasNext = false;
    ASSERT_EQ(NMR::lib3mf_resourceiterator_movenext(objects, &hasNext), LIB3MF_OK);
    ASSERT_TRUE(hasNext);
    NMR::PLib3MFModelMeshObject * mesh = nullptr;
    ASSERT_EQ(NMR::lib3mf_resourceiterator_getcurrent(objects, &mesh), LIB3MF_OK);
    char name[200];
    ULONG length = 0;
    EXPECT_EQ(NMR::lib3mf_object_getnameutf8(mesh, name, sizeof(name), &length), LIB3MF_OK);
    EXPECT_EQ(name, item.name);
    BOOL isClosed = false;
    EXPECT_EQ(NMR::lib3mf_meshobject_ismanifoldandoriented(mesh, &isClosed), LIB3MF_OK);
    EXPECT_TRUE(isClosed);
    DWORD points = 0, triangles = 0;
    NMR::lib3mf_meshobject_getvertexcount(mesh, &points);
    NMR::lib3mf_meshobject_gettrianglecount(mesh, &triangles);
    ASSERT_EQ(points, item.surface->GetNumberOfPoints());
    ASSERT_EQ(triangles, item.surface->GetNumberOfTriangles());
    for (DWORD n = 0; n < points; ++n)
    {
      NMR::MODELMESHVERTEX vertex;
      NMR::lib3mf_meshobject_getvertex(mesh, n, &vertex);
      ASSERT_EQ((Surface::PointType{ vertex.m_fPosition[0], vertex.m_fPosition[1], vertex.m_fPosition[2] }),
                item.surface->GetPoints()[n]);
    }
    NMR::lib3mf_release(mesh);
  }
  NMR::lib3mf_release(objects);
  NMR::lib3mf_release(reader);
  NMR::lib3mf_release(model);
}

TEST_F(ThreeMFFiles, TrianglesOfTwoPointsAreRefused)
{
  auto surface = MakeSphere(1);
  surface->GetTriangles().push_back({ 1, 2, 1 });
  EXPECT_EQ(KindOf(
              [&] {
                rhombic::WriteSurfaces({ { "thin", surface } }, m_Path);
              },
              "the surface thin has one point at two corners"),
            rhombic::FailureKind::Output);
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(ThreeMFFiles, NamesOfCodePointsThatXMLLacks)
{
  rhombic::WriteSurfaces({ { "a\xEF\xBF\xBE\xEF\xBF\xBF' \xF0\x9F\xAB\x80", MakeSphere(0) } }, m_Path);
  EXPECT_EQ(ReadSurfaces(m_Path)[0].name, "a\xEF\xBF\xBD\xEF\xBF\xBD' \xF0\x9F\xAB\x80");
}

TEST_F(ThreeMFFiles, ObjectsStandWhereTheyAreBuilt)
{
  WriteBytes(
    m_Path,
    Package("unit='centimeter' requiredextensions='m' xmlns:m='http://schemas.microsoft.com/3dmanufacturing/"
            "material/2015/02'",
            "<basematerials id='7'><base name='a' displaycolor='#FF8000'/><base name='b' "
            "displaycolor='#0080FF33'/></basematerials><object id='1' name='part &amp; more' pid='7' pindex='1'>" +
              tetrahedron + "</object><object id='2'>" + tetrahedron +
              "</object><object id='3'><components><component objectid='1'/><component objectid='2' "
              "transform='-1 0 0 0 1 0 0 0 1 5 0 0'/></components></object><object id='4'>" +
              tetrahedron + "</object>",
            "<item objectid='3' transform='1 0 0 0 1 0 0 0 1 0 0 2'/>"));
  const auto read = ReadSurfaces(m_Path);
  ASSERT_EQ(read.size(), 2u) << "the object that is not built is no surface";
  EXPECT_EQ(read[0].name, "part & more");
  EXPECT_EQ(read[0].colour, (rhombic::Colour{ 0, 128 / 255.0, 1 }));
  EXPECT_EQ(read[0].opacity, 0.2);
  EXPECT_EQ(read[0].surface->GetBounds(), (std::array<double, 6>{ 0, 10, 0, 10, 20, 30 }));
  EXPECT_EQ(read[1].name, "file");
  EXPECT_EQ(read[1].surface->GetBounds(), (std::array<double, 6>{ 40, 50, 0, 10, 20, 30 })) << "mirrored";
  for (const SceneSurface & item : read)
  {
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*item.surface), 1000.0 / 6, 1e-9) << "not inside out";
  }
}

/** The names of the core may have a prefix; elements of other namespaces are not those of the core. */
TEST_F(ThreeMFFiles, NamespacesMayHavePrefixes)
{
  const std::string core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
  const auto modelOf = [this](const std::string & model) {
    WriteBytes(m_Path, StoredZip({ { "_rels/.rels", relationships }, { "3D/Any.model", model } }));
    return ReadSurfaces(m_Path);
  };
  std::string prefixed = tetrahedron;
  for (const char * const name : { "mesh", "vertices", "vertex", "triangles", "triangle" })
  {
    for (const std::string before : { "<", "</" })
    {
      const std::string tag = before + name;
      for (std::size_t at = 0; (at = prefixed.find(tag, at)) != prefixed.npos; at += tag.size())
      {
        const char next = prefixed[at + tag.size()];
        if (next == '>' || next == ' ' || next == '/')
        {
          prefixed.insert(at + before.size(), "c:");
        }
      }
    }
  }
  const auto read =
    modelOf("<c:model xmlns:c='" + core + "' xmlns:x='http://a/b' requiredextensions='c'><c:resources>" +
            "<x:object id='1'/><c:object id='1'>" + prefixed +
            "</c:object></c:resources><c:build><c:item objectid='1'/></c:build></c:model>");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].surface->GetNumberOfTriangles(), 4u);
}

TEST_F(ThreeMFFiles, DamagedAndOtherFilesAreRefused)
{
  using Kind = rhombic::FailureKind;
  const std::string object = "<object id='1'>" + tetrahedron + "</object>";
  const std::string item = "<item objectid='1'/>";
  const auto refused = [this](const std::string & bytes, const std::string & why) {
    WriteBytes(m_Path, bytes);
    EXPECT_EQ(KindOf([this] { ReadSurfaces(m_Path); }, why), Kind::Unreadable) << why;
  };
  const std::string whole = Package("", object, item);
  WriteBytes(m_Path, whole);
  ASSERT_EQ(ReadSurfaces(m_Path)[0].surface->GetNumberOfTriangles(), 4u);
  for (std::size_t size = 0; size + 20 < whole.size(); size += 97)
  {
    refused(whole.substr(0, size), "does not end like a ZIP archive");
  }
  refused("solid a\nendsolid\n", "does not end like a ZIP archive");
  refused(StoredZip({ { "word/document.xml", "<document/>" } }), "without a model");
  refused(StoredZip({ { "_rels/.rels", relationships } }), "without a model");
  std::string flipped = whole;
  flipped[whole.find("x='1'") + 3] = '2';
  refused(flipped, "another checksum");
  refused(Package("", "<object id='1'><mesh>", item), "is no XML from line 1 on");
  refused(Package("", object, ""), "it holds no triangles");
  refused(Package("", object, "<item objectid='2'/>"), "it builds an object that it does not have");
  refused(Package("", object + object, item), "the same number");
  refused(Package("unit='parsec'", object, item), "its unit of length is none of 3MF");
  refused(Package("requiredextensions='p' xmlns:p='http://a/production/2015'", object, item), "a/production/2015");
  refused(Package("", object, "<item objectid='1' transform='1 0 0 0 1 0 0 0 1 0 0'/>"), "no twelve numbers");
  const auto changed = [&](const std::string & from, const std::string & to) {
    std::string text = object;
    return Package("", text.replace(text.find(from), from.size(), to), item);
  };
  refused(changed("v3='1'", "v3='4'"), "a corner at point '4'");
  refused(changed("v3='1'", "v3='-1'"), "a corner at point '-1'");
  refused(changed("y='0'", "y='inf'"), "a vertex has no three numbers");
  refused(changed("y='0'", "y=''"), "a vertex has no three numbers");
  const std::string itself = "<object id='1'><components><component objectid='1'/></components></object>";
  refused(Package("", itself, item), "put together of too many others");
  std::string doubling = object;
  for (int n = 2; n < 40; ++n)
  {
    const std::string half = "<component objectid='" + std::to_string(n - 1) + "'/>";
    doubling += "<object id='" + std::to_string(n) + "'><components>" + half + half + "</components></object>";
  }
  refused(Package("", doubling, "<item objectid='39'/>"), "put together of too many others");
  std::string many = object;
  for (int n = 0; n < 100'001; ++n)
  {
    many += "<base/>";
  }
  refused(Package("", many, item), "more than 100000 elements beside its meshes");
  refused(StoredZip({ { "_rels/.rels", relationships },
                      { "3D/Any.model", "<!DOCTYPE model [<!ENTITY a 'aaaaaaaa'>]><model>&a;</model>" } }),
          "is no XML");
}

/** What makes a parser of XML slow or large is refused within the time that a usual file of that size takes. */
TEST_F(ThreeMFFiles, PartsThatWearAParserOutAreRefused)
{
  const auto repeated = [](const std::string & text, std::size_t times) {
    std::string all;
    for (std::size_t n = 0; n < times; ++n)
    {
      all += text;
    }
    return all;
  };
  const std::size_t many = 1 << 20;
  std::string newNames;
  for (std::size_t n = 0; n < many / 4; ++n)
  {
    newNames += "<vertex a" + std::to_string(n) + "=''/>";
  }
  const std::vector<std::pair<std::string, std::string>> parts{
    { "a long value", "<model a='" + std::string(32 * many, 'a') + "'/>" },
    { "a long name", "<" + std::string(16 * many, 'a') + "/>" },
    { "a long comment", "<!--" + std::string(16 * many, 'a') + "--><model/>" },
    { "elements in elements", "<model>" + repeated("<vertex>", many / 4) },
    { "ever new names", "<model>" + newNames },
  };
  for (const auto & [what, text] : parts)
  {
    for (const bool isModel : { true, false })
    {
      const std::string & relations = isModel ? relationships : text;
      WriteBytes(m_Path, StoredZip({ { "_rels/.rels", relations }, { "3D/Any.model", isModel ? text : "" } }));
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_EQ(KindOf([this] { ReadSurfaces(m_Path); }, "names or values that are too long"),
                rhombic::FailureKind::Unreadable)
        << what;
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10)) << what;
    }
  }
}

/** Entities that stand for ten others each, nine times over: refused before one of them is read. */
TEST_F(ThreeMFFiles, EntitiesDoNotExpand)
{
  std::string text = "<!DOCTYPE model [<!ENTITY a0 'aaaaaaaaaa'>";
  for (int n = 1; n < 10; ++n)
  {
    text += "<!ENTITY a" + std::to_string(n) + " '";
    for (int times = 0; times < 10; ++times)
    {
      text += "&a" + std::to_string(n - 1) + ";";
    }
    text += "'>";
  }
  text += "]><model>&a9;</model>";
  for (const bool isModel : { true, false })
  {
    WriteBytes(
      m_Path,
      StoredZip({ { "_rels/.rels", isModel ? relationships : text }, { "3D/Any.model", isModel ? text : "" } }));
    EXPECT_EQ(KindOf([this] { ReadSurfaces(m_Path); }, "is no XML from line 1 on"), rhombic::FailureKind::Unreadable);
  }
}

/** A part of zeros that is a thousand times smaller when it is packed. */
TEST_F(ThreeMFFiles, ZipBombsAreRefused)
{
  const std::string blanks(30 << 20, ' ');
  std::vector<Bytef> packed(compressBound(blanks.size()));
  z_stream stream{};
  ASSERT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(blanks.data()));
  stream.avail_in = static_cast<uInt>(blanks.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  ASSERT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  deflateEnd(&stream);
  std::string bytes = StoredZip(
    { { "_rels/.rels", relationships },
      { "3D/Any.model", std::string(reinterpret_cast<char *>(packed.data()), packed.size() - stream.avail_out) } });
  const std::size_t entry = bytes.rfind("PK\1\2");
  const auto size = static_cast<std::uint32_t>(blanks.size());
  bytes[entry + 10] = 8; // deflated
  std::copy_n(
    reinterpret_cast<const char *>(&size), sizeof(size), bytes.begin() + static_cast<std::ptrdiff_t>(entry) + 24);
  WriteBytes(m_Path, bytes);
  EXPECT_LT(bytes.size(), 40000u);
  EXPECT_EQ(KindOf([this] { ReadSurfaces(m_Path); }, "unpacks to far more than its size"),
            rhombic::FailureKind::Unreadable);
}

} // namespace
