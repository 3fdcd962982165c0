#include "rhombicFailure.h"
#include "rhombicPhantom.h"
#include "rhombicPhantomAnatomy.h"

#include "itkGDCMImageIO.h"
#include "itkGDCMSeriesFileNames.h"
#include "itkImageFileReader.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageSeriesReader.h"
#include "itkMultiThreaderBase.h"
#include "itkNiftiImageIO.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using namespace rhombic;

const PhantomOrgan &
Organ(int label)
{
  return PhantomOrgans().at(static_cast<std::size_t>(label) - 1);
}

/** Calls \a function with points spread evenly over a solid's box. */
template <typename TFunction>
void
ForRandomPoints(const PhantomBounds & bounds, int count, const TFunction & function)
{
  std::mt19937 generator;
  const auto random = [&generator] { return generator() / 4294967296.0; };
  for (int i = 0; i < count; ++i)
  {
    PhantomPoint point;
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      point[axis] = bounds.low[axis] + (bounds.high[axis] - bounds.low[axis]) * random();
    }
    function(point);
  }
}

bool
IsIn(const PhantomBounds & bounds, const PhantomPoint & point)
{
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    if (point[axis] < bounds.low[axis] || point[axis] > bounds.high[axis])
    {
      return false;
    }
  }
  return true;
}

double
VolumeOf(const PhantomBounds & bounds)
{
  double volume = 1.0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    volume *= bounds.high[axis] - bounds.low[axis];
  }
  return volume;
}

/** The volume of a solid by the lengths of its spans on a fine grid of lines. */
double
MeasureVolume(const PhantomSolid & solid, int lines)
{
  const PhantomBounds bounds = solid.bounds;
  const unsigned u = (solid.axis + 1) % 3;
  const unsigned v = (solid.axis + 2) % 3;
  const double du = (bounds.high[u] - bounds.low[u]) / lines;
  const double dv = (bounds.high[v] - bounds.low[v]) / lines;
  double length = 0.0;
  for (int i = 0; i < lines; ++i)
  {
    for (int j = 0; j < lines; ++j)
    {
      PhantomPoint point{};
      point[u] = bounds.low[u] + (i + 0.5) * du;
      point[v] = bounds.low[v] + (j + 0.5) * dv;
      const PhantomSpan span = solid.spanAt(point);
      length += std::max(0.0, span.last - span.first);
    }
  }
  return length * du * dv;
}

bool
IsAncestor(int ancestor, int part)
{
  for (; part != PhantomPart::None; part = PhantomParts()[static_cast<std::size_t>(part)].parent)
  {
    if (part == ancestor)
    {
      return true;
    }
  }
  return false;
}

template <typename TImage>
bool
HaveSameVoxels(const TImage & a, const TImage & b)
{
  const auto count = a.GetLargestPossibleRegion().GetNumberOfPixels();
  return a.GetLargestPossibleRegion() == b.GetLargestPossibleRegion() &&
         std::equal(a.GetBufferPointer(), a.GetBufferPointer() + count, b.GetBufferPointer());
}

template <typename TImage>
void
ExpectSameGeometry(const TImage & a, const TImage & b, double tolerance)
{
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(a.GetSpacing()[axis], b.GetSpacing()[axis], tolerance);
    EXPECT_NEAR(a.GetOrigin()[axis], b.GetOrigin()[axis], tolerance);
  }
  EXPECT_EQ(a.GetDirection(), b.GetDirection());
}

/** The centre of mass of an organ in a label image, in millimetres. */
PhantomPoint
CentroidOf(const PhantomLabels & labels, int label)
{
  PhantomPoint sum{};
  double count = 0.0;
  itk::ImageRegionConstIteratorWithIndex<PhantomLabels> it(&labels, labels.GetLargestPossibleRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    if (it.Get() == label)
    {
      PhantomLabels::PointType point;
      labels.TransformIndexToPhysicalPoint(it.GetIndex(), point);
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        sum[axis] += point[axis];
      }
      count += 1.0;
    }
  }
  for (auto & coordinate : sum)
  {
    coordinate /= count;
  }
  return sum;
}

