#include "rhombicCompareLabels.h"

#include "rhombicFailure.h"
#include "rhombicLabelScan.h"
#include "rhombicReadScan.h"
#include "rhombicScanWriter.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>
#include <vnl/vnl_det.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

namespace
{

namespace fs = std::filesystem;
using rhombic::AgreementStatus;
using rhombic::CompareLabelsSettings;
using rhombic::FailureKind;
using rhombic::LabelAgreement;
using rhombictest::At;
using rhombictest::Ball;
using rhombictest::LabelFunction;
using rhombictest::LabelGrid;
using rhombictest::MakeLabelScan;
using rhombictest::TemporaryFolder;
using PointType = itk::Point<double, 3>;

/** \class CompareLabels
 * \brief Two label maps in files, which are compared. */
class CompareLabels : public testing::Test
{
protected:
  void
  Write(const std::string & name, const LabelGrid & grid, const LabelFunction & label) const
  {
    rhombic::WriteScan(MakeLabelScan(grid, label).image, this->PathOf(name));
  }

  void
  WriteText(const std::string & name, const std::string & text) const
  {
    std::ofstream(this->PathOf(name)) << text;
  }

  fs::path
  PathOf(const std::string & name) const
  {
    return m_Folder.Path() / name;
  }

  CompareLabelsSettings
  SettingsFor(const std::string & first, const std::string & second) const
  {
    CompareLabelsSettings settings;
    settings.first.path = this->PathOf(first);
    settings.second.path = this->PathOf(second);
    settings.provenance.writesSidecars = false;
    return settings;
  }

  std::vector<LabelAgreement>
  Run(const CompareLabelsSettings & settings)
  {
    m_Notes.clear();
    rhombic::Events events;
    events.note = [this](const std::string & line) { m_Notes += line + '\n'; };
    std::vector<rhombic::MadeFile> made;
    return rhombic::CompareLabels(settings, events, made);
  }

  /** Expects a failure whose sentence holds a word. */
  void
  ExpectFailure(const CompareLabelsSettings & settings, FailureKind kind, const std::string & word)
  {
    try
    {
      this->Run(settings);
      ADD_FAILURE() << "no failure with " << word;
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), kind) << failure.GetDescription();
      EXPECT_NE(std::string(failure.GetDescription()).find(word), std::string::npos) << failure.GetDescription();
    }
  }

  TemporaryFolder m_Folder;
  std::string m_Notes;
};

const LabelGrid Cubes{ { { 48, 48, 48 } }, { 1.0, 1.0, 1.0 } };
const LabelGrid Slabs{ { { 60, 60, 16 } }, { 0.8, 0.8, 3.0 } };
const LabelGrid Thick{ { { 68, 68, 10 } }, { 0.7, 0.7, 5.0 } };

/** Limits of pairs of balls of 20 and 21 mm, of which every distance is 1 mm: of the means over several places of the
 * balls in the grid. At some places the voxels of the larger ball reach a slice more: there the voxels themselves, and
 * so the surfaces, are a slice apart. */
struct BallLimits
{
  const char * name;
  LabelGrid grid;
  double mean;   ///< largest error of the mean distance, in mm
  double common; ///< largest error of HD95, in mm
  double wide;   ///< least NSD at 1.1 mm
  double narrow; ///< largest NSD at 0.9 mm
};

class ConcentricBalls
  : public CompareLabels
  , public testing::WithParamInterface<BallLimits>
{};

INSTANTIATE_TEST_SUITE_P(CompareLabels,
                         ConcentricBalls,
                         testing::Values(BallLimits{ "cubes", Cubes, 0.02, 0.10, 0.96, 0.05 },
                                         BallLimits{ "slabs", Slabs, 0.04, 0.15, 0.92, 0.13 },
                                         BallLimits{ "thick", Thick, 0.04, 0.60, 0.86, 0.15 }),
                         [](const auto & limits) { return limits.param.name; });

