#include "rhombicTableRemoval.h"

#include "rhombicReadScan.h"

#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkMath.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using ImageType = itk::Image<std::int16_t, 3>;
using PointType = itk::Point<double, 3>;

/** How deep a point is in an object, in mm; negative outside. */
using Depth = std::function<double(const PointType & point)>;

struct Object
{
  double value; // HU
  Depth depth;
};

/** Where the samples of a phantom are. */
struct Grid
{
  double spacing[3];
  double tilt = 0.0; // of the slices about the x axis, in degrees
  bool isUneven = false;
  unsigned int seed = 1;
};

constexpr double backOfBody = 95.0; // y in mm, positive towards the back
constexpr double mattress = 10.0;   // mm, between the back and the table; as air in the scan
constexpr double air = -1000.0;     // HU
constexpr double tissue = -300.0;   // HU
constexpr double halfWidth = 250.0; // of the scan in mm, along x
constexpr double halfLength = 60.0; // along z

double
Ellipse(double x, double y, double semiX, double semiY)
{
  return (1.0 - std::hypot(x / semiX, y / semiY)) * std::min(semiX, semiY);
}

double
Slab(double value, double low, double high)
{
  return std::min(value - low, high - value);
}

std::vector<Object>
Patient()
{
  std::vector<Object> objects{ { 40.0, [](const PointType & p) { return Ellipse(p[0], p[1], 150.0, backOfBody); } } };
  for (const double side : { -1.0, 1.0 })
  {
    objects.push_back({ 40.0, [side](const PointType & p) { return 38.0 - std::hypot(p[0] - side * 192.0, p[1]); } });
    objects.push_back({ 500.0, [side](const PointType & p) { return 12.0 - std::hypot(p[0] - side * 192.0, p[1]); } });
    objects.push_back(
      { -850.0, [side](const PointType & p) { return Ellipse(p[0] - side * 70.0, p[1], 50.0, 65.0); } });
  }
  return objects;
}

/** A closed shell with foam in it. */
std::vector<Object>
FlatTable(double behindBack = mattress)
{
  const double top = backOfBody + behindBack;
  const auto depth = [top](const PointType & p) {
    return std::min(Slab(p[0], -220.0, 220.0), Slab(p[1], top, top + 40.0));
  };
  return { { 300.0, depth }, { -950.0, [=](const PointType & p) { return depth(p) - 4.0; } } };
}

/** Two curved shells one behind the other. */
std::vector<Object>
CurvedTable()
{
  std::vector<Object> objects;
  for (const double behind : { mattress, mattress + 30.0 })
  {
    objects.push_back({ 150.0, [=](const PointType & p) {
                         const double radius = 500.0;
                         const double distance = std::hypot(p[0], p[1] - (backOfBody + behind - radius));
                         return std::min(Slab(distance, radius, radius + 5.0), Slab(p[0], -230.0, 230.0));
                       } });
  }
  return objects;
}

std::vector<Object>
TableWithRails()
{
  std::vector<Object> objects = FlatTable();
  for (const double side : { -1.0, 1.0 })
  {
    objects.push_back({ 600.0, [side](const PointType & p) {
                         return 9.0 - std::hypot(p[0] - side * 235.0, p[1] - backOfBody - mattress - 20.0);
                       } });
  }
  return objects;
}

/** Along the patient, in front of it. */
std::vector<Object>
Tube()
{
  return { { 100.0, [](const PointType & p) {
              return 4.0 - std::hypot(p[0] - 30.0 - 0.1 * p[2], p[1] + backOfBody + 25.0);
            } } };
}

