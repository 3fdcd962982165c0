#include "rhombicFailure.h"
#include "rhombicMappedVoxels.h"
#include "rhombicMemoryRefusal.h"
#include "rhombicMemoryPlan.h"
#include "rhombicMeshScan.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicPhantom.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicResampleScan.h"
#include "rhombicScanReader.h"
#include "rhombicScanWriter.h"
#include "rhombicSourceSurfaces.h"
#include "rhombicTemporaryFolder.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <set>
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

/** A tall volume with a ball in it: 1.3 million voxels; of radius 7 some 3000 triangles. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeTall(double radius = 7.0)
{
  const auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { 40, 40, 800 } });
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<itk::Image<TPixel, 3>> it(image, image->GetBufferedRegion()); !it.IsAtEnd();
       ++it)
  {
    const auto & index = it.GetIndex();
    const double depth = radius - std::hypot(static_cast<double>(index[0]) - 19.3,
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

  rhombic::MeshScanSettings
  SettingsOf(const fs::path & path, Bytes memory) const
  {
    rhombic::MeshScanSettings settings;
    settings.source = this->SourceOf(path, memory);
    settings.mesh = m_Folder.Path() / "mesh.ply";
    rhombic::SurfaceRequest request;
    request.name = "ball";
    request.isovalue = 100.5;
    settings.surfaces.requests = { request };
    return settings;
  }

  Outcome
  Mesh(const fs::path & path, Bytes memory, itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean) const
  {
    rhombic::MeshScanSettings settings = this->SettingsOf(path, memory);
    settings.surfaces.mode = mode;
    return this->Mesh(settings);
  }

  Outcome
  Mesh(const rhombic::MeshScanSettings & settings) const
  {
    Outcome outcome;
    rhombic::MeshScan(settings, this->Collect(outcome.notes));
    outcome.bytes = ReadFile(settings.mesh);
    return outcome;
  }

  /** Expects the same bytes of a mesh in slabs as in memory; does nothing where there is no disk for temporary files.
   */
  void
  ExpectSameInSlabs(rhombic::MeshScanSettings settings, Bytes memory) const
  {
    SCOPED_TRACE(settings.source.path);
    const Outcome whole = this->Mesh(settings);
    EXPECT_EQ(whole.notes.find("slab"), std::string::npos) << whole.notes;
    settings.source.read.maximumMemory = settings.source.lattice.maximumMemory = memory;
    try
    {
      const Outcome parts = this->Mesh(settings);
      EXPECT_NE(parts.notes.find("slabs"), std::string::npos) << parts.notes;
      EXPECT_EQ(parts.bytes == whole.bytes, true);
    }
    catch (const rhombic::Failure & failure)
    {
      const std::string sentence = failure.GetDescription();
      EXPECT_NE(sentence.find("it is in memory itself"), std::string::npos) << sentence;
    }
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

  /** A cube of noise. Surfaces of 60 voxels along each edge have some 0.7 million triangles. */
  fs::path
  WriteNoise(itk::SizeValueType edge) const
  {
    const auto image = itk::Image<std::uint8_t, 3>::New();
    image->SetRegions(itk::Size<3>{ { edge, edge, edge } });
    image->Allocate();
    std::mt19937 random(7);
    std::generate_n(
      image->GetBufferPointer(), edge * edge * edge, [&random] { return static_cast<std::uint8_t>(random() % 256); });
    const fs::path path = m_Folder.Path() / "noise.nii";
    rhombic::WriteScan(rhombic::ScanImage(image), path);
    return path;
  }

  /** A ball of eleven labels that touch, and of background. */
  fs::path
  WriteLabels() const
  {
    using Image = itk::Image<std::uint8_t, 3>;
    const auto image = Image::New();
    image->SetRegions(itk::Size<3>{ { 100, 80, 80 } });
    image->Allocate();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-38.0, 38.0);
    std::array<std::array<double, 3>, 12> middles{}; // of the labels, and of 0
    for (auto & middle : middles)
    {
      std::generate(middle.begin(), middle.end(), [&] { return place(random); });
    }
    for (itk::ImageRegionIteratorWithIndex<Image> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      const double x = static_cast<double>(it.GetIndex()[0]) - 49.5;
      const double y = static_cast<double>(it.GetIndex()[1]) - 39.5;
      const double z = static_cast<double>(it.GetIndex()[2]) - 39.5;
      const auto nearest = std::min_element(middles.begin(), middles.end(), [&](const auto & a, const auto & b) {
        return std::hypot(a[0] - x, a[1] - y, a[2] - z) < std::hypot(b[0] - x, b[1] - y, b[2] - z);
      });
      it.Set(static_cast<std::uint8_t>(std::hypot(x, y, z) < 38.0 ? nearest - middles.begin() : 0));
    }
    const fs::path path = m_Folder.Path() / "labels.nii";
    rhombic::WriteScan(rhombic::ScanImage(image), path);
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

/** The values of a ball as a NIfTI file has them, of any type, order of bytes, scaling and axes. */
template <typename TStored>
NIfTITestFile
TallFile(int datatype, bool isBigEndian)
{
  const auto image = MakeTall<std::int16_t>();
  const auto * const values = image->GetBufferPointer();
  NIfTITestFile file;
  file.isBigEndian = isBigEndian;
  file.dimensions = { 3, 40, 40, 800, 1, 1, 1, 1 };
  file.datatype = datatype;
  file.bits = 8 * sizeof(TStored);
  file.voxels = file.Values(std::vector<TStored>(values, values + 40 * 40 * 800));
  return file;
}

TEST_F(LargeScan, AnyNIfTIIsMeshedInSlabs)
{
  const auto expectSame = [this](const NIfTITestFile & file, const std::string & name) {
    const fs::path path = m_Folder.Path() / (name + ".nii");
    std::ofstream(path, std::ios::binary) << file.Bytes();
    this->ExpectSameInSlabs(this->SettingsOf(path, Plenty), 900'000);
  };
  expectSame(TallFile<std::uint8_t>(2, false), "uint8");
  expectSame(TallFile<std::int16_t>(4, true), "int16-swapped");
  expectSame(TallFile<std::int32_t>(8, true), "int32-swapped");
  expectSame(TallFile<float>(16, true), "float-swapped");
  expectSame(TallFile<double>(64, false), "double");
  expectSame(TallFile<std::uint16_t>(512, true), "uint16-swapped");
  expectSame(TallFile<std::uint32_t>(768, false), "uint32");
  expectSame(TallFile<std::int64_t>(1024, false), "int64");
  expectSame(TallFile<std::uint64_t>(1280, true), "uint64-swapped");
  NIfTITestFile scaled = TallFile<std::int16_t>(4, false);
  scaled.slope = 1.5;
  scaled.intercept = -20;
  expectSame(scaled, "scaled");
}

TEST_F(LargeScan, AnyOrderOfAxesIsMeshedInSlabs)
{
  NIfTITestFile file = TallFile<std::int16_t>(4, false);
  const auto expectSame = [&](const std::array<double, 12> & affine, const std::string & name) {
    file.sform = affine;
    const fs::path path = m_Folder.Path() / (name + ".nii");
    std::ofstream(path, std::ios::binary) << file.Bytes();
    this->ExpectSameInSlabs(this->SettingsOf(path, Plenty), 900'000);
  };
  expectSame({ -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 }, "one-flipped");
  expectSame({ 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0 }, "others-flipped");
  const auto image = MakeTall<std::int16_t>(); // and now with the third axis first in the file
  std::vector<std::int16_t> turned(40 * 40 * 800);
  for (itk::ImageRegionIteratorWithIndex<itk::Image<std::int16_t, 3>> it(image, image->GetBufferedRegion());
       !it.IsAtEnd();
       ++it)
  {
    const auto & index = it.GetIndex();
    turned[static_cast<std::size_t>((index[1] * 40 + index[0]) * 800 + index[2])] = it.Get();
  }
  file.dimensions = { 3, 800, 40, 40, 1, 1, 1, 1 };
  file.voxels = file.Values(turned);
  expectSame({ 0, 1, 0, 5, 0, 0, 1, 6, 1, 0, 0, 7 }, "permuted");
  expectSame({ 0, -1, 0, 5, 0, 0, -1, 6, -1, 0, 0, 7 }, "permuted-and-flipped");
}

TEST_F(LargeScan, DenoisedAndDenserLatticesAreTheSameInSlabs)
{
  rhombic::MeshScanSettings settings = this->SettingsOf(this->Write<std::int16_t>("tall.nii"), Plenty);
  settings.source.lattice.denoising = { rhombic::Denoising::Kind::Gaussian, 1.3, 0.0 };
  this->ExpectSameInSlabs(settings, 1'500'000);
  settings.source.lattice.density = 2.5;
  this->ExpectSameInSlabs(settings, 4'000'000);
  settings.source.lattice.denoising = {};
  this->ExpectSameInSlabs(settings, 3'000'000);
  settings.source.lattice.nested = true;
  this->ExpectSameInSlabs(settings, 900'000);
}

TEST_F(LargeScan, AnyNumberOfSlabsGivesTheSameBytes)
{
  const fs::path path = this->Write<std::int16_t>("tall.nii");
  const Outcome whole = this->Mesh(path, Plenty);
  std::set<int> numbers;
  for (Bytes memory = 1'900'000; numbers.empty() || *numbers.rbegin() < 64; memory -= memory / 12)
  {
    const Outcome parts = this->Mesh(path, memory);
    const auto place = parts.notes.find(" slabs, again");
    ASSERT_NE(place, std::string::npos) << parts.notes;
    numbers.insert(std::stoi(parts.notes.substr(parts.notes.rfind(' ', place - 1))));
    EXPECT_EQ(parts.bytes == whole.bytes, true) << memory;
  }
  EXPECT_LE(*numbers.begin(), 7);
}

TEST_F(LargeScan, ExtremeShapesAreTheSameInSlabs)
{
  const auto write = [this](const itk::Size<3> & size, const itk::Index<3> & middle) {
    const auto image = itk::Image<std::uint8_t, 3>::New();
    image->SetRegions(size);
    image->Allocate();
    for (itk::ImageRegionIteratorWithIndex<itk::Image<std::uint8_t, 3>> it(image, image->GetBufferedRegion());
         !it.IsAtEnd();
         ++it)
    {
      const itk::Offset<3> offset = it.GetIndex() - middle;
      const double radius = std::hypot(static_cast<double>(offset[0]), offset[1], offset[2]);
      it.Set(static_cast<std::uint8_t>(std::lround(100.0 + 90.0 * std::erf((9.0 - radius) / 2.0))));
    }
    const fs::path path = m_Folder.Path() / "shape.nii";
    rhombic::WriteScan(rhombic::ScanImage(image), path);
    return path;
  };
  this->ExpectSameInSlabs(this->SettingsOf(write({ { 8, 9, 6400 } }, { { 4, 4, 3201 } }), Plenty), 200'000);
  // A slab with the planes around it is more than a flat lattice, which therefore has to fit.
  const fs::path flat = write({ { 400, 400, 5 } }, { { 203, 199, 2 } });
  const Outcome parts = this->Mesh(flat, 700'000);
  EXPECT_NE(parts.notes.find("the voxels stay in their file"), std::string::npos) << parts.notes;
  EXPECT_EQ(parts.bytes == this->Mesh(flat, Plenty).bytes, true);
  EXPECT_THROW(this->Mesh(flat, 500'000), rhombic::Failure);
}

TEST_F(LargeScan, FlatVolumesAreTheSameInSlabs)
{
  const auto image = itk::Image<std::uint8_t, 3>::New();
  image->SetRegions(itk::Size<3>{ { 2840, 2840, 5 } });
  image->Allocate(true);
  for (const itk::IndexValueType place : { 3, 1400, 2833 }) // balls at the ends and in the middle
  {
    for (itk::IndexValueType z = 0; z < 5; ++z)
    {
      for (itk::IndexValueType y = std::max<itk::IndexValueType>(place - 9, 0); y < std::min(place + 9, 2840l); ++y)
      {
        for (itk::IndexValueType x = std::max<itk::IndexValueType>(place - 9, 0); x < std::min(place + 9, 2840l); ++x)
        {
          const double radius = std::hypot(static_cast<double>(x - place), y - place, z - 2);
          image->SetPixel({ { x, y, z } },
                          static_cast<std::uint8_t>(std::lround(100.0 + 90.0 * std::erf((5.0 - radius) / 2.0))));
        }
      }
    }
  }
  const fs::path path = m_Folder.Path() / "flat.nii";
  rhombic::WriteScan(rhombic::ScanImage(image), path);
  rhombic::MeshScanSettings settings = this->SettingsOf(path, Plenty);
  this->ExpectSameInSlabs(settings, 10'000'000); // the lattice takes 32 MB, one of its planes across the scan 5 MB
  this->ExpectSameInSlabs(settings, 4'000'000);
  settings.source.lattice.denoising = { rhombic::Denoising::Kind::Gaussian, 1.3, 0.0 };
  this->ExpectSameInSlabs(settings, 10'000'000);
}

TEST_F(LargeScan, DicomFoldersAreMeshedInSlabs)
{
  rhombic::PhantomSettings phantom;
  phantom.spacing = 3.0;
  rhombic::WritePhantom(m_Folder.Path() / "phantom", phantom);
  rhombic::MeshScanSettings settings = this->SettingsOf(m_Folder.Path() / "phantom/dicom", Plenty);
  settings.surfaces.requests.front().isovalue = 1100.5; // a small surface
  this->ExpectSameInSlabs(settings, 4'500'000);
}

TEST_F(LargeScan, MoreMemoryIsNotRefusedWhereLessIsEnough)
{
  rhombic::PhantomSettings phantom;
  phantom.spacing = 3.0;
  rhombic::WritePhantom(m_Folder.Path() / "phantom", phantom);
  for (const char * const scan : { "phantom/dicom", "phantom/phantom.nii.gz" })
  {
    rhombic::MeshScanSettings settings = this->SettingsOf(m_Folder.Path() / scan, Plenty);
    settings.surfaces.requests.front().isovalue = 1100.5; // a small surface
    const Outcome whole = this->Mesh(settings);
    unsigned int refused = 0, made = 0;
    for (Bytes memory = 4'000'000; memory <= 30'000'000; memory += memory / 16)
    {
      settings.source = this->SourceOf(m_Folder.Path() / scan, memory);
      try
      {
        EXPECT_TRUE(this->Mesh(settings).bytes == whole.bytes) << scan << ' ' << memory;
        ++made;
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
        EXPECT_EQ(made, 0u) << scan << ' ' << memory << ": " << failure.what();
        ++refused;
      }
    }
    EXPECT_GT(made, 5u) << scan;
    EXPECT_GT(refused + made, 20u) << scan;
  }
}

TEST_F(LargeScan, PlansTellWhatWorkThenDoes)
{
  rhombic::MeshScanSettings settings = this->SettingsOf(this->Write<std::int16_t>("tall.nii"), 900'000);
  const std::string plan = rhombic::PlanMeshScan(settings, rhombic::Events());
  EXPECT_FALSE(fs::exists(settings.mesh));
  EXPECT_NE(plan.find("which stay in their file"), std::string::npos) << plan;
  EXPECT_NE(plan.find("made again for each of 4 passes"), std::string::npos) << plan;
  EXPECT_NE(plan.find("of the 878.9 KiB that are allowed for volumes"), std::string::npos) << plan;
  const auto begin = plan.find("in ", plan.find("lattice")) + 3;
  const std::string slabs = plan.substr(begin, plan.find(" of", begin) - begin);
  EXPECT_NE(this->Mesh(settings).notes.find(slabs + ", again"), std::string::npos) << slabs;

  settings.source = this->SourceOf(settings.source.path, Plenty);
  EXPECT_NE(rhombic::PlanMeshScan(settings, {}).find("2.4 MiB in memory"), std::string::npos);
  settings.source = this->SourceOf(settings.source.path, 200'000);
  EXPECT_THROW(rhombic::PlanMeshScan(settings, {}), rhombic::Failure);
  settings.source = this->SourceOf(this->Write<std::int16_t>("tall.nii.gz"), 900'000);
  EXPECT_THROW(rhombic::PlanMeshScan(settings, {}), rhombic::Failure);

  rhombic::ResampleScanSettings resampling;
  resampling.source = this->SourceOf(this->Write<std::int16_t>("tall.nii"), 800'000);
  resampling.volume = m_Folder.Path() / "lattice.nrrd";
  const std::string resamplingPlan = rhombic::PlanResampleScan(resampling, {});
  EXPECT_NE(resamplingPlan.find("slabs of"), std::string::npos) << resamplingPlan;
  EXPECT_FALSE(fs::exists(resampling.volume));
}

TEST_F(LargeScan, SurfacesThatAreOnlySeenAreTheSameInSlabs)
{
  const fs::path path = m_Folder.Path() / "tall.nii";
  rhombic::WriteScan(rhombic::ScanImage(MakeTall<std::int16_t>(17.0)), path);
  const rhombic::MeshScanSettings settings = this->SettingsOf(path, Plenty);
  rhombic::SurfaceViewing viewing;
  viewing.mostPoints = 400;
  std::array<double, 6> seen{};
  viewing.findUnseen = [&seen](const std::array<double, 6> & bounds) {
    seen = bounds;
    return 0.05;
  };
  const auto make = [&](Bytes memory, const rhombic::SurfaceViewing & usedViewing, std::string & notes) {
    rhombic::ScanSource source = this->SourceOf(settings.source.path, memory);
    source.streams = true;
    const rhombic::Events events = this->Collect(notes);
    const auto loaded = rhombic::LoadSource(source, settings.surfaces, std::nullopt, events);
    const rhombic::SurfaceMaking making{ source, settings.surfaces, settings.finish, rhombic::SurfaceUse::Pictures,
                                         events, std::nullopt,      &usedViewing };
    auto surfaces = rhombic::ExtractSource(making, loaded);
    rhombic::FinishSurfaces(making, surfaces);
    return surfaces.front();
  };
  std::string notes, notesInSlabs, notesOfAll;
  const rhombic::MeshedSurface whole = make(Plenty, viewing, notes);
  const rhombic::MeshedSurface parts = make(1'200'000, viewing, notesInSlabs);
  EXPECT_EQ(notes.find("slab"), std::string::npos) << notes;
  EXPECT_NE(notesInSlabs.find("slabs"), std::string::npos) << notesInSlabs;
  EXPECT_NE(notesInSlabs.find("which give the same picture"), std::string::npos) << notesInSlabs;
  EXPECT_TRUE(parts.scene.surface->GetPoints() == whole.scene.surface->GetPoints());
  EXPECT_TRUE(parts.scene.surface->GetNormals() == whole.scene.surface->GetNormals());
  EXPECT_TRUE(parts.scene.surface->GetTriangles() == whole.scene.surface->GetTriangles());
  viewing.mostPoints = 1'000'000;
  const rhombic::MeshedSurface all = make(Plenty, viewing, notesOfAll);
  EXPECT_FALSE(all.whole);
  EXPECT_LT(parts.scene.surface->GetNumberOfTriangles(), all.scene.surface->GetNumberOfTriangles() / 2);
  EXPECT_NEAR(parts.extracted->volume, all.extracted->volume, 1e-6 * all.extracted->volume);
  EXPECT_EQ(parts.whole->triangles, all.extracted->triangles);
  const auto bounds = all.scene.surface->GetBounds();
  for (std::size_t n = 0; n < bounds.size(); ++n)
  {
    EXPECT_NEAR(parts.whole->bounds[n], bounds[n], 1e-6);
    EXPECT_NEAR(seen[n], bounds[n], 3.0);
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
    for (int use = 0; use < 2; ++use)
    {
      EXPECT_TRUE(std::equal(one.GetBufferPointer(), one.GetBufferPointer() + 40 * 40 * 800, other.GetBufferPointer()));
      rhombic::DropPages(mapped.image); // keeps the value that took the place of no number
    }
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

TEST_F(LargeScan, MeshesBeyondTheMemoryAreTheSameByTemporaryFiles)
{
  using Mode = itk::FCCIsosurfaceMode;
  rhombic::MeshScanSettings settings = this->SettingsOf(this->WriteNoise(50), Plenty);
  settings.source.read.temporaryFolder = m_Folder.Path();
  if (const std::string obstacle = rhombic::FindObstacle({ m_Folder.Path(), {} }, Plenty); !obstacle.empty())
  {
    GTEST_SKIP() << obstacle;
  }
  const std::pair<Mode, const char *> cases[]{
    { Mode::Lean, ".ply" }, { Mode::Lean, ".stl" }, { Mode::Fine, ".vtp" }, { Mode::Tetrahedra, ".glb" }
  };
  for (const auto & [mode, extension] : cases)
  {
    SCOPED_TRACE(extension);
    settings.surfaces.mode = mode;
    settings.mesh = m_Folder.Path() / (std::string("mesh") + extension);
    settings.audits = std::string(extension) == ".stl";
    settings.source.lattice.maximumMemory = Plenty;
    const Outcome whole = this->Mesh(settings);
    EXPECT_EQ(whole.notes.find("temporary files"), std::string::npos) << whole.notes;
    settings.source.lattice.maximumMemory = 10'000'000;
    const std::string plan = rhombic::PlanMeshScan(settings, {});
    EXPECT_NE(plan.find(" in temporary files in " + m_Folder.Path().string()), std::string::npos) << plan;
    const Outcome files = this->Mesh(settings);
    EXPECT_NE(files.notes.find("are put into temporary files of some"), std::string::npos) << files.notes;
    EXPECT_EQ(files.bytes == whole.bytes, true);
  }
  settings.source.read.temporaryFolder = m_Folder.Path() / "none";
  EXPECT_THROW(this->Mesh(settings), rhombic::Failure);
}

TEST_F(LargeScan, FinishedMeshesBeyondTheMemoryAreTheSameByTemporaryFiles)
{
  const fs::path path = this->WriteNoise(40);
  if (const std::string obstacle = rhombic::FindObstacle({ m_Folder.Path(), {} }, Plenty); !obstacle.empty())
  {
    GTEST_SKIP() << obstacle;
  }
  const auto expectSame = [&](const std::string & what, const std::function<void(rhombic::MeshScanSettings &)> & set) {
    SCOPED_TRACE(what);
    rhombic::MeshScanSettings settings = this->SettingsOf(path, Plenty);
    settings.source.read.temporaryFolder = m_Folder.Path();
    set(settings);
    const Outcome whole = this->Mesh(settings);
    EXPECT_EQ(whole.notes.find("temporary files"), std::string::npos) << whole.notes;
    settings.source.lattice.maximumMemory = 5'000'000;
    Outcome files = this->Mesh(settings);
    const std::size_t note = files.notes.find("the surfaces, some");
    ASSERT_NE(note, std::string::npos) << files.notes;
    files.notes.erase(note, files.notes.find('\n', note) + 1 - note);
    EXPECT_EQ(files.notes, whole.notes);
    EXPECT_EQ(files.bytes == whole.bytes, true);
  };
  expectSame("smoothed", [](auto & settings) { settings.finish.smoothing.spacings = 0.3; });
  expectSame("fewer", [](auto & settings) { settings.finish.share = 0.8; });
  expectSame("thin", [](auto & settings) { settings.minimumThickness = 1.0; });
  expectSame("coloured by a volume",
             [&](auto & settings) { settings.colourBy = rhombic::ParseColourBy(path.string() + ",0,255,mean:2mm"); });
  expectSame("coloured by curvature", [](auto & settings) {
    settings.colourBy = rhombic::ParseColourBy("curvature:2mm");
    settings.mesh.replace_extension(".vtp");
  });
  const fs::path other = m_Folder.Path() / "other.ply";
  fs::copy_file(m_Folder.Path() / "mesh.ply", other);
  expectSame("coloured by distances",
             [&](auto & settings) { settings.colourBy = rhombic::ParseColourBy("distance:" + other.string()); });
}

TEST_F(LargeScan, LabelsBeyondTheMemoryAreTheSameByTemporaryFiles)
{
  const fs::path path = this->WriteLabels();
  if (const std::string obstacle = rhombic::FindObstacle({ m_Folder.Path(), {} }, Plenty); !obstacle.empty())
  {
    GTEST_SKIP() << obstacle;
  }
  const auto expectSame = [&](const std::string & what, const std::function<void(rhombic::MeshScanSettings &)> & set) {
    SCOPED_TRACE(what);
    rhombic::MeshScanSettings settings;
    settings.source = this->SourceOf(path, Plenty);
    settings.source.read.temporaryFolder = m_Folder.Path();
    settings.mesh = m_Folder.Path() / "mesh.vtp";
    settings.surfaces.labels.emplace();
    set(settings);
    const Outcome whole = this->Mesh(settings);
    EXPECT_EQ(whole.notes.find("temporary files"), std::string::npos) << whole.notes;
    settings.source.read.maximumMemory = 500'000; // of 640 kB
    settings.source.lattice.maximumMemory = 10'000'000;
    const std::string plan = rhombic::PlanMeshScan(settings, {});
    EXPECT_NE(plan.find(" in temporary files in " + m_Folder.Path().string()), std::string::npos) << plan;
    Outcome files = this->Mesh(settings);
    for (const char * const more : { "the voxels stay in their file", "labels and their surfaces, some" })
    {
      const std::size_t note = files.notes.find(more);
      ASSERT_NE(note, std::string::npos) << files.notes;
      files.notes.erase(note, files.notes.find('\n', note) + 1 - note);
    }
    EXPECT_EQ(files.notes, whole.notes);
    EXPECT_EQ(files.bytes == whole.bytes, true);
  };
  expectSame("walls", [](auto & settings) { settings.audits = true; });
  expectSame("some", [](auto & settings) { settings.surfaces.labels->labels = { "2", "3" }; });
  expectSame("smoothed", [](auto & settings) { settings.finish.smoothing.spacings = 0.3; });
  expectSame("fewer", [](auto & settings) { settings.finish.share = 0.5; });
  expectSame("another format", [](auto & settings) { settings.mesh.replace_extension(".glb"); });
  expectSame("coloured by thickness", [](auto & settings) { settings.colourBy = rhombic::ParseColourBy("thickness"); });
}

TEST_F(LargeScan, LabelsBesideAScanArePlanned)
{
  rhombic::MeshScanSettings settings;
  settings.source = this->SourceOf(this->WriteLabels(), Plenty);
  settings.source.read.temporaryFolder = m_Folder.Path();
  settings.mesh = m_Folder.Path() / "mesh.vtp";
  settings.surfaces.labels.emplace();
  const auto lineOf = [&settings](const std::string & name) {
    const std::string plan = rhombic::PlanMeshScan(settings, {});
    const std::size_t begin = plan.find(name);
    return begin == std::string::npos ? "no " + name : plan.substr(begin, plan.find('\n', begin) - begin);
  };
  const auto triangles = [](const std::string & line) { return line.substr(14, line.find(" triangles") - 14); };
  const std::string alone = lineOf("surfaces ");
  settings.surfaces.labels->source.paths = { settings.source.path };
  EXPECT_EQ(triangles(lineOf("labels ")), triangles(alone));
  EXPECT_EQ(lineOf("surfaces "), "no surfaces ");
  EXPECT_NE(lineOf("memory ").find(" for the labels"), std::string::npos);
  rhombic::SurfaceRequest request;
  request.name = "ball";
  request.isovalue = 3.5;
  settings.surfaces.requests = { request };
  EXPECT_NE(lineOf("surfaces ").find(" million triangles"), std::string::npos);
  if (rhombic::FindObstacle({ m_Folder.Path(), {} }, Plenty).empty())
  {
    settings.source.lattice.maximumMemory = 10'000'000;
    EXPECT_NE(lineOf("labels ").find(" in temporary files in " + m_Folder.Path().string()), std::string::npos);
  }
  settings.source.read.temporaryFolder = m_Folder.Path() / "none";
  settings.source.lattice.maximumMemory = 10'000'000;
  EXPECT_THROW(rhombic::PlanMeshScan(settings, {}), rhombic::Failure);
}

TEST_F(LargeScan, MapsOfBackgroundArePlannedAsTheWorkIsDone)
{
  const auto map = itk::Image<std::uint8_t, 3>::New();
  map->SetRegions(itk::Size<3>{ { 20, 20, 20 } });
  map->Allocate(true);
  const fs::path path = m_Folder.Path() / "background.nii";
  rhombic::WriteScan(rhombic::ScanImage(map), path);
  rhombic::MeshScanSettings settings;
  settings.source = this->SourceOf(path, Plenty);
  settings.mesh = m_Folder.Path() / "mesh.vtp";
  settings.surfaces.labels.emplace();
  for (const std::vector<fs::path> & beside : { std::vector<fs::path>(), { path } })
  {
    settings.surfaces.labels->source.paths = beside;
    const std::string sentence = path.string() + " holds nothing but background; check that it was exported whole.";
    EXPECT_EQ(rhombictest::Refusal([&] { rhombic::PlanMeshScan(settings, {}); }, rhombic::FailureKind::Empty),
              sentence);
    EXPECT_EQ(rhombictest::Refusal([&] { this->Mesh(settings); }, rhombic::FailureKind::Empty), sentence);
  }
  rhombic::SurfaceRequest request;
  request.name = "air";
  request.isovalue = -0.5;
  settings.surfaces.requests = { request };
  EXPECT_NO_THROW(rhombic::PlanMeshScan(settings, {}));
}

TEST_F(LargeScan, LabelsBeyondTheMemoryAreRefusedWithoutRoom)
{
  rhombic::MeshScanSettings settings;
  settings.source = this->SourceOf(this->WriteLabels(), 10'000'000);
  settings.source.read.temporaryFolder = m_Folder.Path() / "none";
  settings.mesh = m_Folder.Path() / "mesh.vtp";
  settings.surfaces.labels.emplace();
  const auto expectRefused = [](const auto & work) {
    try
    {
      work();
      ADD_FAILURE() << "not refused";
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
      const std::string sentence = failure.GetDescription();
      EXPECT_EQ(sentence.rfind("Cannot make surfaces of labels: their arrays are too large for the memory", 0), 0u)
        << sentence;
    }
  };
  expectRefused([&] { rhombic::PlanMeshScan(settings, {}); });
  expectRefused([&] { this->Mesh(settings); });
  EXPECT_FALSE(fs::exists(settings.mesh));
}

TEST_F(LargeScan, MeshesBeyondTheMemoryAreRefusedBeforeWorkThatNeedsThemThere)
{
  const fs::path path = this->WriteNoise(60);
  rhombic::MeshScanSettings settings = this->SettingsOf(path, 10'000'000);
  settings.surfaces.requests.front().parts = rhombic::SurfaceRequest::Parts::Outermost;
  const auto plan = [&] { rhombic::PlanMeshScan(settings, {}); };
  const auto mesh = [&] { this->Mesh(settings); };
  const std::string sentence = rhombictest::MemoryRefusal(plan);
  EXPECT_NE(sentence.find("Making surfaces of some 0.69 million"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("use a coarser lattice with --density 0.0"), std::string::npos) << sentence;
  EXPECT_EQ(rhombictest::MemoryRefusal(mesh), sentence);
  EXPECT_FALSE(fs::exists(settings.mesh));
  settings.source = this->SourceOf(path, 3'000'000);
  EXPECT_NE(rhombictest::MemoryRefusal(plan).find("more than the 2.9 MiB that are allowed"), std::string::npos);
  settings.source = this->SourceOf(path, 10'000'000);
  settings.source.lattice.denoising = { rhombic::Denoising::Kind::Gaussian, 1.5, 0.0 };
  EXPECT_EQ(rhombictest::MemoryRefusal(mesh), "no exception"); // of which little is left
  settings.source = this->SourceOf(path, Plenty);
  EXPECT_EQ(rhombictest::MemoryRefusal(plan), "no exception");
}

TEST_F(LargeScan, MeshesBeyond32BitsAreRefusedBeforeTheWork)
{
  rhombic::MeshScanSettings settings = this->SettingsOf("none.nii", Bytes(1) << 60);
  const auto sentenceOf = [&settings](double triangles) {
    return rhombictest::MemoryRefusal([&] {
      rhombic::MeshEstimate mesh;
      mesh.triangles = triangles;
      CheckMesh(mesh, settings);
    });
  };
  EXPECT_EQ(sentenceOf(4.2e9), "no exception");
  EXPECT_EQ(sentenceOf(5e9),
            "The surfaces would have some 5000 million triangles, and 32-bit numbers of points and triangles reach for "
            "some 4295 million triangles; simplify them with --max-triangles, or use a coarser lattice with --density "
            "0.58, another threshold or a part of the scan.");
  settings.finish.maximumTriangles = 1000;
  EXPECT_EQ(sentenceOf(5e9), "no exception");
  EXPECT_NE(sentenceOf(9e9).find("some 8590 million triangles; use a coarser lattice"), std::string::npos)
    << sentenceOf(9e9);
  settings.finish = {};
  settings.mesh = "mesh.glb";
  EXPECT_EQ(sentenceOf(1.7e8), "no exception");
  EXPECT_NE(sentenceOf(2e8).find("of lengths in GLB files reach for some 179 million triangles; simplify them with "
                                 "--max-triangles, write a .ply or .vtp"),
            std::string::npos)
    << sentenceOf(2e8);
  settings.source.lattice.nested = true;
  EXPECT_NE(sentenceOf(2e8).find("or use another threshold or"), std::string::npos);
}