TEST_P(ConcentricBalls, AreAMillimetreApart)
{
  const BallLimits & limits = GetParam();
  constexpr int places = 6;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-0.5, 0.5); // of a voxel
  double mean = 0.0, common = 0.0, wide = 0.0, narrow = 0.0;
  for (int place = 0; place < places; ++place)
  {
    const auto & spacing = limits.grid.spacing;
    const PointType centre = At(part(random) * spacing[0], part(random) * spacing[1], part(random) * spacing[2]);
    this->Write("a.nrrd", limits.grid, Ball(20.0, centre));
    this->Write("b.nrrd", limits.grid, Ball(21.0, centre));
    CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
    settings.tolerances = { { "*", 1.1 } };
    const LabelAgreement atWide = this->Run(settings).at(0);
    settings.tolerances = { { "*", 0.9 } };
    const LabelAgreement atNarrow = this->Run(settings).at(0);
    mean += atWide.surfaces.meanOfMeans / places;
    common += atWide.surfaces.hausdorff95 / places;
    wide += atWide.surfaces.normalizedDice / places;
    narrow += atNarrow.surfaces.normalizedDice / places;
    EXPECT_NEAR(atWide.surfaces.pooledMean, atWide.surfaces.meanOfMeans, 0.01);

    if (place > 0)
    {
      continue;
    }
    const LabelAgreement exchanged = this
                                       ->Run([&] {
                                         std::swap(settings.first.path, settings.second.path);
                                         settings.tolerances = { { "*", 1.1 } };
                                         return settings;
                                       }())
                                       .at(0);
    EXPECT_NEAR(exchanged.surfaces.meanOfMeans, atWide.surfaces.meanOfMeans, 0.005);
    EXPECT_NEAR(exchanged.surfaces.hausdorff, atWide.surfaces.hausdorff, 0.005);
    EXPECT_NEAR(exchanged.surfaces.hausdorff95, atWide.surfaces.hausdorff95, 0.005);
    EXPECT_NEAR(exchanged.surfaces.normalizedDice, atWide.surfaces.normalizedDice, 0.005);
    EXPECT_NEAR(*exchanged.dice, *atWide.dice, 1e-12);
    EXPECT_EQ(exchanged.first.millilitres, atWide.second.millilitres);
    EXPECT_NE(exchanged.surfaces.worstSide, atWide.surfaces.worstSide);
  }
  EXPECT_NEAR(mean, 1.0, limits.mean);
  EXPECT_NEAR(common, 1.0, limits.common);
  EXPECT_GE(wide, limits.wide);
  EXPECT_LE(narrow, limits.narrow);
  std::cout << limits.name << ": MASD " << mean << ", HD95 " << common << ", NSD " << wide << " and " << narrow << '\n';
}

/** The axes of the grid in each order and each direction that is right-handed. */
TEST_F(CompareLabels, AxesInAnyOrderGiveTheSameTable)
{
  const std::array<std::array<unsigned int, 3>, 6> orders{
    { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } }
  };
  std::optional<LabelAgreement> before;
  for (const auto & order : orders)
  {
    for (unsigned int flips = 0; flips < 8; ++flips)
    {
      LabelGrid grid{ {}, {}, Thick.middle };
      grid.direction.Fill(0.0);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        grid.size[order[axis]] = Thick.size[axis];
        grid.spacing[order[axis]] = Thick.spacing[axis];
        grid.direction[axis][order[axis]] = (flips >> axis & 1u) != 0 ? -1.0 : 1.0;
      }
      if (vnl_det(grid.direction.GetVnlMatrix()) < 0.0)
      {
        continue;
      }
      this->Write("a.nrrd", grid, Ball(20.0));
      this->Write("b.nrrd", grid, Ball(21.0, At(0.5, 0.0, 0.0)));
      const LabelAgreement found = this->Run(this->SettingsFor("a.nrrd", "b.nrrd")).at(0);
      before = before ? before : found;
      EXPECT_NEAR(*found.dice, *before->dice, 1e-12);
      EXPECT_NEAR(found.surfaces.meanOfMeans, before->surfaces.meanOfMeans, 0.005);
      EXPECT_NEAR(found.surfaces.hausdorff95, before->surfaces.hausdorff95, 0.02);
      EXPECT_NEAR(found.surfaces.normalizedDice, before->surfaces.normalizedDice, 0.01);
      EXPECT_NEAR(*found.centroidShift, *before->centroidShift, 1e-6);
    }
  }
}