template <typename TImage>
typename TImage::Pointer
ReadNifti(const fs::path & path)
{
  auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetImageIO(itk::NiftiImageIO::New());
  reader->SetFileName(path.string());
  reader->Update();
  return reader->GetOutput();
}

PhantomScan::Pointer
ReadSeries(const fs::path & folder)
{
  auto names = itk::GDCMSeriesFileNames::New();
  names->SetDirectory(folder.string());
  EXPECT_EQ(names->GetSeriesUIDs().size(), 1u);
  auto reader = itk::ImageSeriesReader<PhantomScan>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetInputFileNames());
  reader->Update();
  return reader->GetOutput();
}

/** The bytes of every file under a folder, by its path there. */
std::map<std::string, std::string>
ReadFolder(const fs::path & folder)
{
  std::map<std::string, std::string> files;
  for (const auto & entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      std::ifstream stream(entry.path(), std::ios::binary);
      std::stringstream bytes;
      bytes << stream.rdbuf();
      files[fs::relative(entry.path(), folder).string()] = bytes.str();
    }
  }
  return files;
}

class PhantomFiles : public testing::Test
{
protected:
  void
  SetUp() override
  {
    m_Folder = fs::temp_directory_path() / ("rhombic-phantom-" + std::to_string(getpid()));
    fs::remove_all(m_Folder);
    fs::create_directory(m_Folder);
  }
  void
  TearDown() override
  {
    fs::remove_all(m_Folder);
  }

  fs::path m_Folder;
};

TEST(PhantomSolids, VolumesMatchTheirSpans)
{
  for (std::size_t i = 0; i < PhantomParts().size(); ++i)
  {
    const auto & solid = PhantomParts()[i].solid;
    const double volume = solid.volume;
    EXPECT_NEAR(MeasureVolume(solid, 600), volume, 0.002 * volume) << "part " << i;
  }
}

TEST(PhantomSolids, VolumesMatchRandomPoints)
{
  constexpr int count = 40000;
  for (std::size_t i = 0; i < PhantomParts().size(); ++i)
  {
    const auto & solid = PhantomParts()[i].solid;
    int inside = 0;
    ForRandomPoints(solid.bounds, count, [&](const PhantomPoint & point) { inside += solid.Contains(point); });
    const double share = solid.volume / VolumeOf(solid.bounds);
    EXPECT_NEAR(inside / static_cast<double>(count), share, 5.0 * std::sqrt(share / count)) << "part " << i;
  }
}

TEST(PhantomSolids, ClosedForms)
{
  const double pi = std::acos(-1.0);
  const PhantomSolid turned = MakeEllipsoid({ 1, 2, 3 }, { 4, 5, 6 }, { 10, 20, 30 });
  EXPECT_DOUBLE_EQ(turned.volume, 160.0 * pi);
  EXPECT_NEAR(MeasureVolume(turned, 1000), turned.volume, 1e-3 * turned.volume);
  PhantomLoft loft;
  loft.top = 10.0;
  loft.width = 2.0;
  loft.front = loft.back = 3.0;
  EXPECT_NEAR(MakeLoft(loft).volume, 60.0 * pi, 1e-9) << "a cylinder";
  loft.top = loft.topCap = 5.0;
  loft.width = loft.front = loft.back = 5.0;
  EXPECT_NEAR(MakeLoft(loft).volume, 2.0 / 3.0 * 125.0 * pi, 1e-9) << "half a ball";
  const PhantomSolid ring = MakeHoop({ 0, 20, -10, -0.5, 0.5, 1.5, 2.0, 3.0 });
  EXPECT_NEAR(ring.volume, 200.0 * pi * 1.5 / std::sqrt(200.0) * 2.0 * 8.0 / 9.0, 1e-9);
  EXPECT_TRUE(ring.Contains({ 0, -10, 4.9 }));
  EXPECT_FALSE(ring.Contains({ 0, -10, 5.1 }));
  EXPECT_FALSE(ring.Contains({ 0, 10, 3.0 })) << "mirrored in y";
}

