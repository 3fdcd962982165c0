#include "rhombicFailure.h"
#include "rhombicMeshScan.h"
#include "rhombicScanWriter.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using Parts = rhombic::SurfaceRequest::Parts;

/** The notes of making a surface of a scan from -300.5 on. */
std::string
NotesOf(const rhombic::ScanImage & image, Parts parts)
{
  const rhombictest::TemporaryFolder folder;
  rhombic::MeshScanSettings settings;
  settings.source.path = folder.Path() / "scan.nii";
  rhombic::WriteScan(image, settings.source.path);
  rhombic::SurfaceRequest request;
  request.name = "skin";
  request.isovalue = -300.5;
  request.parts = parts;
  settings.surfaces.requests = { request };
  settings.mesh = folder.Path() / "skin.ply";
  std::string notes;
  rhombic::Events events;
  events.note = [&notes](const std::string & line) { notes += line + '\n'; };
  rhombic::MeshScan(settings, events);
  return notes;
}

/** A block of 90 x 90 x 120 mm in air. If asked, it has a hollow of 50 mm diameter and 90 mm length, from which
 * clefts of 14 mm width lead to three sides; both are as dense as lung. */
rhombic::ScanImage
MakeBlock(bool hasClefts)
{
  using ImageType = itk::Image<std::int16_t, 3>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 70, 70, 40 } });
  const double spacing[3] = { 2.0, 2.0, 4.0 };
  image->SetSpacing(spacing);
  image->Allocate();
  for (std::size_t n = 0; n < image->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    const auto index = image->ComputeIndex(static_cast<itk::OffsetValueType>(n));
    const double x = 2.0 * static_cast<double>(index[0]) - 69.0;
    const double y = 2.0 * static_cast<double>(index[1]) - 69.0;
    const double z = 4.0 * static_cast<double>(index[2]) - 78.0;
    const bool isBlock = std::max(std::abs(x), std::abs(y)) < 45.0 && std::abs(z) < 60.0;
    const bool isCleft = std::abs(y) < 7.0 || (std::abs(x) < 7.0 && y < 0.0);
    const bool isHollow = isBlock && hasClefts && std::abs(z) < 45.0 && (std::hypot(x, y) < 25.0 || isCleft);
    image->GetBufferPointer()[n] = isHollow ? -850 : isBlock ? 40 : -1000;
  }
  return itk::SmartPointer<ImageType>(image);
}

TEST(MeshScan, ScansFarFromTheOriginAreRefused)
{
  const auto block = std::get<itk::Image<std::int16_t, 3>::Pointer>(MakeBlock(false));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    itk::Point<double, 3> origin(0.0);
    origin[axis] = -390'000.0;
    block->SetOrigin(origin);
    EXPECT_NO_THROW(NotesOf(block, Parts::All));
    for (const double far : { 400'100.0, -1e6, 2e6 })
    {
      origin[axis] = far;
      block->SetOrigin(origin);
      try
      {
        NotesOf(block, Parts::All);
        ADD_FAILURE() << far;
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Geometry);
        EXPECT_NE(std::string(failure.GetDescription()).find("from the origin"), std::string::npos);
      }
    }
  }
}

TEST(MeshScan, LatticesThatReachFarFromTheOriginAreRefused)
{
  const auto image = itk::Image<std::int16_t, 3>::New();
  image->SetRegions(itk::Size<3>{ { 2, 3, 4 } });
  image->Allocate(true);
  image->SetPixel({ { 1, 1, 1 } }, 100);
  constexpr double spacing[] = { 131072.0, 1.5, 2.5 }; // the voxels reach to 87,381 times the smallest edge
  image->SetSpacing(spacing);
  EXPECT_THROW(NotesOf(image, Parts::All), rhombic::Failure);
}

TEST(MeshNotes, SayWhereAnOutlineFillsAHollow)
{
  const std::string filled = NotesOf(MakeBlock(true), Parts::Outermost);
  EXPECT_NE(filled.find("within two voxels (an outline also runs across filled hollows)"), std::string::npos) << filled;
  EXPECT_EQ(filled.find("--density"), std::string::npos) << "a denser lattice changes nothing there\n" << filled;
}

TEST(MeshNotes, SayNothingOfHollowsWithoutOne)
{
  for (const auto & notes : { NotesOf(MakeBlock(false), Parts::Outermost), NotesOf(MakeBlock(true), Parts::All) })
  {
    EXPECT_NE(notes.find("from the scan's isosurface"), std::string::npos) << notes;
    EXPECT_EQ(notes.find("hollow"), std::string::npos) << notes;
    EXPECT_EQ(notes.find("no isosurface"), std::string::npos) << notes;
  }
}

} // namespace