std::vector<Object>
operator+(std::vector<Object> a, const std::vector<Object> & b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/** Objects in air, later ones in earlier ones, with borders as wide as a sample, and noise. */
rhombic::Scan
MakeScan(const Grid & grid, const std::vector<Object> & objects)
{
  const auto image = ImageType::New();
  itk::Size<3> size;
  const double extent[3] = { 2.0 * halfWidth, 360.0, 2.0 * halfLength };
  PointType origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::size_t>(extent[axis] / grid.spacing[axis]);
    origin[axis] = -0.5 * static_cast<double>(size[axis] - 1) * grid.spacing[axis];
  }
  image->SetRegions(size);
  image->SetSpacing(grid.spacing);
  image->Allocate();
  ImageType::DirectionType direction;
  direction.SetIdentity();
  const double radians = grid.tilt * itk::Math::pi / 180.0;
  direction[1][1] = std::cos(radians);
  direction[2][1] = -std::sin(radians);
  image->SetDirection(direction);
  image->SetOrigin(origin);

  rhombic::Scan scan;
  scan.image = image;
  scan.modality = "CT";
  for (std::size_t slice = 0; grid.isUneven && slice < size[2]; ++slice)
  {
    PointType point = origin;
    const double middle = 0.5 * static_cast<double>(size[2] - 1);
    const double place = static_cast<double>(slice);
    point[2] += grid.spacing[2] * (place < middle ? 0.8 * place : 0.8 * middle + 1.2 * (place - middle));
    scan.sliceOrigins.push_back(point);
  }

  const double border = 0.5 * std::max(grid.spacing[0], grid.spacing[1]);
  itk::MultiThreaderBase::New()->ParallelizeArray(
    0,
    size[2],
    [&](itk::SizeValueType slice) {
      std::mt19937 random(1000 * grid.seed + static_cast<unsigned int>(slice));
      std::normal_distribution<double> noise(0.0, 12.0);
      itk::Index<3> index{ { 0, 0, static_cast<long>(slice) } };
      PointType even;
      image->TransformIndexToPhysicalPoint(index, even);
      std::int16_t * sample = image->GetBufferPointer() + slice * size[0] * size[1];
      for (index[1] = 0; index[1] < static_cast<long>(size[1]); ++index[1])
      {
        for (index[0] = 0; index[0] < static_cast<long>(size[0]); ++index[0])
        {
          PointType point;
          image->TransformIndexToPhysicalPoint(index, point);
          point += scan.sliceOrigins.empty() ? itk::Vector<double, 3>(0.0) : scan.sliceOrigins[slice] - even;
          double value = air;
          for (const Object & object : objects)
          {
            const double share = std::clamp(0.5 + object.depth(point) / (2.0 * border), 0.0, 1.0);
            value += share * (object.value - value);
          }
          *sample++ = static_cast<std::int16_t>(std::lround(std::max(value + noise(random), -1024.0)));
        }
      }
    },
    nullptr);
  return scan;
}

std::vector<std::int16_t>
ValuesOf(const rhombic::Scan & scan)
{
  const auto & image = std::get<ImageType::Pointer>(scan.image);
  const std::int16_t * const begin = image->GetBufferPointer();
  return { begin, begin + image->GetBufferedRegion().GetNumberOfPixels() };
}

std::vector<Grid>
Grids()
{
  return { { { 2.0, 2.0, 5.0 } },
           { { 1.4, 1.4, 10.0 }, 0.0, false, 2 },
           { { 3.0, 3.0, 3.0 }, 0.0, false, 3 },
           { { 2.0, 2.0, 5.0 }, 15.0, false, 4 },
           { { 2.0, 2.0, 6.0 }, 12.0, true, 5 } };
}

/** Where each sample is, in the scan's order. */
std::vector<PointType>
PointsOf(const rhombic::Scan & scan)
{
  const auto & image = *std::get<ImageType::Pointer>(scan.image);
  const auto size = image.GetBufferedRegion().GetSize();
  std::vector<PointType> points;
  itk::Index<3> index;
  for (index[2] = 0; index[2] < static_cast<long>(size[2]); ++index[2])
  {
    for (index[1] = 0; index[1] < static_cast<long>(size[1]); ++index[1])
    {
      for (index[0] = 0; index[0] < static_cast<long>(size[0]); ++index[0])
      {
        PointType point;
        image.TransformIndexToPhysicalPoint(index, point);
        points.push_back(point);
      }
    }
  }
  return points;
}

/** Of a point in the patient: its tissue or its air. */
double
DepthInPatient(const PointType & point)
{
  double depth = -1e9;
  for (const Object & object : Patient())
  {
    depth = std::max(depth, object.depth(point));
  }
  return depth;
}