// The area of a cross-section is a polynomial between knots where the exponent does not vary.
TEST(PhantomSolids, LoftsBetweenKnotsAreExact)
{
  PhantomLoft cone;
  cone.top = 30.0;
  cone.width = { { 0, 4 }, { 10, 4 }, { 20, 8 }, { 30, 8 } };
  cone.front = cone.back = 3.0;
  EXPECT_NEAR(MakeLoft(cone).volume, std::acos(-1.0) * 3.0 * (4.0 * 10.0 + 6.0 * 10.0 + 8.0 * 10.0), 1e-9);
}

TEST(PhantomAnatomy, PartsAreNestedOrApart)
{
  const auto & parts = PhantomParts();
  std::vector<PhantomBounds> bounds;
  for (const auto & part : parts)
  {
    bounds.push_back(part.solid.bounds);
  }
  for (int i = 0; i < static_cast<int>(parts.size()); ++i)
  {
    const auto & part = parts[static_cast<std::size_t>(i)];
    ASSERT_LT(part.parent, i);
    const int count = i < 3 ? 300000 : 40000; // the first three are the layers of the whole body
    std::map<int, PhantomPoint> wrong;
    std::vector<bool> ancestors;
    for (int j = 0; j < static_cast<int>(parts.size()); ++j)
    {
      ancestors.push_back(IsAncestor(j, i));
    }
    ForRandomPoints(part.solid.bounds, count, [&](const PhantomPoint & point) {
      if (!part.solid.Contains(point))
      {
        return;
      }
      for (int j = 0; j < static_cast<int>(parts.size()); ++j)
      {
        const auto & other = parts[static_cast<std::size_t>(j)].solid;
        const bool inside = IsIn(bounds[static_cast<std::size_t>(j)], point) && other.Contains(point);
        if (inside != IsAncestor(j, i) && !IsAncestor(i, j))
        {
          wrong[j] = point;
        }
      }
    });
    for (const auto & [j, point] : wrong)
    {
      ADD_FAILURE() << Organ(part.label).name << " (part " << i << ") and "
                    << Organ(parts[static_cast<std::size_t>(j)].label).name << " (part " << j << ") at " << point[0]
                    << ", " << point[1] << ", " << point[2];
    }
  }
}

TEST(PhantomAnatomy, OrgansAreInTheirOrder)
{
  double sum = 0.0;
  double outer = 0.0;
  for (std::size_t i = 0; i < PhantomOrgans().size(); ++i)
  {
    EXPECT_EQ(PhantomOrgans()[i].label, static_cast<int>(i) + 1);
    EXPECT_GT(PhantomOrgans()[i].volume, 0.0);
    sum += PhantomOrgans()[i].volume;
  }
  for (const auto & part : PhantomParts())
  {
    outer += part.parent == PhantomPart::None ? part.solid.volume : 0.0;
  }
  EXPECT_NEAR(sum, outer, 1e-9 * outer);
  EXPECT_EQ(Organ(PhantomMarker).name, "marker");
  EXPECT_EQ(PhantomLabelAt({ 0, 0, 1000 }), PhantomAir);
  EXPECT_EQ(PhantomLabelAt({ 0, 0, 640 }), PhantomBrain);
}

TEST(Phantom, ThresholdsEncloseWhatIsAtLeastAsDense)
{
  const auto bone = PhantomEnclosedBy(250.5);
  EXPECT_EQ(bone.labels,
            (std::vector<int>{
              PhantomSkull, PhantomTeeth, PhantomSpine, PhantomRibs, PhantomShoulders, PhantomPelvis, PhantomMarker }));
  double expected = 0.0;
  for (const int label : bone.labels)
  {
    expected += Organ(label).volume;
  }
  EXPECT_DOUBLE_EQ(bone.volume, expected);

  const auto skin = PhantomEnclosedBy(-300.5);
  EXPECT_EQ(skin.labels.size(), PhantomOrgans().size() - 3) << "all but two lungs and the airway";
  EXPECT_NEAR(skin.volume,
              PhantomEnclosedBy(-999.0).volume - Organ(PhantomLeftLung).volume - Organ(PhantomRightLung).volume,
              1e-3);
  EXPECT_DOUBLE_EQ(PhantomEnclosedBy(2000.0).volume, Organ(PhantomMarker).volume);
  EXPECT_EQ(PhantomEnclosedBy(2000.5).volume, 0.0);
  EXPECT_THROW(PhantomEnclosedBy(-1000.0), Failure);
  EXPECT_THROW(PhantomEnclosedBy(std::nan("")), Failure);
}