TEST_F(CompareLabels, AMapAgreesWithItself)
{
  this->Write("a.nrrd", Slabs, [](const PointType & point) {
    return Ball(10.0)(point) != 0 ? 1 : Ball(6.0, At(15.0, 0.0, 0.0))(point) != 0 ? 5 : 0;
  });
  for (const bool takesVoxels : { false, true })
  {
    CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "a.nrrd");
    settings.takesVoxelSurfaces = takesVoxels;
    const auto found = this->Run(settings);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].label, "label 5");
    for (const LabelAgreement & label : found)
    {
      EXPECT_EQ(label.dice, 1.0);
      EXPECT_EQ(label.iou, 1.0);
      EXPECT_EQ(label.surfaces.hausdorff, 0.0);
      EXPECT_EQ(label.surfaces.normalizedDice, 1.0);
      EXPECT_EQ(label.centroidShift, 0.0);
      EXPECT_EQ(label.first.millilitres, label.second.millilitres);
      EXPECT_EQ(label.noiseFloor.has_value(), !takesVoxels);
    }
  }
}

/** A ball that is moved, and a transform of points that says so: B's surface comes back to A's place. */
TEST_F(CompareLabels, TransformsBringBToA)
{
  const double angle = 0.3;
  const double c = std::cos(angle), s = std::sin(angle);
  const PointType inA = At(4.0, -6.0, 3.0);
  const PointType inB = At(c * inA[0] - s * inA[1] + 20.0, s * inA[0] + c * inA[1], inA[2] - 5.0); // turned, then moved
  LabelGrid gridOfB = Cubes;
  gridOfB.middle = At(20.0, 0.0, -5.0);
  this->Write("a.nrrd", Cubes, Ball(12.0, inA));
  this->Write("b.nrrd", gridOfB, Ball(12.0, inB));
  std::ostringstream transform;
  transform << "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters: " << c
            << ' ' << -s << " 0 " << s << ' ' << c << " 0 0 0 1 20 0 -5\nFixedParameters: 0 0 0\n";
  this->WriteText("a-to-b.tfm", transform.str());
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  EXPECT_GT(this->Run(settings).at(0).surfaces.hausdorff, 10.0);
  settings.transform = this->PathOf("a-to-b.tfm");
  const LabelAgreement there = this->Run(settings).at(0);
  EXPECT_GT(*there.dice, 0.95);
  EXPECT_LT(there.surfaces.meanOfMeans, 0.06);
  EXPECT_LT(*there.centroidShift, 0.05);

  CompareLabelsSettings back = this->SettingsFor("b.nrrd", "a.nrrd");
  back.transform = settings.transform;
  back.isTransformInverted = true;
  const LabelAgreement andBack = this->Run(back).at(0);
  EXPECT_NEAR(andBack.surfaces.meanOfMeans, there.surfaces.meanOfMeans, 0.005);
  EXPECT_GT(*andBack.dice, 0.95);
}

TEST_F(CompareLabels, MissingLabelsAreNoNumbers)
{
  const LabelFunction one = Ball(8.0);
  this->Write("a.nrrd", Cubes, [&](const PointType & p) { return one(p) != 0 ? 1 : Ball(4.0, At(15.0, 0, 0))(p) * 2; });
  this->Write(
    "b.nrrd", Cubes, [&](const PointType & p) { return one(p) != 0 ? 1 : Ball(4.0, At(-15.0, 0, 0))(p) * 3; });
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  settings.table = this->PathOf("table.csv");
  const auto found = this->Run(settings);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].status, AgreementStatus::Compared);
  EXPECT_EQ(found[1].status, AgreementStatus::MissingInSecond);
  EXPECT_EQ(found[2].status, AgreementStatus::MissingInFirst);
  EXPECT_EQ(found[2].dice, 0.0);
  std::ifstream file(settings.table);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
  {
    lines.push_back(line);
  }
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_NE(lines[2].find("\"label 2\",\"missing-in-B\""), std::string::npos) << lines[2];
  EXPECT_NE(lines[2].find(",0.0,0.0,n/a,n/a,n/a,n/a,0.0,"), std::string::npos)
    << "Dice, IoU, HD to ASSD, NSD: " << lines[2];
  EXPECT_NE(lines[4].find("\"mean\",\"1 compared, 1 missing-in-A, 1 missing-in-B\""), std::string::npos) << lines[4];
  EXPECT_NE(lines[4].find(",0.3333333333333333,"), std::string::npos) << "Dice of three labels: " << lines[4];
}