/** How far from the true skin the scan's skin may be, in mm. */
struct Tolerance
{
  double inside = 4.0;
  double outside = 4.0;
  double volume = 0.01; ///< by how much the volume inside the skin may differ from that without a table, as a share
};

/** That the patient stays and the objects go: what is deeper in the patient than the tolerance is tissue as before, and
 * what is farther outside is not tissue. */
void
ExpectOnlyThePatient(const Grid & grid, const std::vector<Object> & objects, const Tolerance & tolerance)
{
  rhombic::Scan scan = MakeScan(grid, Patient() + objects);
  const auto points = PointsOf(scan);
  const auto before = ValuesOf(scan);
  const auto removal = rhombic::RemoveTable(scan, {});
  const auto after = ValuesOf(scan);
  std::size_t changed = 0;
  std::size_t objectSamples = 0;
  std::size_t left = 0;
  for (std::size_t n = 0; n < after.size(); ++n)
  {
    const double depth = DepthInPatient(points[n]);
    changed += depth >= tolerance.inside && after[n] != before[n] ? 1 : 0;
    const bool isObject = depth < -tolerance.outside && before[n] >= tissue;
    objectSamples += isObject ? 1 : 0;
    left += isObject && after[n] >= tissue ? 1 : 0;
  }
  EXPECT_EQ(changed, 0u);
  EXPECT_EQ(left, 0u) << "of " << objectSamples;
  const auto countTissue = [](const auto & values) {
    return static_cast<double>(std::count_if(values.begin(), values.end(), [](auto value) { return value >= tissue; }));
  };
  const double patient = countTissue(ValuesOf(MakeScan(grid, Patient())));
  EXPECT_NEAR(countTissue(after) / patient, 1.0, tolerance.volume);
  EXPECT_FALSE(removal.objects.empty());
}

std::string
Describe(const rhombic::TableRemoval & removal)
{
  std::ostringstream text;
  text.precision(17);
  for (const rhombic::ScanObject & object : removal.objects)
  {
    text << object.millilitres << " ml at " << object.centroid << " from " << object.lowest << " to " << object.highest
         << '\n';
  }
  text << removal.numberOfSpecks << " specks of " << removal.millilitresOfSpecks << " ml in air of " << removal.airValue
       << " HU\n";
  for (const std::string & note : removal.notes)
  {
    text << note << '\n';
  }
  return text.str();
}

TEST(TableRemoval, ScansWithoutATableStayAsTheyAre)
{
  for (const Grid & grid : Grids())
  {
    rhombic::Scan scan = MakeScan(grid, Patient());
    const auto before = ValuesOf(scan);
    const auto removal = rhombic::RemoveTable(scan, {});
    EXPECT_TRUE(removal.objects.empty()) << Describe(removal);
    EXPECT_EQ(ValuesOf(scan), before);
  }
}

TEST(TableRemoval, TablesGoAndThePatientStays)
{
  const std::vector<std::vector<Object>> tables{ FlatTable(), CurvedTable(), TableWithRails() };
  for (const Grid & grid : Grids())
  {
    SCOPED_TRACE(grid.seed);
    ExpectOnlyThePatient(grid, tables[grid.seed % tables.size()] + Tube(), {});
  }
}

// The wall of a table can't be told from the skin that lies on it.
TEST(TableRemoval, AWallStaysWhereTheBackLiesOnIt)
{
  const Grid grid = Grids()[0];
  ExpectOnlyThePatient(grid, FlatTable(0.0) + Tube(), { 4.0, 12.0, 0.015 });
}

// A sheet under the back, which touches it in the middle and leaves it to the sides.
TEST(TableRemoval, TheSkinIsSmoothWhereItTouchesASheet)
{
  for (const double spacing : { 1.2, 2.0 })
  {
    SCOPED_TRACE(spacing);
    const auto sheet = [](const PointType & p) {
      const double fromSkin = -Ellipse(p[0], p[1], 150.0, backOfBody) - 0.0004 * p[0] * p[0];
      return std::min({ Slab(fromSkin, 0.3, 1.8), p[1] - 40.0, 200.0 - std::abs(p[0]) });
    };
    ExpectOnlyThePatient({ { spacing, spacing, 4.0 } },
                         FlatTable() + std::vector<Object>{ { 0.0, sheet } },
                         { 2.0 * spacing + 1.0, 2.0 * spacing + 1.0 });
  }
}

