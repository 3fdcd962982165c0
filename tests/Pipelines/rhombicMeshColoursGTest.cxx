#include "rhombicFailure.h"
#include "rhombicMeshScan.h"
#include "rhombicScanWriter.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>

namespace
{

/** A plate of 40 x 30 mm and \a thickness mm in a scan with voxels of 0.5 x 0.5 x 0.25 mm, whose values fall by 400 a
 * mm at its faces. */
rhombic::ScanImage
MakePlate(double thickness)
{
  using ImageType = itk::Image<std::int16_t, 3>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 100, 80, 48 } });
  const double spacing[3] = { 0.5, 0.5, 0.25 };
  image->SetSpacing(spacing);
  image->Allocate();
  for (std::size_t n = 0; n < image->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    const auto index = image->ComputeIndex(static_cast<itk::OffsetValueType>(n));
    const double x = std::abs(0.5 * static_cast<double>(index[0]) - 24.75) - 20.0;
    const double y = std::abs(0.5 * static_cast<double>(index[1]) - 19.75) - 15.0;
    const double z = std::abs(0.25 * static_cast<double>(index[2]) - 5.875) - 0.5 * thickness;
    image->GetBufferPointer()[n] = static_cast<std::int16_t>(std::clamp(-400.0 * std::max({ x, y, z }), -500.0, 500.0));
  }
  return itk::SmartPointer<ImageType>(image);
}

/** \class MeshedPlate
 * \brief Meshes a plate; the notes and the report are kept. */
class MeshedPlate : public testing::Test
{
protected:
  void
  Mesh(double thickness, rhombic::MeshScanSettings settings)
  {
    settings.source.path = m_Folder.Path() / "plate.nii";
    rhombic::WriteScan(MakePlate(thickness), settings.source.path);
    settings.source.lattice.density = 2.0;
    rhombic::SurfaceRequest request;
    request.name = "plate";
    request.isovalue = 0.5;
    settings.surfaces.requests = { request };
    settings.mesh = m_Folder.Path() / settings.mesh;
    rhombic::Events events;
    events.note = [this](const std::string & line) { m_Notes += line + '\n'; };
    rhombic::MeshScan(settings, events);
    std::ifstream(rhombic::SidecarOf(settings.mesh)) >> m_Report;
  }

  rhombictest::TemporaryFolder m_Folder;
  std::string m_Notes;
  nlohmann::json m_Report;
};

TEST_F(MeshedPlate, IsThinOnBothFaces)
{
  rhombic::MeshScanSettings settings;
  settings.mesh = "plate.stl";
  settings.minimumThickness = 1.0;
  this->Mesh(0.8, settings);
  const auto & thin = m_Report["surfaces"][0]["thinParts"];
  EXPECT_NEAR(thin["areaInSquareMillimetres"].get<double>(), 2 * 40.0 * 30.0, 0.05 * 2400.0);
  EXPECT_NEAR(thin["largestParts"][0]["thinnestInMillimetres"].get<double>(), 0.8, 0.1);
  EXPECT_NEAR(thin["largestParts"][0]["thinnestAtInLPSMillimetres"][2].get<double>(), 5.875, 0.6);
  EXPECT_NE(m_Notes.find("warning: plate: "), std::string::npos) << m_Notes;
  EXPECT_NE(m_Notes.find("are thinner than 1 mm"), std::string::npos) << m_Notes;
}

TEST_F(MeshedPlate, IsNotThinWhereItIsThicker)
{
  rhombic::MeshScanSettings settings;
  settings.mesh = "plate.stl";
  settings.minimumThickness = 1.0;
  this->Mesh(3.0, settings);
  EXPECT_NE(m_Notes.find("plate: no part is thinner than 1 mm"), std::string::npos) << m_Notes;
  EXPECT_EQ(m_Report["surfaces"][0]["thinParts"]["areaInSquareMillimetres"].get<double>(), 0.0);
}

TEST_F(MeshedPlate, HasColoursByItsThickness)
{
  rhombic::MeshScanSettings settings;
  settings.mesh = "plate.vtp";
  settings.colourBy = rhombic::ParseColourBy("thickness,0,4");
  this->Mesh(2.0, settings);
  std::ifstream file(m_Folder.Path() / "plate.vtp", std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  EXPECT_NE(bytes.find("Name=\"thickness_mm\""), std::string::npos);
  EXPECT_EQ(m_Report["colours"]["by"], "thickness");
  EXPECT_EQ(m_Report["colours"]["title"], "thickness, mm");
  EXPECT_EQ(m_Report["colours"]["low"], 0.0);
  EXPECT_NEAR(m_Report["colours"]["highestValue"].get<double>(), 2.0, 0.2);
  EXPECT_NE(m_Notes.find("colours by thickness, mm"), std::string::npos) << m_Notes;
}

TEST_F(MeshedPlate, IsNotWrittenToFilesWithoutColoursOfPoints)
{
  rhombic::MeshScanSettings settings;
  settings.mesh = "plate.stl";
  settings.colourBy = rhombic::ParseColourBy("thickness");
  try
  {
    this->Mesh(2.0, settings);
    ADD_FAILURE();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find(".ply, .vtp, .glb"), std::string::npos)
      << failure.GetDescription();
  }
}

/** A copy of a DICOM folder whose frame of reference has another last digit. */
void
CopyWithAnotherFrame(const std::filesystem::path & from, const std::filesystem::path & to)
{
  std::filesystem::create_directory(to);
  for (const auto & entry : std::filesystem::directory_iterator(from))
  {
    std::ifstream file(entry.path(), std::ios::binary);
    std::string bytes{ std::istreambuf_iterator<char>(file), {} };
    const std::size_t element = bytes.find(std::string("\x20\0\x52\0UI", 6)); // (0020,0052), then its length
    ASSERT_NE(element, std::string::npos);
    char & last = bytes[element + 8 + static_cast<unsigned char>(bytes[element + 6]) - 2]; // the value's length is even
    last = last == '1' ? '2' : '1';
    std::ofstream(to / entry.path().filename(), std::ios::binary) << bytes;
  }
}

TEST(MeshColours, AnotherFrameOfReferenceIsSaid)
{
  const std::filesystem::path scan = std::filesystem::path(RHOMBIC_TESTDATA) / "phantom/dicom";
  const rhombictest::TemporaryFolder folder;
  CopyWithAnotherFrame(scan, folder.Path() / "other");
  for (const std::filesystem::path & other : { scan, folder.Path() / "other" })
  {
    rhombic::MeshScanSettings settings;
    settings.source.path = scan;
    rhombic::SurfaceRequest request;
    request.name = "bone";
    request.isovalue = 300.0;
    settings.surfaces.requests = { request };
    settings.mesh = folder.Path() / "bone.vtp";
    settings.colourBy = rhombic::ParseColourBy(other.string());
    std::string notes;
    rhombic::Events events;
    events.note = [&notes](const std::string & line) { notes += line + '\n'; };
    rhombic::MeshScan(settings, events);
    EXPECT_EQ(notes.find("warning: other has another frame of reference") != std::string::npos, other != scan) << notes;
    EXPECT_EQ(notes.find("2.25."), std::string::npos) << "no UID is shown";
  }
}

} // namespace