TEST(Phantom, LabelsFillTheExactVolumes)
{
  const PhantomSettings settings{ 1.0 };
  const auto labels = MakePhantomLabels(settings);
  std::vector<double> counts(PhantomOrgans().size() + 1, 0.0);
  const auto count = labels->GetLargestPossibleRegion().GetNumberOfPixels();
  std::for_each(
    labels->GetBufferPointer(), labels->GetBufferPointer() + count, [&counts](auto label) { ++counts[label]; });
  for (const auto & organ : PhantomOrgans())
  {
    const double tolerance = organ.volume > 100000.0 ? 0.005 : 0.03; // small organs are all border
    EXPECT_NEAR(counts[static_cast<std::size_t>(organ.label)], organ.volume, tolerance * organ.volume) << organ.name;
  }
}

TEST(Phantom, LabelsAreThoseOfTheVoxelsCentres)
{
  const auto labels = MakePhantomLabels({ 7.3 });
  itk::ImageRegionConstIteratorWithIndex<PhantomLabels> it(labels, labels->GetLargestPossibleRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    PhantomLabels::PointType point;
    labels->TransformIndexToPhysicalPoint(it.GetIndex(), point);
    ASSERT_EQ(it.Get(), PhantomLabelAt({ point[0], point[1], point[2] })) << it.GetIndex();
  }
}

TEST(Phantom, VoxelsKeepTheMassOfTheIdealScan)
{
  double exact = 0.0; // HU mm^3 above air
  for (const auto & organ : PhantomOrgans())
  {
    exact += (organ.hounsfield + 1000.0) * organ.volume;
  }
  for (const double spacing : { 2.0, 3.0, 8.0 })
  {
    const auto scan = MakePhantomScan({ spacing });
    const auto count = scan->GetLargestPossibleRegion().GetNumberOfPixels();
    double mass = 0.0;
    std::for_each(
      scan->GetBufferPointer(), scan->GetBufferPointer() + count, [&mass](auto value) { mass += value + 1000.0; });
    EXPECT_NEAR(mass * spacing * spacing * spacing, exact, 5e-4 * exact) << spacing;
  }
}

TEST(Phantom, VoxelsAwayFromBordersAreExact)
{
  const auto scan = MakePhantomScan({ 2.0 });
  const auto at = [&scan](const PhantomPoint & point) {
    PhantomScan::PointType physical;
    std::copy(point.begin(), point.end(), physical.Begin());
    return scan->GetPixel(scan->TransformPhysicalPointToIndex(physical));
  };
  EXPECT_EQ(at({ -40, -40, 177 }), 60) << "liver";
  EXPECT_EQ(at({ 17, -40, 282 }), 45) << "heart";
  EXPECT_EQ(at({ -69, 0, 280 }), -850) << "right lung";
  EXPECT_EQ(at({ 0, 0, 640 }), 35) << "brain";
  EXPECT_EQ(at({ 0, 30, 550 }), 35) << "brain stem";
  EXPECT_EQ(at({ 200, -120, 500 }), -1000) << "air";
}

TEST(Phantom, IsosurfaceBetweenTwoTissuesIsWhereItShouldBe)
{
  // Along lines from the forehead into the brain: the place of the mean, by linear interpolation between samples.
  constexpr double spacing = 2.0;
  const double mean = 0.5 * (Organ(PhantomSkull).hounsfield + Organ(PhantomBrain).hounsfield);
  const auto scan = MakePhantomScan({ spacing });
  const auto brain = std::find_if(
    PhantomParts().begin(), PhantomParts().end(), [](const auto & part) { return part.label == PhantomBrain; });
  double square = 0.0;
  double sum = 0.0;
  int count = 0;
  itk::ImageRegionConstIteratorWithIndex<PhantomScan> it(scan, scan->GetLargestPossibleRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    PhantomScan::PointType point;
    scan->TransformIndexToPhysicalPoint(it.GetIndex(), point);
    const double surface = brain->solid.spanAt({ point[0], point[1], point[2] }).first;
    if (std::abs(point[0]) < 40.0 && point[2] > 605.0 && point[2] < 660.0 && point[1] < surface &&
        point[1] + spacing >= surface)
    {
      const double skull = it.Get();
      const double inside = scan->GetPixel(it.GetIndex() + PhantomScan::OffsetType{ { 0, 1, 0 } });
      const double error = point[1] + spacing * (skull - mean) / (skull - inside) - surface;
      square += error * error;
      sum += error;
      ++count;
    }
  }
  ASSERT_GT(count, 500);
  EXPECT_LT(std::sqrt(square / count), 0.04 * spacing);
  EXPECT_LT(std::abs(sum / count), 0.03 * spacing);
}