TEST_F(CompareLabels, LabelsArePairedByNameOrAsAsked)
{
  const auto map = [](int one, int two) -> LabelFunction {
    return [=](const PointType & p) {
      return Ball(6.0, At(-12.0, 0, 0))(p) != 0 ? one : Ball(6.0, At(12.0, 0, 0))(p) * two;
    };
  };
  this->Write("a.nrrd", Cubes, map(1, 2));
  this->Write("b.nrrd", Cubes, map(2, 1));
  this->WriteText("a.tsv", "index\tname\n1\tliver\n2\tspleen\n");
  this->WriteText("b.tsv", "index\tname\n2\tliver\n1\tspleen\n");
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  for (const LabelAgreement & label : this->Run(settings))
  {
    EXPECT_EQ(label.dice, 1.0) << label.label;
  }
  settings.pairsByValue = true;
  EXPECT_EQ(this->Run(settings).at(0).dice, 0.0);
  settings.pairsByValue = false;
  settings.only = { "spl*" };
  ASSERT_EQ(this->Run(settings).size(), 1u);
  settings.only = { "kidney" };
  this->ExpectFailure(settings, FailureKind::Usage, "kidney");

  settings.only.clear();
  this->WriteText("b.tsv", "index\tname\n2\tLeber\n1\tMilz\n");
  this->ExpectFailure(settings, FailureKind::Usage, "no label in common: A has liver and spleen, B has Milz and Leber");
  settings.pairs = { { "spleen", "Milz" } };
  const auto pairs = this->Run(settings);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].label, "spleen");
  EXPECT_EQ(pairs[0].dice, 1.0);
  EXPECT_EQ(pairs[1].status, AgreementStatus::MissingInSecond);
  settings.pairs = { { "splen", "Mils" } };
  this->ExpectFailure(settings, FailureKind::Usage, "did you mean spleen?");

  settings.pairs.clear();
  fs::remove(this->PathOf("b.tsv"));
  this->ExpectFailure(settings, FailureKind::Usage, "--by-value");
}

TEST_F(CompareLabels, EmptyMapsAndMasks)
{
  this->Write("full.nrrd", Cubes, Ball(8.0));
  this->Write("byte.nrrd", Cubes, [](const PointType & p) { return Ball(8.0)(p) * 255; });
  this->Write("empty.nrrd", Cubes, [](const PointType &) { return 0; });
  EXPECT_EQ(this->Run(this->SettingsFor("full.nrrd", "byte.nrrd")).at(0).dice, 1.0);
  EXPECT_EQ(this->Run(this->SettingsFor("full.nrrd", "empty.nrrd")).at(0).status, AgreementStatus::MissingInSecond);
  EXPECT_EQ(this->Run(this->SettingsFor("empty.nrrd", "full.nrrd")).at(0).status, AgreementStatus::MissingInFirst);
  const LabelAgreement none = this->Run(this->SettingsFor("empty.nrrd", "empty.nrrd")).at(0);
  EXPECT_EQ(none.status, AgreementStatus::BothEmpty);
  EXPECT_EQ(none.dice, 1.0);
}

TEST_F(CompareLabels, PlacesThatCannotBeCompared)
{
  LabelGrid far = Cubes;
  far.middle = At(100.0, 0.0, 0.0);
  this->Write("a.nrrd", Cubes, Ball(8.0));
  this->Write("far.nrrd", far, Ball(8.0, far.middle));
  this->ExpectFailure(this->SettingsFor("a.nrrd", "far.nrrd"), FailureKind::Geometry, "52 mm apart");

  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "a.nrrd");
  settings.transform = this->PathOf("none.tfm");
  this->ExpectFailure(settings, FailureKind::NotFound, "none.tfm");
  settings.transform = this->PathOf("bends.tfm");
  std::string zeros;
  for (int n = 0; n < 3 * 64; ++n)
  {
    zeros += " 0";
  }
  this->WriteText("bends.tfm",
                  "#Insight Transform File V1.0\nTransform: BSplineTransform_double_3_3\nParameters:" + zeros +
                    "\nFixedParameters: 4 4 4 0 0 0 1 1 1 1 0 0 0 1 0 0 0 1\n");
  this->ExpectFailure(settings, FailureKind::Unreadable, "bends");
  this->WriteText("bends.tfm", "no transform\n");
  this->ExpectFailure(settings, FailureKind::Unreadable, "bends.tfm");
  this->WriteText(
    "bends.tfm",
    "#Insight Transform File V1.0\nTransform: AffineTransform_double_3_3\nParameters: 1 0 0 0 1 0 0 0 0 0 0 "
    "0\nFixedParameters: 0 0 0\n");
  this->ExpectFailure(settings, FailureKind::Unreadable, "cannot be inverted");
  settings = this->SettingsFor("a.nrrd", "a.nrrd");
  settings.tolerances = { { "liver", 2.0 } };
  this->ExpectFailure(settings, FailureKind::Usage, "tolerances");
}

