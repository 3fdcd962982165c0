#include "rhombicFailure.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicPhantom.h"

#include "itkImageAlgorithm.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{

using rhombic::PhantomPoint;
using rhombic::SurfaceRequest;

constexpr PhantomPoint chestLow{ -216.0, -144.0, 205.0 };
constexpr PhantomPoint chestHigh{ 216.0, 136.0, 420.0 };

/** The part of an image between two corners, in LPS mm. */
template <typename TImage>
typename TImage::Pointer
Crop(const TImage & image, const PhantomPoint & low, const PhantomPoint & high)
{
  typename TImage::RegionType region = image.GetLargestPossibleRegion();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double spacing = image.GetSpacing()[axis];
    const auto indexOf = [&](double place) { return std::lround((place - image.GetOrigin()[axis]) / spacing); };
    const auto size = static_cast<long>(region.GetSize(axis));
    region.SetIndex(axis, std::clamp(indexOf(low[axis]), 0l, size));
    region.SetSize(axis, static_cast<std::size_t>(std::clamp(indexOf(high[axis]), 0l, size) - region.GetIndex(axis)));
  }
  const auto cropped = TImage::New();
  typename TImage::PointType origin;
  image.TransformIndexToPhysicalPoint(region.GetIndex(), origin);
  cropped->SetOrigin(origin);
  cropped->SetSpacing(image.GetSpacing());
  cropped->SetRegions(region.GetSize());
  cropped->Allocate();
  itk::ImageAlgorithm::Copy(&image, cropped.GetPointer(), region, cropped->GetLargestPossibleRegion());
  return cropped;
}

/** A part of the phantom's CT, and its labels, which tell how much air of which kind is in it. */
class PhantomCrop
{
public:
  PhantomCrop(const PhantomPoint & low, const PhantomPoint & high)
  {
    static const auto wholeScan = rhombic::MakePhantomScan();
    static const auto wholeLabels = rhombic::MakePhantomLabels();
    m_Scan = Crop(*wholeScan, low, high);
    m_Labels = Crop(*wholeLabels, low, high);
  }

  /** Replaces values by a function of the point, the value and the label. */
  void
  Change(const std::function<double(const PhantomPoint &, double, int)> & function)
  {
    const auto size = m_Scan->GetLargestPossibleRegion().GetSize();
    std::size_t n = 0;
    for (std::size_t k = 0; k < size[2]; ++k)
    {
      for (std::size_t j = 0; j < size[1]; ++j)
      {
        for (std::size_t i = 0; i < size[0]; ++i, ++n)
        {
          const PhantomPoint point{ this->At(0, i), this->At(1, j), this->At(2, k) };
          std::int16_t & value = m_Scan->GetBufferPointer()[n];
          value = static_cast<std::int16_t>(function(point, value, m_Labels->GetBufferPointer()[n]));
        }
      }
    }
  }

  /** What is outside of a circle in each slice is not measured, but gets one value, and is no lung. */
  void
  PadOutside(double centreY, double radius, double padding)
  {
    std::uint8_t * label = m_Labels->GetBufferPointer();
    this->Change([&](const PhantomPoint & point, double value, int) {
      const bool isPadding = std::hypot(point[0], point[1] - centreY) > radius;
      *label = isPadding ? 0 : *label;
      ++label;
      return isPadding ? padding : value;
    });
  }

  /** The volume of the voxels of the lungs and the airway, in ml. */
  double
  LungMillilitres() const
  {
    const std::string names[] = { "airway", "right lung", "left lung" };
    const std::uint8_t * const begin = m_Labels->GetBufferPointer();
    const auto count =
      std::count_if(begin, begin + m_Labels->GetLargestPossibleRegion().GetNumberOfPixels(), [&](int n) {
        return n != 0 && std::count(std::begin(names), std::end(names), rhombic::PhantomOrgans()[n - 1u].name) == 1;
      });
    const double spacing = m_Labels->GetSpacing()[0];
    return static_cast<double>(count) * spacing * spacing * spacing / 1000.0;
  }