TEST(TableRemoval, EarsThatTouchAHeadHolderStay)
{
  // The holder is a bowl along the patient; an ear leans on each of its sides.
  const auto head = [](const PointType & p) { return 75.0 - std::hypot(p[0], p[1], p[2]); };
  const auto ear = [](const PointType & p) {
    return std::min(Slab(p[1], -3.0, 3.0), 22.0 - std::hypot(std::abs(p[0]) - 78.0, p[2]));
  };
  const auto holder = [](const PointType & p) {
    return std::min(Slab(std::hypot(p[0], p[1]), 100.0, 104.0), p[1] + 20.0);
  };
  const Grid grid{ { 1.0, 1.0, 3.0 } };
  rhombic::Scan scan = MakeScan(grid, { { 40.0, head }, { 0.0, ear }, { 400.0, holder } });
  const auto points = PointsOf(scan);
  const auto before = ValuesOf(scan);
  rhombic::RemoveTable(scan, {});
  const auto after = ValuesOf(scan);
  std::size_t changed = 0;
  std::size_t earSamples = 0;
  std::size_t earLost = 0;
  std::size_t holderSamples = 0;
  std::size_t holderLeft = 0;
  for (std::size_t n = 0; n < after.size(); ++n)
  {
    const double depth = std::max(head(points[n]), ear(points[n]));
    changed += depth >= 3.0 && holder(points[n]) < -3.0 && after[n] != before[n] ? 1 : 0;
    earSamples += depth >= 0.0 && head(points[n]) < 0.0 ? 1 : 0;
    earLost += depth >= 0.0 && head(points[n]) < 0.0 && after[n] < tissue ? 1 : 0;
    holderSamples += depth < -3.0 && holder(points[n]) >= 0.0 ? 1 : 0;
    holderLeft += depth < -3.0 && holder(points[n]) >= 0.0 && after[n] >= tissue ? 1 : 0;
  }
  EXPECT_EQ(changed, 0u);
  EXPECT_LT(static_cast<double>(earLost), 0.08 * static_cast<double>(earSamples));
  EXPECT_LT(static_cast<double>(holderLeft), 0.01 * static_cast<double>(holderSamples));
}

TEST(TableRemoval, TheResultIsTheSameForAnyNumberOfThreads)
{
  const Grid grid = Grids()[0];
  const rhombic::Scan original = MakeScan(grid, Patient() + CurvedTable());
  const auto values = ValuesOf(original);
  std::vector<std::int16_t> first;
  std::string firstReport;
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  for (const unsigned int count : { 1u, 2u, 3u, 8u })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(count);
    std::copy(values.begin(), values.end(), std::get<ImageType::Pointer>(original.image)->GetBufferPointer());
    rhombic::Scan scan = original;
    const auto report = Describe(rhombic::RemoveTable(scan, {}));
    if (first.empty())
    {
      first = ValuesOf(scan);
      firstReport = report;
    }
    EXPECT_TRUE(ValuesOf(scan) == first) << count;
    EXPECT_EQ(report, firstReport);
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

TEST(TableRemoval, ReportsVolumeAndPlaceOfWhatIsRemoved)
{
  // A plate of 40 x 6 x 60 mm.
  const std::vector<Object> block{
    { 100.0,
      [](const PointType & p) {
        return std::min({ Slab(p[0], 60.0, 100.0), Slab(p[1], -150.0, -144.0), Slab(p[2], -30.0, 30.0) });
      } }
  };
  rhombic::Scan scan = MakeScan(Grids()[0], Patient() + block);
  std::vector<std::string> notes;
  rhombic::Events events;
  events.note = [&notes](const std::string & note) { notes.push_back(note); };
  const auto removal = rhombic::RemoveTable(scan, events);
  ASSERT_EQ(removal.objects.size(), 1u);
  const auto & object = removal.objects.front();
  EXPECT_NEAR(object.millilitres, 14.4, 2.0);
  const double centroid[3] = { 80.0, -147.0, 0.0 };
  const double halves[3] = { 20.0, 3.0, 30.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(object.centroid[axis], centroid[axis], 0.5);
    EXPECT_NEAR(object.lowest[axis], centroid[axis] - halves[axis], 5.0);
    EXPECT_NEAR(object.highest[axis], centroid[axis] + halves[axis], 5.0);
  }
  EXPECT_NEAR(removal.airValue, air, 5.0);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("1 object"), std::string::npos) << notes.front();
}

