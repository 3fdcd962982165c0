#include "rhombicTableRemoval.h"

#include "rhombicScanReader.h"

#include "itkMath.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
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

constexpr double backOfBody = 95.0;  // the table's top touches it: y in mm, positive towards the back
constexpr double air = -1000.0;      // HU
constexpr double tissue = -300.0;    // HU
constexpr double halfWidth = 250.0;  // of the scan in mm, along x
constexpr double halfLength = 100.0; // along z

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

/** A closed shell with foam in it; its top touches the back. */
std::vector<Object>
FlatTable()
{
  const auto depth = [](const PointType & p) {
    return std::min(Slab(p[0], -220.0, 220.0), Slab(p[1], backOfBody, backOfBody + 40.0));
  };
  return { { 300.0, depth }, { -950.0, [=](const PointType & p) { return depth(p) - 4.0; } } };
}

/** Two curved shells one behind the other. */
std::vector<Object>
CurvedTable()
{
  std::vector<Object> objects;
  for (const double behind : { 0.0, 30.0 })
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
                         return 9.0 - std::hypot(p[0] - side * 235.0, p[1] - backOfBody - 20.0);
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

  std::mt19937 random(grid.seed);
  std::normal_distribution<double> noise(0.0, 12.0);
  const double border = 0.5 * std::max(grid.spacing[0], grid.spacing[1]);
  std::int16_t * sample = image->GetBufferPointer();
  itk::Index<3> index;
  for (index[2] = 0; index[2] < static_cast<long>(size[2]); ++index[2])
  {
    for (index[1] = 0; index[1] < static_cast<long>(size[1]); ++index[1])
    {
      for (index[0] = 0; index[0] < static_cast<long>(size[0]); ++index[0])
      {
        PointType point;
        image->TransformIndexToPhysicalPoint(index, point);
        if (grid.isUneven)
        {
          const auto slice = static_cast<std::size_t>(index[2]);
          PointType even;
          image->TransformIndexToPhysicalPoint({ { 0, 0, index[2] } }, even);
          point += scan.sliceOrigins[slice] - even;
        }
        double value = air;
        for (const Object & object : objects)
        {
          const double share = std::clamp(0.5 + object.depth(point) / (2.0 * border), 0.0, 1.0);
          value += share * (object.value - value);
        }
        *sample++ = static_cast<std::int16_t>(std::lround(std::max(value + noise(random), -1024.0)));
      }
    }
  }
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

/** That the patient stays and the objects go. */
void
ExpectOnlyThePatient(const Grid & grid, const std::vector<Object> & objects)
{
  const auto patient = ValuesOf(MakeScan(grid, Patient()));
  rhombic::Scan scan = MakeScan(grid, Patient() + objects);
  const auto before = ValuesOf(scan);
  const auto removal = rhombic::RemoveTable(scan, {});
  const auto after = ValuesOf(scan);
  std::size_t cut = 0;
  std::size_t objectSamples = 0;
  std::size_t left = 0;
  for (std::size_t n = 0; n < after.size(); ++n)
  {
    const bool isPatient = patient[n] >= tissue;
    cut += isPatient && after[n] != before[n] ? 1 : 0;
    objectSamples += !isPatient && before[n] >= tissue ? 1 : 0;
    left += !isPatient && before[n] >= tissue && after[n] >= tissue ? 1 : 0;
  }
  EXPECT_EQ(cut, 0u);
  EXPECT_LT(static_cast<double>(left), 0.01 * static_cast<double>(objectSamples)) << objectSamples;
  EXPECT_FALSE(removal.objects.empty());
}

TEST(TableRemoval, ScansWithoutATableStayAsTheyAre)
{
  for (const Grid & grid : Grids())
  {
    rhombic::Scan scan = MakeScan(grid, Patient());
    const auto before = ValuesOf(scan);
    const auto removal = rhombic::RemoveTable(scan, {});
    EXPECT_TRUE(removal.objects.empty()) << rhombic::ToJson(rhombic::ReportTableRemoval(removal));
    EXPECT_EQ(ValuesOf(scan), before);
  }
}

TEST(TableRemoval, TablesThatTouchTheBackGoAndThePatientStays)
{
  for (const Grid & grid : Grids())
  {
    SCOPED_TRACE(grid.seed);
    for (const auto & table : { FlatTable(), CurvedTable(), TableWithRails() })
    {
      ExpectOnlyThePatient(grid, table + Tube());
    }
  }
}

} // namespace