TEST_F(CompareLabels, TransformsWithOtherParametersThanTheirsAreRefused)
{
  this->Write("a.nrrd", Cubes, Ball(8.0));
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "a.nrrd");
  settings.transform = this->PathOf("wrong.tfm");
  const std::string affine = "Transform: AffineTransform_double_3_3\n";
  const std::string numbers = "Parameters: 1 0 0 0 1 0 0 0 1 0 0 0\n";
  const std::string centre = "FixedParameters: 0 0 0\n";
  for (const auto & [text, words] :
       { std::pair{ affine + "Parameters: 1 0 0\n" + centre, "3 parameters" },
         { affine + numbers, "0 fixed" },
         { affine + centre, "0 parameters" },
         { numbers + centre, "no transform" },
         { "Transform: Euler3DTransform_double_3_3\nParameters: 0 0 0\nFixedParameters: 0 0 0 0\n", "3 parameters" },
         { "Transform: NoSuchTransform_double_3_3\n" + numbers + centre, "NoSuchTransform" },
         { "Transform: AffineTransform_double_2_2\nParameters: 1 0 0 1 0 0\nFixedParameters: 0 0\n", "3-D" },
         { affine + "Parameters: 1 0 0 0 1 0 0 0 1 0 0 nan\n" + centre, "nan" },
         { affine + "Parameters: 1 0 0 0 1 0 0 0 1 0 0 x\n" + centre, "x" },
         { affine + numbers + centre + affine + numbers + centre, "several" } })
  {
    this->WriteText("wrong.tfm", text);
    this->ExpectFailure(settings, FailureKind::Unreadable, words);
  }
  this->WriteText("wrong.tfm", "Transform: Euler3DTransform_double_3_3\nParameters: 0 0 0 0 0 0\n" + centre);
  EXPECT_EQ(this->Run(settings).size(), 1u);
  this->WriteText("wrong.tfm", "Transform: AffineTransform_float_3_3\n" + numbers + centre);
  EXPECT_EQ(this->Run(settings).size(), 1u);
}

TEST_F(CompareLabels, MirroredMapsAreDoubted)
{
  const auto organs = [](double side) -> LabelFunction {
    return [=](const PointType & p) {
      return Ball(4.0, At(side * 15.0, 2.0, 1.0))(p) * 1 + Ball(3.0, At(side * -13.0, -4.0, 10.0))(p) * 2 +
             Ball(3.0, At(side * 12.0, 9.0, -12.0))(p) * 3 + Ball(2.5, At(side * -12.0, 3.0, -9.0))(p) * 4;
    };
  };
  this->Write("a.nrrd", Cubes, organs(1.0));
  this->Write("b.nrrd", Cubes, organs(-1.0));
  this->Run(this->SettingsFor("a.nrrd", "b.nrrd"));
  EXPECT_NE(m_Notes.find("mirrored from left to right"), std::string::npos) << m_Notes;
  this->Run(this->SettingsFor("a.nrrd", "a.nrrd"));
  EXPECT_EQ(m_Notes.find("warning"), std::string::npos) << m_Notes;
  LabelGrid shifted = Cubes;
  shifted.middle = At(0.0, 14.0, 0.0);
  this->Write(
    "c.nrrd", shifted, [&](const PointType & p) { return organs(1.0)(p - At(0.0, 14.0, 0.0).GetVectorFromOrigin()); });
  this->Run(this->SettingsFor("a.nrrd", "c.nrrd"));
  EXPECT_NE(m_Notes.find("14 mm beside those of A"), std::string::npos) << m_Notes;
}