TEST(TableRemoval, KeepsWhatMayBeAHand)
{
  const std::vector<Object> hand{
    { 30.0,
      [](const PointType & p) {
        return std::min({ Slab(p[0], 60.0, 130.0), Slab(p[1], -150.0, -132.0), Slab(p[2], -40.0, 40.0) });
      } }
  };
  rhombic::Scan scan = MakeScan(Grids()[0], Patient() + hand);
  const auto before = ValuesOf(scan);
  const auto removal = rhombic::RemoveTable(scan, {});
  EXPECT_TRUE(removal.objects.empty());
  EXPECT_TRUE(ValuesOf(scan) == before);
  ASSERT_EQ(removal.notes.size(), 1u);
  EXPECT_NE(removal.notes.front().find("nothing was removed"), std::string::npos) << removal.notes.front();
}

TEST(TableRemoval, SaysWhichSeparatePartsAreKept)
{
  // A head between two walls of a holder, of 18 x 190 x 120 mm each, which can't be told from arms.
  std::vector<Object> objects{ { 40.0, [](const PointType & p) { return Ellipse(p[0], p[1], 75.0, 95.0); } } };
  for (const double side : { -1.0, 1.0 })
  {
    objects.push_back({ 40.0, [side](const PointType & p) {
                         return std::min(Slab(side * p[0], 100.0, 118.0), Slab(p[1], -95.0, 95.0));
                       } });
  }
  rhombic::Scan scan = MakeScan(Grids()[0], objects);
  const auto before = ValuesOf(scan);
  const auto removal = rhombic::RemoveTable(scan, {});
  EXPECT_TRUE(removal.objects.empty());
  EXPECT_EQ(ValuesOf(scan), before);
  ASSERT_EQ(removal.kept.size(), 2u) << Describe(removal);
  for (const rhombic::ScanObject & wall : removal.kept)
  {
    EXPECT_NEAR(wall.millilitres, 18.0 * 190.0 * 120.0 / 1000.0, 15.0);
    EXPECT_NEAR(std::abs(wall.centroid[0]), 109.0, 1.0);
  }
  ASSERT_EQ(removal.notes.size(), 1u);
  EXPECT_NE(removal.notes.front().find("kept as the patient's: 2 parts apart from the largest"), std::string::npos)
    << removal.notes.front();
}

TEST(TableRemoval, ScansThatAreNotInHounsfieldUnitsStayAsTheyAre)
{
  rhombic::Scan scan = MakeScan(Grids()[0], Patient() + FlatTable());
  const auto & image = *std::get<ImageType::Pointer>(scan.image);
  std::int16_t * const values = std::get<ImageType::Pointer>(scan.image)->GetBufferPointer();
  for (std::size_t n = 0; n < image.GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    values[n] = static_cast<std::int16_t>(values[n] + 1024);
  }
  const auto before = ValuesOf(scan);
  const auto removal = rhombic::RemoveTable(scan, {});
  EXPECT_TRUE(ValuesOf(scan) == before);
  EXPECT_TRUE(removal.objects.empty());
  ASSERT_EQ(removal.notes.size(), 1u);
}

/** Real scans, which are no part of the project: RHOMBIC_SCANS says where they are. */
class TableOfRealScans : public testing::Test
{
protected:
  void
  SetUp() override
  {
    const char * const folder = std::getenv("RHOMBIC_SCANS");
    if (folder == nullptr)
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set";
    }
    m_Scans = folder;
  }

  std::filesystem::path m_Scans;
};

