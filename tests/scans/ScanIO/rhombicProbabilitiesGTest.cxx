#include "rhombicLabelMap.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicScanTest.h"

#include <fstream>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::LabelMap;

constexpr int Width = 6;

class Probabilities : public ScanTest
{
protected:
  /** A file of volumes of 6 x 5 x 4 voxels of 2 mm, each with one value in the first half along x and another behind.
   */
  fs::path
  Write(const std::string & name,
        const std::vector<std::array<float, 2>> & halves,
        double scale = 1.0,
        double origin = 0.0) const
  {
    NIfTITestFile file;
    file.dimensions = { 4, Width, 5, 4, static_cast<std::int64_t>(halves.size()), 1, 1, 1 };
    file.datatype = 16;
    file.bits = 32;
    file.sform = { 2, 0, 0, origin, 0, 2, 0, 0, 0, 0, 2, 0 };
    std::vector<float> values;
    for (const auto & [first, second] : halves)
    {
      for (int n = 0; n < Width * 5 * 4; ++n)
      {
        values.push_back(static_cast<float>(scale) * (n % Width < Width / 2 ? first : second));
      }
    }
    file.voxels = file.Values(values);
    std::ofstream(m_Folder / name, std::ios::binary) << file.Bytes();
    return m_Folder / name;
  }

  LabelMap
  Read(const std::vector<fs::path> & paths) const
  {
    rhombic::ScanReadOptions options;
    options.onSeveralFrames = rhombic::ScanReadOptions::Policy::Accept;
    return rhombic::ReadLabelMap({ {}, {}, true, paths }, {}, rhombic::ReadScan(paths.front(), options), paths.front());
  }

  FailureKind
  KindOf(const std::vector<fs::path> & paths, const std::string & named) const
  {
    try
    {
      this->Read(paths);
    }
    catch (const Failure & failure)
    {
      EXPECT_NE(std::string(failure.GetDescription()).find(named), std::string::npos) << failure.GetDescription();
      return failure.GetKind();
    }
    ADD_FAILURE() << "was read";
    return FailureKind::Internal;
  }
};

TEST_F(Probabilities, OfSeveralFilesAndOfOneAreTheSame)
{
  const std::array<float, 2> grey{ 0.25f, 0.75f };
  const std::array<float, 2> white{ 0.5f, 0.1f };
  const auto files = this->Read({ this->Write("grey.matter.nii", { grey }), this->Write("white.nii", { white }) });
  std::ofstream(m_Folder / "both.tsv") << "index\tname\n1\tgrey matter\n2\twhite matter\n";
  const auto file = this->Read({ this->Write("both.nii", { grey, white }) });
  const auto percent = this->Read({ this->Write("percent.nii", { grey, white }, 100.0) });
  const auto bytes = this->Read({ this->Write("bytes.nii", { grey, white }, 255.0) });
  EXPECT_EQ(percent.scan.notes.size(), file.scan.notes.size() + 1);
  for (const LabelMap * map : { &files, &file, &percent, &bytes })
  {
    ASSERT_EQ(map->probabilities.size(), 2u);
    ASSERT_EQ(map->labels.size(), 2u);
    const auto & labels = *std::get<itk::Image<std::uint16_t, 3>::Pointer>(map->scan.image);
    for (int n = 0; n < Width * 5 * 4; ++n)
    {
      const std::size_t half = n % Width < Width / 2 ? 0 : 1;
      EXPECT_EQ(labels.GetBufferPointer()[n], half == 0 ? 2 : 1);
      EXPECT_FLOAT_EQ(map->probabilities[0]->GetBufferPointer()[n], grey[half]);
      EXPECT_FLOAT_EQ(map->probabilities[1]->GetBufferPointer()[n], white[half]);
    }
    EXPECT_EQ(map->labels[0].numberOfVoxels, 60u);
    EXPECT_NEAR(map->labels[0].millilitres, 60 * (0.25 + 0.75) * 8.0 / 1000.0, 1e-6);
  }
  EXPECT_EQ(files.scan.files.size(), 2u);
  EXPECT_EQ(files.labels[1].label.name, "label 2");
  EXPECT_EQ(file.labels[1].label.name, "white matter");
}

TEST_F(Probabilities, WhatIsLeftIsBackground)
{
  const auto map = this->Read({ this->Write("a.nii", { { 0.3f, 0.6f } }), this->Write("b.nii", { { 0.2f, 0.0f } }) });
  ASSERT_EQ(map.labels.size(), 1u);
  EXPECT_EQ(map.labels[0].label.value, 1);
  EXPECT_EQ(map.labels[0].numberOfVoxels, 60u);
}

TEST_F(Probabilities, AreRefusedWithASentence)
{
  const fs::path good = this->Write("good.nii", { { 0.3f, 0.6f } });
  const fs::path shifted = this->Write("shifted.nii", { { 0.3f, 0.6f } }, 1.0, 0.5);
  EXPECT_EQ(this->KindOf({ good, shifted }, "shifted.nii"), FailureKind::Geometry);
  EXPECT_EQ(this->KindOf({ this->Write("hounsfield.nii", { { -900.0f, 40.0f } }) },
                         "no probabilities: their values are from -900 to 40 and"),
            FailureKind::Unreadable);
  EXPECT_EQ(this->KindOf({ good, m_Folder / "none.nii" }, "none.nii"), FailureKind::NotFound);
}

} // namespace