  /** The volume of the voxels without a label, in ml. */
  double
  AirMillilitres() const
  {
    const std::uint8_t * const begin = m_Labels->GetBufferPointer();
    const auto count = std::count(begin, begin + m_Labels->GetLargestPossibleRegion().GetNumberOfPixels(), 0);
    const double spacing = m_Labels->GetSpacing()[0];
    return static_cast<double>(count) * spacing * spacing * spacing / 1000.0;
  }

  rhombic::ExtractedSurface
  Extract(double isovalue = -400.5, const rhombic::Events & events = {}) const
  {
    rhombic::Scan scan;
    scan.image = m_Scan;
    SurfaceRequest request;
    request.name = "lungs";
    request.isovalue = isovalue; // half way between lungs and muscle
    request.insideIsBelow = true;
    request.parts = SurfaceRequest::Parts::Enclosed;
    const auto lattice = rhombic::ScanToLattice(scan, {}, {});
    return rhombic::LatticeToSurfaces(lattice, { request }, itk::FCCIsosurfaceMode::Lean, events, m_Scan).front();
  }

  /** The skin, as the body's outermost parts. */
  rhombic::ExtractedSurface
  ExtractOutline() const
  {
    rhombic::Scan scan;
    scan.image = m_Scan;
    SurfaceRequest request;
    request.name = "skin";
    request.isovalue = -300.5;
    request.parts = SurfaceRequest::Parts::Outermost;
    const auto lattice = rhombic::ScanToLattice(scan, {}, {});
    return rhombic::LatticeToSurfaces(lattice, { request }, itk::FCCIsosurfaceMode::Lean, {}, m_Scan).front();
  }

  /** The volume of all voxels, in ml. */
  double
  Millilitres() const
  {
    const double spacing = m_Labels->GetSpacing()[0];
    return static_cast<double>(m_Labels->GetLargestPossibleRegion().GetNumberOfPixels()) * spacing * spacing * spacing /
           1000.0;
  }

private:
  double
  At(unsigned int axis, std::size_t index) const
  {
    return m_Scan->GetOrigin()[axis] + static_cast<double>(index) * m_Scan->GetSpacing()[axis];
  }

  rhombic::PhantomScan::Pointer m_Scan;
  rhombic::PhantomLabels::Pointer m_Labels;
};

double
Millilitres(const rhombic::ExtractedSurface & extracted)
{
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*extracted.surface).IsWatertight());
  return ComputeTriangleSurfaceVolume(*extracted.surface) / 1000.0;
}

struct Field
{
  const char * name;
  PhantomPoint low;
  PhantomPoint high;
  std::size_t numberCutBySides; ///< of lungs and airway
};

const Field fields[] = {
  { "Chest", chestLow, chestHigh, 0 },
  { "ChestWithCutArms", { -160.0, -144.0, 205.0 }, { 160.0, 136.0, 420.0 }, 0 },
  { "BothSides", { -75.0, -144.0, 205.0 }, { 80.0, 136.0, 420.0 }, 2 },
  { "OneSide", { -75.0, -144.0, 205.0 }, chestHigh, 1 },
  { "Front", { -216.0, -10.0, 205.0 }, chestHigh, 2 },
  { "Back", chestLow, { 216.0, 10.0, 420.0 }, 3 },
  { "CornerInALung", { -216.0, -20.0, 205.0 }, { 80.0, 136.0, 420.0 }, 2 },
  { "CornersInLungs", { -80.0, -30.0, 240.0 }, { 75.0, 30.0, 300.0 }, 2 },
  { "LungsCutAtBothEnds", { -75.0, -144.0, 260.0 }, { 80.0, 136.0, 330.0 }, 2 },
  { "Neck", { -216.0, -144.0, 340.0 }, { 216.0, 136.0, 490.0 }, 0 },
  { "NeckBetweenTheShoulders", { -40.0, -144.0, 340.0 }, { 40.0, 136.0, 490.0 }, 2 },
};