TEST(Phantom, TheLiverIsOnTheRightAndTheHeartOnTheLeft)
{
  const auto labels = MakePhantomLabels({ 4.0 });
  EXPECT_LT(CentroidOf(*labels, PhantomLiver)[0], -30.0);
  EXPECT_GT(CentroidOf(*labels, PhantomHeart)[0], 10.0);
  EXPECT_GT(CentroidOf(*labels, PhantomSpleen)[0], 50.0);
  EXPECT_LT(CentroidOf(*labels, PhantomRightLung)[0], -40.0);
  EXPECT_GT(CentroidOf(*labels, PhantomLeftLung)[0], 40.0);
  EXPECT_GT(CentroidOf(*labels, PhantomSpine)[1], 20.0) << "at the back";
  EXPECT_GT(CentroidOf(*labels, PhantomBrain)[2], CentroidOf(*labels, PhantomHeart)[2] + 250.0);
}

TEST(Phantom, TheMarkerIsAnFOnTheLeftOfTheChest)
{
  const auto labels = MakePhantomLabels({ 2.0 });
  // Seen from the front, with the head up, the patient's left is on the right: columns grow with x, rows with falling
  // z.
  constexpr std::array<const char *, 17> letter{ "FFFFFFFFFFF", "FFFFFFFFFFF", "FFFFFFFFFFF", "FFF........",
                                                 "FFF........", "FFF........", "FFF........", "FFFFFFFF...",
                                                 "FFFFFFFF...", "FFFFFFFF...", "FFF........", "FFF........",
                                                 "FFF........", "FFF........", "FFF........", "FFF........",
                                                 "FFF........" };
  const auto isMarked = [&labels](double x, double z) {
    for (double y = -143.0; y < -60.0; y += 2.0)
    {
      PhantomLabels::PointType point;
      point[0] = x;
      point[1] = y;
      point[2] = z;
      if (labels->GetPixel(labels->TransformPhysicalPointToIndex(point)) == PhantomMarker)
      {
        return true;
      }
    }
    return false;
  };
  for (std::size_t row = 0; row < letter.size(); ++row)
  {
    std::string seen;
    for (int column = 0; column < 11; ++column)
    {
      seen += isMarked(66.0 + 4.0 * column, 338.0 - 4.0 * static_cast<double>(row)) ? 'F' : '.';
    }
    EXPECT_EQ(seen, letter[row]) << "row " << row;
  }
  EXPECT_LT(CentroidOf(*labels, PhantomMarker)[1], -100.0);
}

TEST(Phantom, IsTheSameForAnyNumberOfThreads)
{
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const auto scan = MakePhantomScan({ 4.0 });
  const auto labels = MakePhantomLabels({ 4.0 });
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(5);
  EXPECT_TRUE(HaveSameVoxels(*scan, *MakePhantomScan({ 4.0 })));
  EXPECT_TRUE(HaveSameVoxels(*labels, *MakePhantomLabels({ 4.0 })));
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

TEST(Phantom, HasAirAllAround)
{
  for (const double spacing : { 3.0, 10.0 })
  {
    const auto scan = MakePhantomScan({ spacing });
    const auto size = scan->GetLargestPossibleRegion().GetSize();
    itk::ImageRegionConstIteratorWithIndex<PhantomScan> it(scan, scan->GetLargestPossibleRegion());
    for (; !it.IsAtEnd(); ++it)
    {
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        const auto index = it.GetIndex()[axis];
        if (index == 0 || index + 1 == static_cast<itk::IndexValueType>(size[axis]))
        {
          ASSERT_EQ(it.Get(), -1000) << it.GetIndex();
        }
      }
    }
  }
}