TEST_F(CompareLabels, GrowthOfALesion)
{
  EXPECT_EQ(rhombic::CountDays("2024-02-28", "2024-03-01"), 2.0) << "2024 has a 29th of February";
  EXPECT_EQ(rhombic::CountDays("2023-12-31", "2025-01-01"), 367.0);
  for (const auto & [first, second] : { std::pair{ "2025-01-03", "2025-01-03" },
                                        { "2025-01-03", "2024-01-03" },
                                        { "2025-02-30", "2026-01-01" },
                                        { "03.01.2025", "2026-01-01" },
                                        { "2025-01-03", "2026-01-10x" } })
  {
    EXPECT_THROW(rhombic::CountDays(first, second), rhombic::Failure) << first << ' ' << second;
  }
  this->Write("a.nrrd", Cubes, Ball(8.0));
  this->Write("b.nrrd", Cubes, Ball(8.0 * std::cbrt(2.0)));
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  settings.days = 100.0;
  settings.table = this->PathOf("table.tsv");
  const LabelAgreement found = this->Run(settings).at(0);
  std::ifstream file(settings.table);
  std::string heading, row;
  std::getline(file, heading);
  std::getline(file, row);
  const auto fieldOf = [&](const std::string & column) {
    std::istringstream names(heading), values(row);
    std::string name, value;
    while (std::getline(names, name, '\t') && std::getline(values, value, '\t') && name != column)
    {}
    return std::stod(value);
  };
  EXPECT_NEAR(fieldOf("doubling_time_days"), 100.0, 3.0);
  EXPECT_NEAR(fieldOf("growth_ml_per_year"), found.first.millilitres * 3.6525, 0.3);
  std::swap(settings.first.path, settings.second.path);
  this->Run(settings);
  EXPECT_THROW((file = std::ifstream(settings.table),
                std::getline(file, heading),
                std::getline(file, row),
                fieldOf("doubling_time_days")),
               std::invalid_argument)
    << "a lesion that shrinks does not double";
}

/** Lesions along a row, as intervals of x in mm: label 1 among organs of label 2. */
LabelFunction
LesionsAt(const std::vector<std::pair<double, double>> & intervals)
{
  return [=](const PointType & p) {
    const bool isInRow = std::abs(p[1]) <= 3.0 && std::abs(p[2]) <= 3.0;
    const bool isInLesion = isInRow && std::any_of(intervals.begin(), intervals.end(), [&](const auto & interval) {
                              return p[0] >= interval.first && p[0] <= interval.second;
                            });
    return isInLesion ? 1 : p[1] > 10.0 && p[1] < 16.0 && std::abs(p[0]) < 15.0 && std::abs(p[2]) < 12.0 ? 2 : 0;
  };
}