// The air in the body is known from the labels, whatever the scan's sides cut.
TEST(EnclosedParts, AreTheLungsAndTheAirwayInEveryField)
{
  for (const Field & field : fields)
  {
    SCOPED_TRACE(field.name);
    const PhantomCrop crop(field.low, field.high);
    const auto extracted = crop.Extract();
    EXPECT_NEAR(Millilitres(extracted) / crop.LungMillilitres(), 1.0, 0.02);
    const auto & enclosed = extracted.enclosed.value();
    EXPECT_NEAR(enclosed.aroundBody, crop.AirMillilitres(), 0.02 * crop.AirMillilitres());
    EXPECT_EQ(enclosed.numberCutBySides, field.numberCutBySides);
    EXPECT_LT(enclosed.small, 0.02 * crop.LungMillilitres());
    EXPECT_EQ(enclosed.small > 0.0, enclosed.numberOfSmall > 0);
  }
}

TEST(EnclosedParts, EndAtTheBorderOfARoundField)
{
  for (const double padding : { -1000.0, -1024.0, -3024.0 })
  {
    for (const double centreY : { 0.0, -60.0 }) // in the body; with air in front of it
    {
      PhantomCrop crop({ -150.0, -144.0, 230.0 }, { 150.0, 136.0, 320.0 });
      crop.PadOutside(centreY, 85.0, padding);
      const auto extracted = crop.Extract();
      EXPECT_NEAR(Millilitres(extracted) / crop.LungMillilitres(), 1.0, 0.05) << padding << ' ' << centreY;
      EXPECT_NEAR(extracted.enclosed->aroundBody / crop.AirMillilitres(), 1.0, 0.02) << padding << ' ' << centreY;
    }
  }
}

// Images for networks are often clipped, and scanners are not always calibrated.
TEST(EnclosedParts, AreFoundWhereTheAirAroundIsNoLessDense)
{
  for (const double floor : { -940.0, -900.0 })
  {
    for (const PhantomPoint & low : { chestLow, PhantomPoint{ -75.0, -144.0, 205.0 } })
    {
      PhantomCrop crop(low, chestHigh);
      crop.Change([floor](const PhantomPoint &, double value, int) { return std::max(value, floor); });
      const auto extracted = crop.Extract();
      EXPECT_NEAR(Millilitres(extracted) / crop.LungMillilitres(), 1.0, 0.02) << floor;
      EXPECT_NEAR(extracted.enclosed->aroundBody / crop.AirMillilitres(), 1.0, 0.02) << floor;
    }
  }
}

TEST(EnclosedParts, DontMindARoundFieldAroundThem)
{
  PhantomCrop crop(chestLow, chestHigh);
  crop.PadOutside(0.0, 140.0, -3024.0);
  EXPECT_NEAR(Millilitres(crop.Extract()) / crop.LungMillilitres(), 1.0, 0.02);
}

TEST(EnclosedParts, EndAtANarrowOpening)
{
  PhantomCrop crop(chestLow, chestHigh);
  crop.Change([](const PhantomPoint & point, double value, int label) {
    const bool isOpening = std::hypot(point[0] + 69.0, point[2] - 280.0) < 5.0 && point[1] < -20.0;
    return isOpening && rhombic::PhantomOrgans()[static_cast<std::size_t>(std::max(label, 1)) - 1].name != "right lung"
             ? -1000.0
             : value;
  });
  EXPECT_NEAR(Millilitres(crop.Extract()) / crop.LungMillilitres(), 1.0, 0.02);
}

TEST(EnclosedParts, AreNoBlanket)
{
  PhantomCrop crop(chestLow, chestHigh);
  crop.Change([](const PhantomPoint & point, double value, int label) {
    return label == 0 && std::abs(point[0]) < 120.0 && point[1] > -138.0 && point[1] < 0.0 ? -880.0 : value;
  });
  EXPECT_NEAR(Millilitres(crop.Extract()) / crop.LungMillilitres(), 1.0, 0.02);
}

