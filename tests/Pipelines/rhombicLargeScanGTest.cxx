#include "rhombicFailure.h"
#include "rhombicMappedVoxels.h"
#include "rhombicMeshScan.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicResampleScan.h"
#include "rhombicScanReader.h"
#include "rhombicScanWriter.h"
#include "rhombicTemporaryFolder.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

/** Volumes larger than the memory allowed. */

namespace fs = std::filesystem;

namespace
{

using Bytes = std::uintmax_t;

std::string
ReadFile(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/** A tall volume with a ball of radius 7 in it: 1.3 million voxels, some 3000 triangles. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeTall()
{
  const auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { 40, 40, 800 } });
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<itk::Image<TPixel, 3>> it(image, image->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    const auto & index = it.GetIndex();
    const double depth = 7.0 - std::hypot(static_cast<double>(index[0]) - 19.3,
                                          static_cast<double>(index[1]) - 20.1,
                                          static_cast<double>(index[2]) - 401.7);
    it.Set(static_cast<TPixel>(std::lround(100.0 + 90.0 * std::erf(depth / 2.0))));
  }
  return image;
}

struct Outcome
{
  std::string bytes;
  std::string notes;
};

class LargeScan : public testing::Test
{
protected:
  rhombic::Events
  Collect(std::string & notes) const
  {
    rhombic::Events events;
    events.note = [&notes](const std::string & note) { notes += note + '\n'; };
    return events;
  }

  rhombic::ScanSource
  SourceOf(const fs::path & path, Bytes memory) const
  {
    rhombic::ScanSource source;
    source.path = path;
    source.read.maximumMemory = memory;
    source.lattice.maximumMemory = memory;
    return source;
  }

  Outcome
  Mesh(const fs::path & path, Bytes memory, itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean) const
  {
    rhombic::MeshScanSettings settings;
    settings.source = this->SourceOf(path, memory);
    settings.mesh = m_Folder.Path() / "mesh.ply";
    settings.surfaces.mode = mode;
    rhombic::SurfaceRequest request;
    request.name = "ball";
    request.isovalue = 100.5;
    settings.surfaces.requests = { request };
    Outcome outcome;
    rhombic::MeshScan(settings, this->Collect(outcome.notes));
    outcome.bytes = ReadFile(settings.mesh);
    return outcome;
  }

  Outcome
  Resample(const fs::path & path, Bytes memory) const
  {
    rhombic::ResampleScanSettings settings;
    settings.source = this->SourceOf(path, memory);
    settings.volume = m_Folder.Path() / "lattice.nrrd";
    Outcome outcome;
    rhombic::ResampleScan(settings, this->Collect(outcome.notes));
    outcome.bytes = ReadFile(settings.volume);
    return outcome;
  }

  template <typename TPixel>
  fs::path
  Write(const std::string & name) const
  {
    const fs::path path = m_Folder.Path() / name;
    rhombic::WriteScan(rhombic::ScanImage(MakeTall<TPixel>()), path);
    return path;
  }

  rhombictest::TemporaryFolder m_Folder;
};

constexpr Bytes Plenty = Bytes(1) << 30;

} // namespace

TEST_F(LargeScan, MeshesAreTheSameInSlabs)
{
  using Mode = itk::FCCIsosurfaceMode;
  const fs::path path = this->Write<std::int16_t>("tall.nii");
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    const Outcome whole = this->Mesh(path, Plenty, mode);
    EXPECT_EQ(whole.notes.find("slab"), std::string::npos) << whole.notes;
    for (const Bytes memory : { 1'900'000, 790'000 })
    {
      const Outcome parts = this->Mesh(path, memory, mode);
      EXPECT_NE(parts.notes.find("slabs, again for each pass"), std::string::npos) << parts.notes;
      EXPECT_EQ(parts.bytes == whole.bytes, true) << static_cast<int>(mode) << ' ' << memory;
      const std::string last = whole.notes.substr(whole.notes.rfind("ball: "));
      EXPECT_NE(parts.notes.find(last), std::string::npos) << parts.notes << whole.notes;
    }
  }
}

TEST_F(LargeScan, EveryPixelTypeAndFormatIsMeshedInSlabs)
{
  for (const fs::path & path : { this->Write<std::uint8_t>("c.nii"),
                                 this->Write<std::uint16_t>("a.nii"),
                                 this->Write<std::int32_t>("d.nii"),
                                 this->Write<float>("b.nii") })
  {
    EXPECT_EQ(this->Mesh(path, Plenty).bytes == this->Mesh(path, 900'000).bytes, true) << path;
  }
}

TEST_F(LargeScan, LatticesAreWrittenInSlabs)
{
  const fs::path path = this->Write<std::int16_t>("tall.nii");
  const Outcome whole = this->Resample(path, Plenty);
  const Outcome parts = this->Resample(path, 800'000);
  EXPECT_NE(parts.notes.find("slabs"), std::string::npos) << parts.notes;
  EXPECT_EQ(parts.bytes == whole.bytes, true);
}

TEST_F(LargeScan, MappedVoxelsAreThoseThatAreRead)
{
  const fs::path path = m_Folder.Path() / "a.nii";
  rhombic::WriteScan(rhombic::ScanImage(MakeTall<float>()), path);
  {
    constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(352 + 77 * 4);
    file.write(reinterpret_cast<const char *>(&notANumber), 4);
  }
  const std::string before = ReadFile(path);
  rhombic::ScanReadOptions options;
  options.maximumMemory = Plenty;
  const rhombic::Scan read = rhombic::ReadVoxels(rhombic::OpenScan(path, options));
  options.maximumMemory = 1'000'000;
  {
    const rhombic::Scan mapped = rhombic::ReadVoxels(rhombic::OpenScan(path, options));
    EXPECT_FALSE(rhombic::IsMapped(read.image));
    ASSERT_TRUE(rhombic::IsMapped(mapped.image));
    EXPECT_EQ(mapped.notes, read.notes);
    const auto & one = *std::get<itk::Image<float, 3>::Pointer>(read.image);
    auto & other = *std::get<itk::Image<float, 3>::Pointer>(mapped.image);
    EXPECT_EQ(one.GetDirection(), other.GetDirection());
    EXPECT_EQ(one.GetOrigin(), other.GetOrigin());
    EXPECT_EQ(one.GetBufferedRegion(), other.GetBufferedRegion());
    EXPECT_TRUE(std::equal(one.GetBufferPointer(), one.GetBufferPointer() + 40 * 40 * 800, other.GetBufferPointer()));
    other.FillBuffer(0.0f);
  }
  EXPECT_EQ(before == ReadFile(path), true) << "the file was changed";
}

TEST_F(LargeScan, OMEZarrIsUnpackedToATemporaryFile)
{
  const auto image = MakeTall<std::int16_t>();
  rhombictest::OMEZarrTestFolder zarr;
  zarr.shape = { 800, 40, 40 };
  zarr.chunks = { 64, 16, 32 };
  zarr.codec = rhombictest::DeflateCodecs().front();
  zarr.transformations = R"([{"type": "scale", "scale": [1000, 1000, 1000]}])"; // micrometres
  const std::int16_t * const values = image->GetBufferPointer();
  const fs::path path =
    zarr.Write(m_Folder.Path() / "tall.ome.zarr", std::vector<std::int16_t>(values, values + 40 * 40 * 800));
  const Outcome whole = this->Mesh(path, Plenty);
  EXPECT_EQ(whole.notes.find("temporary file"), std::string::npos) << whole.notes;
  EXPECT_EQ(whole.bytes == this->Mesh(this->Write<std::int16_t>("tall.nii"), Plenty).bytes, true);
  try
  {
    const Outcome parts = this->Mesh(path, 790'000);
    EXPECT_NE(parts.notes.find("temporary file"), std::string::npos) << parts.notes;
    EXPECT_NE(parts.notes.find("slabs"), std::string::npos) << parts.notes;
    EXPECT_EQ(parts.bytes == whole.bytes, true);
  }
  catch (const rhombic::Failure & failure)
  {
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find("it is in memory itself"), std::string::npos) << sentence;
  }
}

TEST_F(LargeScan, CompressedFilesAreRefusedWithTheCommandThatUnpacksThem)
{
  const fs::path path = this->Write<std::int16_t>("tall.nii.gz");
  try
  {
    this->Mesh(path, 900'000);
    FAIL() << "no exception";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
    EXPECT_NE(std::string(failure.GetDescription()).find("gunzip -k tall.nii.gz"), std::string::npos)
      << failure.GetDescription();
  }
}