/** A lesion that goes, two that merge, one that splits, one that is kept and one that is new. */
TEST_F(CompareLabels, PartsAreFollowed)
{
  this->Write("a.nrrd", Cubes, LesionsAt({ { -22, -19 }, { -15, -13 }, { -11, -8 }, { -4, 6 }, { 10, 14 } }));
  this->Write("b.nrrd", Cubes, LesionsAt({ { -15, -8 }, { -4, -1 }, { 3, 6 }, { 10, 15 }, { 19, 22 } }));
  this->WriteText("a.tsv", "index\tname\n1\tlesion\n2\tliver\n");
  this->WriteText("b.tsv", "index\tname\n1\tlesion\n2\tliver\n");
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  settings.parts = { "les*" };
  settings.tolerances = { { "*", 1.0 }, { "lesion", 3.0 } };
  settings.table = this->PathOf("table.tsv");
  const auto found = this->Run(settings);
  struct Expected
  {
    const char * label;
    std::size_t partsOfFirst, partsOfSecond;
    double lengthInFirst, lengthInSecond; // of the voxels in mm; half a voxel more at both ends
  };
  // Voxels' centres are at halves, so an interval from -4 to 6 has ten voxels; the largest of A come first.
  const Expected expected[] = { { "lesion 1", 1, 2, 10, 6 },
                                { "lesion 2", 2, 1, 5, 7 },
                                { "lesion 3", 1, 1, 4, 5 },
                                { "lesion 4", 1, 0, 3, 0 },
                                { "lesion 5", 0, 1, 0, 3 } };
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t n = 0; n < 5; ++n)
  {
    const Expected & part = expected[n];
    EXPECT_EQ(found[n].label, part.label);
    ASSERT_TRUE(found[n].change.has_value());
    EXPECT_EQ(found[n].change->partsOfFirst, part.partsOfFirst) << part.label;
    EXPECT_EQ(found[n].change->partsOfSecond, part.partsOfSecond) << part.label;
    EXPECT_NEAR(*found[n].first.voxelMillilitres, 0.036 * part.lengthInFirst, 1e-9) << part.label;
    EXPECT_NEAR(*found[n].second.voxelMillilitres, 0.036 * part.lengthInSecond, 1e-9) << part.label;
    EXPECT_EQ(found[n].tolerance, 3.0);
  }
  EXPECT_EQ(found[5].label, "liver");
  EXPECT_FALSE(found[5].change.has_value());
  EXPECT_EQ(found[5].dice, 1.0);
  std::ifstream file(settings.table);
  std::string text{ std::istreambuf_iterator<char>(file), {} };
  for (const char * const words :
       { "\tsplit\t1\t2\n", "\tmerged\t2\t1\n", "\tkept\t1\t1\n", "\tgone\t1\t0\n", "\tnew\t0\t1\n" })
  {
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }

  settings.first.lattice.maximumMemory = 800'000; // the numbers of parts have 4 bytes a voxel
  this->ExpectFailure(settings, FailureKind::Memory, "parts of labels");
  settings.first.lattice.maximumMemory = 0;
  settings.parts = { "lesoin" };
  this->ExpectFailure(settings, FailureKind::Usage, "did you mean lesion?");
  settings.parts = { "lesion" };
  std::mt19937 random(3);
  this->Write("a.nrrd", Cubes, [&](const PointType & p) { return p[1] > 0.0 ? 2 : random() % 40 == 0 ? 1 : 0; });
  this->ExpectFailure(settings, FailureKind::Usage, "at most 1000");
}

TEST_F(CompareLabels, VoxelMetricsAreColumnsOfTheirOwn)
{
  this->Write("a.nrrd", Cubes, Ball(8.0));
  this->Write("b.nrrd", Cubes, Ball(9.0));
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  settings.hasVoxelMetrics = true;
  settings.table = this->PathOf("table.csv");
  const auto found = this->Run(settings).at(0);
  ASSERT_TRUE(found.voxels.has_value());
  EXPECT_NEAR(found.voxels->meanToFirst, 1.0, 0.4);
  std::ifstream file(settings.table);
  std::string heading;
  std::getline(file, heading);
  EXPECT_NE(
    heading.find("deepmind_mean_a_to_b_mm,deepmind_mean_b_to_a_mm,deepmind_hd_mm,deepmind_hd95_mm,deepmind_nsd"),
    std::string::npos)
    << heading;
  EXPECT_EQ(heading.find("change"), std::string::npos);
  this->Write("b.nrrd", Slabs, Ball(9.0));
  this->ExpectFailure(settings, FailureKind::Usage, "on one grid");
  settings.kind = rhombic::ComparedKind::Surfaces;
  this->ExpectFailure(settings, FailureKind::Usage, "--voxel-metrics");
}

TEST_F(CompareLabels, MistakesAreNotTakenForResults)
{
  const auto map = [](int one, int two) -> LabelFunction {
    return [=](const PointType & p) {
      return Ball(6.0, At(-12.0, 0, 0))(p) != 0 ? one : Ball(6.0, At(12.0, 0, 0))(p) * two;
    };
  };
  this->Write("a.nrrd", Cubes, map(1, 2));
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "a.nrrd");
  settings.hidden = { "*" };
  this->ExpectFailure(settings, FailureKind::Usage, "No label is left");
  settings = this->SettingsFor("a.nrrd", "a.nrrd");
  settings.pairs = { { "1", "1" }, { "1", "2" } };
  this->ExpectFailure(settings, FailureKind::Usage, "two pairs");
  settings.pairs = { { "1", "7" } };
  this->Run(settings);
  EXPECT_NE(m_Notes.find("warning: B has no label 7"), std::string::npos) << m_Notes;

  this->WriteText("a.tsv", "index\tname\n1\tlesion\n2\tlesion\n");
  settings.pairs.clear();
  this->ExpectFailure(settings, FailureKind::Usage, "called lesion");
  settings.pairsByValue = true;
  EXPECT_EQ(this->Run(settings).size(), 2u);
  settings.table = this->PathOf("a.tsv");
  this->ExpectFailure(settings, FailureKind::Usage, "is the input itself");

  this->WriteText(
    "mirror.tfm",
    "#Insight Transform File V1.0\nTransform: AffineTransform_double_3_3\nParameters: -1 0 0 0 1 0 0 0 1 0 0 "
    "0\nFixedParameters: 0 0 0\n");
  settings.table.clear();
  settings.transform = this->PathOf("mirror.tfm");
  this->ExpectFailure(settings, FailureKind::Usage, "mirrors");
}