// Foam within a hard shell beside the body: no lung, although only the scan's side closes it.
TEST(EnclosedParts, AreNoPadThatASideCuts)
{
  PhantomCrop crop(chestLow, { 216.0, 136.0, 270.0 });
  crop.Change([](const PhantomPoint & point, double value, int label) {
    const double depth = std::min(point[0] - 176.0, 60.0 - std::abs(point[1]));
    return label != 0 || depth < 0.0 ? value : depth < 4.0 ? 200.0 : -955.0;
  });
  const auto extracted = crop.Extract();
  EXPECT_NEAR(Millilitres(extracted) / crop.LungMillilitres(), 1.0, 0.02);
  EXPECT_EQ(extracted.enclosed->numberCutBySides, 0u);
}

TEST(EnclosedParts, NeedNoHounsfieldUnitsWhereTheCornersAreAir)
{
  PhantomCrop crop({ -75.0, -144.0, 205.0 }, chestHigh);
  crop.Change([](const PhantomPoint &, double value, int) { return value + 1024.0; });
  EXPECT_NEAR(Millilitres(crop.Extract(623.5)) / crop.LungMillilitres(), 1.0, 0.02);
}

TEST(EnclosedParts, NotesSayWhatIsLeftOutAndWhatIsCut)
{
  const PhantomCrop crop({ -75.0, -144.0, 205.0 }, chestHigh);
  std::vector<std::string> notes;
  rhombic::Events events;
  events.note = [&notes](const std::string & line) { notes.push_back(line); };
  const auto extracted = crop.Extract(-400.5, events);
  ASSERT_EQ(notes.size(), 3u);
  const std::string before = "lungs: left out ";
  ASSERT_EQ(notes[0].find(before), 0u) << notes[0];
  EXPECT_NE(notes[0].find(" ml around the body"), std::string::npos) << notes[0];
  EXPECT_NEAR(std::stod(notes[0].substr(before.size())), extracted.enclosed->aroundBody, 0.06);
  EXPECT_EQ(notes[1], "lungs: the sides of the scan cut 1 part; the volume is that within the scan");
}

TEST(EnclosedParts, WhereThereAreNoneItIsSaidWhatIsAround)
{
  const PhantomCrop crop({ -216.0, -144.0, 20.0 }, { 216.0, 136.0, 60.0 }); // hips
  try
  {
    crop.Extract();
    FAIL();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Empty);
    const std::string sentence = failure.GetDescription();
    const std::string before = "Nothing can be extracted for lungs at -400.5 that lies in the body (";
    ASSERT_EQ(sentence.find(before), 0u) << sentence;
    EXPECT_NE(sentence.find(" ml around it are left out)"), std::string::npos) << sentence;
    EXPECT_NEAR(std::stod(sentence.substr(before.size())) / crop.AirMillilitres(), 1.0, 0.02);
  }
}

TEST(OutermostParts, HoldTheBodyWithItsLungs)
{
  const PhantomCrop chest(chestLow, chestHigh);
  const auto skin = chest.ExtractOutline();
  const double body = chest.Millilitres() - chest.AirMillilitres();
  EXPECT_NEAR(itk::ComputeTriangleSurfaceVolume(*skin.surface) / 1000.0,
              body,
              0.02 * body); // voxels count wholly, the threshold is not half way
  EXPECT_EQ(itk::FindTriangleSurfaceComponents(*skin.surface).count, 1u); // no lung, no vessel in it
}

TEST(OutermostParts, HoldLungsThatTopAndBottomCut)
{
  for (const double top : { 300.0, 340.0, 380.0 })
  {
    PhantomPoint high = chestHigh;
    high[2] = top;
    PhantomPoint low = chestLow;
    low[2] = top - 60.0;
    const PhantomCrop slab(low, high);
    ASSERT_GT(slab.LungMillilitres(), 100.0);
    const auto skin = slab.ExtractOutline();
    const double body = slab.Millilitres() - slab.AirMillilitres();
    EXPECT_NEAR(itk::ComputeTriangleSurfaceVolume(*skin.surface) / 1000.0, body, 0.02 * body) << top;
  }
}

} // namespace