TEST(Phantom, RefusesSpacingsOutOfRange)
{
  for (const double spacing : { 0.0, -2.0, 0.4, 11.0, std::nan("") })
  {
    try
    {
      MakePhantomScan({ spacing });
      ADD_FAILURE() << spacing;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Usage);
    }
  }
}

TEST_F(PhantomFiles, ReadBackAsTheyWereMade)
{
  const PhantomSettings settings{ 7.3 };
  const auto scan = MakePhantomScan(settings);
  WritePhantom(m_Folder / "new", settings);

  const auto nifti = ReadNifti<PhantomScan>(m_Folder / "new/phantom.nii.gz");
  EXPECT_TRUE(HaveSameVoxels(*scan, *nifti));
  ExpectSameGeometry(*scan, *nifti, 1e-4);

  const auto labels = ReadNifti<PhantomLabels>(m_Folder / "new/phantom-labels.nii.gz");
  EXPECT_TRUE(HaveSameVoxels(*MakePhantomLabels(settings), *labels));
  ExpectSameGeometry(*MakePhantomLabels(settings), *labels, 1e-4);

  const auto series = ReadSeries(m_Folder / "new/dicom");
  EXPECT_TRUE(HaveSameVoxels(*scan, *series));
  ExpectSameGeometry(*scan, *series, 1e-9);
}

TEST_F(PhantomFiles, AreTheSameBytesEveryTime)
{
  WritePhantom(m_Folder / "first", { 10.0 });
  fs::create_directories(m_Folder / "second/.phantom-999999999/dicom"); // of a process that was killed
  WritePhantom(m_Folder / "second", { 10.0 });
  const auto first = ReadFolder(m_Folder / "first");
  EXPECT_EQ(first.count("phantom-organs.csv"), 1u);
  EXPECT_EQ(first.size(), 4u + MakePhantomScan({ 10.0 })->GetLargestPossibleRegion().GetSize()[2]);
  EXPECT_TRUE(first == ReadFolder(m_Folder / "second"));
}

TEST_F(PhantomFiles, RefuseWhatTheyCannotOrMustNotWrite)
{
  const auto expectFailure = [](const fs::path & folder, const PhantomSettings & settings, FailureKind kind) {
    try
    {
      WritePhantom(folder, settings);
      ADD_FAILURE() << folder;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), kind) << failure.GetDescription();
    }
  };
  std::ofstream(m_Folder / "mine") << "precious";
  const auto before = ReadFolder(m_Folder);
  expectFailure(m_Folder, { 10.0 }, FailureKind::Output);
  expectFailure(m_Folder / "mine", { 10.0 }, FailureKind::Output);
  expectFailure(m_Folder / "no/parent", { 10.0 }, FailureKind::Output);
  expectFailure(m_Folder / "unmade", { 0.0 }, FailureKind::Usage);
  EXPECT_TRUE(before == ReadFolder(m_Folder));
  EXPECT_FALSE(fs::exists(m_Folder / "unmade"));
}

TEST_F(PhantomFiles, CommittedOnesAreWhatIsMadeToday)
{
  const fs::path committed = fs::path(RHOMBIC_TESTDATA) / "phantom";
  WritePhantom(m_Folder / "today", { 8.0 });
  EXPECT_TRUE(HaveSameVoxels(*ReadNifti<PhantomScan>(committed / "phantom.nii.gz"), *MakePhantomScan({ 8.0 })));
  EXPECT_TRUE(
    HaveSameVoxels(*ReadNifti<PhantomLabels>(committed / "phantom-labels.nii.gz"), *MakePhantomLabels({ 8.0 })));
  auto made = ReadFolder(m_Folder / "today");
  auto kept = ReadFolder(committed);
  for (const auto compressed : { "phantom.nii.gz", "phantom-labels.nii.gz" }) // bytes vary with the version of zlib
  {
    EXPECT_EQ(made.erase(compressed), 1u);
    EXPECT_EQ(kept.erase(compressed), 1u);
  }
  EXPECT_TRUE(made == kept);
}

} // namespace
