#include "itkBruteForceCrossings.h"
#include "itkExampleCloseSheets.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "rhombicSurfaceFinish.h"

#include <gtest/gtest.h>

namespace
{

using Surface = itk::TriangleSurface;
using itk::example::CloseSheets;
using itk::example::MakeCloseSheets;

/** Expects that no triangles cross, by two searches, and that none touch. */
void
ExpectNoContacts(const Surface & surface)
{
  EXPECT_EQ(bruteforce::CountCrossings(surface), 0u);
  const auto found = FindTriangleSurfaceSelfIntersections(itk::TriangleTree(surface));
  EXPECT_EQ(found.crossingPairs + found.touchingPairs, 0u);
}

void
ExpectNoContactsOfSimplifiedPairs(unsigned int pairsOfKind)
{
  std::size_t before = 0, after = 0;
  for (const CloseSheets kind : { CloseSheets::Spheres, CloseSheets::Tori, CloseSheets::Planes })
  {
    for (unsigned int seed = 0; seed < pairsOfKind; ++seed)
    {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", seed " << seed);
      const auto surface = MakeCloseSheets(kind, seed);
      itk::TriangleSurfaceSimplificationSettings settings;
      settings.targetTriangles = surface->GetNumberOfTriangles() / (3 + seed % 20);
      const auto report = SimplifyTriangleSurface(*surface, settings);
      before += report.trianglesBefore;
      after += report.trianglesAfter;
      ExpectNoContacts(*surface);
    }
  }
  EXPECT_LT(after, before / 2);
}

TEST(TriangleSurfaceCloseSheets, SimplifiedPairsDoNotMeet)
{
  ExpectNoContactsOfSimplifiedPairs(80);
}

/** A thousand with the 250 pairs of walls in itkLabelWallsEditingGTest.cxx. Takes half a minute: the label long. */
TEST(TriangleSurfaceCloseSheets, AThousandPairsDoNotMeet)
{
  ExpectNoContactsOfSimplifiedPairs(250);
}

/** Spheres so close that many collapses are taken back, and triangles come back among those that others have become. */
TEST(TriangleSurfaceCloseSheets, CollapsesTakenBackDoNotCrossOthers)
{
  const std::array<double, 4> radiiGapsShiftsAndTargets[] = {
    { 20.0, 0.13, 0.02, 400 }, { 17.3, 0.06, 0.0, 1500 }, { 23.1, 0.03, 0.0, 400 }, { 23.1, 0.07, 0.0, 3000 }
  };
  for (const auto & [radius, gap, shift, target] : radiiGapsShiftsAndTargets)
  {
    const auto surface = itk::example::MakeSphere(radius, 5);
    const auto inner = itk::example::MakeSphere(radius - gap, 5);
    itk::example::TurnInsideOut(*inner);
    itk::example::Append(*surface, *inner, { static_cast<float>(shift), 0.0f, 0.0f });
    itk::TriangleSurfaceSimplificationSettings settings;
    settings.targetTriangles = static_cast<itk::SizeValueType>(target);
    SimplifyTriangleSurface(*surface, settings);
    SCOPED_TRACE(testing::Message() << "radius " << radius << ", gap " << gap);
    ExpectNoContacts(*surface);
  }
}

/** A plane, and above it a sheet with a step: smoothing rounds the step, and the sheet sags beside it. */
Surface::Pointer
MakeStepOverPlane(double gap, double step)
{
  constexpr std::uint32_t squares = 24;
  const auto surface = itk::example::MakeWavySheet(squares, 1.0, 0.0, gap);
  for (auto & point : surface->GetPoints())
  {
    point[2] += point[0] > squares / 2.0f ? static_cast<float>(step) : 0.0f;
  }
  const auto plane = itk::example::MakeWavySheet(squares, 1.0, 0.0, 0.0);
  itk::example::TurnInsideOut(*plane);
  itk::example::Append(*surface, *plane, { 0.1f, 0.07f, 0.0f });
  return surface;
}

TEST(TriangleSurfaceCloseSheets, SmoothedSheetsDoNotMeet)
{
  for (unsigned int n = 0; n < 100; ++n)
  {
    const double gap = 0.004 * (1 + n % 10);
    const double step = 0.5 + 0.25 * (n / 10);
    SCOPED_TRACE(testing::Message() << "gap " << gap << ", step " << step);
    const auto surface = MakeStepOverPlane(gap, step);
    ASSERT_EQ(bruteforce::CountCrossings(*surface), 0u);
    itk::TriangleSurfaceSmoothingSettings settings;
    settings.maximumMove = 0.5;
    const auto report = SmoothTriangleSurface(*surface, settings);
    EXPECT_GT(report.largestMove, 0.05) << "other points still move";
    ExpectNoContacts(*surface);
  }
}

/** What `rhombic mesh` does to a surface. */
TEST(TriangleSurfaceCloseSheets, FinishedPairsDoNotMeet)
{
  constexpr double spacing = 100.0; // larger than all errors
  for (const CloseSheets kind : { CloseSheets::Spheres, CloseSheets::Tori })
  {
    for (const unsigned int seed : { 3u, 5u, 9u, 72u, 77u, 176u, 195u, 215u, 239u })
    {
      for (const double smoothing : { 0.0, 0.01 })
      {
        const auto surface = MakeCloseSheets(kind, seed);
        ASSERT_EQ(bruteforce::CountCrossings(*surface), 0u);
        rhombic::SurfaceFinish finish;
        finish.smoothing = smoothing;
        finish.maximumTriangles = surface->GetNumberOfTriangles() / (3 + seed % 20);
        SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", seed " << seed);
        const auto refinement = RefineSurface(*surface, finish, spacing, "pair", {});
        EXPECT_FALSE(refinement.untangling);
        EXPECT_LT(surface->GetNumberOfTriangles(), refinement.simplification->triangles.trianglesBefore);
        ExpectNoContacts(*surface);
      }
    }
  }
}

} // namespace