/** How much of the scan is at or above a threshold, in ml. */
double
MillilitresOf(const rhombic::Scan & scan, double threshold)
{
  return std::visit(
    [&](const auto & image) {
      const auto & spacing = image->GetSpacing();
      const auto * const begin = image->GetBufferPointer();
      const auto count = std::count_if(begin, begin + image->GetBufferedRegion().GetNumberOfPixels(), [&](auto value) {
        return static_cast<double>(value) >= threshold;
      });
      return static_cast<double>(count) * spacing[0] * spacing[1] * spacing[2] / 1000.0;
    },
    scan.image);
}

TEST_F(TableOfRealScans, OnlyWhatIsReportedIsLost)
{
  struct Case
  {
    const char * path;
    double lowest; // removed, in ml
    double highest;
  };
  for (const Case & real : { Case{ "ct_chest_lidc0314_dicom_jpegls", 700.0, 900.0 },
                             Case{ "ct_body_totalseg_dicom_j2k", 150.0, 190.0 },
                             Case{ "ct_body_totalseg_nifti/example_ct.nii.gz", 150.0, 210.0 },
                             Case{ "ct_head_tilt_varspacing_dicom_rle", 60.0, 100.0 },
                             Case{ "ct_mr_dicom2stl_nifti/ct_example.nii.gz", 0.0, 0.0 },
                             Case{ "ct_body_totalseg_nifti/ct_aorta_cropped.nii.gz", 0.0, 0.0 },
                             Case{ "ct_head_ge8800_dicom", 0.0, 0.0 } })
  {
    SCOPED_TRACE(real.path);
    rhombic::Scan scan = rhombic::ReadScan(m_Scans / real.path);
    const double before = MillilitresOf(scan, -300.5);
    const auto removal = rhombic::RemoveTable(scan, {});
    const double after = MillilitresOf(scan, -300.5);
    double removed = removal.objects.empty() ? 0.0 : removal.millilitresOfSpecks;
    for (const auto & object : removal.objects)
    {
      removed += object.millilitres;
    }
    EXPECT_GE(removed, real.lowest);
    EXPECT_LE(removed, real.highest);
    EXPECT_NEAR(before - removed, after, 0.005 * after);
  }
}

TEST_F(TableOfRealScans, NoOrganIsTouched)
{
  // The organs were found by TotalSegmentator.
  const auto folder = m_Scans / "ct_body_totalseg_nifti";
  for (const auto & [path, labelPath] :
       { std::pair{ folder / "example_ct_sm.nii.gz", folder / "example_seg.nii.gz" },
         std::pair{ folder / "example_ct.nii.gz", folder / "example_seg_fast_force_split.nii.gz" },
         std::pair{ m_Scans / "ct_body_totalseg_dicom_j2k", folder / "example_seg_dicom.nii.gz" } })
  {
    const rhombic::Scan labels = rhombic::ReadScan(labelPath);
    const rhombic::Scan original = rhombic::ReadScan(path);
    rhombic::Scan scan = rhombic::ReadScan(path);
    EXPECT_FALSE(rhombic::RemoveTable(scan, {}).objects.empty());
    std::size_t organs = 0;
    std::size_t changed = 0;
    std::visit(
      [&](const auto & image) {
        const auto & was = *std::get<std::decay_t<decltype(image)>>(original.image);
        for (itk::ImageRegionConstIteratorWithIndex<std::decay_t<decltype(*image)>> it(image,
                                                                                       image->GetBufferedRegion());
             !it.IsAtEnd();
             ++it)
        {
          PointType point;
          image->TransformIndexToPhysicalPoint(it.GetIndex(), point);
          const bool isOrgan = std::visit(
            [&](const auto & map) {
              itk::Index<3> index;
              return map->TransformPhysicalPointToIndex(point, index) && map->GetPixel(index) != 0;
            },
            labels.image);
          organs += isOrgan ? 1 : 0;
          changed += isOrgan && it.Get() != was.GetPixel(it.GetIndex()) ? 1 : 0;
        }
      },
      scan.image);
    EXPECT_GT(organs, 1000u);
    EXPECT_EQ(changed, 0u) << path;
  }
}

} // namespace