/** The walls of a label depend on the labels beside it, and not on which ones are compared. */
TEST_F(CompareLabels, RowsDoNotDependOnWhichLabelsAreChosen)
{
  const auto map = [](double shift) -> LabelFunction {
    return [=](const PointType & p) {
      return Ball(7.0, At(-8.0 + shift, 0, 0))(p) != 0 ? 1 : Ball(8.0, At(7.5, 0, 0))(p) * 2;
    };
  };
  this->Write("a.nrrd", Cubes, map(0.0));
  this->Write("b.nrrd", Cubes, map(1.0));
  CompareLabelsSettings settings = this->SettingsFor("a.nrrd", "b.nrrd");
  const LabelAgreement amongAll = this->Run(settings).at(0);
  settings.only = { "label 1" };
  const LabelAgreement alone = this->Run(settings).at(0);
  EXPECT_EQ(amongAll.surfaces.hausdorff, alone.surfaces.hausdorff);
  EXPECT_EQ(amongAll.surfaces.pooledMean, alone.surfaces.pooledMean);
}

TEST_F(CompareLabels, LabelsBeyondTheGridOfAAreSaid)
{
  LabelGrid half = Cubes;
  half.size[0] = 24;
  half.middle = At(-12.0, 0.0, 0.0);
  this->Write("half.nrrd", half, Ball(10.0));
  this->Write("whole.nrrd", Cubes, Ball(10.0));
  this->Run(this->SettingsFor("half.nrrd", "whole.nrrd"));
  EXPECT_NE(m_Notes.find("lie outside of A's grid"), std::string::npos) << m_Notes;
  this->Run(this->SettingsFor("whole.nrrd", "half.nrrd"));
  EXPECT_EQ(m_Notes.find("lie outside of A's grid"), std::string::npos) << m_Notes;
}

/** A map of a real scan against itself moved by a voxel. */
TEST_F(CompareLabels, OneVoxelOfARealMap)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  const fs::path path = fs::path(scans != nullptr ? scans : "") / "ct_body_totalseg_nifti/example_seg.nii.gz";
  if (scans == nullptr || !fs::exists(path))
  {
    GTEST_SKIP() << "RHOMBIC_SCANS names no folder with " << path.filename();
  }
  const rhombic::Scan scan = rhombic::ReadScan(path);
  double step = 0.0;
  std::visit(
    [&](const auto & image) {
      const auto moved = std::decay_t<decltype(*image)>::New();
      moved->Graft(image);
      itk::Index<3> next{};
      next[1] = 1;
      const auto origin = image->template TransformIndexToPhysicalPoint<double>(next);
      step = origin.EuclideanDistanceTo(image->GetOrigin());
      moved->SetOrigin(origin);
      rhombic::WriteScan(typename std::decay_t<decltype(*image)>::Pointer(moved), this->PathOf("moved.nii.gz"));
    },
    scan.image);
  CompareLabelsSettings settings = this->SettingsFor("", "moved.nii.gz");
  settings.first.path = path;
  settings.pairsByValue = true;
  const auto found = this->Run(settings);
  EXPECT_GT(found.size(), 20u);
  for (const LabelAgreement & label : found)
  {
    EXPECT_NEAR(*label.centroidShift, step, 1e-3) << label.label;
    EXPECT_LE(label.surfaces.hausdorff, step + 0.01) << label.label;
    EXPECT_NEAR(label.first.millilitres, label.second.millilitres, 1e-3 * label.first.millilitres) << label.label;
  }
}

} // namespace
